// A rasterizer in the page's editor, step by step, compared with the core at every change.
import {Comparison} from "../comparison";
import {button, choice, columns, element, row, sourceLink, status, text, type Control, type Option} from "../controls";
import {PixelText} from "../derivation";
import {download} from "../download";
import type {Lesson, Page, State} from "../lesson";
import {plural} from "../numbers";
import {keep, kept} from "../storage";
import {CodeEditor} from "../write_it/editor";
import {StudentRoom, type Finding} from "../write_it/light_tasks";
import {LightView} from "../write_it/light_view";
import {judge, Tasks, type Drawn, type Judgement} from "../write_it/judge";
import {packed, unpacked} from "../write_it/packed_code";
import {CodeError, helpers, Sandbox} from "../write_it/sandbox";
import {allSteps, startOf} from "../write_it/steps";

const quietTime = 300; // milliseconds from the last key to the verdict

const codeKey = "code"; // under which the browser keeps the student's code

function describeInput(parent: HTMLElement): void {
  const box = element(parent, "details");
  element(box, "summary", {textContent: "What draw gets, and functions that it may call"});
  text(
    box,
    "<code>view</code>: <code>width</code>, <code>height</code> of the picture, <code>column</code>, " +
      "<code>row</code> of its first pixel, <code>resolution</code> R, <code>near</code>, <code>background</code>, " +
      "<code>mirrored</code>, <code>blend</code>, <code>channels</code> (<code>unit</code>, <code>size</code>: " +
      "⌊id / unit⌋ modulo size is the channel) and <code>triangles</code>. A triangle: three <code>corners</code> " +
      "(<code>x</code>, <code>y</code>, <code>w</code>, <code>u</code>, <code>v</code>; the vertex stage is done), " +
      "<code>offset</code>, <code>back</code> and <code>map</code> (<code>width</code>, <code>height</code>, " +
      "<code>ids</code>), both or either null.",
  );
  const list = element(box, "ul");
  for (const [call, what] of helpers) {
    const item = element(list, "li");
    element(item, "code", {textContent: call});
    item.append(`: ${what}`);
  }
}

function place({view, first}: Drawn): [column: number, row: number] {
  return [first % view.width, Math.floor(first / view.width)];
}

function describe({vectors, passed, shown}: Judgement, step: number): string {
  if (shown.first < 0) {
    return `Passed: every pixel of ${plural(vectors, "test vector")} is right. Go on to step ${step + 2}.`;
  }
  const {vector, wrong, answers} = shown;
  const count = allSteps[step].vectors ? "" : `${passed} of ${vectors} test vectors pass. `;
  const findings = vector.judge(answers, {}).findings();
  const diagnosis = findings ? ` It looks like this fault: ${findings}` : "";
  return `${count}Not yet: ${plural(wrong, "wrong pixel")} in ${vector.name()}. The first one is marked.${diagnosis}`;
}

/** Expected and found pixels of a face, and the derivation of the one that is selected. */
class DrawnView {
  private readonly comparison: Comparison;
  private readonly pixelText: PixelText;
  private drawn: Drawn | undefined;

  private readonly box: HTMLElement;
  private readonly notes: HTMLElement;
  private sandbox: Sandbox | undefined;

  constructor(parent: HTMLElement) {
    this.box = element(parent, "div");
    this.comparison = new Comparison(this.box, 150);
    this.pixelText = new PixelText(this.box);
    this.notes = element(this.box, "div");
    this.comparison.onSelect((column, line) => this.derive(column, line));
  }

  /** Selects the first wrong pixel. `sandbox` drew, and is asked for the student's notes. */
  show(drawn: Drawn, sandbox: Sandbox): void {
    Object.assign(this, {drawn, sandbox});
    this.notes.replaceChildren();
    const {view, expected, found} = drawn;
    this.comparison.show({columns: view.width, rows: view.height, background: view.background, expected, found});
    this.pixelText.clear();
    this.box.hidden = false;
    if (drawn.first < 0) return;
    this.comparison.select(...place(drawn));
    this.derive(...place(drawn));
  }

  /** An old picture does not stand beside a message about new code. */
  hide(): void {
    this.box.hidden = true;
  }

  private derive(column: number, line: number): void {
    if (!this.drawn) return;
    const {vector, face, view, expected, found} = this.drawn;
    const pixel = line * view.width + column;
    const place = {vector, face, column: view.column + column, row: view.row + line};
    this.pixelText.show({...place, expected: expected[pixel], found: found[pixel]});
    void this.showNotes(view, place.column, place.row);
  }

  /** The student's values of this pixel, under the right ones. */
  private async showNotes(view: Drawn["view"], column: number, row: number): Promise<void> {
    const notes = await this.sandbox!.notes(view, column, row);
    this.notes.replaceChildren();
    if (!notes.length) return;
    element(this.notes, "p", {className: "source", textContent: "Your notes of this pixel:"});
    const table = element(this.notes, "table", {className: "derivation"});
    for (const [name, value] of notes) {
      const line = element(table, "tr");
      element(line, "th", {scope: "row", textContent: name});
      element(line, "td", {textContent: value});
    }
  }
}

class WriteLesson {
  private readonly tasks: Tasks;
  private readonly steps: Control<string>;
  private readonly instruction: HTMLElement;
  private readonly editor: CodeEditor;
  private readonly result: Control<string>;
  private readonly next: HTMLButtonElement;
  private readonly drawnView: DrawnView;
  private readonly lightBox: HTMLElement;
  private lightView: LightView | undefined;
  private room: StudentRoom | undefined;
  private step: number; // from 0
  private timer = 0;
  private sandbox: Sandbox | undefined;

  constructor(root: HTMLElement, private readonly page: Page, private readonly state: State) {
    this.tasks = new Tasks(page.core);
    this.step = state.number("step", 1, {min: 1, max: allSteps.length, step: 1}) - 1;
    text(
      root,
      "Write the whole method in twenty steps: a rasterizer that passes the suite, and then the light of the Cornell " +
        "box. At every change of the code the page compares what it gives with the right answer.",
    );
    this.steps = this.addSteps(root);
    this.instruction = text(root, "");
    const [left, right] = columns(root);
    this.editor = this.addEditor(left);
    describeInput(left);
    this.result = status(right, "result");
    this.next = button(right, "Next step", () => this.goTo(this.step + 1));
    this.drawnView = new DrawnView(right);
    this.lightBox = element(right, "div", {className: "comparison light"});
    text(
      root,
      "Pineda 1988, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH '88. " +
        "Sutherland and Hodgman 1974, Reentrant Polygon Clipping, Communications of the ACM 17(1). " +
        "Cohen, Chen, Wallace and Greenberg 1988, A Progressive Refinement Approach to Fast Radiosity Image " +
        "Generation, SIGGRAPH '88.",
    ).className = "source";
    sourceLink(root, "raster/plain/rules.h", "The same rules in C++");
    sourceLink(root, "examples/method.cpp", "The same method in C++");
    void this.open(state.text("code", "")).then(() => this.run());
  }

  end(): void {
    clearTimeout(this.timer);
    this.sandbox?.end();
    this.lightView?.dispose();
    this.editor.dispose();
  }

  private addSteps(parent: HTMLElement): Control<string> {
    const options = allSteps.map(({title}, k): Option => [String(k), `${k + 1}. ${title}`]);
    return choice(parent, {label: "Step", options, value: String(this.step)}, (value) => this.goTo(Number(value)));
  }

  private addEditor(parent: HTMLElement): CodeEditor {
    const start = startOf(this.step);
    const editor = new CodeEditor(parent, kept(codeKey) ?? start, start, () => {
      keep(codeKey, editor.code());
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.run(), quietTime);
    });
    const buttons = row(parent);
    button(buttons, "Start code of this step", () => editor.setCode(startOf(this.step)));
    button(buttons, "Show a solution", () => editor.setCode(allSteps[this.step].solution));
    button(buttons, "Save as a file", () => download("hemitex-method.js", editor.code()));
    button(buttons, "Put it into the address", async () => this.state.set("code", await packed(editor.code())));
    const label = element(parent, "label", {className: "line", textContent: "Open a file:"});
    const file = element(label, "input", {type: "file", accept: ".js"});
    file.addEventListener("change", async () => editor.setCode((await file.files?.[0]?.text()) ?? editor.code()));
    return editor;
  }

  /** Shows the code that the address holds, if it holds some. */
  private async open(letters: string): Promise<void> {
    if (letters === "") return;
    try {
      this.editor.setCode(await unpacked(letters));
    } catch {
      throw new Error("The code in the address is damaged: copy the whole link.");
    }
  }

  private goTo(step: number): void {
    this.step = step;
    this.state.set("step", step + 1);
    this.steps.set(String(step));
    this.editor.setStart(startOf(step));
    void this.run();
  }

  private async run(): Promise<void> {
    this.instruction.innerHTML = allSteps[this.step].text;
    this.next.hidden = true;
    if (allSteps[this.step].light) this.drawnView.hide();
    this.result.set("Judging ...");
    this.sandbox?.end();
    const sandbox = (this.sandbox = new Sandbox(this.editor.code()));
    try {
      const show = await this.judge(sandbox);
      if (sandbox === this.sandbox) show(); // else the code has changed
    } catch (error) {
      if (!(error instanceof CodeError)) throw error;
      if (sandbox === this.sandbox) this.showError(error);
    }
  }

  /** Returns what shows the judgement. */
  private async judge(sandbox: Sandbox): Promise<() => void> {
    const {vectors, light} = allSteps[this.step];
    if (light) {
      const finding = await light(sandbox, (this.room ??= new StudentRoom(this.page.cornellBox())));
      return () => this.showLight(finding);
    }
    const progress = (done: number, all: number) => {
      if (sandbox === this.sandbox && done > 0) this.result.set(`Judging ... ${done} of ${all} test vectors`);
    };
    const judgement = await judge(sandbox, this.tasks, vectors ?? this.tasks.suiteNames(), !vectors, progress);
    return () => this.show(judgement, sandbox);
  }

  private clear(): void {
    this.drawnView.hide();
    this.lightView?.dispose();
    this.lightView = undefined;
    this.lightBox.replaceChildren();
  }

  private showError({line, message}: CodeError): void {
    this.clear();
    this.result.set((line ? `Line ${line}: ` : "") + message);
  }

  private show(judgement: Judgement, sandbox: Sandbox): void {
    this.clear();
    this.result.set(describe(judgement, this.step));
    this.next.hidden = judgement.shown.first >= 0;
    this.drawnView.show(judgement.shown, sandbox);
  }

  private showLight({wrong, light}: Finding): void {
    this.clear();
    const isLast = this.step + 1 === allSteps.length;
    const passed = isLast ? "Your functions light the Cornell box." : `Go on to step ${this.step + 2}.`;
    this.result.set(wrong ? `Not yet: ${wrong}.` : `Passed: all numbers are right. ${passed}`);
    this.next.hidden = wrong !== undefined || isLast;
    if (light) this.lightView = new LightView(this.lightBox, this.room!, light);
  }
}

export const lesson: Lesson = {
  id: "write",
  title: "7. Write it",
  show(root, page) {
    const shown = new WriteLesson(root, page, page.state);
    return () => shown.end();
  },
};
