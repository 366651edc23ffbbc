// The page: navigation over the lessons, and the settings of the lesson in the address.
import {button, element} from "./controls";
import {startCore, type Core, type Scene} from "./core";
import type {Lesson, Range, State} from "./lesson";
import {lesson as accuracy} from "./lessons/accuracy";
import {lesson as breakIt} from "./lessons/break_it";
import {lesson as hemicube} from "./lessons/hemicube";
import {lesson as pixel} from "./lessons/pixel";
import {lesson as shooting} from "./lessons/shooting";
import {lesson as textureAndMesh} from "./lessons/texture_and_mesh";
import {lesson as writeIt} from "./lessons/write_it";
import {figureAlone, lesson as start} from "./story/story";
import {lesson as gpu} from "./trial/gpu";

// build.mjs puts the files of data/ here.
declare const sceneFiles: Record<string, string>;

const lessons = [start, pixel, hemicube, shooting, textureAndMesh, accuracy, breakIt, writeIt, gpu];
const root = document.querySelector<HTMLElement>("main")!;
const nav = document.querySelector<HTMLElement>("nav")!;
const alertBox = document.querySelector<HTMLElement>("#alert")!;

function showError(error: unknown): void {
  alertBox.replaceChildren();
  element(alertBox, "p", {textContent: error instanceof Error ? error.message : String(error)});
  button(alertBox, "Close", () => alertBox.replaceChildren());
}

/** The address behind #: the id of the lesson, then its settings as in a query, key=value, each behind "&". */
class AddressState implements State {
  private timer = 0;
  private address = location.hash;

  constructor(private readonly id: string, private readonly settings: URLSearchParams) {}

  number(key: string, otherwise: number, range?: Range): number {
    const value = Number.parseFloat(this.text(key, ""));
    if (!Number.isFinite(value)) return otherwise;
    if (!range) return value;
    const {min, max, step} = range;
    // Twelve digits: multiples of 0.05 are those of a slider.
    return Number((step * Math.round(Math.min(max, Math.max(min, value)) / step)).toPrecision(12));
  }

  text(key: string, otherwise: string): string {
    return this.settings.get(key) ?? otherwise;
  }

  option<Name extends string>(key: string, options: readonly Name[], otherwise: Name): Name {
    return options.find((name) => name === this.settings.get(key)) ?? otherwise;
  }

  set(key: string, value: string | number): void {
    this.settings.set(key, String(value));
    // Browsers limit how often a page changes its address, and a drag changes settings with each event.
    this.timer ||= window.setTimeout(() => this.write(), 200);
  }

  end(): void {
    clearTimeout(this.timer);
  }

  private write(): void {
    this.timer = 0;
    if (location.hash !== this.address) return; // another lesson follows: its event has not arrived
    history.replaceState(null, "", `#${this.id}&${this.settings}`);
    this.address = location.hash;
  }
}

function makeNavigation(): void {
  for (const {id, title} of lessons.slice(1)) element(nav, "a", {href: `#${id}`, textContent: title});
}

function markNavigation(current: Lesson): void {
  for (const link of document.querySelectorAll<HTMLAnchorElement>("header a"))
    if (link.hash === `#${current.id}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
}

/** The title, and links to the lessons before and after. Returns the title. */
function addHeading(current: Lesson): HTMLElement {
  const heading = element(root, "div", {className: "heading"});
  const title = element(heading, "h2", {textContent: current.title, tabIndex: -1});
  const place = lessons.findIndex(({id}) => id === current.id);
  const link = (to: Lesson | undefined, rel: string, text: string) => {
    if (to) element(heading, "a", {href: `#${to.id}`, rel, title: to.title, textContent: text});
  };
  link(lessons[place - 1], "prev", "← back");
  link(lessons[place + 1], "next", "next →");
  return title;
}

let endShown = () => {};

/** ?figure=NAME: only this figure, in the type of a projector. */
const alone = figureAlone(new URLSearchParams(location.search).get("figure") ?? "");

/** Larger type, for a projector. */
function setLarge(isLarge: boolean): void {
  document.documentElement.toggleAttribute("data-large", isLarge);
}

function addLargeType(): void {
  const large = button(nav, "Large", () => {
    const isLarge = !document.documentElement.hasAttribute("data-large");
    setLarge(isLarge);
    large.setAttribute("aria-pressed", String(isLarge));
  });
  large.setAttribute("aria-pressed", "false");
  large.title = "Large type, for a projector";
}

function show(core: Core, cornellBox: () => Scene): void {
  endShown();
  endShown = () => {};
  alertBox.replaceChildren();
  const [id, ...settings] = location.hash.slice(1).split("&");
  const lesson = alone ?? lessons.find((one) => one.id === id) ?? start;
  const state = new AddressState(lesson.id, new URLSearchParams(settings.join("&")));
  document.title = `${lesson.title} - hemitex`;
  markNavigation(lesson);
  const hadFocus = root.contains(document.activeElement);
  root.replaceChildren();
  const heading = addHeading(lesson);
  if (hadFocus) heading.focus();
  let endLesson: (() => void) | void;
  endShown = () => {
    state.end();
    endLesson?.();
  };
  try {
    endLesson = lesson.show(element(root, "div", {className: `lesson ${lesson.id}`}), {core, cornellBox, state});
  } catch (error) {
    showError(error);
  }
  window.scrollTo(0, 0);
  root.dataset.shown = lesson.id; // tests wait for it
}

async function main(): Promise<void> {
  makeNavigation();
  addLargeType();
  setLarge(alone !== undefined);
  document.documentElement.toggleAttribute("data-alone", alone !== undefined);
  window.addEventListener("error", (event) => showError(event.error ?? event.message));
  window.addEventListener("unhandledrejection", (event) => showError(event.reason));
  const core = await startCore().finally(() => root.replaceChildren());
  let scene: Scene | undefined;
  const cornellBox = () => (scene ??= core.loadScene(sceneFiles, "cornell-box.obj"));
  window.addEventListener("hashchange", () => show(core, cornellBox));
  show(core, cornellBox);
  requestAnimationFrame(() => requestAnimationFrame(() => performance.mark("first picture")));
}

void main();
