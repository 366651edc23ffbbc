// A rasterizer in the page's editor, step by step, compared with the core at every change.
import {Comparison, describeIds} from "../comparison";
import {button, choice, columns, element, row, sourceLink, status, text, type Option} from "../controls";
import {showDerivation} from "../derivation";
import type {Lesson} from "../lesson";
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

export const lesson: Lesson = {
  id: "write",
  title: "7. Write it",
  show(root, {core, state}) {
    const tasks = new Tasks(core);
    let step = state.number("step", 1, {min: 1, max: allSteps.length, step: 1}) - 1;
    let timer = 0;
    let sandbox: Sandbox | undefined;

    text(
      root,
      "Write a rasterizer in twelve steps. Each begins with a wrong picture. At every change of the code the page " +
        "compares all pixels with the rules; the last step draws the whole suite.",
    );
    const steps = choice(
      root,
      {
        label: "Step",
        options: allSteps.map(({title}, k): Option => [String(k), `${k + 1}. ${title}`]),
        value: String(step),
      },
      (value) => goTo(Number(value)),
    );
    const instruction = text(root, "");
    const [left, right] = columns(root);
    const editor = new CodeEditor(left, keptCode ?? startOf(step), startOf(step), () => {
      keptCode = editor.code();
      clearTimeout(timer);
      timer = window.setTimeout(run, quietTime);
    });
    const buttons = row(left);
    button(buttons, "Start code of this step", () => editor.setCode(startOf(step)));
    button(buttons, "Show a solution", () => editor.setCode(allSteps[step].solution));
    describeInput(left);

    const result = status(right, "result");
    const next = button(right, "Next step", () => goTo(step + 1));
    const comparison = new Comparison(right, 150);
    const pixel = status(right, "pixel");
    const derivation = element(right, "div");
    text(
      root,
      "Pineda 1988, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH '88. " +
        "Sutherland and Hodgman 1974, Reentrant Polygon Clipping, Communications of the ACM 17(1).",
    ).className = "source";
    sourceLink(root, "raster/plain/plain_renderer.cpp", "The same rules in C++");

    let shown: Drawn | undefined;
    comparison.onSelect((column, line) => derive(column, line));

    function derive(column: number, line: number): void {
      if (!shown) return;
      const {vector, face, view, expected, found} = shown;
      const [x, y, k] = [view.column + column, view.row + line, line * view.width + column];
      pixel.set(`column ${x}, row ${y} of ${face}: ${describeIds(expected[k], found[k], view.background)}`);
      showDerivation(derivation, vector, face, x, y);
    }

    function goTo(to: number): void {
      step = to;
      state.set("step", step + 1);
      steps.set(String(step));
      editor.setStart(startOf(step));
      void run();
    }

    function showDrawn(drawn: Drawn): void {
      shown = drawn;
      const {view, expected, found} = drawn;
      comparison.show({columns: view.width, rows: view.height, background: view.background, expected, found});
      pixel.set("");
      derivation.replaceChildren();
      if (drawn.first < 0) return;
      comparison.select(...place(drawn));
      derive(...place(drawn));
    }

    async function run(): Promise<void> {
      const {text: html, vectors} = allSteps[step];
      instruction.innerHTML = html;
      next.hidden = true;
      result.set("Judging ...");
      sandbox?.end();
      const own = (sandbox = new Sandbox(editor.code()));
      try {
        const judgement = await judge(own, tasks, vectors ?? tasks.suiteNames(), !vectors);
        if (own !== sandbox) return; // the code has changed
        result.set(describe(judgement, step));
        next.hidden = judgement.shown.first >= 0 || step + 1 === allSteps.length;
        showDrawn(judgement.shown);
      } catch (error) {
        if (!(error instanceof CodeError)) throw error;
        if (own === sandbox) result.set((error.line ? `Line ${error.line}: ` : "") + error.message);
      }
    }

    void run();
    return () => {
      clearTimeout(timer);
      sandbox?.end();
      editor.dispose();
    };
  },
};
