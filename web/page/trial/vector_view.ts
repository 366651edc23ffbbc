// A judged vector: the expected item IDs, those of the device, the verdict per pixel, and the derivation of a pixel.
import {button, choice, element, row, status} from "../controls";
import type {Core, ErrorPixel, VectorFace} from "../core";
import type {Page} from "../lesson";
import {idColours, PixelCanvas} from "../pixels";
import {derivationOf} from "./derivation";
import {countsOf, lastJudgement, reduceCase, summaryOf, type Answer, type SmallCase, type Trial} from "./trial";

/** In the order of Core.verdicts. */
const verdictColours = [
  [150, 150, 150],
  [40, 110, 230],
  [40, 160, 70],
  [235, 200, 40],
  [160, 80, 200],
  [225, 40, 40],
];

function verdictPicture(verdicts: Uint8Array): Uint8ClampedArray {
  return Uint8ClampedArray.from([...verdicts].flatMap((verdict) => [...verdictColours[verdict], 255]));
}

const plural = (count: number, noun: string): string => `${count} ${noun}${count === 1 ? "" : "s"}`;

function label(core: Core, {vector, report}: Answer): string {
  const {explained, errors} = summaryOf(countsOf(core, report));
  if (errors > 0) return `${vector.name()}: ${plural(errors, "error")}`;
  return `${vector.name()}: ${explained > 0 ? `${explained} explained` : "exact"}`;
}

/** Vectors with the most errors first, then those with the most explained pixels. */
function sorted(core: Core, answers: Answer[]): Answer[] {
  const rank = ({report}: Answer) => {
    const {explained, errors} = summaryOf(countsOf(core, report));
    return 1e9 * errors + explained;
  };
  return answers
    .map((answer) => ({answer, rank: rank(answer)}))
    .sort((a, b) => b.rank - a.rank)
    .map(({answer}) => answer);
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

function smallCaseText({vector, error, drawings}: SmallCase): string {
  const triangles = vector.json().draws.reduce((sum, {count}) => sum + count / 3, 0);
  const origin = (from: string | null) => (from ? ` (${from})` : "");
  return (
    `${plural(triangles, "triangle")} after ${plural(drawings, "drawing")}. Pixel ${error.column}, ${error.row} of ` +
    `${error.face} should be ${error.expected}${origin(error.expected_from)}, ` +
    `and the device draws ${error.found}${origin(error.found_from)}.`
  );
}

/** The triangles of a small vector, one line each. */
function trianglesOf(small: SmallCase): string[] {
  const {positions, indices} = small.vector.arrays();
  const corner = (index: number) => `(${[...positions.subarray(3 * index, 3 * index + 3)].join(", ")})`;
  const count = Math.min(4, indices.length / 3);
  return Array.from({length: count}, (_, k) => [...indices.subarray(3 * k, 3 * k + 3)].map(corner).join(" "));
}

export function showVectors(parent: HTMLElement, {core, state}: Page, trial: Trial): void {
  const answers = sorted(core, lastJudgement(trial).answers);
  const names = answers.map(({vector}) => vector.name());
  const chosen = names.includes(state.text("vector", "")) ? state.text("vector", "") : names[0];
  const options = answers.map((answer): [string, string] => [answer.vector.name(), label(core, answer)]);
  choice(parent, {label: "Vector", options, value: chosen}, (name) => {
    state.set("vector", name);
    show(name);
  });
  const box = element(parent, "div");
  const show = (name: string) => {
    box.replaceChildren();
    showVector(box, core, trial, answers[names.indexOf(name)]);
  };
  show(chosen);
}

function showVector(parent: HTMLElement, core: Core, trial: Trial, answer: Answer): void {
  const {vector, found, report} = answer;
  const {faces, background} = vector.json();
  const {errors} = report.json();
  const verdicts = report.pixels();
  const expected = report.expected();
  const place = firstPlace(faces, errors, verdicts);

  element(parent, "p", {className: "hint", textContent: `Detects: ${vector.catches()}.`});
  if (faces.length > 1)
    choice(
      parent,
      {label: "Face", options: faces.map(({name}, k) => [String(k), name]), value: String(place.face)},
      (face) => {
        place.face = Number(face);
        Object.assign(place, {column: 0, row: 0});
        draw();
      },
    );
  const pictures = element(parent, "div", {className: "pictures"});
  const canvases = ["Expected", "Drawn by the device", "Verdict"].map((title) => {
    const figure = element(pictures, "div");
    element(figure, "p", {className: "hint", textContent: title});
    const canvas = new PixelCanvas(figure, {label: title, columns: 1, rows: 1, size: 185});
    canvas.onSelect((column, row) => select(column, row));
    return canvas;
  });
  showLegend(parent, core);
  const pixelText = status(parent, "gpu-pixel");
  const steps = element(parent, "ol");

  const select = (column: number, row: number) => {
    Object.assign(place, {column, row});
    for (const canvas of canvases) canvas.select(column, row);
    const {name, scissor} = faces[place.face];
    const pixel = row * scissor[2] + column;
    const [i, j] = [column + scissor[0], row + scissor[1]];
    const verdict = core.verdicts()[verdicts[place.face][pixel]];
    pixelText.set(
      `Pixel ${i}, ${j} of ${name}: expected ${expected[place.face][pixel]}, ` +
        `drawn ${found[place.face][pixel]}: ${verdict}.`,
    );
    steps.replaceChildren();
    for (const step of derivationOf(vector.explain(name, i, j))) element(steps, "li", {textContent: step});
  };
  const draw = () => {
    const [, , width, height] = faces[place.face].scissor;
    const pixels = [
      idColours(expected[place.face], background),
      idColours(found[place.face], background),
      verdictPicture(verdicts[place.face]),
    ];
    canvases.forEach((canvas, k) => canvas.show(pixels[k], width, height));
    select(place.column, place.row);
  };
  draw();
  if (errors.length > 0) addReduction(parent, trial, answer);
}

function showLegend(parent: HTMLElement, core: Core): void {
  const legend = element(parent, "p", {className: "hint"});
  core.verdicts().forEach((verdict, k) => {
    const item = element(legend, "span", {className: "legend"});
    element(item, "span", {className: "swatch"}).style.background = `rgb(${verdictColours[k].join(" ")})`;
    item.append(verdict);
  });
}

function addReduction(parent: HTMLElement, trial: Trial, answer: Answer): void {
  const line = row(parent);
  const reduce = button(line, "Reduce the case", () => {
    reduce.disabled = true;
    void showReduction().finally(() => (reduce.disabled = false));
  });
  element(line, "p", {className: "hint", textContent: answer.report.findings()});
  const result = status(parent, "gpu-reduced");
  const details = element(parent, "ul");
  const showReduction = async () => {
    details.replaceChildren();
    const small = await reduceCase(trial.device, answer, lastJudgement(trial).profile);
    result.set(smallCaseText(small));
    for (const triangle of trianglesOf(small)) element(details, "li", {textContent: `Corners ${triangle}.`});
    const {face, column, row: pixelRow} = small.error;
    for (const step of derivationOf(small.vector.explain(face, column, pixelRow)))
      element(details, "li", {textContent: step});
  };
}
