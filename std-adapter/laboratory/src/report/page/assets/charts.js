"use strict";

/**
 * Fills the page's `.chart` elements. Returns a function that moves all their cursors to a step. `onPick` gets the step that a
 * reader points at.
 */
function createCharts(recording, onPick) {
  const moves = [];
  for (const place of document.querySelectorAll(".chart")) {
    const kind = place.dataset.kind;
    const series = [...recording.series, ...recording.measures].filter((one) => one.kind === kind);
    const groups = kind === "gauge" ? series.map((one) => [one]) : [series];
    for (const group of groups) moves.push(createChart(place, recording, kind, group, onPick));
  }
  return (step) => moves.forEach((move) => move(step));
}

const CHARTS = {
  pairs: { caption: "pairs left per step; logarithmic", shape: logarithmic, height: 250 },
  events: { caption: "count per step; logarithmic", shape: logarithmic, height: 190 },
  effect: { caption: "time of effects per step; stacked", shape: stacked, height: 230 },
  step: { caption: "time of a whole step", shape: stacked, height: 150 },
  stage: { caption: "time of shared stages per step; stacked", shape: stacked, height: 200 },
  gauge: { caption: "", shape: linear, height: 130 },
  energy: { caption: "energy, in J", shape: linear, height: 230 },
  "effect-energy": { caption: "energy stored by effects, in J", shape: linear, height: 190 },
  stretch: { caption: "length relative to rest", shape: linear, height: 150 },
  load: { caption: "force on bodies, pins and attachments, in N", shape: linear, height: 190 },
};
const MARGIN = { left: 58, right: 14, top: 12, bottom: 26 };
const NAMESPACE = "http://www.w3.org/2000/svg";

function createChart(place, recording, kind, series, onPick) {
  const { caption, shape, height } = CHARTS[kind];
  const figure = place.appendChild(document.createElement("figure"));
  const heading = figure.appendChild(document.createElement("figcaption"));
  const unit = series[0].unit ? `, in ${series[0].unit}` : "";
  heading.textContent = kind === "gauge" ? series[0].label + unit : caption;
  const svg = figure.appendChild(document.createElementNS(NAMESPACE, "svg"));
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", `${heading.textContent}: ${series.map((one) => one.label).join(", ")}; the table below has the numbers`);
  const note = figure.appendChild(document.createElement("p"));
  note.className = "note";
  const legend = figure.appendChild(document.createElement("ul"));
  legend.className = "legend";
  const readings = series.map((one, i) => {
    const item = legend.appendChild(document.createElement("li"));
    const swatch = item.appendChild(document.createElement("i"));
    swatch.style.background = colour(i);
    item.append(one.label, " ");
    return item.appendChild(document.createElement("b"));
  });

  const begin = (recording.firstStep - 1) * recording.timeStep;
  const end = begin + recording.steps * recording.timeStep;
  let step = 0;
  let toX = null;
  let cursor = null;

  function draw() {
    const width = Math.max(figure.clientWidth, 220);
    const right = width - MARGIN.right, bottom = height - MARGIN.bottom;
    toX = (time) => MARGIN.left + ((time - begin) / (end - begin)) * (right - MARGIN.left);
    const { times, means } = series[0].steps ? measured(series, recording) : columnsOf(series, begin, end, (right - MARGIN.left) / 2);
    const drawing = shape(means);
    const toY = (share) => bottom - Math.min(share, 1.5) * (bottom - MARGIN.top);
    const middles = times.map(toX);

    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    for (const [share, label] of drawing.ticks) {
      const y = toY(share);
      element(svg, "line", { class: "rule", x1: MARGIN.left, x2: right, y1: y, y2: y });
      element(svg, "text", { x: MARGIN.left - 8, y: y + 4, "text-anchor": "end" }, label);
    }
    const tick = niceStep(end - begin, (right - MARGIN.left) / 90);
    for (let k = Math.ceil(begin / tick - 1e-9); k * tick <= end + 1e-9 * tick; k++) {
      const isLast = toX(k * tick) > right - 16;
      const label = `${Number((k * tick).toPrecision(6))} s`;
      element(svg, "text", { x: toX(k * tick), y: height - 7, "text-anchor": isLast ? "end" : "middle" }, label);
    }
    const clip = `clip-${kind}-${series[0].name.replace(/\W/g, "-")}`;
    const area = element(element(svg, "clipPath", { id: clip }), "rect", {
      x: MARGIN.left, y: MARGIN.top - 2, width: right - MARGIN.left, height: bottom - MARGIN.top + 4,
    });
    const curves = element(svg, "g", { "clip-path": `url(#${clip})` });
    drawing.layers.forEach(({ index, tops, bottoms, filled }) => {
      for (const run of finiteRuns(tops)) {
        const top = run.map((i) => `${middles[i].toFixed(1)},${toY(tops[i]).toFixed(1)}`);
        const low = [...run].reverse().map((i) => `${middles[i].toFixed(1)},${toY(bottoms?.[i] ?? 0).toFixed(1)}`);
        if (filled > 0) {
          element(curves, "path", { d: `M${top.join("L")}L${low.join("L")}Z`, fill: colour(index), "fill-opacity": filled });
        }
        if (filled < 0.5) {
          element(curves, "path", { class: "line", d: `M${top.join("L")}`, stroke: colour(index) });
        }
      }
    });
    note.textContent = drawing.note ?? "";
    note.hidden = !drawing.note;
    cursor = element(svg, "line", { class: "cursor", y1: MARGIN.top, y2: bottom });
    move(step);
  }

  function move(to) {
    step = to;
    if (!cursor) return;
    const x = toX(Math.min(end, Math.max(begin, step * recording.timeStep)));
    cursor.setAttribute("x1", x);
    cursor.setAttribute("x2", x);
    const index = series[0].steps
      ? series[0].steps.findLastIndex((measured) => measured <= step)
      : Math.floor((step - recording.firstStep) / recording.stepsPerValue);
    series.forEach((one, i) => {
      const value = one.values[Math.min(Math.max(index, 0), one.values.length - 1)];
      readings[i].textContent = one.unit === "s" && kind !== "gauge" ? duration(value) : few(value);
    });
  }

  const pick = (event) => {
    const box = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / box.width;
    const share = ((event.clientX - box.left) * scale - toX(begin)) / (toX(end) - toX(begin));
    onPick((begin + Math.min(1, Math.max(0, share)) * (end - begin)) / recording.timeStep);
  };
  svg.addEventListener("pointerdown", (event) => {
    svg.setPointerCapture(event.pointerId);
    pick(event);
  });
  svg.addEventListener("pointermove", (event) => event.buttons && pick(event));
  new ResizeObserver(draw).observe(figure);
  return move;
}

/** Places a value v at log(1 + v), so that zero has a place. */
function logarithmic(means) {
  const most = Math.max(1, ...means.flat().filter(Number.isFinite));
  const top = Math.log1p(most) * 1.04;
  const shares = means.map((one) => one.map((value) => Math.log1p(Math.max(0, value)) / top));
  const ticks = [[0, "0"]];
  for (let power = 1; power <= most * 1.001; power *= 10) ticks.push([Math.log1p(power) / top, shortCount(power)]);
  return { ticks, layers: shares.map((tops, index) => ({ index, tops, filled: 0.1 })) };
}

/** Stacks the series, the largest at the bottom. A few high peaks are cut off, and the note says so. */
function stacked(means) {
  const sum = (one) => one.reduce((total, value) => total + value, 0);
  const order = means.map((_, i) => i).sort((a, b) => sum(means[b]) - sum(means[a]));
  const floor = new Array(means[0].length).fill(0);
  const layers = order.map((index) => {
    const bottoms = [...floor];
    means[index].forEach((value, i) => (floor[i] += value));
    return { index, bottoms, tops: [...floor], filled: 0.85 };
  });
  const sorted = [...floor].sort((a, b) => a - b);
  const most = sorted[sorted.length - 1];
  const usual = sorted[Math.floor(0.97 * (sorted.length - 1))];
  const top = (most > 1.8 * usual && usual > 0 ? 1.35 * usual : most * 1.05) || 1e-9;
  for (const layer of layers) {
    layer.tops = layer.tops.map((value) => value / top);
    layer.bottoms = layer.bottoms.map((value) => value / top);
  }
  const above = floor.filter((value) => value > top).length;
  const note = above ? `${above === 1 ? "1 peak goes" : `${above} peaks go`} beyond the chart, up to ${duration(most)}` : null;
  const [unit, name] = timeUnit(top);
  return { layers, note, ticks: linearTicks(0, top, (value) => `${few(value / unit)} ${name}`) };
}

/** Scales from the least to the largest value, or from zero if that is near. */
function linear(means) {
  const values = means.flat().filter(Number.isFinite);
  let least = values.reduce((a, b) => Math.min(a, b), Infinity), most = values.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!values.length) [least, most] = [0, 1];
  if (least > 0 && least < 0.5 * most) least = 0;
  if (most === least) most = least + (Math.abs(least) || 1);
  const range = 1.06 * (most - least);
  const shares = means.map((one) => one.map((value) => (value - least) / range));
  const ticks = linearTicks(least, least + range, few);
  return { ticks, layers: shares.map((tops, index) => ({ index, tops, filled: 0 })) };
}

function linearTicks(from, to, label) {
  const step = niceStep(to - from, 4);
  const ticks = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to; k++) ticks.push([(k * step - from) / (to - from), label(k * step)]);
  return ticks;
}

/** Returns measurements at frames, and their times. */
function measured(series, recording) {
  return { times: series[0].steps.map((step) => step * recording.timeStep), means: series.map((one) => Array.from(one.values)) };
}

/** Returns means of recorded values in at most `most` columns, and the times of their middles. */
function columnsOf(series, begin, end, most) {
  const columns = Math.max(1, Math.min(series[0].values.length, Math.floor(most)));
  const times = Array.from({ length: columns }, (_, i) => begin + ((i + 0.5) / columns) * (end - begin));
  // The first and the last column extend to the ends.
  if (columns > 1) [times[0], times[columns - 1]] = [begin, end];
  return { times, means: series.map((one) => columnMeans(one.values, columns)) };
}

/** Returns means over equal parts of the values. */
function columnMeans(values, columns) {
  return Array.from({ length: columns }, (_, i) => {
    const from = Math.floor((i * values.length) / columns), to = Math.floor(((i + 1) * values.length) / columns);
    return values.subarray(from, to).reduce((sum, value) => sum + value, 0) / (to - from);
  });
}

/** Returns the indices of finite numbers, in unbroken runs. */
function finiteRuns(numbers) {
  const runs = [[]];
  numbers.forEach((number, i) => {
    if (Number.isFinite(number)) runs[runs.length - 1].push(i);
    else runs.push([]);
  });
  return runs.filter((run) => run.length);
}

function shortCount(number) {
  const [unit, name] = [[1e9, "G"], [1e6, "M"], [1e3, "k"]].find(([unit]) => number >= unit) ?? [1, ""];
  return `${number / unit}${name}`;
}

function colour(index) {
  return `var(--series-${index % 12})`;
}

function element(parent, name, attributes, text) {
  const made = parent.appendChild(document.createElementNS(NAMESPACE, name));
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}
