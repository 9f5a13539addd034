// Calls every function of the package with any values: `node border.mjs PACKAGE SECONDS [SEED]`, where PACKAGE is the folder that
// build.sh writes. Each call gives a result, or an exception of the package that names the argument, and its object stays usable.
// It never traps. fuzz/campaign.sh runs it as the target `npm`, and node.test.mjs runs some thousand calls.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const EXCEPTIONS = new Set([
  "InputError", "SceneError", "TangledError", "BlockedError", "CheckpointError", "MeshError", "TooManyPairsError", "TooMuchMemoryError",
]);

/** A small scene with all that can be driven, and with a body of another engine. */
const SCENE = `${readFileSync(new URL("../../c/tests/messages/scene.toml", import.meta.url), "utf8")}
[[body]]
name = "box"
shape = "ball"
centre = [0.05, 0.05, -0.3]
radius = 0.05
around = 6
mass = 0.1
proxy = true
`;

const TRIANGLES = [0, 1, 2, 3, 4, 5];
const START = [-5, -5, 0, 5, -5, 0, 0, 5, 0, 0, 0, 1, 1, 0, 1.1, 0, 1, 1.2];
const END = START.map((x, i) => (i >= 9 && i % 3 === 2 ? x - 2 : x));
const PAIR = [0.2, 0.2, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0];
const OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/** Whole numbers from 0 to 2³² − 1, the same from a seed on every machine. */
function generator(seed) {
  let state = seed >>> 0;
  const word = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return (mixed ^ (mixed >>> 14)) >>> 0;
  };
  const below = (count) => word() % count;
  return { word, below, one: (list) => list[below(list.length)] };
}

const NUMBERS = [
  NaN, Infinity, -Infinity, -0, 0, 1, 2, -1, 2.5, 1e-300, 5e-324, 1e308, 2 ** 31, 2 ** 32 - 1, 2 ** 32, 2 ** 32 + 6, 2 ** 53 - 1, 2 ** 53,
];
const throwing = () => {
  throw new Error("the caller's own");
};

/** Values that are no number, text or list. */
const OTHERS = [
  null, true, false, Symbol("s"), 10n, () => 1, {}, new Date(0), new Map([[0, 1]]), /x/, Promise.resolve(), Object.create(null),
  { valueOf: throwing, toString: throwing }, { get length() { return throwing(); } }, new Proxy({}, { get: throwing, ownKeys: throwing }),
  { length: -1 }, { length: NaN }, { length: "6" }, new ArrayBuffer(8), new DataView(new ArrayBuffer(48)), new Set([1]),
];
const KINDS = [
  Int8Array, Uint8Array, Uint8ClampedArray, Int16Array, Uint16Array, Int32Array, Uint32Array, Float32Array, Float64Array,
];

function detached(kind) {
  const array = new kind(6);
  structuredClone(array.buffer, { transfer: [array.buffer] });
  return array;
}

/** Lists that hold too few, too many or no numbers. */
function list(random, right) {
  const numbers = Array.isArray(right) || ArrayBuffer.isView(right) ? [...right] : [0, 1, 2];
  const place = numbers.length > 0 ? random.below(numbers.length) : 0;
  switch (random.below(14)) {
    case 0: return numbers.with(place, random.one(NUMBERS));
    case 1: return numbers.with(place, random.one(OTHERS));
    case 2: return numbers.with(place, undefined);
    case 3: return numbers.slice(0, place);
    case 4: return [...numbers, ...numbers];
    case 5: return new (random.one(KINDS))(numbers);
    case 6: return Float64Array.from(numbers.with(place, random.one(NUMBERS)));
    case 7: return detached(random.one(KINDS));
    case 8: return random.one([BigInt64Array.of(0n, 1n, 2n), new BigUint64Array(6)]);
    case 9: return [numbers, numbers];
    case 10: return random.one([{ length: 2 ** 32 - 1 }, { length: 3, 0: 0, 1: 1 }, new Array(2 ** 32 - 1), new Array(6)]);
    case 11: return { length: numbers.length, ...numbers };
    case 12: return new Proxy(numbers, { get: (target, name) => (name === String(place) ? throwing() : target[name]) });
    default: return new (random.one([Float64Array, Uint32Array]))(new SharedArrayBuffer(8 * 6));
  }
}

function any(random, right) {
  switch (random.below(8)) {
    case 0: return undefined;
    case 1: return random.one(OTHERS);
    case 2: return random.one(["", "1", "ball", "a\0b", "\ud800", "x".repeat(1000), new String("ball")]);
    case 3: return random.one(NUMBERS);
    default: return list(random, right);
  }
}

const isList = (value) => Array.isArray(value) || ArrayBuffer.isView(value) || (typeof value === "object" && value !== null && "length" in value);
/** For each kind of argument, whether a value has the wrong type, whatever it holds. */
const WRONG = {
  number: (value) => typeof value !== "number",
  list: (value) => !isList(value),
  text: (value) => typeof value !== "string",
  texts: (value) => !isList(value),
  bytes: (value) => !(value instanceof Uint8Array),
  object: (value) => typeof value !== "object" && typeof value !== "function",
  flag: () => false,
};

/** The functions: the class, their name, and their arguments: name, kind, right value, whether it may be left out. */
const CALLS = [
  ["Detector", "constructor", [["vertexCount", "number", 6], ["triangles", "list", TRIANGLES], ["looseEdges", "list", [0, 3], true], ["loosePoints", "list", [5], true]]],
  ["Detector", "contacts", [["start", "list", START, true], ["end", "list", END, true], ["geometry", "flag", true, true]]],
  ["Detector", "earliest", [["start", "list", START, true], ["end", "list", END, true]]],
  ["Detector", "isFree", [["start", "list", START, true], ["end", "list", END, true]]],
  ["Detector", "candidates", [["start", "list", START, true], ["end", "list", END, true], ["swept", "flag", true, true]]],
  ["Detector", "near", [["positions", "list", START], ["distance", "number", 1.05]]],
  ["Detector", "truncate", [["start", "list", START, true], ["wanted", "list", END, true]]],
  ["Detector", "intersections", [["positions", "list", START]]],
  ["Detector", "hasIntersections", [["positions", "list", START]]],
  ["Detector", "setLimits", [["limits", "object", { separation: 0.1 }]]],
  ["Detector", "setMoving", [["moving", "list", [1, 1, 1, 1, 1, 1], true]]],
  ["Detector", "setCollisionFilter", [["filter", "object", { patches: [0, 0, 0, 1, 1, 1] }]]],
  ["Detector", "setCoherent", [["coherent", "flag", true]]],
  ["Detector", "setPairLimit", [["limit", "number", 100, true]]],
  ["Detector", "setMemoryLimit", [["limit", "number", 1e6, true]]],
  ["Simulation", "constructor", [["text", "text", SCENE], ["files", "object", { "a.obj": OBJ }, true]]],
  ["Simulation", "step", [["count", "number", 1, true]]],
  ["Simulation", "advance", [["seconds", "number", 1 / 240], ["most", "number", 4, true]]],
  ["Simulation", "normals", []],
  ["Simulation", "bodyVertices", [["body", "text", "ball"]]],
  ["Simulation", "placeBody", [["body", "text", "ball"], ["translation", "list", [0, 0, -1e-3]], ["rotation", "list", [0, 0, 0, 1], true]]],
  ["Simulation", "bringBody", [["body", "text", "box"], ["translation", "list", [0, 0, 1e-3]], ["rotation", "list", [0, 0, 0, 1]], ["velocity", "list", [0, 0, 0.1]], ["spin", "list", [0, 0, 1]]]],
  ["Simulation", "teleport", [["bodies", "texts", ["ball"]], ["translation", "list", [0, 0, 1]], ["rotation", "list", [0, 0, 0, 1], true], ["cloths", "texts", ["cloth"], true]]],
  ["Simulation", "moveBody", [["body", "text", "ball"], ["positions", "list", START]]],
  ["Simulation", "movePins", [["group", "number", 0], ["positions", "list", [0, 0, 0, 0, 0.05, 0, 0, 0.1, 0]]]],
  ["Simulation", "setWind", [["velocity", "list", [0, 0, 1]]]],
  ["Simulation", "setVelocity", [["vertices", "list", [0, 1]], ["velocity", "list", [0, 0, 1]]]],
  ["Simulation", "addForce", [["vertices", "list", [0, 1]], ["force", "list", [0, 0, 1]]]],
  ["Simulation", "placement", [["body", "text", "ball"]]],
  ["Simulation", "bodyMotion", [["body", "text", "ball"]]],
  ["Simulation", "proxyLoad", [["body", "text", "box"]]],
  ["Simulation", "bodyLoad", [["body", "text", "ball"], ["about", "list", [0, 0, 1], true]]],
  ["Simulation", "pinLoad", [["group", "number", 0], ["about", "list", [0, 0, 1], true]]],
  ["Simulation", "attachmentLoad", [["group", "number", 0], ["about", "list", [0, 0, 1], true]]],
  ["Simulation", "checkpoint", []],
  ["Simulation", "resume", [["checkpoint", "bytes", new Uint8Array(64)]]],
  [undefined, "timeOfImpact", [["kind", "text", "vertex-face"], ["start", "list", PAIR], ["end", "list", PAIR], ["separation", "number", 0.1, true], ["tolerance", "number", 1e-6, true]]],
  [undefined, "pairVerdicts", [["kind", "text", "edge-edge"], ["start", "list", PAIR], ["end", "list", PAIR]]],
  [undefined, "readMesh", [["name", "text", "a.obj"], ["bytes", "bytes", new TextEncoder().encode(OBJ)]]],
  [undefined, "effectNames", [["text", "text", SCENE], ["files", "object", {}, true]]],
];

/** The functions of the package that no call above names; there are none. */
export function missing(library) {
  const known = new Set(CALLS.map(([owner, name]) => `${owner ?? ""}.${name}`));
  const found = [];
  for (const [name, value] of Object.entries(library)) {
    // wasm-bindgen has its own functions to load a module and to free an object.
    if (typeof value !== "function" || ["load", "initSync"].includes(name)) continue;
    if (!["Detector", "Simulation"].includes(name)) found.push(`.${name}`);
    else for (const [own, { value: method }] of Object.entries(Object.getOwnPropertyDescriptors(value.prototype)))
      if (typeof method === "function" && own !== "free" && !own.startsWith("__")) found.push(`${name}.${own}`);
  }
  return found.filter((name) => !known.has(name));
}

/** A property of a settings object gets any value. */
function changed(random, right) {
  const names = ["separation", "tolerance", "touching", "groups", "patches", "excluded", "other", "a.obj"];
  return { ...right, [random.one(names)]: any(random, TRIANGLES) };
}

/** Calls functions with any values, and checks each answer. */
export class Border {
  constructor(library, seed) {
    [this.library, this.random, this.calls] = [library, generator(seed), 0];
    this.make = { Detector: () => new library.Detector(6, TRIANGLES), Simulation: () => new library.Simulation(SCENE) };
    this.objects = { Detector: this.make.Detector(), Simulation: this.make.Simulation() };
  }

  /** Makes one call. */
  call() {
    const { library, random, objects } = this;
    this.calls += 1;
    const [owner, name, parameters] = random.one(CALLS);
    const values = parameters.map(([, , right]) => right);
    // Mostly one argument is wrong, so that the message must name it.
    const wrong = parameters.length > 0 ? random.below(parameters.length) : -1;
    if (wrong >= 0) {
      const right = values[wrong];
      values[wrong] = parameters[wrong][1] === "object" && random.below(2) === 0 ? changed(random, right) : any(random, right);
      // That many steps are no error.
      if (name === "step" && Number.isInteger(values[0]) && values[0] > 3) values[0] = 3;
    }
    const said = () => `${owner ?? ""}.${name}, argument ${wrong}, call ${this.calls}`;
    try {
      if (name === "constructor") new library[owner](...values).free();
      else if (owner === undefined) library[name](...values);
      else objects[owner][name](...values);
    } catch (error) {
      assert.ok(EXCEPTIONS.has(error?.name), `${said()}: ${error?.stack ?? String(error)}`);
      assert.ok(/^[^\p{Cc}]{5,2000}$/u.test(error.message), `${said()}: not one readable line: ${error.message}`);
      const [argument, kind, , isOptional] = parameters[wrong];
      const value = values[wrong];
      if (WRONG[kind](value) && !(isOptional && (value === undefined || value === null))) {
        assert.equal(error.name, "InputError", said());
        assert.ok(error.message.startsWith(argument), `${said()}: the message does not name '${argument}': ${error.message}`);
      }
    }
    this.checkObjects(said);
  }

  /** After any call both objects answer, and each is made again at times. */
  checkObjects(said) {
    const { objects, random } = this;
    assert.equal(objects.Detector.components.length, 6, said());
    assert.ok(objects.Simulation.positions.every(Number.isFinite), said());
    const name = random.one(["Detector", "Simulation"]);
    if (random.below(64) === 0) {
      objects[name].free();
      objects[name] = this.make[name]();
    }
  }
}

async function main([folder, seconds, seed]) {
  const library = await import(pathToFileURL(join(folder, "index.js")));
  await library.load();
  const begin = performance.now();
  const first = Number(seed ?? Date.now() % 2 ** 32);
  const border = new Border(library, first);
  const elapsed = () => (performance.now() - begin) / 1000;
  try {
    while (elapsed() < Number(seconds)) border.call();
  } catch (error) {
    console.error(`seed ${first}:`, error);
    process.exitCode = 1;
  }
  // As libFuzzer names them, for fuzz/campaign.sh.
  console.log(`stat::number_of_executed_units: ${border.calls}`);
  console.log(`stat::average_exec_per_sec: ${Math.round(border.calls / elapsed())}`);
}
if (process.argv[1]?.endsWith("border.mjs")) await main(process.argv.slice(2));
