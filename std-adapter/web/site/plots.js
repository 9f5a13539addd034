// Small plots in SVG.

const text = (x, y, words, anchor = "middle") => `<text x="${x}" y="${y}" text-anchor="${anchor}">${words}</text>`;

/** Formats a number with three digits. */
export function few(number) {
  const size = Math.abs(number);
  if (size === 0 || (size >= 1e-3 && size < 1e5)) return String(Number(number.toPrecision(3)));
  return number.toExponential(1);
}

/**
 * Draws the four control values in units of their error bounds, on a logarithmic scale with both signs. Inside the band the
 * sign is unknown.
 */
export function drawBars(svg, values, bounds) {
  const middle = 56, unit = 2.6;
  const parts = [
    `<rect x="0" y="${middle - unit * scaled(1)}" width="360" height="${2 * unit * scaled(1)}" fill="var(--series-1)" fill-opacity="0.35"/>`,
    `<line x1="0" x2="360" y1="${middle}" y2="${middle}" stroke="var(--faint)"/>`,
    text(356, middle - 8, "error bound", "end"),
  ];
  ["k₀", "3k₁", "3k₂", "k₃"].forEach((name, i) => {
    const x = 48 + 80 * i;
    if (!Number.isFinite(values[i] / bounds[i])) {
      parts.push(text(x, middle - 6, "not finite"), text(x, 113, name));
      return;
    }
    const height = unit * scaled(Math.abs(values[i] / bounds[i]));
    const isCertain = Math.abs(values[i]) > bounds[i];
    const y = values[i] > 0 ? middle - height : middle;
    parts.push(`<rect x="${x - 16}" y="${y}" width="32" height="${Math.max(height, 0.8)}" rx="2" fill="var(${isCertain ? "--series-0" : "--series-5"})"/>`);
    parts.push(text(x, 113, name), text(x, 126, few(values[i])));
  });
  svg.innerHTML = parts.join("");
  svg.setAttribute("aria-label", `control values ${[...values].map(few).join(", ")}, with error bounds ${[...bounds].map(few).join(", ")}`);
}

/** Returns the length of a bar in powers of ten from a hundredth of the error bound on. */
function scaled(ratio) {
  return Math.min(19, Math.max(0, Math.log10(ratio) + 2));
}

/** Draws the cubic by its control values k0, 3 k1, 3 k2, k3, with their hull, the present time and the time of impact. */
export function drawCubic(svg, tripled, now, impact) {
  const k = [tripled[0], tripled[1] / 3, tripled[2] / 3, tripled[3]];
  const largest = Math.max(...k.map(Math.abs));
  if (!(largest > 0) || !Number.isFinite(largest)) {
    svg.innerHTML = text(180, 65, largest === 0 ? "zero throughout: the points are always in one plane" : "not finite");
    return;
  }
  const x = (t) => 20 + 320 * t, y = (v) => 62 - (50 * v) / largest;
  const points = k.map((v, i) => [i / 3, v]);
  const curve = Array.from({ length: 61 }, (_, i) => {
    const t = i / 60, s = 1 - t;
    return `${x(t)},${y(s ** 3 * k[0] + 3 * s * s * t * k[1] + 3 * s * t * t * k[2] + t ** 3 * k[3])}`;
  });
  const line = (t, style) => `<line x1="${x(t)}" x2="${x(t)}" y1="6" y2="114" ${style}/>`;
  svg.innerHTML = [
    `<polygon points="${hull(points).map(([t, v]) => `${x(t)},${y(v)}`).join(" ")}" fill="var(--series-0)" fill-opacity="0.14" stroke="var(--series-0)" stroke-opacity="0.4"/>`,
    `<line x1="20" x2="340" y1="${y(0)}" y2="${y(0)}" stroke="var(--faint)"/>`,
    `<polyline points="${curve.join(" ")}" fill="none" stroke="var(--series-0)" stroke-width="2"/>`,
    ...points.map(([t, v]) => `<circle cx="${x(t)}" cy="${y(v)}" r="3" fill="var(--series-0)"/>`),
    line(now, 'stroke="var(--ink)" stroke-dasharray="3 3"'),
    impact === undefined ? "" : line(impact, 'stroke="var(--series-5)" stroke-width="1.5"'),
    text(20, 126, "time 0"), text(340, 126, "1"), impact === undefined ? "" : text(Math.min(270, Math.max(110, x(impact))), 126, `contact from ${few(impact)}`),
  ].join("");
}

/** Returns the convex hull of points, by Andrew's chains. */
function hull(points) {
  const turn = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const chain = (ordered) => {
    const kept = [];
    for (const p of ordered) {
      while (kept.length > 1 && turn(kept.at(-2), kept.at(-1), p) <= 0) kept.pop();
      kept.push(p);
    }
    return kept.slice(0, -1);
  };
  return [...chain(points), ...chain([...points].reverse())];
}

/** Draws times as stacked areas. `rows` are maps from a name to a number, `names` their order, `colour` the colour of a name. */
export function drawStack(svg, rows, names, colour, unit) {
  const total = (row) => names.reduce((sum, name) => sum + (row[name] ?? 0), 0);
  const top = Math.max(...rows.map(total), 1e-9) * 1.1;
  const x = (i) => 44 + (312 * i) / Math.max(rows.length - 1, 1), y = (v) => 104 - (96 * v) / top;
  let below = rows.map(() => 0);
  const areas = names.map((name) => {
    const above = below.map((v, i) => v + (rows[i][name] ?? 0));
    const edge = [...above.map((v, i) => `${x(i)},${y(v)}`), ...below.map((v, i) => `${x(i)},${y(v)}`).reverse()];
    below = above;
    return `<polygon points="${edge.join(" ")}" fill="${colour(name)}"/>`;
  });
  svg.innerHTML = [
    ...areas, `<line x1="44" x2="356" y1="104" y2="104" stroke="var(--faint)"/>`,
    text(40, 14, few(top / 1.1), "end"), text(40, 107, "0", "end"), text(4, 60, unit, "start"), text(356, 117, "now", "end"),
  ].join("");
}
