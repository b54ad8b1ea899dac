"use strict";
// The slider: an entry of `moments` says for every element, by its id, which attributes or which text it has then.
const held = document.getElementById("moments");
if (held) {
  const moments = JSON.parse(held.textContent);
  const slider = document.getElementById("moment");
  const play = document.getElementById("play");
  let timer = 0;
  const show = () => {
    for (const [id, changes] of Object.entries(moments[slider.value])) {
      const element = document.getElementById(id);
      if (!element) continue;
      for (const [name, value] of Object.entries(changes)) {
        if (name === "text") element.textContent = value;
        else element.setAttribute(name, value);
      }
    }
    slider.setAttribute("aria-valuetext", document.getElementById("word-increment").textContent);
  };
  const stop = () => { clearInterval(timer); timer = 0; play.textContent = "▶"; play.setAttribute("aria-label", "play"); };
  play.addEventListener("click", () => {
    if (timer) return stop();
    play.textContent = "❚❚";
    play.setAttribute("aria-label", "pause");
    timer = setInterval(() => { slider.value = (Number(slider.value) + 1) % moments.length; show(); }, 180);
  });
  slider.addEventListener("input", () => { stop(); show(); });
  document.getElementById("slider").hidden = false;
  show();
}
// A pointer over a chart reads its nearest point.
for (const svg of document.querySelectorAll("svg[data-axes]")) {
  const [left, right, lower, upper, x0, x1, y0, y1, logarithmic] = JSON.parse(svg.dataset.axes);
  const add = (name, attributes) => {
    const element = document.createElementNS(svg.namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.style.display = "none";
    return svg.appendChild(element);
  };
  const ring = add("circle", { class: "ring", r: 4.5 });
  const words = add("text", { class: "readout", x: right, y: 12, "text-anchor": "end" });
  const printed = (value) => String(Number(value.toPrecision(4))).replace(/-/g, "−");
  const points = () => {
    const found = [];
    for (const path of svg.querySelectorAll("path.line"))
      for (const [, x, y] of (path.getAttribute("d") || "").matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)) found.push([Number(x), Number(y)]);
    for (const dot of svg.querySelectorAll("circle.dot")) found.push([Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))]);
    return found;
  };
  svg.addEventListener("pointermove", (event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    let best = null;
    let distance = Infinity;
    for (const point of points()) {
      const away = Math.hypot(point[0] - at.x, point[1] - at.y);
      if (away < distance) [best, distance] = [point, away];
    }
    if (!best) return;
    const part = (best[1] - lower) / (upper - lower);
    const x = x0 + (best[0] - left) / (right - left) * (x1 - x0);
    const y = logarithmic ? y0 * Math.pow(y1 / y0, part) : y0 + part * (y1 - y0);
    words.textContent = printed(x) + ", " + printed(y);
    ring.setAttribute("cx", best[0]);
    ring.setAttribute("cy", best[1]);
    for (const element of [ring, words]) element.style.display = "";
  });
  svg.addEventListener("pointerleave", () => { for (const element of [ring, words]) element.style.display = "none"; });
}
