// Loop and field of a history beside each other, with a slider over the increments whose fields are kept. Python says what is drawn:
// `setting` does not change, `seen` belongs to the place of the slider and the field.
const SIDE = 240;
const ROOM = { left: 66, right: 8, top: 8, bottom: 40 };

const make = (kind, parent, words = "") => {
  const made = document.createElement(kind);
  made.textContent = words;
  parent.append(made);
  return made;
};
const draw = (kind, parent, marks, words = "") => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", kind);
  for (const [name, value] of Object.entries(marks)) made.setAttribute(name, value);
  made.textContent = words;
  parent.append(made);
  return made;
};
const printed = (value) => {
  const rounded = Number(value.toPrecision(3));
  return rounded !== 0 && Math.abs(rounded) < 1e-3 ? rounded.toExponential() : String(rounded);
};
const reach = (values) => {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const room = (high - low || Math.abs(high) || 1) * 0.05;
  return [low - room, high + room];
};

// Axes with the ends of their ranges and their labels; returns what puts a point in its place.
const frame = (picture, [x0, x1], [y0, y1], [across, up], width, height) => {
  const [left, top, right, bottom] = [ROOM.left, ROOM.top, ROOM.left + width, ROOM.top + height];
  picture.setAttribute("viewBox", `0 0 ${right + ROOM.right} ${bottom + ROOM.bottom}`);
  const box = { x: left, y: top, width, height, fill: "none", stroke: "currentColor", "stroke-width": 0.7 };
  draw("rect", picture, box);
  const small = { fill: "currentColor", "font-size": 10.5 };
  draw("text", picture, { ...small, x: left, y: bottom + 13 }, printed(x0));
  draw("text", picture, { ...small, x: right, y: bottom + 13, "text-anchor": "end" }, printed(x1));
  draw("text", picture, { ...small, x: (left + right) / 2, y: bottom + 30, "text-anchor": "middle" }, across);
  draw("text", picture, { ...small, x: left - 4, y: bottom, "text-anchor": "end" }, printed(y0));
  draw("text", picture, { ...small, x: left - 4, y: top + 9, "text-anchor": "end" }, printed(y1));
  const turned = `translate(12 ${(top + bottom) / 2}) rotate(-90)`;
  draw("text", picture, { ...small, transform: turned, "text-anchor": "middle" }, up);
  return ([x, y]) => [left + ((x - x0) / (x1 - x0)) * width, bottom - ((y - y0) / (y1 - y0)) * height];
};
const line = (picture, points, place, colour) => {
  const way = points.map((point) => place(point).map((part) => part.toFixed(1)).join(",")).join(" ");
  draw("polyline", picture, { points: way, fill: "none", stroke: colour, "stroke-width": 1.6, "stroke-linejoin": "round" });
};
const picture = (parent, name) => {
  const made = draw("svg", parent, { role: "img", "aria-label": name });
  made.style.cssText = "flex: 1 1 15rem; max-width: 22rem; min-width: 0";
  return made;
};

export default {
  render({ model, el }) {
    const setting = model.get("setting");
    // Keys belong to slider and choice while they have the focus: JupyterLab would take arrows for the way from cell to cell.
    el.dataset.lmSuppressShortcuts = "true";
    el.addEventListener("keydown", (event) => event.stopPropagation());
    const head = make("div", el);
    head.style.cssText = "display: flex; flex-wrap: wrap; gap: .4rem 1rem; align-items: center";
    const label = make("label", head, "increment ");
    const slider = make("input", label);
    Object.assign(slider, { type: "range", min: 0, max: setting.kept.length - 1, step: 1 });
    const told = make("output", head);
    const choice = make("select", make("label", head, "field "));
    for (const name of setting.fields) make("option", choice, name.replaceAll("_", " ")).value = name;
    const figures = make("div", el);
    figures.style.cssText = "display: flex; flex-wrap: wrap; gap: .6rem; align-items: flex-start";
    const loop = picture(figures, "path of the load");
    const field = picture(figures, "field");
    const numbers = make("div", el);
    numbers.style.cssText = "display: flex; flex-wrap: wrap; gap: .2rem 1.4rem; font-variant-numeric: tabular-nums";

    const place = frame(loop, reach(setting.path.map(([x]) => x)), reach(setting.path.map(([, y]) => y)), setting.axes, SIDE, SIDE);
    line(loop, setting.path, place, setting.colours.line);
    const here = draw("circle", loop, { r: 4.5, fill: setting.colours.here });

    const show = () => {
      const seen = model.get("seen");
      slider.value = model.get("place");
      choice.value = model.get("field");
      told.textContent = `${seen.increment} (${setting.stages[seen.stage]})`;
      slider.setAttribute("aria-valuetext", told.textContent);
      const [x, y] = place(seen.here);
      here.setAttribute("cx", x.toFixed(1));
      here.setAttribute("cy", y.toFixed(1));
      field.replaceChildren();
      field.setAttribute("aria-label", seen.name);
      if (seen.line) {
        const at = frame(field, setting.x, seen.range, [setting.lengths[0], seen.name], SIDE, SIDE);
        line(field, seen.line, at, setting.colours.line);
      } else {
        const [width, height] = setting.cells;
        const tall = Math.min(SIDE * 2, (SIDE * (setting.y[1] - setting.y[0])) / (setting.x[1] - setting.x[0]));
        frame(field, setting.x, setting.y, setting.lengths, SIDE, tall);
        const cells = document.createElement("canvas");
        Object.assign(cells, { width, height });
        const { buffer, byteOffset, byteLength } = seen.colours;
        const bytes = new Uint8ClampedArray(buffer.slice(byteOffset, byteOffset + byteLength));
        cells.getContext("2d").putImageData(new ImageData(bytes, width, height), 0, 0);
        const where = { x: ROOM.left, y: ROOM.top, width: SIDE, height: tall, preserveAspectRatio: "none", href: cells.toDataURL() };
        draw("image", field, where).style.imageRendering = "pixelated";
      }
      numbers.replaceChildren();
      for (const [name, value] of [...seen.legend, ...seen.numbers]) {
        const entry = make("span", numbers, `${name} `);
        if (value.startsWith("#")) entry.prepend(Object.assign(make("span", entry, "■ "), { style: `color: ${value}` }));
        else make("strong", entry, value);
      }
    };
    slider.addEventListener("input", () => {
      model.set("place", Number(slider.value));
      model.save_changes();
    });
    choice.addEventListener("change", () => {
      model.set("field", choice.value);
      model.save_changes();
    });
    model.on("change:seen", show);
    show();
    return () => model.off("change:seen", show);
  },
};
