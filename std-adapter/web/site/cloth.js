// The third experiment: cloth that runs live.

/* global readRecording */

import { Costs } from "./costs.js";
import { Remote } from "./remote.js";
import { SCENES, loadScene, without } from "./scenes.js";
import { createView } from "./view.js";
import { Strain, contactTints } from "./tints.js";
import { Hand } from "./hand.js";

const find = (id) => document.getElementById(id);
/** The most seconds that pass in a frame: a machine that is slower shows slow motion. */
const MOST = 0.05;
/** The seconds of a frame, and of the longest step in it. */
const FRAME = 1 / 60, STEP = 1 / 240;

export async function startCloth() {
  const remote = new Remote();
  const view = createView(find("cloth-canvas"));
  const costs = new Costs((off) => create(off));
  const hand = new Hand(find("cloth-canvas"), view, remote, () => scene);
  let scene = null; // What the worker made.
  let source = null; // Text and files.
  let report = null; // The recording of a report that is shown instead.
  let strain = null;
  let last = null; // The worker's last answer.
  let playing = false;
  let isBusy = false;
  let before = null;
  let owed = 0; // Seconds to simulate.
  let frames = [];
  let simulated = []; // The simulated times of the last second, and when they were shown.
  let spent = [0, 0]; // Milliseconds of a frame in the worker and on this thread, the mean of about ten frames.
  let run = 0;

  for (const { file, name } of SCENES) find("scene").append(new Option(name, file));

  function complain(message) {
    find("cloth-message").textContent = message;
    find("cloth-message").hidden = !message;
  }

  /** Makes the scene again, without the effects that are switched off. */
  async function create(off) {
    const own = ++run;
    complain("");
    try {
      const text = off.reduce(without, source.text);
      const made = await remote.call("create", text, source.files);
      if (own !== run) return;
      scene = made;
      last = made;
      owed = 0;
      simulated = [];
      report = null;
      hand.release();
      strain = new Strain(made);
      const isSame = view.reopenMesh(made);
      if (!isSame) view.viewer?.zoom(SCENES.find(({ file }) => file === find("scene").value).zoom ?? 1.1);
      costs.begin(made);
      show(made);
    } catch (error) {
      if (own === run) complain(error.message);
    }
  }

  async function choose(file) {
    try {
      source = await loadScene(file);
      find("scrub").hidden = true;
      find("live").hidden = false;
      costs.forget();
      await create([]);
    } catch (error) {
      complain(error.message);
    }
  }

  function show(state) {
    const begin = performance.now();
    last = state;
    view.show(state.positions);
    const { ratios, largest } = strain.measure(state.positions);
    const colours = find("colours").value;
    view.tint(colours === "strain" ? strain.tints(ratios) : colours === "contacts" ? contactTints(scene, state.contacts) : null);
    find("time").textContent = `${state.time.toFixed(3)} s`;
    find("certified").textContent = state.hasContact ? `${state.certified.toLocaleString("en")} of ${state.stepsDone.toLocaleString("en")}` : "no contact effect";
    find("stretch").textContent = `${largest.toFixed(3)}× rest`;
    if (state.done) {
      find("step-time").textContent = `${(state.milliseconds / state.done).toFixed(2)} ms`;
      costs.add(state);
      // The draw is the last frame's.
      const now = [state.milliseconds, performance.now() - begin + view.drawing];
      spent = spent.map((mean, i) => mean + (now[i] - mean) / Math.min(10, state.stepsDone / state.done));
      if (playing) showPace(state.time);
      find("frame-time").textContent = `${spent[0].toFixed(1)} + ${spent[1].toFixed(1)} ms`;
    }
  }

  /** Lets seconds pass in the worker, or one step if they are `null`, unless it is still busy. */
  async function advance(seconds) {
    if (isBusy || !scene) return;
    isBusy = true;
    const own = run;
    try {
      const state = await remote.call("run", seconds, find("colours").value === "contacts");
      if (own === run) show(state);
    } catch (error) {
      if (own === run) {
        setPlaying(false);
        complain(error.message);
      }
    }
    isBusy = false;
    // Where drawing is slow, the next frame of the cloth does not wait for the page's.
    if (playing && !report && own === run) catchUp(FRAME);
  }

  function tick(now) {
    if (!playing) return;
    requestAnimationFrame(tick);
    frames = [...frames.filter((at) => now - at < 1000), now];
    find("frame-rate").textContent = frames.length;
    if (report) return play(passed());
    catchUp(STEP);
  }

  /** Returns the seconds since the last call. */
  function passed() {
    const now = performance.now();
    const seconds = before === null ? 0 : Math.min(0.1, (now - before) / 1000);
    before = now;
    return seconds;
  }

  /** Lets the time pass that the cloth is behind, if it is at least so many seconds at full speed. */
  function catchUp(least) {
    const speed = Number(find("speed").value);
    owed = Math.min(owed + passed() * speed, MOST);
    if (isBusy || owed < least * speed * (1 - 1e-9)) return;
    const end = scene.steps * scene.timeStep;
    if (find("repeat").checked && last.time > end + 1 && !hand.isHolding) return restart();
    // The rest of a step is left for later: it would cost as much as a whole one.
    const steps = Math.floor(owed / STEP + 1e-6);
    const seconds = steps > 0 ? steps * STEP : owed;
    owed = Math.max(owed - seconds, 0);
    advance(seconds);
  }

  /** Shows how fast time passes in the cloth. */
  function showPace(time) {
    const now = performance.now();
    simulated = [...simulated.filter(({ at }) => now - at < 1000), { at: now, time }];
    const [first] = simulated;
    if (now - first.at > 300) find("pace").textContent = `${((time - first.time) / ((now - first.at) / 1000)).toFixed(2)}× real time`;
  }

  function restart() {
    if (report) return showFrame(0);
    create(costs.off);
  }

  function setPlaying(wanted) {
    playing = wanted && Boolean(scene || report);
    find("play").textContent = playing ? "Pause" : "Play";
    before = null;
    simulated = [];
    for (const id of ["frame-rate", "pace"]) find(id).textContent = "–";
    if (playing) requestAnimationFrame(tick);
  }

  // A report of `selvedge simulate` brings its recording along.
  async function openReport(file) {
    try {
      const text = await file.text();
      report = readRecording(new DOMParser().parseFromString(text, "text/html"));
    } catch {
      return complain(`${file.name} is not a report of selvedge simulate`);
    }
    complain("");
    run++;
    hand.release();
    view.open(report);
    find("scrub").max = report.frameSteps.length - 1;
    find("scrub").hidden = false;
    find("live").hidden = true;
    showFrame(0);
  }

  function showFrame(frame) {
    report.frame = frame;
    report.time = report.frameTimes[frame];
    find("scrub").value = frame;
    find("time").textContent = `${report.time.toFixed(3)} s`;
    view.viewer?.setFrame(frame);
    view.refresh();
  }

  function play(seconds) {
    const times = report.frameTimes;
    const time = report.time + seconds * Number(find("speed").value);
    const next = times.findIndex((at) => at > time);
    if (next < 0) showFrame(find("repeat").checked ? 0 : times.length - 1);
    else {
      if (next - 1 !== report.frame) showFrame(Math.max(next - 1, 0));
      report.time = time;
    }
  }

  find("scene").addEventListener("change", async (event) => {
    await choose(event.target.value);
  });
  find("colours").addEventListener("change", () => scene && !report && show(last));
  find("report").addEventListener("change", (event) => event.target.files[0] && openReport(event.target.files[0]));
  find("scrub").addEventListener("input", (event) => showFrame(Number(event.target.value)));
  find("play").addEventListener("click", () => setPlaying(!playing));
  find("one-step").addEventListener("click", () => {
    setPlaying(false);
    if (report) showFrame(Math.min(report.frame + 1, report.frameSteps.length - 1));
    else advance(null);
  });
  find("restart").addEventListener("click", restart);
  find("edges").addEventListener("change", (event) => {
    view.showEdges(event.target.checked);
  });
  // Cloth that nobody sees does not run.
  let wasPlaying = false;
  new IntersectionObserver(([{ isIntersecting }]) => {
    if (!isIntersecting && playing) {
      wasPlaying = true;
      setPlaying(false);
    } else if (isIntersecting && wasPlaying) {
      wasPlaying = false;
      setPlaying(true);
    }
  }).observe(find("cloth"));

  await choose(SCENES[0].file);
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) setPlaying(true);
}
