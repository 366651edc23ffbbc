// A judged vector: the expected item IDs, those of the device, the verdict per pixel, and the derivation of a pixel.
import {Comparison, verdictColours} from "../comparison";
import {button, choice, element, row, status} from "../controls";
import type {Core, ErrorPixel, ItemBuffers, VectorFace, VectorJson} from "../core";
import {showDerivation} from "../derivation";
import type {Page} from "../lesson";
import {reduceCase, type SmallCase} from "./small_case";
import {countsOf, summaryOf, type Answer, type Trial} from "./trial";

const plural = (count: number, noun: string): string => `${count} ${noun}${count === 1 ? "" : "s"}`;

interface Listed {
  answer: Answer;
  errors: number;
  explained: number;
}

function listed(core: Core, answer: Answer): Listed {
  const {explained, errors} = summaryOf(countsOf(core, answer.report));
  return {answer, errors, explained};
}

function label({answer, errors, explained}: Listed): string {
  const explainedText = explained > 0 ? `${explained} explained` : "exact";
  return `${answer.vector.name()}: ${errors > 0 ? plural(errors, "error") : explainedText}`;
}

/** Shows the vectors of a trial, those with the most errors first, then those with the most explained pixels. */
export function showVectors(parent: HTMLElement, {core, state}: Page, trial: Trial, signal: AbortSignal): void {
  const all = trial.measured.answers.map((answer) => listed(core, answer));
  all.sort((a, b) => b.errors - a.errors || b.explained - a.explained);
  const indexOf = (name: string) => Math.max(0, all.findIndex(({answer}) => answer.vector.name() === name));
  const options = all.map((one, k): [string, string] => [String(k), label(one)]);
  const first = indexOf(state.text("vector", ""));
  choice(parent, {label: "Vector", options, value: String(first)}, (chosen) => {
    state.set("vector", all[Number(chosen)].answer.vector.name());
    show(Number(chosen));
  });
  const box = element(parent, "div");
  const show = (index: number) => {
    box.replaceChildren();
    new VectorView(box, core, all[index].answer);
    if (all[index].errors > 0) addReduction(box, trial, all[index].answer, signal);
  };
  show(first);
}

interface Place {
  face: number;
  column: number; // in the scissor rectangle
  row: number;
}

/** The first error, else the first pixel that is not exact, else the middle of the first face. */
function firstPlace(faces: VectorFace[], errors: ErrorPixel[], verdicts: Uint8Array[]): Place {
  if (errors.length > 0) {
    const face = faces.findIndex(({name}) => name === errors[0].face);
    return {face, column: errors[0].column - faces[face].scissor[0], row: errors[0].row - faces[face].scissor[1]};
  }
  const face = Math.max(0, verdicts.findIndex((pixels) => pixels.some((verdict) => verdict > 0)));
  const [, , width, height] = faces[face].scissor;
  const pixel = verdicts[face].findIndex((verdict) => verdict > 0);
  if (pixel < 0) return {face, column: width >> 1, row: height >> 1};
  return {face, column: pixel % width, row: Math.floor(pixel / width)};
}

class VectorView {
  private readonly comparison: Comparison;
  private readonly pixelText: {set(text: string): void};
  private readonly derivation: HTMLElement;
  private readonly json: VectorJson;
  private readonly verdicts: Uint8Array[];
  private readonly expected: ItemBuffers;
  private face: number;

  constructor(parent: HTMLElement, private readonly core: Core, private readonly answer: Answer) {
    this.json = answer.vector.json();
    this.verdicts = answer.report.pixels();
    this.expected = answer.report.expected();
    const {faces} = this.json;
    const place = firstPlace(faces, answer.report.json().errors, this.verdicts);
    this.face = place.face;
    element(parent, "p", {className: "hint", textContent: `Detects: ${answer.vector.catches()}.`});
    if (faces.length > 1) {
      const options = faces.map(({name}, k): [string, string] => [String(k), name]);
      choice(parent, {label: "Face", options, value: String(this.face)}, (face) => this.show(Number(face), 0, 0));
    }
    this.comparison = new Comparison(parent, 180);
    this.comparison.onSelect((column, line) => this.explain(column, line));
    showLegend(parent);
    this.pixelText = status(parent, "gpu-pixel");
    this.derivation = element(parent, "div");
    this.show(place.face, place.column, place.row);
  }

  private show(face: number, column: number, line: number): void {
    this.face = face;
    const [, , columns, rows] = this.json.faces[face].scissor;
    const [expected, found] = [this.expected[face], this.answer.found[face]];
    const names = this.core.verdicts();
    this.comparison.show(
      {columns, rows, background: this.json.background, expected, found},
      (pixel) => names[this.verdicts[face][pixel]],
    );
    this.comparison.select(column, line);
    this.explain(column, line);
  }

  private explain(column: number, line: number): void {
    const {name, scissor} = this.json.faces[this.face];
    const pixel = line * scissor[2] + column;
    const [x, y] = [column + scissor[0], line + scissor[1]];
    const verdict = this.core.verdicts()[this.verdicts[this.face][pixel]];
    const [expected, found] = [this.expected[this.face][pixel], this.answer.found[this.face][pixel]];
    this.pixelText.set(`column ${x}, row ${y} of ${name}: expected ${expected}, found ${found}: ${verdict}`);
    showDerivation(this.derivation, this.answer.vector, name, x, y);
  }
}

function showLegend(parent: HTMLElement): void {
  const legend = element(parent, "p", {className: "hint", textContent: "Difference: "});
  for (const [verdict, colour] of Object.entries(verdictColours)) {
    const mark = element(legend, "span", {className: "colour-mark"});
    mark.style.background = `rgb(${colour.map((value) => 255 * value).join(" ")})`;
    legend.append(`${verdict} `);
  }
}

function smallCaseText({vector, error, drawings}: SmallCase): string {
  const triangles = vector.json().draws.reduce((sum, {count}) => sum + count / 3, 0);
  const pixels = vector.json().faces.reduce((sum, {scissor}) => sum + scissor[2] * scissor[3], 0);
  const origin = (from: string | null) => (from ? ` (${from})` : "");
  return (
    `${plural(triangles, "triangle")} and ${plural(pixels, "pixel")} after ${plural(drawings, "drawing")}: ` +
    `expected ${error.expected}${origin(error.expected_from)}, found ${error.found}${origin(error.found_from)}`
  );
}

function addReduction(parent: HTMLElement, trial: Trial, answer: Answer, signal: AbortSignal): void {
  element(parent, "p", {className: "hint", textContent: answer.report.findings()});
  const reduce = button(row(parent), "Reduce the case", () => {
    reduce.disabled = true;
    void show()
      .catch((error) => {
        if (!signal.aborted) throw error;
      })
      .finally(() => (reduce.disabled = false));
  });
  const result = status(parent, "gpu-reduced");
  const derivation = element(parent, "div");
  const show = async () => {
    const progress = (drawings: number) => result.set(`${plural(drawings, "drawing")} ...`);
    const small = await reduceCase(trial.device, answer, trial.measured.profile, progress, signal);
    result.set(smallCaseText(small));
    showDerivation(derivation, small.vector, small.error.face, small.error.column, small.error.row);
  };
}
