// Devices with a known fault: what they draw, how the diagnosis names the fault, and hidden ones to be named.
import {hiddenDevices, type HiddenDevice} from "../break_it/hidden_devices";
import {describeError} from "../comparison";
import {button, choice, columns, element, row, sourceLink, status, text, type Option} from "../controls";
import type {Core, ItemBuffers, Vector} from "../core";
import {differing, FaceView} from "../face_view";
import {drawWithFault} from "../faulty_device";
import type {Lesson, Page, State} from "../lesson";
import {plural, sum} from "../numbers";

const vectorNames = [
  "five-faces",
  "perspective-floor",
  "layout-r8g8b8a8",
  "unaligned-clamped-add",
  "rectangular-map",
  "magnified",
  "clamped-coordinates",
  "crossing",
  "depth-range",
  "coplanar-slope",
  "sample-grid-later-nearer",
  "shared-vertices",
  "near-plane-sheet",
  "backs",
  "scissors",
  "odd-faces",
  "edge-offsets-r5g6b5",
];

function vectorsOf(core: Core): Map<string, Vector> {
  const suite = new Map(core.suite().map((vector) => [vector.name(), vector]));
  return new Map(vectorNames.map((name) => [name, suite.get(name)!]));
}

/** The parts of the page for one task. */
interface Place {
  controls: HTMLElement;
  task: HTMLElement;
  view: FaceView;
}

/** The fault is chosen, and the diagnosis names it. Returns what ends it. */
function breakDevice({controls, task, view}: Place, {core, state}: Page, vectors: Map<string, Vector>): () => void {
  let vector = vectors.get(state.text("vector", "five-faces")) ?? vectors.get("five-faces")!;
  let fault = state.text("fault", "picture upside down");
  let variant = state.text("variant", "");
  let timer = 0;
  const diagnosis = status(task, "diagnosis");
  const firstError = status(task, "first-error");
  const purpose = text(task, "");
  const bar = row(controls);
  choice(bar, {label: "Test vector", options: vectorNames, value: vector.name()}, (name) => {
    vector = vectors.get(name)!;
    offerFaults();
    draw();
  });
  const faultBox = element(bar, "div", {className: "control"});
  const variantBox = element(bar, "div", {className: "control"});

  /** Those that the vector can show: the format of its item IDs has variants of them. */
  function offerFaults(): void {
    const faults = vector.faults().filter(({variants}) => variants.length);
    if (!faults.some(({name}) => name === fault)) fault = faults[0].name;
    faultBox.replaceChildren();
    choice(faultBox, {label: "Fault", options: faults.map(({name}) => name), value: fault}, (name) => {
      fault = name;
      offerVariants();
      draw();
    });
    offerVariants();
  }

  function offerVariants(): void {
    const {variants} = vector.faults().find(({name}) => name === fault)!;
    if (!variants.includes(variant)) variant = variants[0];
    variantBox.replaceChildren();
    variantBox.hidden = variants.length === 1;
    if (variants.length === 1) return;
    choice(variantBox, {label: "Variant", options: variants, value: variant}, (name) => {
      variant = name;
      draw();
    });
  }

  function draw(): void {
    state.set("vector", vector.name());
    state.set("fault", fault);
    state.set("variant", variant);
    const found = drawWithFault(vector, fault, variant);
    const expected = vector.render();
    view.show(vector, expected, found);
    purpose.textContent = `This vector detects: ${vector.catches()}.`;
    diagnosis.set("Judging ...");
    firstError.set("");
    clearTimeout(timer);
    timer = window.setTimeout(() => diagnose(expected, found));
  }

  function advise(): string {
    const shows = (other: Vector) => sum(differing(other.render(), drawWithFault(other, fault)));
    const other = [...vectors.values()].find(shows);
    return other ? `Try ${other.name()}.` : "";
  }

  function diagnose(expected: ItemBuffers, found: ItemBuffers): void {
    const differences = sum(differing(expected, found));
    if (!differences) return diagnosis.set(`Every pixel is right: this vector cannot show the fault. ${advise()}`);
    const report = vector.judge(found, {});
    view.showVerdicts(report);
    const wrong = core.verdicts().indexOf("error");
    const errors = sum(report.pixels().map((face) => face.filter((verdict) => verdict === wrong).length));
    diagnosis.set(
      `${plural(differences, "pixel")} differ, ${errors} of them are errors. ` +
        (report.findings() ? `The diagnosis: ${report.findings()}` : "The diagnosis names no fault."),
    );
    const [error] = report.json().errors;
    if (!error) return;
    const {kind, column, row: line, face} = error;
    firstError.set(`The first error: ${kind} at column ${column}, row ${line} of ${face}, ${describeError(error)}.`);
  }

  offerFaults();
  draw();
  return () => clearTimeout(timer);
}

/** In an order that does not give the right one away. */
function candidates({fault, others}: HiddenDevice): string[] {
  return [fault, ...others].sort();
}

/** A hidden device, and a list of faults to choose from. */
function findFault({controls, task, view}: Place, {state}: Page, vectors: Map<string, Vector>): void {
  let number = state.number("device", 1, {min: 1, max: hiddenDevices.length, step: 1}) - 1;
  const bar = row(controls);
  const names = hiddenDevices.map((_, k): Option => [String(k), `Device ${k + 1}`]);
  choice(bar, {label: "Broken device", options: names, value: String(number)}, (value) => {
    number = Number(value);
    showDevice();
  });
  const drawn = choice(bar, {label: "Test vector that it draws", options: vectorNames, value: vectorNames[0]}, showVector);
  const form = element(task, "form", {className: "question"});
  let vector: Vector;

  function showVector(name: string): void {
    vector = vectors.get(name)!;
    const {fault, variant} = hiddenDevices[number];
    view.show(vector, vector.render(), drawWithFault(vector, fault, variant));
  }

  function showDevice(): void {
    state.set("device", number + 1);
    const device = hiddenDevices[number];
    drawn.set(device.vector);
    showVector(device.vector);
    ask(device);
  }

  function ask(device: HiddenDevice): void {
    form.replaceChildren();
    delete form.dataset.right;
    const group = element(form, "fieldset");
    element(group, "legend", {textContent: "Which fault does this device have?"});
    const list = element(group, "div", {className: "candidates"});
    for (const name of candidates(device)) {
      const line = element(list, "label", {className: "line"});
      element(line, "input", {type: "radio", name: "fault", value: name, required: true});
      line.append(` ${name}`);
    }
    const line = row(group);
    element(line, "button", {type: "submit", textContent: "Check"});
    const verdict = element(group, "p", {className: "verdict", role: "status"});
    verdict.dataset.testid = "answer";
    form.onsubmit = (event) => {
      event.preventDefault();
      answer(device, String(new FormData(form).get("fault")), verdict);
    };
  }

  function answer(device: HiddenDevice, guess: string, verdict: HTMLElement): void {
    const isRight = guess === device.fault;
    form.dataset.right = String(isRight);
    if (!isRight) {
      verdict.textContent = compareGuess(device, guess);
      return;
    }
    const {advice} = vectors.get(device.vector)!.faults().find(({name}) => name === device.fault)!;
    verdict.textContent = `Right. To mend it: ${advice}. ${device.story} `;
    element(verdict, "a", {href: device.source, textContent: device.source});
  }

  /** How far a device with the guessed fault is from this one on the vector that is shown. */
  function compareGuess({fault, variant}: HiddenDevice, guess: string): string {
    const device = drawWithFault(vector, fault, variant);
    const count = sum(differing(drawWithFault(vector, guess), device));
    return count
      ? `Not this one: with that fault, ${plural(count, "pixel")} of ${vector.name()} would look otherwise. Try again.`
      : `Not this one, though on ${vector.name()} it would look the same. Try another vector.`;
  }

  showDevice();
}

const modes: [value: string, label: string][] = [
  ["break", "Break a device"],
  ["find", "Find a hidden fault"],
];

const modeOf = (state: State) => state.option("task", modes.map(([value]) => value), "break");

/** Shows one of the two tasks; returns what ends it. */
function showTask(
  parent: HTMLElement,
  page: Page,
  vectors: Map<string, Vector>,
  mode: string,
): (() => void) | void {
  parent.replaceChildren();
  const controls = element(parent, "div");
  const [left, right] = columns(parent);
  const pictures = element(left, "div");
  const task = element(mode === "find" ? left : right, "div");
  const view = new FaceView(pictures, element(right, "div"), page.core, 250);
  const show = mode === "find" ? findFault : breakDevice;
  return show({controls, task, view}, page, vectors);
}

function makeModes(parent: HTMLElement, state: State, change: (mode: string) => void): void {
  const bar = row(parent);
  const buttons = modes.map(([value, label]) =>
    button(bar, label, () => {
      state.set("task", value);
      press(value);
      change(value);
    }),
  );
  const press = (pressed: string) =>
    buttons.forEach((one, k) => one.setAttribute("aria-pressed", String(modes[k][0] === pressed)));
  press(modeOf(state));
}

export const lesson: Lesson = {
  id: "break",
  title: "6. Break it",
  show(root, page) {
    text(
      root,
      "A device with a fault draws a test vector. The page compares each pixel with the rules, and draws the vector " +
        "with about sixty known faults: the one that gives the same item IDs is the diagnosis.",
    );
    const vectors = vectorsOf(page.core);
    let end: (() => void) | void;
    makeModes(root, page.state, (mode) => {
      end?.();
      end = showTask(task, page, vectors, mode);
    });
    const task = element(root, "div");
    end = showTask(task, page, vectors, modeOf(page.state));
    sourceLink(root, "reference/conformance/diagnosis/fault.h", "The faults");
    return () => end?.();
  },
};
