// What a lesson is: it builds itself into an element of the page.
import type {Core, Scene} from "./core";

/** The settings of a lesson. They are in the address, so that a link shows the same. */
export interface State {
  number(key: string, otherwise: number): number;
  text(key: string, otherwise: string): string;
  set(key: string, value: string | number): void;
}

export interface Page {
  core: Core;
  scene(name: "cornell-box"): Scene;
  state: State;
}

export interface Lesson {
  id: string; // in the address
  title: string;
  /** Builds the lesson; returns what ends its timers, workers and views. */
  show(root: HTMLElement, page: Page): (() => void) | void;
}
