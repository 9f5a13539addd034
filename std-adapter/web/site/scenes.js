// Built-in scenes, and scenes without some of their effects. `zoom` leaves room for what moves.

export const SCENES = [
  { file: "arm-sleeve.toml", name: "sleeve on a bending arm", zoom: 1.5 },
  { file: "drop.toml", name: "sheet dropped on a ball" },
  { file: "flag.toml", name: "flag in gusty wind" },
  { file: "walker.toml", name: "walker in a shirt" },
  { file: "hammock.toml", name: "ball in a hammock" },
];
const FILES = { "walker.toml": ["walker.glb", "walker-shirt.ply"] };

/** Returns the text of a scene and the files that it names. */
export async function loadScene(file) {
  const get = async (name) => {
    const answer = await fetch(new URL(`scenes/${name}`, import.meta.url));
    if (!answer.ok) throw new Error(`scenes/${name} cannot be loaded: ${answer.status}`);
    return answer;
  };
  let text = await (await get(file)).text();
  // The reader moves the ball, so the scene leaves it to code.
  if (file === "drop.toml") text = text.replace('shape = "ball"', 'shape = "ball"\ndriven = true');
  const files = {};
  for (const name of FILES[file] ?? []) files[name] = new Uint8Array(await (await get(name)).arrayBuffer());
  return { text, files };
}

/** Returns the text of a scene without an effect: its tables, from each header to the next one. */
export function without(text, effect) {
  const header = new RegExp(`^\\[\\[?effects\\.${effect}[.\\]]`);
  let isOff = false;
  return text.split("\n").filter((line) => {
    if (line.startsWith("[")) isOff = header.test(line);
    return !isOff;
  }).join("\n");
}
