// Calls the worker. A worker that died is replaced, so that one failure does not end the page.

export class Remote {
  #worker = null;
  #waiting = new Map();
  #next = 0;

  /** Calls a function of worker.js. Rejects with the library's error. */
  call(name, ...values) {
    this.#worker ??= this.#start();
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ id, name, values });
    });
  }

  #start() {
    const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker.onmessage = ({ data: { id, value, error } }) => {
      const { resolve, reject } = this.#waiting.get(id);
      this.#waiting.delete(id);
      if (!error) return resolve(value);
      reject(Object.assign(new Error(error.message), { name: error.name }));
      if (error.isFatal) this.#restart("the module ran out of memory or failed; it was started again");
    };
    worker.onerror = (event) => {
      event.preventDefault();
      this.#restart(event.message || "the worker could not start");
    };
    return worker;
  }

  #restart(message) {
    this.#worker?.terminate();
    this.#worker = null;
    for (const { reject } of this.#waiting.values()) reject(new Error(message));
    this.#waiting.clear();
  }
}
