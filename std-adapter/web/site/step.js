// The second experiment: one step of a mesh, method by method.

import { Remote } from "./remote.js";
import { createView, linear } from "./view.js";

const find = (id) => document.getElementById(id);
/** Meshes above this size are only for methods without triangle pairs, which need too much memory for a page. */
const LARGE = 200_000;
/** Colours of the stages, from the first to the last. */
const COLOURS = ["#9aa4ae", "#56b4e9", "#efb13a", "#e07b20", "#d02040"];

export function startStep(names) {
  const remote = new Remote();
  const view = createView(find("step-canvas"));
  let mesh = null;
  let kept = null; // The first of two files.
  let run = 0;

  const method = find("method");
  for (const name of names) method.append(new Option(name.replaceAll("_", " "), name));
  method.value = "lv_2014";

  function complain(message) {
    find("step-message").textContent = message;
    find("step-message").hidden = !message;
  }

  async function attempt(work) {
    const own = ++run;
    complain("");
    try {
      await work(() => own !== run);
    } catch (error) {
      if (own === run) complain(error.message);
    }
  }

  async function loadSleeve() {
    const step = Number(find("bend").value);
    find("bend-number").textContent = step;
    mesh = { ...(await remote.call("armStep", (step - 1) / 60, step / 60)), name: "the sleeve of the paper", up: [0, 0, 1] };
    find("own-sleeve").hidden = true;
    find("bend-label").hidden = false;
  }

  function showMesh() {
    view.openMesh({
      triangles: mesh.triangles, positions: Float32Array.from(mesh.end), up: mesh.up, clothTriangleCount: mesh.triangles.length / 3, room: 0.02,
    });
  }

  function check(name) {
    const count = mesh.triangles.length / 3;
    if (count > LARGE && !name.startsWith("selvedge")) {
      throw new Error(`${count.toLocaleString("en")} triangles are too many for this method in a page: choose selvedge, or use the program`);
    }
  }

  async function show(isStale) {
    check(method.value);
    const result = await remote.call("runMethod", method.value, mesh.triangles, mesh.start, mesh.end);
    if (isStale()) return;
    const rows = result.stages.map(({ name, pairs, milliseconds }, i) => {
      const row = document.createElement("tr");
      const head = Object.assign(document.createElement("th"), { scope: "row" });
      head.innerHTML = `<span class="swatch" style="background:${COLOURS[Math.min(i + COLOURS.length - result.stages.length, 4)] ?? COLOURS[0]}"></span>`;
      head.append(name.replaceAll("-", " "));
      row.append(head, cell(pairs.toLocaleString("en")), cell(milliseconds.toFixed(2)));
      return row;
    });
    find("stages").tBodies[0].replaceChildren(...rows);
    const contacts = result.stages.at(-1).pairs;
    find("step-summary").textContent = `${mesh.name}: ${(mesh.triangles.length / 3).toLocaleString("en")} triangles, ` +
      `${contacts.toLocaleString("en")} contacts in ${result.milliseconds.toFixed(1)} ms. ` +
      (result.certified ? "This method is certified: it misses no contact." : "This method is not certified: it may miss contacts.");
    view.tint(tints(result.stages));
  }

  /** Returns the colour of the last stage that a pair of each vertex reached. */
  function tints(stages) {
    const tint = new Float32Array((4 * mesh.start.length) / 3);
    stages.forEach(({ vertices }, i) => {
      const colour = linear(COLOURS[Math.min(Math.max(i + COLOURS.length - stages.length, 0), 4)], i === 0 ? 0.35 : 0.85);
      for (const vertex of vertices) tint.set(colour, 4 * vertex);
    });
    return tint;
  }

  async function readOwn(files) {
    const given = [...files].slice(0, 2);
    const read = [];
    for (const file of given) read.push({ name: file.name, ...(await remote.call("readMesh", file.name, new Uint8Array(await file.arrayBuffer()))) });
    if (read.length === 1 && kept) read.unshift(kept);
    kept = null;
    if (read.length === 1) {
      [kept] = read;
      complain(`${kept.name} is the start of the step. Now drop the mesh at its end.`);
      return false;
    }
    const [from, to] = read;
    const [n, m] = [from, to].map(({ positions }) => positions.length / 3);
    if (n !== m) throw new Error(`${from.name} and ${to.name} are not two frames of one mesh: the first has ${n} vertices, the second ${m}`);
    if (from.triangles.length !== to.triangles.length || from.triangles.some((v, i) => v !== to.triangles[i])) {
      throw new Error(`${from.name} and ${to.name} are not two frames of one mesh: their triangles differ`);
    }
    mesh = { name: `${from.name} to ${to.name}`, triangles: from.triangles, start: from.positions, end: to.positions, up: [0, 0, 1] };
    if (mesh.triangles.length / 3 > LARGE && !method.value.startsWith("selvedge")) method.value = "selvedge";
    find("own-sleeve").hidden = false;
    find("bend-label").hidden = true;
    return true;
  }

  const own = (files) => attempt(async (isStale) => {
    if (!(await readOwn(files))) return;
    showMesh();
    await show(isStale);
  });
  const sleeve = () => attempt(async (isStale) => {
    const isFirst = !mesh || find("bend-label").hidden;
    await loadSleeve();
    if (isFirst) showMesh();
    else view.show(Float32Array.from(mesh.end));
    await show(isStale);
  });

  find("bend").addEventListener("input", sleeve);
  find("own-sleeve").addEventListener("click", sleeve);
  method.addEventListener("change", () => attempt(show));
  find("files").addEventListener("change", (event) => own(event.target.files));
  find("all-methods").addEventListener("click", () => attempt(async (isStale) => {
    const body = find("methods").tBodies[0];
    body.replaceChildren();
    find("methods").hidden = false;
    for (const name of names) {
      if (isStale()) return;
      check(name);
      const { stages, milliseconds } = await remote.call("runMethod", name, mesh.triangles, mesh.start, mesh.end);
      const row = document.createElement("tr");
      row.append(Object.assign(document.createElement("th"), { scope: "row", textContent: name.replaceAll("_", " ") }));
      row.append(...[stages.at(-1).pairs, stages.at(-2).pairs].map((pairs) => cell(pairs.toLocaleString("en"))), cell(milliseconds.toFixed(2)));
      if (name.startsWith("selvedge")) row.classList.add("ours");
      body.append(row);
    }
  }));
  const target = find("drop-here");
  for (const name of ["dragenter", "dragover"]) {
    target.addEventListener(name, (event) => { event.preventDefault(); target.classList.add("over"); });
  }
  target.addEventListener("dragleave", () => target.classList.remove("over"));
  target.addEventListener("drop", (event) => {
    event.preventDefault();
    target.classList.remove("over");
    own(event.dataTransfer.files);
  });
  sleeve();
}

function cell(textContent) {
  return Object.assign(document.createElement("td"), { textContent });
}
