// Shows a mesh that changes from frame to frame in the viewer of the reports.

/* global createViewer, steerView */

/**
 * Makes a view on a canvas, or shows the message beside it where there is no WebGL 2. `mesh` has triangles, positions, up and
 * clothTriangleCount.
 */
export function createView(canvas) {
  let viewer = null;
  let current = null;
  let isStale = false;
  let areEdgesShown = false;
  let drawing = 0; // Milliseconds of this thread for the last draw.
  const refresh = () => {
    if (!isStale) requestAnimationFrame(() => {
      isStale = false;
      const begin = performance.now();
      viewer?.draw();
      drawing = performance.now() - begin;
    });
    isStale = true;
  };
  const steered = { turn: 0, zoom: 0, shift: 0 };
  // The canvas keeps one viewer after another, since a mesh has buffers of its own.
  steerView(canvas, Object.fromEntries(Object.keys(steered).map((name) => [name, (...values) => viewer?.[name](...values)])));
  new ResizeObserver(() => viewer?.resize()).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);

  function open(recording) {
    current = recording;
    try {
      viewer = createViewer(canvas, recording, refresh);
    } catch (error) {
      console.warn(error);
      viewer = null;
    }
    canvas.hidden = !viewer;
    canvas.nextElementSibling.hidden = Boolean(viewer);
    if (viewer) viewer.shown.edges = areEdgesShown;
    viewer?.resize();
    viewer?.reset();
    viewer?.setFrame(0);
    refresh();
  }

  return {
    get viewer() { return viewer; },
    get drawing() { return drawing; },
    open,
    /** Shows a mesh whose positions change. */
    openMesh({ triangles, positions, up, clothTriangleCount, room = 0.15 }) {
      const parts = [{ kind: "cloth", colour: 0, triangles: clothTriangleCount }];
      const others = triangles.length / 3 - clothTriangleCount;
      if (others) parts.push({ kind: "body", colour: 0, triangles: others });
      open({
        up, triangles, parts, vertices: positions.length / 3, frameSteps: [0], bounds: boundsOf(positions, room),
        current: positions, write(_, out) { out.set(this.current); },
      });
    },
    /** Shows a mesh like `openMesh`, but keeps the view if it has the same triangles as before. Returns whether it has. */
    reopenMesh(mesh) {
      const isSame = current?.current?.length === mesh.positions.length && current.triangles.every((v, i) => v === mesh.triangles[i]);
      if (isSame) this.show(mesh.positions);
      else this.openMesh(mesh);
      return isSame;
    },
    show(positions) {
      current.current = positions;
      viewer?.setFrame(0);
      refresh();
    },
    showEdges(wanted) {
      areEdgesShown = wanted;
      if (viewer) viewer.shown.edges = wanted;
      refresh();
    },
    tint(tints) { viewer?.setTints(tints); },
    refresh,
  };
}

/** Returns the box around positions as its corner and its size, with some room on all sides. */
function boundsOf(positions, room) {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    least[i % 3] = Math.min(least[i % 3], positions[i]);
    most[i % 3] = Math.max(most[i % 3], positions[i]);
  }
  const size = Math.max(...most.map((x, i) => x - least[i]));
  return Float32Array.from([...least.map((x) => x - room * size), ...most.map((x, i) => x - least[i] + 2 * room * size)]);
}

/** Returns a tint of each vertex: a colour of the theme, `#rrggbb`, with a share. */
export function linear(hex, share) {
  return [...[1, 3, 5].map((i) => (parseInt(hex.slice(i, i + 2), 16) / 255) ** 2.2), share];
}
