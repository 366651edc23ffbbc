// The item ID of a pixel, and its derivation as a table (reference/conformance/verdict/explanation.h).
import {element, status, type Control} from "./controls";
import type {Explanation, Vector} from "./core";

/** Integers are exact. */
function digits(value: number): string {
  return String(Number.isInteger(value) ? value : Number(value.toPrecision(6)));
}

function point(numbers: number[]): string {
  return `(${numbers.map(digits).join(", ")})`;
}

/** Names of the steps with their values. */
function stepsOf({derivation}: Explanation): [name: string, value: string][] {
  if (!derivation) return [["no triangle", "none covers the sample: background"]];
  const {corners, sample, edges, inverse_depth, u, v, texel, sums, faces_away, clip, runner_up} = derivation;
  const steps: [name: string, value: string][] = [
    ["triangle", `${derivation.triangle} of draw ${derivation.draw}${faces_away ? ", faces away" : ""}`],
    ["corners x, y, w", corners.map(({view}) => point(view)).join(" ")],
    ["snapped", corners.map((corner) => point(corner.snapped)).join(" ")],
    ["sample", point(sample)],
    ["edge functions", edges.map(({value, kind}) => (value ? digits(value) : `0 (${kind})`)).join(", ")],
    ["1/w", digits(inverse_depth) + (runner_up ? `, of the next triangle ${digits(runner_up.inverse_depth)}` : "")],
  ];
  if (clip.cut_by.length) steps.splice(1, 0, ["clipped", clip.cut_by.join(", ")]);
  if (texel) {
    steps.push(["u, v", `${digits(u)}, ${digits(v)}`]);
    steps.push(["texel", `column ${texel.column}, row ${texel.row} of ${texel.width} × ${texel.height}`]);
    steps.push(["offset + texel", sums.map((sum) => `${sum.offset} + ${sum.texel} → ${sum.result}`).join(", ")]);
  }
  return steps;
}

/** Replaces the content of `parent` by the derivation of a pixel; column and row count in the viewport. */
export function showDerivation(parent: HTMLElement, vector: Vector, face: string, column: number, row: number): void {
  parent.replaceChildren();
  const table = element(parent, "table", {className: "derivation"});
  for (const [name, value] of stepsOf(vector.explain(face, column, row))) {
    const line = element(table, "tr");
    element(line, "th", {scope: "row", textContent: name});
    element(line, "td", {textContent: value});
  }
}

/** "expected 266, found the background" */
function describeIds(expected: number, found: number, background: number): string {
  const named = (id: number) => (id === background ? "the background" : String(id));
  return `expected ${named(expected)}, found ${named(found)}`;
}

/** A pixel of a face; column and row count in the viewport. */
interface ShownPixel {
  vector: Vector;
  face: string;
  column: number;
  row: number;
  expected: number; // item IDs
  found: number;
}

/** Says what a pixel should hold and what it holds, and derives it. */
export class PixelText {
  private readonly ids: Control<string>;
  private readonly derivation: HTMLElement;

  constructor(parent: HTMLElement) {
    this.ids = status(parent, "pixel");
    this.derivation = element(parent, "div");
  }

  show({vector, face, column, row, expected, found}: ShownPixel, verdict?: string): void {
    const ids = describeIds(expected, found, vector.json().background);
    this.ids.set(`column ${column}, row ${row} of ${face}: ${ids}${verdict ? ` (${verdict})` : ""}`);
    showDerivation(this.derivation, vector, face, column, row);
  }

  clear(): void {
    this.ids.set("");
    this.derivation.replaceChildren();
  }
}
