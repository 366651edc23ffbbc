// Three pictures side by side: expected item IDs, found ones, and where they differ.
import type {Rgb} from "./colours";
import {element} from "./controls";
import type {ErrorPixel} from "./core";
import {idColours, PixelCanvas} from "./pixels";

interface Compared {
  columns: number;
  rows: number;
  background: number;
  expected: Uint32Array; // row 0 first
  found: Uint32Array;
}

const exact: Rgb = [0.32, 0.34, 0.37];

/** Colours of pixel verdicts, by their names in Core.verdicts. */
export const verdictColours: Record<string, Rgb> = {
  exact,
  coverage: [0.35, 0.6, 1],
  texel: [0.3, 0.75, 0.4],
  depth: [0.95, 0.85, 0.3],
  "loose-clipping": [0.75, 0.5, 0.95],
  error: [1, 0.25, 0.2],
};

/** "expected 266 (draw 0 texel 0,2), found 16777215 (background)" */
export function describeError({expected, expected_from, found, found_from}: ErrorPixel): string {
  const from = (origin: string | null) => (origin ? ` (${origin})` : "");
  return `expected ${expected}${from(expected_from)}, found ${found}${from(found_from)}`;
}

export class Comparison {
  private readonly canvases: PixelCanvas[];

  /** @param size CSS pixels of the longer side of a picture */
  constructor(parent: HTMLElement, size: number) {
    const all = element(parent, "div", {className: "comparison"});
    this.canvases = ["Expected", "Found", "Difference"].map((label) => {
      const figure = element(all, "figure");
      element(figure, "figcaption", {textContent: label});
      return new PixelCanvas(figure, {label, columns: 1, rows: 1, size});
    });
  }

  /** @param verdict the name of a pixel's verdict in verdictColours */
  show({columns, rows, background, expected, found}: Compared, verdict?: (pixel: number) => string): void {
    const verdictOf = verdict ?? ((pixel: number) => (expected[pixel] === found[pixel] ? "exact" : "error"));
    const difference = new Uint8ClampedArray(4 * expected.length);
    for (let pixel = 0; pixel < expected.length; ++pixel) {
      const name = verdictOf(pixel);
      const isDark = name === "exact" && expected[pixel] === background;
      const colour = verdictColours[name].map((value) => 255 * (isDark ? value / 3 : value));
      difference.set([...colour, 255], 4 * pixel);
    }
    const pictures = [idColours(expected, background), idColours(found, background), difference];
    this.canvases.forEach((canvas, k) => canvas.show(pictures[k], columns, rows));
  }

  /** Calls `selected` when a pixel of one of the pictures is selected, and marks it in all. */
  onSelect(selected: (column: number, row: number) => void): void {
    for (const canvas of this.canvases)
      canvas.onSelect((column, row) => {
        this.select(column, row);
        selected(column, row);
      });
  }

  select(column: number, row: number): void {
    for (const canvas of this.canvases) canvas.select(column, row);
  }
}
