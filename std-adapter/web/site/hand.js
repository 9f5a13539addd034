// A hand that grabs cloth and bodies, by pointer or by keyboard.

/** Where the hand holds, and where it leads. */
export class Hand {
  #canvas;
  #view;
  #remote;
  #scene;
  #held = null;

  constructor(canvas, view, remote, scene) {
    [this.#canvas, this.#view, this.#remote, this.#scene] = [canvas, view, remote, scene];
    // Before the view turns.
    canvas.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.#move(event), { capture: true });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => this.release(), { capture: true });
    canvas.addEventListener("keydown", (event) => this.#key(event), { capture: true });
  }

  get isHolding() { return this.#held !== null; }

  #place(event) {
    const box = this.#canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  /** Grabs what is at a place of the canvas. Returns whether there is something that can be moved. */
  #grab([across, down], reach, onlyBody = false) {
    const scene = this.#scene();
    const found = scene && this.#view.viewer?.pick(across, down, reach);
    if (!found) return false;
    const grabbed = this.#view.viewer.pointAt(across, down, found.depth);
    const body = scene.bodies.find(({ vertices: [from, to] }) => found.vertex >= from && found.vertex < to);
    if (body ? scene.name !== "sheet dropped on a ball" : onlyBody) return false;
    this.#held = { at: [across, down], depth: found.depth, from: grabbed, moved: body && (this.#placed ?? [0, 0, 0]), body: body?.name, vertex: found.vertex };
    this.#lead();
    return true;
  }

  #placed = null;

  #lead() {
    const { at, depth, from, moved, body, vertex } = this.#held;
    const point = this.#view.viewer.pointAt(...at, depth);
    const reach = 0.03;
    if (body) {
      this.#placed = point.map((x, i) => moved[i] + x - from[i]);
      this.#remote.call("hold", { body, target: this.#placed });
    } else {
      this.#remote.call("hold", { vertex, target: point, reach });
    }
  }

  #down(event) {
    if (event.button !== 0 || event.shiftKey || !this.#grab(this.#place(event), 0.035)) return;
    this.#canvas.focus({ preventScroll: true });
    this.#canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
  }

  #move(event) {
    if (!this.#held) return;
    this.#held.at = this.#place(event);
    this.#lead();
    event.stopImmediatePropagation();
  }

  #key(event) {
    if (event.key === "g" || event.key === "b") {
      if (this.#held) this.release();
      else if (event.key === "g") this.#grab([0.5, 0.5], 0.5);
      else this.#grabBody();
    } else if (event.key === "Escape" && this.#held) {
      this.release();
    } else if (this.#held && event.key.startsWith("Arrow")) {
      const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      this.#held.at = this.#held.at.map((x, i) => x + 0.02 * by[i]);
      this.#lead();
    } else {
      return;
    }
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  #grabBody() {
    for (let k = 0; k <= 20; k++) if (this.#grab([0.5, 0.5 + 0.02 * k], 0.03, true)) return;
  }

  release() {
    if (this.#held) this.#remote.call("hold", null);
    this.#held = null;
    if (this.#scene()?.stepsDone === 0) this.#placed = null;
  }
}
