// A rasterizer in the page's editor, step by step, compared with the core at every change.
import {Comparison} from "../comparison";
import {button, choice, columns, element, row, sourceLink, status, text, type Control, type Option} from "../controls";
import type {Core} from "../core";
import {PixelText} from "../derivation";
import type {Lesson, State} from "../lesson";
import {plural} from "../numbers";
import {CodeEditor} from "../write_it/editor";
import {judge, Tasks, type Drawn, type Judgement} from "../write_it/judge";
import {CodeError, helpers, Sandbox} from "../write_it/sandbox";
import {allSteps, startOf} from "../write_it/steps";

const quietTime = 300; // milliseconds from the last key to the verdict

// Another lesson may be shown in between.
let keptCode: string | undefined;

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
    const next = step + 1 < allSteps.length ? ` Go on to step ${step + 2}.` : " Your rasterizer is right.";
    return `Passed: every pixel of ${plural(vectors, "test vector")} is right.${next}`;
  }
  const {vector, wrong} = shown;
  const count = allSteps[step].vectors ? "" : `${passed} of ${vectors} test vectors pass. `;
  return `${count}Not yet: ${plural(wrong, "wrong pixel")} in ${vector.name()}. The first one is marked.`;
}

/** Expected and found pixels of a face, and the derivation of the one that is selected. */
class DrawnView {
  private readonly comparison: Comparison;
  private readonly pixelText: PixelText;
  private drawn: Drawn | undefined;

  constructor(parent: HTMLElement) {
    this.comparison = new Comparison(parent, 150);
    this.pixelText = new PixelText(parent);
    this.comparison.onSelect((column, line) => this.derive(column, line));
  }

  /** Selects the first wrong pixel. */
  show(drawn: Drawn): void {
    this.drawn = drawn;
    const {view, expected, found} = drawn;
    this.comparison.show({columns: view.width, rows: view.height, background: view.background, expected, found});
    this.pixelText.clear();
    if (drawn.first < 0) return;
    this.comparison.select(...place(drawn));
    this.derive(...place(drawn));
  }

  private derive(column: number, line: number): void {
    if (!this.drawn) return;
    const {vector, face, view, expected, found} = this.drawn;
    const pixel = line * view.width + column;
    const place = {vector, face, column: view.column + column, row: view.row + line};
    this.pixelText.show({...place, expected: expected[pixel], found: found[pixel]});
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
  private step: number; // from 0
  private timer = 0;
  private sandbox: Sandbox | undefined;

  constructor(root: HTMLElement, core: Core, private readonly state: State) {
    this.tasks = new Tasks(core);
    this.step = state.number("step", 1, {min: 1, max: allSteps.length, step: 1}) - 1;
    text(
      root,
      "Write a rasterizer in twelve steps. Each begins with a wrong picture. At every change of the code the page " +
        "compares all pixels with the rules; the last step draws the whole suite.",
    );
    this.steps = this.addSteps(root);
    this.instruction = text(root, "");
    const [left, right] = columns(root);
    this.editor = this.addEditor(left);
    describeInput(left);
    this.result = status(right, "result");
    this.next = button(right, "Next step", () => this.goTo(this.step + 1));
    this.drawnView = new DrawnView(right);
    text(
      root,
      "Pineda 1988, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH '88. " +
        "Sutherland and Hodgman 1974, Reentrant Polygon Clipping, Communications of the ACM 17(1).",
    ).className = "source";
    sourceLink(root, "raster/plain/rules.h", "The same rules in C++");
    void this.run();
  }

  end(): void {
    clearTimeout(this.timer);
    this.sandbox?.end();
    this.editor.dispose();
  }

  private addSteps(parent: HTMLElement): Control<string> {
    const options = allSteps.map(({title}, k): Option => [String(k), `${k + 1}. ${title}`]);
    return choice(parent, {label: "Step", options, value: String(this.step)}, (value) => this.goTo(Number(value)));
  }

  private addEditor(parent: HTMLElement): CodeEditor {
    const start = startOf(this.step);
    const editor = new CodeEditor(parent, keptCode ?? start, start, () => {
      keptCode = editor.code();
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.run(), quietTime);
    });
    const buttons = row(parent);
    button(buttons, "Start code of this step", () => editor.setCode(startOf(this.step)));
    button(buttons, "Show a solution", () => editor.setCode(allSteps[this.step].solution));
    return editor;
  }

  private goTo(step: number): void {
    this.step = step;
    this.state.set("step", step + 1);
    this.steps.set(String(step));
    this.editor.setStart(startOf(step));
    void this.run();
  }

  private async run(): Promise<void> {
    const {text: html, vectors} = allSteps[this.step];
    this.instruction.innerHTML = html;
    this.next.hidden = true;
    this.result.set("Judging ...");
    this.sandbox?.end();
    const sandbox = (this.sandbox = new Sandbox(this.editor.code()));
    try {
      const judgement = await judge(sandbox, this.tasks, vectors ?? this.tasks.suiteNames(), !vectors);
      if (sandbox === this.sandbox) this.show(judgement); // else the code has changed
    } catch (error) {
      if (!(error instanceof CodeError)) throw error;
      if (sandbox === this.sandbox) this.result.set((error.line ? `Line ${error.line}: ` : "") + error.message);
    }
  }

  private show(judgement: Judgement): void {
    this.result.set(describe(judgement, this.step));
    this.next.hidden = judgement.shown.first >= 0 || this.step + 1 === allSteps.length;
    this.drawnView.show(judgement.shown);
  }
}

export const lesson: Lesson = {
  id: "write",
  title: "7. Write it",
  show(root, {core, state}) {
    const shown = new WriteLesson(root, core, state);
    return () => shown.end();
  },
};
