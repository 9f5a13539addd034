// What each effect costs, while the cloth runs.

import { drawStack } from "./plots.js";

const find = (id) => document.getElementById(id);
const SERIES = 12;
// An effect without a time of its own acts in the solve.
const STAGES = { solve: "solve, with contact and friction" };

export class Costs {
  #change;
  #rows = new Map(); // From an effect's name to the parts of its row.
  #off = new Set();
  #before = null;
  #history = [];
  #sums = { times: {}, steps: 0, drawn: 0 };
  #typical = null; // Before the last switch.
  #switched = null;

  /** `change(off)` makes the scene again without the effects in the list. */
  constructor(change) {
    this.#change = change;
  }

  get off() { return [...this.#off]; }

  /** Begins with another scene. */
  forget() {
    this.#rows.clear();
    this.#off.clear();
    this.#typical = null;
    this.#switched = null;
    find("effects").tBodies[0].replaceChildren();
    find("saved").textContent = "";
  }

  begin(state) {
    const names = [...Object.keys(state.effectSeconds)];
    for (const name of names) if (!this.#rows.has(name)) this.#addRow(name, true);
    for (const name of Object.keys(state.stageSeconds)) if (!this.#rows.has(name)) this.#addRow(name, false);
    this.#before = state;
    this.#history = [];
    this.#sums = { times: {}, steps: 0, drawn: performance.now() };
  }

  #addRow(name, isEffect) {
    const row = find("effects").tBodies[0].insertRow();
    const head = row.appendChild(Object.assign(document.createElement("th"), { scope: "row" }));
    const label = document.createElement(isEffect ? "label" : "span");
    if (isEffect) {
      const input = Object.assign(document.createElement("input"), { type: "checkbox", checked: true });
      input.dataset.effect = name;
      input.addEventListener("change", () => this.#toggle(name, input.checked));
      label.append(input);
    }
    const swatch = Object.assign(document.createElement("span"), { className: "swatch" });
    swatch.style.background = this.#colour(name, this.#rows.size);
    label.append(swatch, isEffect ? name.replaceAll("_", " ") : STAGES[name] ?? `contact: ${name}`);
    head.append(label);
    const number = row.insertCell();
    number.textContent = "–";
    const bar = row.insertCell().appendChild(Object.assign(document.createElement("span"), { className: "bar" }));
    bar.style.setProperty("--share", 0);
    this.#rows.set(name, { row, number, bar, index: this.#rows.size });
  }

  #colour(name, index = this.#rows.get(name).index) {
    return `var(--series-${index % SERIES})`;
  }

  async #toggle(name, isOn) {
    this.#typical = this.#mean();
    this.#switched = { name, isOn };
    if (isOn) this.#off.delete(name);
    else this.#off.add(name);
    await this.#change(this.off);
    for (const [effect, { row }] of this.#rows) row.classList.toggle("off", this.#off.has(effect));
  }

  /** Returns the mean time of a step over what the chart shows, in microseconds. */
  #mean() {
    const totals = this.#history.map((times) => Object.values(times).reduce((sum, time) => sum + time, 0));
    return totals.length ? totals.reduce((sum, time) => sum + time, 0) / totals.length : null;
  }

  /** Adds the times of some steps. The numbers change four times a second, so that they can be read. */
  add(state) {
    const now = { ...state.effectSeconds, ...state.stageSeconds };
    const then = { ...this.#before.effectSeconds, ...this.#before.stageSeconds };
    this.#before = state;
    for (const [name, seconds] of Object.entries(now)) {
      this.#sums.times[name] = (this.#sums.times[name] ?? 0) + 1e6 * (seconds - (then[name] ?? 0));
    }
    this.#sums.steps += state.done;
    if (performance.now() - this.#sums.drawn < 250) return;
    const times = Object.fromEntries(Object.entries(this.#sums.times).map(([name, sum]) => [name, Math.max(0, sum / this.#sums.steps)]));
    this.#sums = { times: {}, steps: 0, drawn: performance.now() };
    this.#history = [...this.#history, times].slice(-60);
    this.#draw(times);
  }

  #draw(times) {
    const largest = Math.max(...Object.values(times), 1e-9);
    for (const [name, { number, bar, row }] of this.#rows) {
      const isOff = !(name in times);
      row.classList.toggle("off", isOff);
      number.textContent = isOff ? "0 (off)" : times[name] > 0 ? times[name].toFixed(1) : "–";
      bar.style.setProperty("--share", isOff ? 0 : times[name] / largest);
    }
    drawStack(find("history"), this.#history, [...this.#rows.keys()], (name) => this.#colour(name), "µs");
    if (this.#switched && this.#typical && this.#history.length > 3) {
      const mean = this.#mean();
      const { name, isOn } = this.#switched;
      find("saved").textContent = `With ${name.replaceAll("_", " ")} ${isOn ? "on" : "off"}, a step takes ${mean.toFixed(0)} µs; before it took ${this.#typical.toFixed(0)} µs.`;
    }
  }
}
