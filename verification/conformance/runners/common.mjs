// What runners in JavaScript share. See common.py.
import readline from 'node:readline';

/** A hexadecimal float as a number. */
export function number(text) {
  const found = /^(-?)0x([01])(?:\.([0-9a-f]+))?p([+-]\d+)$/.exec(text);
  if (!found) return Number(text.replace('inf', 'Infinity'));
  const [, sign, lead, digits = '', exponent] = found;
  const mantissa = Number(BigInt('0x' + lead + digits));
  // Two steps, since the power may be below the smallest number.
  const power = Number(exponent) - 4 * digits.length;
  const half = Math.trunc(power / 2);
  return (sign ? -1 : 1) * mantissa * 2 ** half * 2 ** (power - half);
}

/** Reads the numbers of a case: points one after the other, and the triangles of both meshes. */
function read(question, words) {
  if (question !== 'meshes' && question !== 'moving-mesh') return { x: words.map(number), faces: [[0, 1, 2], [3, 4, 5]], split: 1 };
  const [vertices, count, split] = words.slice(0, 3).map(Number);
  const index = words.slice(words.length - 3 * count).map(Number);
  const faces = Array.from({ length: count }, (_, i) => index.slice(3 * i, 3 * i + 3));
  return { x: words.slice(3, words.length - 3 * count).map(number), faces, split, vertices };
}

/** The two meshes: coordinates and indices of each. */
export function two({ x, faces, split }) {
  const first = Math.max(...faces.slice(0, split).flat()) + 1;
  const own = faces.slice(split).flat().map((v) => v - first);
  return [[x.slice(0, 3 * first), faces.slice(0, split).flat()], [x.slice(3 * first), own]];
}

/** Answers until the input ends. `questions[q](case)` returns a function that is timed and returns [touches, time or null]. */
export async function serve(version, questions) {
  const say = (line) => process.stdout.write(line + '\n');
  say(`ready ${version}`);
  for await (const line of readline.createInterface({ input: process.stdin })) {
    const [name, question, , ...words] = line.trim().split(' ');
    try {
      const ask = questions[question](read(question, words));
      let best = Infinity;
      let said;
      for (let i = 0; i < 3; i++) {
        const begin = process.hrtime.bigint();
        said = ask();
        best = Math.min(best, Number(process.hrtime.bigint() - begin));
      }
      const [touches, time] = said;
      say(`${name} ${touches ? 'touches' : 'none'} ${touches && time !== null ? time : '-'} ${best}`);
    } catch (error) {
      say(`${name} refused - 0 ${String(error?.message ?? error).replace(/\s+/g, ' ').slice(0, 100)}`);
    }
  }
  process.exit(0);
}
