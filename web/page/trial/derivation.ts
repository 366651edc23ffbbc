// The derivation of a pixel in words; reference/conformance/verdict/explanation.h has the keys of an explanation.
import type {Explanation} from "../core";

const short = (value: number): string => String(Number(value.toPrecision(6)));

function edge({value, kind}: {value: number; kind: string}): string {
  return value === 0 ? `0 on a ${kind === "other" ? "right or bottom" : kind} edge` : String(value);
}

function coverage(sample: number[], triangle: number, draw: number, edges: {value: number; kind: string}[]): string {
  const [x, y] = sample.map((value) => value / 256);
  const values = edges.map(edge).join(", ");
  return `Triangle ${triangle} of draw ${draw} covers the sample (${x}, ${y}): its edge functions are ${values}.`;
}

function depth(inverseDepth: number, next: {triangle: number; difference: number} | null): string {
  const visible = `1/w = ${short(inverseDepth)} is interpolated at the sample.`;
  return next ? `${visible} Triangle ${next.triangle} is behind it, by ${short(next.difference)}.` : visible;
}

function texture(u: number, v: number, texel: Record<string, number>): string {
  const {width, height, column, row} = texel;
  return `u = ${short(u)} and v = ${short(v)} give texel (${column}, ${row}) of ${width} × ${height}.`;
}

function sum({bits, offset, texel, result}: Record<string, number>): string {
  return `Channel of ${bits} bits: ${offset} + ${texel} ${offset + texel === result ? "=" : "is limited to"} ${result}.`;
}

/** One sentence per step. */
export function derivationOf({word, derivation}: Explanation): string[] {
  if (!derivation) return ["No triangle covers the sample, so the pixel holds the item ID of the background."];
  const {sample, triangle, draw, edges, inverse_depth, runner_up, u, v, texel, sums, faces_away} = derivation;
  return [
    coverage(sample, triangle, draw, edges),
    depth(inverse_depth, runner_up),
    ...(faces_away ? ["The triangle faces away."] : []),
    ...(texel ? [texture(u, v, texel), ...sums.map(sum)] : []),
    `The item ID is ${word}.`,
  ];
}
