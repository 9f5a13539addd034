// The first experiment: one pair of primitives, and what each test says about it.

import { MISSED } from "./missed.js";
import { drawBars, drawCubic } from "./plots.js";

const find = (id) => document.getElementById(id);
const NAMES = { "vertex-face": ["vertex", "corner a", "corner b", "corner c"], "edge-edge": ["edge 1, from", "edge 1, to", "edge 2, from", "edge 2, to"] };
const SHORT = { "vertex-face": ["p", "a", "b", "c"], "edge-edge": ["a", "b", "c", "d"] };

export function startPair(selvedge) {
  const cases = [...MISSED, ...selvedge.hardCases()];
  const pair = { kind: "vertex-face", start: new Float64Array(12), end: new Float64Array(12), known: null };
  const view = { yaw: 0.5, pitch: 0.35, time: 0, scale: 1, centre: [0, 0, 0] };
  const svg = find("pair-view");

  const isWrong = (one) => {
    const { filterCulls, cubicTime } = selvedge.publishedVerdicts(one.kind, one.start, one.end);
    const touches = one.exact !== "never" && one.exact !== "undefined";
    return { filter: filterCulls && touches, cubic: touches === (cubicTime === undefined) };
  };
  const named = (list) => [...new Set(list.map((one) => `${one.name}, ${one.kind}`))].map((name) => [name, `name ${name}`]);
  const known = cases.slice(MISSED.length);
  const group = (label, entries) => {
    const element = find("case").appendChild(document.createElement("optgroup"));
    element.label = label;
    for (const [text, value] of entries) element.append(new Option(text, value));
  };
  group("start here", [["a vertex falls onto a face", `case ${MISSED.length}`]]);
  group("the paper's filter misses a contact", MISSED.map((one, i) => [one.name, `case ${i}`]));
  group("the plain cubic is wrong", named(known.filter((one) => isWrong(one).cubic)));
  group("other hard cases", named(known.filter((one) => !known.some((other) => other.name === one.name && isWrong(other).cubic))));

  function choose() {
    const value = find("case").value;
    const [kind, ...rest] = value.split(" ");
    const name = rest.join(" ");
    const isChosen = (one) => `${one.name}, ${one.kind}` === name;
    const placements = kind === "case" ? [cases[Number(name)]] : cases.filter(isChosen);
    find("placement").replaceChildren(...placements.map((one) => {
      const wrong = isWrong(one);
      const note = wrong.filter ? " – filter wrong" : wrong.cubic ? " – cubic wrong" : "";
      return new Option(one.placement + note, cases.indexOf(one));
    }));
    // The first place at which a published test is wrong says most.
    const worst = placements.find((one) => isWrong(one).filter) ?? placements.find((one) => isWrong(one).cubic) ?? placements[0];
    find("placement").value = cases.indexOf(worst);
    load();
  }

  function load() {
    const one = cases[Number(find("placement").value)];
    pair.kind = one.kind;
    pair.start = one.start.slice();
    pair.end = one.end.slice();
    pair.known = one;
    fit();
    makeInputs();
    update();
  }

  /** Chooses the scale at which all eight points are in view. */
  function fit() {
    const all = [...pair.start, ...pair.end].map((x) => (Number.isFinite(x) ? x : 0));
    const low = [0, 1, 2].map((i) => Math.min(...all.filter((_, k) => k % 3 === i)));
    const high = [0, 1, 2].map((i) => Math.max(...all.filter((_, k) => k % 3 === i)));
    view.centre = low.map((x, i) => 0.5 * (x + high[i]));
    view.scale = 62 / Math.max(0.5 * Math.hypot(...low.map((x, i) => high[i] - x)), 1e-300);
  }

  const axes = () => {
    const [s, c, t, d] = [Math.sin(view.yaw), Math.cos(view.yaw), Math.sin(view.pitch), Math.cos(view.pitch)];
    return { across: [c, -s, 0], up: [s * t, c * t, d] };
  };
  const project = (p) => {
    const { across, up } = axes();
    const q = p.map((x, i) => (Number.isFinite(x) ? (x - view.centre[i]) * view.scale : 0));
    const along = (axis) => axis[0] * q[0] + axis[1] * q[1] + axis[2] * q[2];
    return [along(across), -along(up)];
  };
  const at = (frame, point) => [...pair[frame].subarray(3 * point, 3 * point + 3)];
  const between = (point, time) => at("start", point).map((x, i) => x + (at("end", point)[i] - x) * time);

  function drawScene() {
    const shape = (time) => {
      const points = [0, 1, 2, 3].map((point) => project(between(point, time)));
      return pair.kind === "vertex-face" ? [points.slice(1), points.slice(0, 1)] : [points.slice(0, 2), points.slice(2)];
    };
    const path = (points, style) => points.length < 2 ? "" : `<polygon points="${points.map((p) => p.join()).join(" ")}" ${style}/>`;
    const drawn = [];
    for (const [time, opacity] of [[0, 0.18], [1, 0.18], [view.time, 0.75]]) {
      const [first, second] = shape(time);
      drawn.push(path(first, `fill="var(--cloth-0)" fill-opacity="${opacity}" stroke="var(--cloth-0)" stroke-width="1.4" stroke-linejoin="round"`));
      drawn.push(path(second, `fill="none" stroke="var(--series-5)" stroke-opacity="${Math.min(1, opacity + 0.2)}" stroke-width="1.4"`));
    }
    for (let point = 0; point < 4; point++) {
      const [x0, y0] = project(at("start", point)), [x1, y1] = project(at("end", point));
      drawn.push(`<line x1="${x0}" y1="${y0}" x2="${x1}" y2="${y1}" stroke="var(--faint)" stroke-width="0.6" stroke-dasharray="2 2"/>`);
      const [x, y] = project(between(point, view.time));
      drawn.push(`<circle cx="${x}" cy="${y}" r="2" fill="var(--ink)"/>`);
    }
    svg.querySelector(".shapes").innerHTML = drawn.join("");
    for (const handle of svg.querySelectorAll(".point")) {
      const { frame, point } = handle.dataset;
      const [x, y] = project(at(frame, Number(point)));
      handle.setAttribute("transform", `translate(${x} ${y})`);
      // Where a point rests, its two names would hide each other.
      const [u, v] = project(at(frame === "start" ? "end" : "start", Number(point)));
      const rests = Math.hypot(x - u, y - v) < 5;
      handle.querySelector("text").textContent = SHORT[pair.kind][point] + (rests ? "" : frame === "start" ? "₀" : "₁");
      handle.querySelector("text").setAttribute("visibility", rests && frame === "start" ? "hidden" : "visible");
    }
  }

  function makeHandles() {
    svg.innerHTML = '<g class="shapes"></g>';
    for (const frame of ["start", "end"]) {
      for (let point = 0; point < 4; point++) {
        const handle = document.createElementNS("http://www.w3.org/2000/svg", "g");
        handle.classList.add("point");
        Object.assign(handle.dataset, { frame, point });
        handle.tabIndex = 0;
        handle.setAttribute("role", "button");
        const isMoving = point === 0 ? "var(--series-5)" : "var(--cloth-0)";
        const fill = frame === "start" ? "var(--card)" : isMoving;
        handle.innerHTML = `<circle r="9" fill="transparent"/><circle r="3.6" fill="${fill}" stroke="${isMoving}" stroke-width="1.4"/><text x="5" y="-4" font-size="7" fill="var(--ink)"></text>`;
        svg.append(handle);
      }
    }
  }

  /** Moves a point in the plane of the view, or towards the reader. */
  function move(frame, point, across, up, towards = 0) {
    const { across: a, up: u } = axes();
    const out = [a[1] * u[2] - a[2] * u[1], a[2] * u[0] - a[0] * u[2], a[0] * u[1] - a[1] * u[0]];
    for (let i = 0; i < 3; i++) pair[frame][3 * point + i] += (a[i] * across + u[i] * up + out[i] * towards) / view.scale;
    pair.known = null;
    writeInputs();
    update();
  }

  function listen() {
    let dragged = null;
    svg.addEventListener("pointerdown", (event) => {
      const handle = event.target.closest(".point");
      dragged = { handle, x: event.clientX, y: event.clientY };
      svg.setPointerCapture(event.pointerId);
      handle?.focus({ preventScroll: true });
      event.preventDefault();
    });
    svg.addEventListener("pointermove", (event) => {
      if (!dragged) return;
      const unit = 200 / svg.clientWidth;
      const [dx, dy] = [(event.clientX - dragged.x) * unit, (event.clientY - dragged.y) * unit];
      Object.assign(dragged, { x: event.clientX, y: event.clientY });
      if (dragged.handle) return move(dragged.handle.dataset.frame, Number(dragged.handle.dataset.point), dx, -dy);
      view.yaw += dx * 0.015;
      view.pitch = Math.max(-1.5, Math.min(1.5, view.pitch + dy * 0.015));
      drawScene();
    });
    for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, () => { dragged = null; });
    svg.addEventListener("keydown", (event) => {
      const handle = event.target.closest(".point");
      const size = event.shiftKey ? 0.25 : 3;
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [0, 0, -1], PageDown: [0, 0, 1] }[event.key];
      if (!handle || !way) return;
      move(handle.dataset.frame, Number(handle.dataset.point), ...way.map((x) => x * size));
      event.preventDefault();
    });
    const turn = (by) => { view.yaw += by; drawScene(); };
    find("turn-left").addEventListener("click", () => turn(-0.25));
    find("turn-right").addEventListener("click", () => turn(0.25));
    find("moment").addEventListener("input", (event) => { view.time = Number(event.target.value); update(); });
    find("case").addEventListener("change", choose);
    find("placement").addEventListener("change", load);
    let playing = null;
    const tick = (now) => {
      if (playing === null) return;
      view.time = Math.min(1, (now - playing) / 2500);
      find("moment").value = view.time;
      update();
      if (view.time < 1) requestAnimationFrame(tick); else playing = null;
    };
    find("pair-play").addEventListener("click", () => {
      playing = playing === null ? performance.now() : null;
      requestAnimationFrame(tick);
    });
  }

  function makeInputs() {
    const rows = NAMES[pair.kind].map((name, point) => {
      const row = document.createElement("tr");
      row.append(Object.assign(document.createElement("th"), { textContent: name, scope: "row" }));
      for (const frame of ["start", "end"]) {
        for (const i of [0, 1, 2]) {
          const input = document.createElement("input");
          Object.assign(input.dataset, { frame, index: 3 * point + i });
          input.setAttribute("aria-label", `${name}, ${frame}, ${"xyz"[i]}`);
          input.addEventListener("change", () => {
            pair[frame][3 * point + i] = input.value.trim() === "" ? NaN : Number(input.value);
            pair.known = null;
            fit();
            update();
          });
          row.appendChild(document.createElement("td")).append(input);
        }
      }
      return row;
    });
    find("coordinates").tBodies[0].replaceChildren(...rows);
    for (const handle of svg.querySelectorAll(".point")) {
      const { frame, point } = handle.dataset;
      handle.setAttribute("aria-label", `${SHORT[pair.kind][point]}${frame === "start" ? "₀" : "₁"}, ${NAMES[pair.kind][point]} at the ${frame}; arrow keys move it, Page Up and Page Down too`);
    }
    writeInputs();
  }

  function writeInputs() {
    for (const input of find("coordinates").querySelectorAll("input")) input.value = String(pair[input.dataset.frame][input.dataset.index]);
  }

  function update() {
    drawScene();
    const { kind, start, end } = pair;
    const certain = selvedge.pairVerdicts(kind, start, end);
    const published = selvedge.publishedVerdicts(kind, start, end);
    const touches = certain.contact !== "never";
    const filter = (culls) => [culls ? "drops the pair" : "keeps the pair", culls && touches ? "wrong" : culls || touches ? "right" : "keeps"];
    const time = (t) => Number(t.toPrecision(12));
    const rows = [
      ["swept boxes", ...filter(certain.culledBy.sweptBoxes)],
      ["path against box", ...filter(certain.culledBy.segmentBox)],
      ["relative boxes", ...filter(certain.culledBy.relativeBoxes)],
      ["the paper's filter, as printed", ...filter(published.filterCulls)],
      ["certified filter", ...filter(certain.culledBy.permanent)],
      ["certified, then in integers", ...filter(certain.culledBy.exact)],
      ["plain cubic (Provot)", published.cubicTime === undefined ? "no contact" : `contact at ${time(published.cubicTime)}`,
        (published.cubicTime === undefined) === touches ? "wrong" : "right"],
      ["certified time of impact", certain.time === undefined ? "never" : `not before ${time(certain.time)}`, certain.time === undefined || touches ? "right" : "keeps"],
      ["exact verdict", { never: "never touches", happens: "touches", undefined: "undefined: not finite" }[certain.contact], ""],
    ];
    const marks = { right: "✓ right", wrong: "✗ wrong", keeps: "not proven", "": "" };
    find("verdicts").tBodies[0].replaceChildren(...rows.map(([test, says, mark]) => {
      const row = document.createElement("tr");
      row.append(Object.assign(document.createElement("th"), { textContent: test, scope: "row" }));
      row.append(Object.assign(document.createElement("td"), { textContent: says }));
      row.append(Object.assign(document.createElement("td"), { textContent: marks[mark], className: mark }));
      return row;
    }));
    drawBars(find("bars"), certain.controlValues, certain.errorBounds);
    drawCubic(find("cubic"), certain.controlValues, view.time, certain.time);
    find("explanation").innerHTML = explain(certain, published, touches, pair.known);
  }

  makeHandles();
  listen();
  choose();
}

/** Says in one or two sentences what is to be seen. */
function explain(certain, published, touches, known) {
  const { controlValues: k, errorBounds: e, culledBy, contact } = certain;
  if (contact === "undefined") return "A coordinate is not finite. No test may drop this pair, since nothing about it is certain.";
  const inside = [...k].filter((value, i) => Math.abs(value) <= e[i]).length;
  const exact = touches && /\d/.test(known?.exact ?? "") ? `, first at the exact time ${known.exact}` : "";
  if (published.filterCulls && touches) {
    return `The pair touches${exact}, and <strong>the paper's filter drops it</strong>: a contact is missed. ${["None", "One", "Two", "Three", "All"][inside]} of the four control
      values ${inside === 1 ? "is" : "are"} smaller than the rounding error, so the computed signs mean nothing. The certified filter sees that and keeps the pair.`;
  }
  if (published.cubicTime === undefined && touches) {
    return `The pair touches${exact}, and <strong>the plain cubic finds no contact</strong>. Rounding hides the root, or moves the contact beyond the
      border of the triangle or edge. The certified time of impact is a lower bound that no rounding can spoil.`;
  }
  if (published.cubicTime !== undefined && !touches) return "The pair never touches, but <strong>the plain cubic reports a contact</strong>.";
  if (culledBy.permanent) return "All four control values are beyond their error bounds, with one sign: the four points are never in one plane, so the pair certainly does not touch.";
  if (touches) return `The pair touches${exact}. The control values have both signs, or are smaller than their error bounds, so the filter keeps the pair, and the time of impact is computed.`;
  return "The pair does not touch, but the filter alone cannot prove it. The time of impact and the exact verdict do.";
}
