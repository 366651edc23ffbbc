// A step of the story: a short text, one figure with one handle, and one question.
import type {Question} from "../controls";
import type {Scene} from "../core";
import type {Page} from "../lesson";
import type {Draw} from "./student";

export interface StoryPage extends Page {
  scene: Scene; // the Cornell box, or the visitor's own
}

export interface Step {
  name: string; // of the figure, in the address
  title: string;
  text: string; // trusted HTML, at most 120 words
  paper: string; // the section that it follows
  source: string; // the file of hemitex that does this
  /** Builds the figure; returns what ends its views. The setting of its handle has the name of the figure. */
  figure(root: HTMLElement, page: StoryPage): (() => void) | void;
  /** The numbers of the question are drawn for each student. */
  question(draw: Draw, page: StoryPage): Question;
}
