// The story of the method, from a lamp and a wall to the visitor's GPU: it reads from top to bottom, and each figure
// also stands alone (?figure=NAME), for slides.
import {button, element, question, row, sourceLink, status, text} from "../controls";
import type {Core, Scene} from "../core";
import type {Lesson, Page} from "../lesson";
import {accuracy, mesh} from "./cost";
import {hemicube, pixelNumber, row as rowStep} from "./hemicube";
import {clamp, indexMap} from "./ids";
import {fault, gpu, write} from "./judging";
import {cosine, lamp, nusselt} from "./light";
import {checkedFile, Solved} from "./solved";
import {shot, texture} from "./shooting";
import type {Step, StoryPage} from "./step";
import {numbersOf} from "./student";

const steps: Step[] = [
  ...[lamp, cosine, nusselt, hemicube, pixelNumber, indexMap, clamp, rowStep],
  ...[shot, texture, mesh, accuracy, fault, write, gpu],
];

// Figures show it in place of the Cornell box, also after another lesson.
let ownScene: Scene | undefined;

/** The name of the student, from whom the numbers of the questions follow. */
const studentOf = ({state}: Page): string => state.text("student", "");

async function loadOwn(core: Core, files: Iterable<File>): Promise<Scene> {
  const texts: Record<string, string> = {};
  for (const file of files) texts[file.name] = await file.text();
  const main = Object.keys(texts).find((name) => /\.obj$/i.test(name));
  if (!main) throw new Error("Choose an OBJ file, and with it its MTL file.");
  const scene = core.loadScene(texts, main);
  if (!scene.info().surfaces.some(({emission}) => emission.some((band) => band > 0)))
    throw new Error(`No surface of ${main} emits light: give one a material with Ke in the MTL file.`);
  return scene;
}

/** Only figures that show the scene load it. */
function storyPage({core, cornellBox, state}: Page): StoryPage {
  return {
    core,
    cornellBox,
    state,
    get scene() {
      return ownScene ?? cornellBox();
    },
  };
}

function addFigure(parent: HTMLElement, step: Step, page: StoryPage): () => void {
  const figure = element(parent, "div", {className: "figure"});
  figure.dataset.figure = step.name;
  try {
    return step.figure(figure, page) ?? (() => {});
  } catch (error) {
    text(figure, "This figure cannot be drawn: ").append(error instanceof Error ? error.message : String(error));
    return () => {};
  }
}

class Story {
  private readonly ends: (() => void)[] = [];
  private readonly observer: IntersectionObserver;
  private readonly solved: Solved;

  constructor(
    private readonly root: HTMLElement,
    private readonly page: Page,
  ) {
    this.solved = new Solved(studentOf(page), steps.length);
    this.observer = new IntersectionObserver((seen) => this.build(seen), {rootMargin: "400px"});
    this.addStart();
    steps.forEach((step, k) => this.addStep(step, k));
    this.addEnd();
  }

  end(): void {
    this.observer.disconnect();
    for (const end of this.ends) end();
  }

  private addStart(): void {
    const {state} = this.page;
    text(
      this.root,
      "How does light fill a room? Fifteen steps lead from a lamp and a wall to a method that lights whole rooms, and " +
        "to your own program. In each there is one thing to move and one question. All numbers come from the program " +
        "itself, which runs in this page.",
    );
    const line = row(this.root);
    const label = element(line, "label", {className: "line", textContent: "Your name, for numbers of your own:"});
    const name = element(label, "input", {type: "text", value: studentOf(this.page), autocomplete: "off"});
    name.addEventListener("change", () => {
      state.set("student", name.value);
      this.again();
    });
    this.addOwnScene(line);
  }

  private addOwnScene(parent: HTMLElement): void {
    const label = element(parent, "label", {className: "line", textContent: "Your own scene (OBJ and MTL):"});
    const files = element(label, "input", {type: "file", multiple: true, accept: ".obj,.mtl"});
    files.addEventListener("change", () => void this.use(files.files ?? []));
    const drop = (event: DragEvent) => {
      event.preventDefault();
      if (event.type === "drop") void this.use(event.dataTransfer?.files ?? []);
    };
    for (const name of ["dragover", "drop"] as const) document.addEventListener(name, drop);
    this.ends.push(() =>
      ["dragover", "drop"].forEach((name) => document.removeEventListener(name, drop as EventListener)),
    );
    if (!ownScene) return;
    button(parent, "The Cornell box again", () => {
      ownScene = undefined;
      this.again();
    });
  }

  private async use(files: Iterable<File>): Promise<void> {
    ownScene = await loadOwn(this.page.core, files);
    this.again();
  }

  /** Builds all anew, with another scene or other numbers. */
  private again(): void {
    this.end();
    this.root.replaceChildren();
    current = new Story(this.root, this.page);
  }

  private addStep(step: Step, number: number): void {
    const section = element(this.root, "section", {className: "step", id: `step-${step.name}`});
    element(section, "h3", {textContent: `${number + 1}. ${step.title}`});
    const words = element(section, "div", {className: "words"});
    text(words, step.text);
    const place = element(section, "div", {className: "place"});
    place.dataset.step = step.name;
    const page = storyPage(this.page);
    const asked = step.question(numbersOf(studentOf(page), step.name), page);
    question(words, asked, (answer) => this.solved.add(step.name, asked.text, answer));
    const links = row(words);
    element(links, "p", {className: "source", textContent: `Paper: ${step.paper}.`});
    sourceLink(links, step.source, "hemitex");
    element(element(links, "p", {className: "source"}), "a", {
      href: `?figure=${step.name}`,
      textContent: "The figure alone",
    });
    this.observer.observe(place);
  }

  /** For lecturers: the numbers follow from the name, so that the answers of a file can be checked. */
  private addCheck(parent: HTMLElement): void {
    const label = element(parent, "label", {className: "line", textContent: "Check the file of a student:"});
    const input = element(label, "input", {type: "file", accept: ".json"});
    const found = status(parent, "checked-file");
    const page = storyPage(this.page);
    const ask = (student: string, figure: string) =>
      steps.find(({name}) => name === figure)?.question(numbersOf(student, figure), page);
    input.addEventListener("change", async () => found.set(checkedFile((await input.files?.[0]?.text()) ?? "", ask)));
  }

  /** Figures are built when they come near to what is seen: the page starts at once. */
  private build(seen: IntersectionObserverEntry[]): void {
    for (const {target, isIntersecting} of seen) {
      if (!isIntersecting) continue;
      this.observer.unobserve(target);
      const step = steps.find(({name}) => name === (target as HTMLElement).dataset.step)!;
      this.ends.push(addFigure(target as HTMLElement, step, storyPage(this.page)));
    }
  }

  private addEnd(): void {
    const section = element(this.root, "section", {className: "step"});
    element(section, "h3", {textContent: "What you have solved"});
    this.solved.show(status(section, "solved"));
    button(section, "Save a file for your lecturer", () => void this.solved.save());
    this.addCheck(section);
    element(section, "p", {className: "source"}).innerHTML =
      "Nielsen and Christensen 2002, <cite>Fast Texture Based Form Factor Calculations for Radiosity using Graphics " +
      "Hardware</cite>. Cohen and Greenberg 1985, <cite>The Hemi-Cube: A Radiosity Solution for Complex " +
      "Environments</cite>. Nusselt 1928, <cite>Graphische Bestimmung des Winkelverhältnisses bei der " +
      "Wärmestrahlung</cite>.";
    sourceLink(section, "README.md", "The project");
  }
}

let current: Story | undefined;

export const lesson: Lesson = {
  id: "start",
  title: "How light fills a room",
  show(root, page) {
    current = new Story(root, page);
    return () => current?.end();
  },
};

/** A figure without the rest of the page, as ?figure=NAME asks for; undefined where there is none of this name. */
export function figureAlone(name: string): Lesson | undefined {
  const step = steps.find((one) => one.name === name);
  return (
    step && {
      id: "start",
      title: step.title,
      show: (root, page) => addFigure(root, step, storyPage(page)),
    }
  );
}
