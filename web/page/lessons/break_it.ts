// Devices with a known fault: what they draw, how the diagnosis names the fault, and hidden ones to be named.
import {BreakTask} from "../break_it/break_task";
import {FindTask} from "../break_it/find_task";
import type {Task} from "../break_it/task";
import {button, columns, element, row, sourceLink, text} from "../controls";
import type {Core, Vector} from "../core";
import {FaceView} from "../face_view";
import type {Lesson, Page, State} from "../lesson";

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

const modes = [
  ["break", "Break a device"],
  ["find", "Find a hidden fault"],
] as const;
type Mode = (typeof modes)[number][0];

const modeOf = (state: State): Mode => state.option<Mode>("task", modes.map(([mode]) => mode), "break");

function showTask(parent: HTMLElement, {core, state}: Page, vectors: Map<string, Vector>, mode: Mode): void {
  parent.replaceChildren();
  const controls = element(parent, "div");
  const [left, right] = columns(parent);
  const pictures = element(left, "div");
  const text = element(mode === "find" ? left : right, "div");
  const view = new FaceView(pictures, element(right, "div"), core, 250);
  const task: Task = {place: {controls, text, view}, state, vectors};
  if (mode === "find") new FindTask(task);
  else new BreakTask(task);
}

function addModes(parent: HTMLElement, state: State, change: (mode: Mode) => void): void {
  const bar = row(parent);
  const buttons = modes.map(([mode, label]) =>
    button(bar, label, () => {
      state.set("task", mode);
      press(mode);
      change(mode);
    }),
  );
  const press = (pressed: Mode) =>
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
    addModes(root, page.state, (mode) => showTask(task, page, vectors, mode));
    const task = element(root, "div");
    showTask(task, page, vectors, modeOf(page.state));
    sourceLink(root, "reference/conformance/diagnosis/fault.h", "The faults");
  },
};
