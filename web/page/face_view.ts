// The pictures of a test vector that a device draws, one face at a time.
import {Comparison, verdictColours} from "./comparison";
import {choice, element, row, type Control, type Option} from "./controls";
import type {Core, ItemBuffers, Report, Vector} from "./core";
import {PixelText} from "./derivation";

/** The number of pixels per face that differ. */
export function differing(expected: ItemBuffers, found: ItemBuffers): number[] {
  return expected.map((ids, face) => ids.filter((id, pixel) => id !== found[face][pixel]).length);
}

/** The pictures of one face of a vector, and the derivation of the pixel that is selected. */
export class FaceView {
  private readonly comparison: Comparison;
  private readonly faceRow: HTMLElement;
  private faceChoice: Control<string> | undefined;
  private readonly legend: HTMLElement;
  private readonly pixelText: PixelText;
  private vector!: Vector;
  private expected!: ItemBuffers;
  private found!: ItemBuffers;
  private face = 0;
  private verdicts: Uint8Array[] | undefined;
  private selected: [column: number, line: number] = [0, 0];

  /** @param size CSS pixels of the longer side of a picture */
  constructor(pictures: HTMLElement, details: HTMLElement, private readonly core: Core, size: number) {
    this.faceRow = row(pictures);
    this.comparison = new Comparison(pictures, size);
    this.legend = element(pictures, "div");
    this.pixelText = new PixelText(details);
    this.comparison.onSelect((column, line) => this.explain(column, line));
  }

  /** Shows the face with most differences. */
  show(vector: Vector, expected: ItemBuffers, found: ItemBuffers): void {
    Object.assign(this, {vector, expected, found, verdicts: undefined});
    const counts = differing(expected, found);
    const {faces} = vector.json();
    this.faceRow.replaceChildren();
    this.legend.replaceChildren();
    this.face = counts.indexOf(Math.max(...counts));
    this.faceChoice = undefined;
    if (faces.length > 1)
      this.faceChoice = choice(
        this.faceRow,
        {
          label: "Face",
          options: faces.map(({name}, k): Option => [String(k), `${name}: ${counts[k]} differ`]),
          value: String(this.face),
        },
        (value) => {
          this.face = Number(value);
          this.draw();
          this.selectFirst();
        },
      );
    this.draw();
    this.selectFirst();
  }

  /** Colours the differences by their verdicts. */
  showVerdicts(report: Report): void {
    this.legend.replaceChildren();
    legend(this.legend);
    this.verdicts = report.pixels();
    this.draw();
    this.explain(...this.selected);
  }

  /** Shows a face and selects a pixel of it; column and row count in the viewport. */
  select(name: string, column: number, line: number): void {
    const {faces} = this.vector.json();
    this.face = faces.findIndex((face) => face.name === name);
    this.faceChoice?.set(String(this.face));
    this.draw();
    const [firstColumn, firstRow] = faces[this.face].scissor;
    this.comparison.select(column - firstColumn, line - firstRow);
    this.explain(column - firstColumn, line - firstRow);
  }

  private draw(): void {
    const {background, faces} = this.vector.json();
    const [, , columns, rows] = faces[this.face].scissor;
    const [expected, found] = [this.expected[this.face], this.found[this.face]];
    const names = this.core.verdicts();
    const verdicts = this.verdicts?.[this.face];
    this.comparison.show(
      {columns, rows, background, expected, found},
      verdicts && ((pixel) => names[verdicts[pixel]]),
    );
  }

  /** A difference where a triangle is visible, if there is one. */
  private selectFirst(): void {
    const {background, faces} = this.vector.json();
    const [expected, found] = [this.expected[this.face], this.found[this.face]];
    const differs = (id: number, pixel: number) => id !== found[pixel];
    const visible = expected.findIndex((id, pixel) => id !== background && differs(id, pixel));
    const first = Math.max(0, visible < 0 ? expected.findIndex(differs) : visible);
    const columns = faces[this.face].scissor[2];
    const [column, line] = [first % columns, Math.floor(first / columns)];
    this.comparison.select(column, line);
    this.explain(column, line);
  }

  private explain(column: number, line: number): void {
    this.selected = [column, line];
    const {name: face, scissor} = this.vector.json().faces[this.face];
    const [firstColumn, firstRow, columns] = scissor;
    const pixel = line * columns + column;
    const [expected, found] = [this.expected[this.face][pixel], this.found[this.face][pixel]];
    const verdict = this.verdicts && this.core.verdicts()[this.verdicts[this.face][pixel]];
    const place = {vector: this.vector, face, column: firstColumn + column, row: firstRow + line};
    this.pixelText.show({...place, expected, found}, verdict);
  }
}

function legend(parent: HTMLElement): void {
  const line = element(parent, "p", {className: "source", textContent: "Difference: "});
  for (const [name, colour] of Object.entries(verdictColours)) {
    const mark = element(line, "span", {className: "colour-mark"});
    mark.style.background = `rgb(${colour.map((value) => 255 * value).join(" ")})`;
    line.append(`${name} `);
  }
}
