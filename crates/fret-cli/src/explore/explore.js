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
  for (const part of [document.querySelector(".seen .figures"), by("numbers")]) part.classList.toggle("stale", Boolean(words));
};
// Whether what is seen still waits for an answer: readers of the screen are told, and tests wait for it.
const awaited = (is) => document.querySelector(".seen").setAttribute("aria-busy", String(is));
const failed = (error) => {
  trouble(error instanceof TypeError
    ? "fret explore has ended: start it again for another page."
    : `This was not answered: ${error.message}. "As in the case" starts again.`);
  awaited(false);
};
const cards = (of) => by("numbers").querySelectorAll(`[data-of="${of}"]`);
// What a question of a kind has told: its figures and numbers take the place of those before.
const put = (answer, of) => {
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
      card.dataset.of = of;
      card.append(document.createElement("dt"), document.createElement("dd"));
      by("numbers").append(card);
    }
    card.classList.remove("stale");
    card.firstChild.textContent = name;
    card.lastChild.textContent = value;
  }
  const told = answer.numbers.map(([id]) => "card-" + id);
  for (const card of cards(of)) if (!told.includes(card.id)) card.remove();
  return true;
};

async function next() {
  busy = true;
  try {
    while (waiting) {
      const question = waiting;
      waiting = null;
      const answer = await post("solve", question);
      if (answer.status === "superseded") { waiting ??= question; continue; }
      if (!put(answer, "solve")) continue;
      for (const name of ["zones", "pressure", "section"]) if (!(name in answer.figures)) by("figure-" + name).hidden = true;
      by("moment").max = answer.moments - 1;
      if (document.activeElement !== by("moment")) by("moment").value = answer.moment;
      by("moment").setAttribute("aria-valuetext", `${answer.moment + 1} of ${answer.moments}`);
      const now = performance.now();
      drawn.push(now);
      while (drawn[0] < now - 1000) drawn.shift();
      by("status").textContent = `solved in ${Math.round(1000 * answer.solve_s)} ms on ${answer.raw.cells.join(" x ")} cells` + (drawn.length > 2 ? `, ${drawn.length} a second` : "");
    }
    clearTimeout(resting);
    resting = setTimeout(rest, 150);
  } catch (error) {
    failed(error);
  }
  busy = false;
}
const ask = () => {
  waiting = asked();
  awaited(true);
  for (const part of [by("stress"), ...cards("stress")]) part.classList.add("stale");
  if (!busy) next();
};
// The stress below takes longer, and is asked for when the sliders rest.
async function rest() {
  if (busy) return;
  const question = asked();
  const now = JSON.stringify(question);
  try {
    const answer = await post("stress", question);
    if (answer.status === "superseded") { resting = setTimeout(rest, 150); return; }
    if (busy || now !== JSON.stringify(asked())) return;
    if (put(answer, "stress")) by("stress").classList.remove("stale");
    awaited(false);
  } catch (error) {
    failed(error);
  }
}

setting.sliders.forEach((slider, place) => {
  const [range, number] = [by("slider-" + place), by("number-" + place)];
  const show = (value) => {
    const place = part(slider, value);
    range.value = Math.round(STEPS * Math.min(Math.max(Number.isFinite(place) ? place : 0, 0), 1));
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
  try {
    do answer = await post("case", { ...asked(), written }); while (answer.status === "superseded");
  } catch (error) {
    return failed(error);
  }
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
