// Progressive refinement, shot by shot. After an edit of the scene the light is updated instead of computed again.
import {button, columns, question, row, sourceLink, status, text, type Control} from "../controls";
import type {Scene} from "../core";
import type {Lesson, State} from "../lesson";
import {changesOf, type Changes} from "../shooting/changes";
import {Picture} from "../shooting/picture";
import {Progress, Rate} from "../shooting/progress";
import {SceneControls} from "../shooting/scene_controls";
import {Shooting} from "../shooting/solution";

const shotsAtStart = 20; // the lamp has shot

const shotFormula =
  "<math><mi>Δ</mi><msub><mi>B</mi><mi>j</mi></msub><mo>=</mo><msub><mi>ρ</mi><mi>j</mi></msub>" +
  "<msub><mi>F</mi><mrow><mi>i</mi><mi>j</mi></mrow></msub><msub><mi>Φ</mi><mi>i</mi></msub><mo>/</mo>" +
  "<msub><mi>A</mi><mi>j</mi></msub></math>";
const ambientFormula =
  "<math><mo>∑</mo><msub><mi>Φ</mi><mi>i</mi></msub><mo>/</mo><mo>∑</mo><mo stretchy='false'>(</mo><mn>1</mn>" +
  "<mo>−</mo><msub><mi>ρ</mi><mi>j</mi></msub><mo stretchy='false'>)</mo><msub><mi>A</mi><mi>j</mi></msub></math>";

function addText(right: HTMLElement): void {
  text(
    right,
    "A shot takes the patch <math><mi>i</mi></math> with the most unshot flux Φ and draws one hemicube over it. Each " +
      "element <math><mi>j</mi></math> reflects a part ρ of the flux that it receives. This part is unshot in turn: " +
      `${shotFormula}. The ambient estimate spreads all unshot flux evenly, for display: ` +
      `<math><msub><mi>ρ</mi><mi>j</mi></msub></math>${ambientFormula} (Cohen, Chen, Wallace and Greenberg 1988). ` +
      "It takes the room for closed, and is too bright where light leaves by an open front. The residual is the unshot " +
      "flux, without signs, over the emitted flux.",
  );
}

function addQuestion(right: HTMLElement): void {
  question(right, {
    text: "The room is lit. You make the lamp twice as bright. How many hemicubes does hemitex draw for the new light?",
    options: ["One per patch", "One per patch of the lamp", "None"],
    right: 2,
    why: "Form factors depend on the geometry alone. Only the flux along known rows changes.",
  });
  sourceLink(right, "radiosity/solver/progressive_solver.cpp", "Shots");
  sourceLink(right, "radiosity/solver/dynamic_solution.cpp", "Edits (Chen 1990)");
}

class ShootingLesson {
  private readonly shooting: Shooting;
  private readonly wanted: Changes;
  private readonly rate = new Rate();
  private readonly picture: Picture;
  private readonly pictures: Control<string>; // per second
  private readonly run: HTMLButtonElement;
  private readonly again: HTMLButtonElement;
  private readonly progress: Progress;
  private isRunning = false;
  private frame = 0;

  constructor(root: HTMLElement, scene: Scene, private readonly state: State) {
    this.shooting = new Shooting(scene);
    this.wanted = changesOf(state);
    const [left, right] = columns(root);
    this.picture = new Picture(left, scene, this.shooting, state);
    new SceneControls(left, state, this.wanted, () => this.request());
    this.pictures = status(left, "pictures-per-second");
    this.pictures.set("Move an object, dim the lamp, paint the wall: the light follows.");
    addText(right);
    const buttons = row(right);
    this.addAction(buttons, "One shot", () => this.shooting.shootAll(1));
    this.addAction(buttons, "Ten shots", () => this.shooting.shootAll(10));
    this.run = button(buttons, "Run", () => this.toggle());
    this.again = this.addAction(buttons, "Start again", () => this.shooting.restart());
    this.progress = new Progress(right, scene.info().square_metres);
    addQuestion(right);
    this.shooting.shootAll(state.number("shots", shotsAtStart));
    this.settle();
    this.request();
  }

  end(): void {
    cancelAnimationFrame(this.frame);
    this.progress.plot.dispose();
    this.picture.view.dispose();
  }

  /** A button that ends a run. */
  private addAction(parent: HTMLElement, label: string, action: () => void): HTMLButtonElement {
    return button(parent, label, () => {
      this.isRunning = false;
      action();
      this.settle();
    });
  }

  private toggle(): void {
    this.isRunning = !this.isRunning;
    this.settle();
    if (this.isRunning) this.request();
  }

  private draw(): void {
    this.picture.draw();
    this.progress.show(this.shooting);
    this.run.textContent = this.isRunning ? "Pause" : "Run";
    this.again.disabled = this.wanted.lamp === 0; // without a lamp there is nothing to shoot
  }

  /** Draws before and after a run: with the patch that shoots next. */
  private settle(): void {
    const {shooting, state} = this;
    this.draw();
    this.picture.view.mark(this.isRunning ? [] : shooting.solution.brightest());
    if (shooting.shots !== state.number("shots", shotsAtStart)) state.set("shots", shooting.shots);
  }

  private request(): void {
    this.frame ||= requestAnimationFrame((now) => this.step(now));
  }

  /** One update per animation frame, whatever number of changes came since the last one. */
  private step(now: number): void {
    const {shooting, rate} = this;
    this.frame = 0;
    const edits = shooting.change(this.wanted);
    if (edits.length) this.isRunning = true;
    else if (this.isRunning && !shooting.isDone) shooting.shootSome();
    else this.isRunning = false;
    rate.frame(now, this.isRunning);
    const update = `the last update took ${shooting.info.milliseconds.toFixed(0)} ms`;
    if (rate.perSecond) this.pictures.set(`${rate.perSecond.toFixed(1)} pictures per second; ${update}`);
    if (!this.isRunning) return this.settle();
    if (edits.some(({edit}) => edit === "move")) this.picture.view.setElements(shooting.solution.elements());
    this.draw();
    this.request();
  }
}

export const lesson: Lesson = {
  id: "shooting",
  title: "3. Shooting",
  show(root, {cornellBox, state}) {
    const shown = new ShootingLesson(root, cornellBox(), state);
    return () => shown.end();
  },
};
