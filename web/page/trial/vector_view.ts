// The judged vectors: pictures, verdicts, the derivation of a pixel, and the smallest case on which the device fails.
import {describeError} from "../comparison";
import {button, choice, element, row, status, type Option} from "../controls";
import type {Core} from "../core";
import {showDerivation} from "../derivation";
import {FaceView} from "../face_view";
import type {Page} from "../lesson";
import {plural, sum} from "../numbers";
import {reduceCase, type SmallCase} from "./small_case";
import {countsOf, summaryOf, type Answer, type Trial} from "./trial";

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
  const options = all.map((one, k): Option => [String(k), label(one)]);
  const first = indexOf(state.text("vector", ""));
  choice(parent, {label: "Vector", options, value: String(first)}, (chosen) => {
    state.set("vector", all[Number(chosen)].answer.vector.name());
    show(Number(chosen));
  });
  const box = element(parent, "div");
  const show = (index: number) => {
    box.replaceChildren();
    showVector(box, core, all[index].answer);
    if (all[index].errors > 0) addReduction(box, trial, all[index].answer, signal);
  };
  show(first);
}

function showVector(parent: HTMLElement, core: Core, {vector, found, report}: Answer): void {
  element(parent, "p", {className: "hint", textContent: `Detects: ${vector.catches()}.`});
  const view = new FaceView(parent, parent, core, 180);
  view.show(vector, report.expected(), found);
  view.showVerdicts(report);
  const [error] = report.json().errors;
  if (error) view.select(error.face, error.column, error.row);
}

function smallCaseText({vector, error, drawings}: SmallCase): string {
  const {draws, faces} = vector.json();
  const triangles = sum(draws.map(({count}) => count / 3));
  const pixels = sum(faces.map(({scissor: [, , columns, rows]}) => columns * rows));
  const size = `${plural(triangles, "triangle")} and ${plural(pixels, "pixel")}`;
  return `${size} after ${plural(drawings, "drawing")}: ${describeError(error)}`;
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
