"use strict";

/** Plays the animation, and keeps canvas, controls and charts at the same frame. */
(function () {
  const recording = readRecording();
  const find = (id) => document.getElementById(id);
  const [canvas, play, scrub, speed, clock] = ["view", "play", "scrub", "speed", "clock"].map(find);
  const times = recording.frameTimes;
  const last = times.length - 1;
  // Seconds for which the end is shown before the animation restarts.
  const REST = 0.8;

  let frame = 0;
  let playing = false;
  let time = times[0];
  let rested = 0;
  let before = null;
  let isStale = false;

  let viewer = null;
  try {
    viewer = createViewer(canvas, recording, refresh);
  } catch (error) {
    console.error(error);
  }
  const moveCharts = createCharts(recording, (step) => show(nearestFrame(step * recording.timeStep)));

  /** Redraws once before the browser next shows the page. */
  function refresh() {
    if (!isStale) requestAnimationFrame(tick);
    isStale = true;
  }

  function show(to) {
    frame = Math.min(last, Math.max(0, to));
    time = times[frame];
    rested = 0;
    update();
  }

  function update() {
    scrub.value = frame;
    const step = recording.frameSteps[frame];
    clock.textContent = `${times[frame].toFixed(3)} s · step ${step.toLocaleString("en")} · frame ${frame + 1} of ${last + 1}`;
    scrub.setAttribute("aria-valuetext", `${times[frame].toFixed(3)} seconds`);
    viewer?.setFrame(frame);
    moveCharts(step);
    refresh();
  }

  function setPlaying(wanted) {
    playing = wanted && last > 0;
    if (playing && frame === last) show(0);
    play.textContent = playing ? "Pause" : "Play";
    before = null;
    refresh();
  }

  function tick(now) {
    isStale = false;
    if (playing) {
      advance(before === null ? 0 : Math.min(0.1, (now - before) / 1000));
      before = now;
      refresh();
    }
    viewer?.draw();
  }

  function advance(seconds) {
    if (frame === last) {
      rested += seconds;
      if (rested > REST) show(0);
      return;
    }
    time += seconds * Number(speed.value);
    let to = frame;
    while (to < last && times[to + 1] <= time) to++;
    if (to !== frame) {
      frame = to;
      rested = 0;
      update();
    }
  }

  function nearestFrame(at) {
    let best = 0;
    times.forEach((candidate, i) => {
      if (Math.abs(candidate - at) < Math.abs(times[best] - at)) best = i;
    });
    return best;
  }

  function step(by) {
    setPlaying(false);
    show(frame + by);
  }

  for (const control of document.querySelectorAll(".controls [disabled]")) {
    control.disabled = !viewer && ["edges", "bodies", "reset"].includes(control.id);
  }
  play.addEventListener("click", () => setPlaying(!playing));
  find("back").addEventListener("click", () => step(-1));
  find("forward").addEventListener("click", () => step(1));
  scrub.addEventListener("input", () => {
    setPlaying(false);
    show(Number(scrub.value));
  });
  document.addEventListener("keydown", (event) => {
    const busy = event.target.closest("button, select, input:not([type=range]), pre");
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === " " && !busy) setPlaying(!playing);
    else if (event.key === ",") step(-1);
    else if (event.key === ".") step(1);
    else if (event.key === "Home" && event.target === canvas) viewer?.reset();
    else return;
    event.preventDefault();
  });

  if (viewer) {
    find("no-view").hidden = true;
    find("edges").addEventListener("change", (event) => {
      viewer.shown.edges = event.target.checked;
      refresh();
    });
    find("bodies")?.addEventListener("change", (event) => {
      viewer.shown.bodies = event.target.checked;
      refresh();
    });
    find("reset").addEventListener("click", viewer.reset);
    document.querySelector(".hint").append(` · grid: ${gridName(viewer.gridSpacing)}`);
    steerView(canvas, viewer);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => location.reload());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);
    viewer.resize();
    viewer.reset();
    new ResizeObserver(() => viewer.resize()).observe(canvas);
  } else {
    canvas.hidden = true;
    document.querySelector(".hint").hidden = true;
  }
  update();
  setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches);

  function gridName(metres) {
    const [unit, name] = [[1, "m"], [1e-2, "cm"], [1e-3, "mm"]].find(([unit]) => metres >= 0.999 * unit) ?? [1e-6, "µm"];
    return `${few(metres / unit)} ${name}`;
  }
})();
