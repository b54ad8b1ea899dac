"use strict";
const [setting] = JSON.parse(document.getElementById("setting").textContent);
const by = (id) => document.getElementById(id);
const values = {};
let moment = null;
// One question is under way at a time; of those that come meanwhile the newest alone is asked.
let busy = false;
let waiting = null;
let resting = 0;
const drawn = [];

const STEPS = 1000;
const part = (slider, value) => slider.logarithmic
  ? Math.log(value / slider.low) / Math.log(slider.high / slider.low)
  : (value - slider.low) / (slider.high - slider.low);
const valueAt = (slider, part) => {
  const value = slider.logarithmic ? slider.low * Math.pow(slider.high / slider.low, part) : slider.low + part * (slider.high - slider.low);
  return Number(value.toPrecision(4));
};
const printed = (value) => (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6) ? value.toExponential() : String(value));

const asked = () => ({ values: { ...values }, moment });
const post = async (what, question) => {
  const answer = await fetch(what, { method: "POST", body: JSON.stringify(question) });
  if (!answer.ok) throw new Error(String(answer.status));
  return answer.json();
};
const trouble = (words) => {
  by("trouble").textContent = words;
  by("trouble").hidden = !words;
  document.querySelector(".seen .figures").classList.toggle("stale", Boolean(words));
};
const put = (answer) => {
  if (answer.status === "superseded") return false;
  if (answer.status !== "solved") {
    trouble(answer.message);
    return false;
  }
  trouble("");
  for (const [name, drawing] of Object.entries(answer.figures)) {
    by(name).innerHTML = drawing;
    by("figure-" + name).hidden = !drawing;
  }
  for (const [id, name, value] of answer.numbers) {
    let card = by("card-" + id);
    if (!card) {
      card = document.createElement("div");
      card.id = "card-" + id;
      card.append(document.createElement("dt"), document.createElement("dd"));
      by("numbers").append(card);
    }
    card.firstChild.textContent = name;
    card.lastChild.textContent = value;
  }
  return true;
};

async function next() {
  busy = true;
  try {
    while (waiting) {
      const question = waiting;
      waiting = null;
      const answer = await post("solve", question);
      if (!put(answer)) continue;
      for (const name of ["zones", "pressure", "section"]) if (!(name in answer.figures)) by("figure-" + name).hidden = true;
      by("moment").max = answer.moments - 1;
      by("moment").value = answer.moment;
      const now = performance.now();
      drawn.push(now);
      while (drawn[0] < now - 1000) drawn.shift();
      by("status").textContent = `solved in ${Math.round(1000 * answer.solve_s)} ms on ${answer.raw.cells.join(" x ")} cells` + (drawn.length > 2 ? `, ${drawn.length} a second` : "");
    }
    clearTimeout(resting);
    resting = setTimeout(rest, 150);
  } catch {
    trouble("fret explore has ended: start it again for another page.");
  }
  busy = false;
}
const ask = () => {
  waiting = asked();
  by("stress").classList.add("stale");
  if (!busy) next();
};
// The stress below takes longer, and is asked for when the sliders rest.
async function rest() {
  if (busy) return;
  const question = asked();
  const now = JSON.stringify(question);
  try {
    const answer = await post("stress", question);
    if (now === JSON.stringify(asked()) && put(answer)) by("stress").classList.remove("stale");
  } catch {
    trouble("fret explore has ended: start it again for another page.");
  }
}

setting.sliders.forEach((slider, place) => {
  const [range, number] = [by("slider-" + place), by("number-" + place)];
  const show = (value) => {
    range.value = Math.round(STEPS * part(slider, value));
    range.setAttribute("aria-valuetext", printed(value) + (slider.unit ? " " + slider.unit : ""));
    number.value = printed(value);
    range.parentElement.classList.toggle("moved", value !== slider.value);
  };
  const set = (value) => {
    if (value === slider.value) delete values[slider.key];
    else values[slider.key] = value;
    ask();
  };
  range.addEventListener("input", () => {
    const value = valueAt(slider, range.value / STEPS);
    set(value);
    number.value = printed(value);
    range.setAttribute("aria-valuetext", printed(value) + (slider.unit ? " " + slider.unit : ""));
    range.parentElement.classList.toggle("moved", value !== slider.value);
  });
  number.addEventListener("change", () => {
    const value = number.value === "" ? slider.value : Number(number.value);
    if (Number.isFinite(value)) { set(value); show(value); }
  });
  slider.show = show;
  show(slider.value);
});
by("moment").addEventListener("input", () => { moment = Number(by("moment").value); ask(); });
by("reset").addEventListener("click", () => {
  for (const key of Object.keys(values)) delete values[key];
  moment = null;
  for (const slider of setting.sliders) slider.show(slider.value);
  ask();
});
const write = async (written, name) => {
  let answer;
  do answer = await post("case", { ...asked(), written }); while (answer.status === "superseded");
  if (answer.status !== "written") return trouble(answer.message);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([answer.text], { type: "text/plain" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
};
by("write").addEventListener("click", () => write("own", setting.name + "-explored.toml"));
by("write-shown").addEventListener("click", () => write("shown", setting.name + "-shown.toml"));
by("sliders").addEventListener("submit", (event) => event.preventDefault());
ask();
