"use strict";

// ---- data

function bytes(text) {
  const binary = atob(text);
  const result = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) result[k] = binary.charCodeAt(k);
  return result.buffer;
}

const quantized = new Uint16Array(bytes(DATA.positions));
const triangles = new Uint32Array(bytes(DATA.triangles));

/// Positions of one frame, three numbers a vertex.
function positions(frame) {
  const count = 3 * DATA.vertices;
  const result = new Float32Array(count);
  for (let k = 0; k < count; k++) result[k] = DATA.lower[k % 3] + DATA.scale * quantized[frame * count + k];
  return result;
}

// ---- camera

const camera = { turn: 0.6, tilt: 0.35, distance: 1.7 };
const extent = { centre: [0, 0, 0], radius: 1 };

function measure() {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const frame of [0, DATA.frames - 1]) {
    const at = positions(frame);
    for (let k = 0; k < at.length; k++) {
      low[k % 3] = Math.min(low[k % 3], at[k]);
      high[k % 3] = Math.max(high[k % 3], at[k]);
    }
  }
  extent.centre = low.map((x, k) => (x + high[k]) / 2);
  extent.radius = Math.max(1e-6, Math.hypot(...low.map((x, k) => high[k] - x)) / 2);
}

/// Column by column: the world, z up, seen from the camera in perspective.
function matrix(aspect) {
  const [ct, st, cp, sp] = [Math.cos(camera.turn), Math.sin(camera.turn), Math.cos(camera.tilt), Math.sin(camera.tilt)];
  const right = [ct, st, 0], up = [st * sp, -ct * sp, cp], back = [st * cp, -ct * cp, sp];
  const dot = (a) => a[0] * extent.centre[0] + a[1] * extent.centre[1] + a[2] * extent.centre[2];
  const far = camera.distance * extent.radius;
  const f = 1.8, near = Math.max(0.01 * far, far - 4 * extent.radius), end = far + 4 * extent.radius;
  const a = (end + near) / (near - end), b = 2 * end * near / (near - end);
  const tz = -dot(back) - far;
  const rows = [
    [f / aspect * right[0], f / aspect * right[1], f / aspect * right[2], -f / aspect * dot(right)],
    [f * up[0], f * up[1], f * up[2], -f * dot(up)],
    [a * back[0], a * back[1], a * back[2], a * tz + b],
    [-back[0], -back[1], -back[2], -tz],
  ];
  const result = new Float32Array(16);
  for (let r = 0; r < 4; r++) for (let c = 0; c < 4; c++) result[4 * c + r] = rows[r][c];
  return result;
}

// ---- picture

const VERTEX = `#version 300 es
uniform mat4 view; in vec3 position; out vec3 place;
void main() { place = position; gl_Position = view * vec4(position, 1.0); }`;
const FRAGMENT = `#version 300 es
precision highp float; uniform vec3 front; uniform vec3 rear; in vec3 place; out vec4 colour;
void main() {
  vec3 n = normalize(cross(dFdx(place), dFdy(place)));
  float light = 0.35 + 0.65 * abs(dot(n, normalize(vec3(0.4, -0.5, 0.75))));
  colour = vec4((gl_FrontFacing ? front : rear) * light, 1.0);
}`;

function picture(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) return flatPicture(canvas);
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  const position = gl.getAttribLocation(program, "position");
  gl.enableVertexAttribArray(position);
  gl.vertexAttribPointer(position, 3, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  gl.enable(gl.DEPTH_TEST);
  gl.clearColor(1, 1, 1, 1);
  const [view, front, rear] = ["view", "front", "rear"].map((name) => gl.getUniformLocation(program, name));
  let last = -1;
  return (frame) => {
    if (frame !== last) gl.bufferData(gl.ARRAY_BUFFER, positions(frame), gl.DYNAMIC_DRAW);
    last = frame;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(view, false, matrix(canvas.width / canvas.height));
    const cloth = 3 * DATA.clothTriangles;
    gl.uniform3f(front, 0.35, 0.55, 0.9);
    gl.uniform3f(rear, 0.9, 0.6, 0.35);
    gl.drawElements(gl.TRIANGLES, cloth, gl.UNSIGNED_INT, 0);
    gl.uniform3f(front, 0.7, 0.7, 0.7);
    gl.uniform3f(rear, 0.5, 0.5, 0.5);
    gl.drawElements(gl.TRIANGLES, triangles.length - cloth, gl.UNSIGNED_INT, 4 * cloth);
  };
}

/// Without WebGL: triangles from the farthest to the nearest.
function flatPicture(canvas) {
  const context = canvas.getContext("2d");
  return (frame) => {
    const at = positions(frame), m = matrix(canvas.width / canvas.height), count = triangles.length / 3;
    const x = new Float32Array(DATA.vertices), y = new Float32Array(DATA.vertices), w = new Float32Array(DATA.vertices);
    for (let v = 0; v < DATA.vertices; v++) {
      const [p, q, r] = [at[3 * v], at[3 * v + 1], at[3 * v + 2]];
      const row = (k) => m[k] * p + m[4 + k] * q + m[8 + k] * r + m[12 + k];
      w[v] = row(3);
      x[v] = (0.5 + 0.5 * row(0) / w[v]) * canvas.width;
      y[v] = (0.5 - 0.5 * row(1) / w[v]) * canvas.height;
    }
    const corner = (t, k) => triangles[3 * t + k];
    const depth = (t) => w[corner(t, 0)] + w[corner(t, 1)] + w[corner(t, 2)];
    const order = Array.from({ length: count }, (_, t) => t).sort((s, t) => depth(t) - depth(s));
    context.fillStyle = "#fff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    for (const t of order) {
      const [a, b, c] = [corner(t, 0), corner(t, 1), corner(t, 2)];
      const u = [0, 1, 2].map((k) => at[3 * b + k] - at[3 * a + k]), v = [0, 1, 2].map((k) => at[3 * c + k] - at[3 * a + k]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const light = 0.35 + 0.65 * Math.abs(0.4 * n[0] - 0.5 * n[1] + 0.75 * n[2]) / (Math.hypot(...n) || 1);
      const front = (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a]) < 0;
      const base = t >= DATA.clothTriangles ? [178, 178, 178] : front ? [90, 140, 230] : [230, 153, 90];
      context.fillStyle = context.strokeStyle = `rgb(${base.map((z) => Math.round(z * light)).join()})`;
      context.beginPath();
      context.moveTo(x[a], y[a]); context.lineTo(x[b], y[b]); context.lineTo(x[c], y[c]);
      context.closePath(); context.fill(); context.stroke();
    }
  };
}

// ---- charts

const COLOURS = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb", "#222255", "#dd7788", "#117733", "#999933", "#882255", "#44aa99", "#cc6677", "#661100", "#6699cc"];

/// Lines, on a logarithmic scale that begins at `floor`, or stacked on a linear one.
function chart(canvas, legend, series, floor) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const context = canvas.getContext("2d");
  const [left, bottom, top] = [56 * ratio, 24 * ratio, 8 * ratio];
  const width = canvas.width - left - 8 * ratio, height = canvas.height - bottom - top;
  const isStacked = floor === undefined;
  // The first frame is the start: nothing was counted before it.
  const columns = DATA.times.map((_, k) => k).slice(1);
  const sums = columns.map((k) => series.reduce((sum, one) => sum + one.values[k], 0));
  const largest = isStacked ? Math.max(1e-6, ...sums) : Math.max(10 * floor, ...series.flatMap((one) => one.values));
  const last = DATA.times[DATA.times.length - 1] || 1;
  const x = (k) => left + width * DATA.times[k] / last;
  const y = (value) => top + height * (1 - (isStacked ? value / largest : Math.log(Math.max(value, floor) / floor) / Math.log(largest / floor)));
  context.font = `${12 * ratio}px system-ui, sans-serif`;
  context.fillStyle = "#555";
  context.strokeStyle = "#ddd";
  context.textAlign = "right";
  const ticks = isStacked ? [0, 0.25, 0.5, 0.75, 1].map((part) => part * largest) : [];
  if (!isStacked) for (let tick = floor; tick <= largest; tick *= 10) ticks.push(tick);
  for (const tick of ticks) {
    context.beginPath(); context.moveTo(left, y(tick)); context.lineTo(left + width, y(tick)); context.stroke();
    context.fillText(String(Number(tick.toPrecision(2))), left - 4 * ratio, y(tick) + 4 * ratio);
  }
  context.textAlign = "center";
  for (const part of [0, 0.25, 0.5, 0.75, 1]) context.fillText(`${Number((part * last).toPrecision(3))} s`, left + width * part * 0.98 + 8 * ratio, canvas.height - 6 * ratio);
  const below = columns.map(() => 0);
  series.forEach((one, index) => {
    const colour = COLOURS[index % COLOURS.length];
    context.fillStyle = context.strokeStyle = colour;
    context.lineWidth = 1.5 * ratio;
    context.beginPath();
    if (isStacked) {
      columns.forEach((k, place) => context.lineTo(x(k), y(below[place])));
      columns.forEach((k, place) => { below[place] += one.values[k]; });
      for (let place = columns.length - 1; place >= 0; place--) context.lineTo(x(columns[place]), y(below[place]));
      context.closePath();
      context.fill();
    } else {
      columns.forEach((k) => context.lineTo(x(k), y(one.values[k])));
      context.stroke();
    }
  });
  legend.replaceChildren(...series.map((one, index) => {
    const entry = document.createElement("span"), swatch = document.createElement("i");
    swatch.style.background = COLOURS[index % COLOURS.length];
    entry.append(swatch, one.name);
    return entry;
  }));
}

function table() {
  const total = (one) => one.values.reduce((sum, value, k) => sum + value * weight(k), 0) / DATA.steps;
  // Each value is a mean over the steps of its frame, all of which but the last have the same number.
  const weight = (k) => k === 0 ? 0 : DATA.steps / Math.max(1, DATA.times.length - 1);
  const all = DATA.milliseconds.reduce((sum, one) => sum + total(one), 0) || 1;
  document.getElementById("table").replaceChildren(...DATA.milliseconds.map((one) => {
    const row = document.createElement("tr");
    row.append(...[one.name, total(one).toFixed(4), `${(100 * total(one) / all).toFixed(1)} %`].map((text) => {
      const cell = document.createElement("td");
      cell.textContent = text;
      return cell;
    }));
    return row;
  }));
}

// ---- controls

function start() {
  measure();
  const canvas = document.getElementById("view"), slider = document.getElementById("frame");
  const draw = picture(canvas);
  slider.max = DATA.frames - 1;
  let frame = 0, playing = false, begin = 0;
  const show = (next) => {
    frame = Math.max(0, Math.min(DATA.frames - 1, next));
    slider.value = frame;
    document.getElementById("time").textContent = `${DATA.frameTimes[frame].toFixed(3)} s`;
    const ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(canvas.clientWidth * ratio)) {
      canvas.width = Math.round(canvas.clientWidth * ratio);
      canvas.height = Math.round(canvas.clientHeight * ratio);
    }
    draw(frame);
  };
  const play = (on) => {
    playing = on && DATA.frames > 1;
    document.getElementById("play").textContent = playing ? "⏸" : "▶";
    if (!playing) return;
    if (frame === DATA.frames - 1) show(0);
    begin = performance.now() / 1000 - DATA.frameTimes[frame];
    requestAnimationFrame(tick);
  };
  const tick = () => {
    if (!playing) return;
    const now = performance.now() / 1000 - begin;
    let next = frame;
    while (next + 1 < DATA.frames && DATA.frameTimes[next + 1] <= now) next++;
    if (next !== frame) show(next);
    if (frame === DATA.frames - 1) play(false); else requestAnimationFrame(tick);
  };
  const step = (by) => { play(false); show(frame + by); };
  document.getElementById("play").onclick = () => play(!playing);
  document.getElementById("back").onclick = () => step(-1);
  document.getElementById("forth").onclick = () => step(1);
  slider.oninput = () => step(Number(slider.value) - frame);
  canvas.onkeydown = (event) => {
    if (event.key === " ") play(!playing);
    else if (event.key === "ArrowLeft") step(-1);
    else if (event.key === "ArrowRight") step(1);
    else return;
    event.preventDefault();
  };
  canvas.onpointerdown = (event) => canvas.setPointerCapture(event.pointerId);
  canvas.onpointermove = (event) => {
    if (!event.buttons) return;
    camera.turn -= 0.008 * event.movementX;
    camera.tilt = Math.max(-1.5, Math.min(1.5, camera.tilt + 0.008 * event.movementY));
    show(frame);
  };
  canvas.onwheel = (event) => {
    event.preventDefault();
    camera.distance = Math.max(0.3, Math.min(20, camera.distance * Math.exp(0.001 * event.deltaY)));
    show(frame);
  };
  const charts = () => {
    if (DATA.pairs.length > 0) chart(document.getElementById("pairs"), document.getElementById("pairs-legend"), DATA.pairs, 0.01);
    else document.getElementById("pairs-section").remove();
    chart(document.getElementById("times"), document.getElementById("times-legend"), DATA.milliseconds);
  };
  charts();
  table();
  show(0);
  window.onresize = () => { if (DATA.pairs.length > 0) charts(); show(frame); };
}

start();
