// What a lesson is: it builds itself into an element of the page.
import type {Core, Scene} from "./core";

/** The numbers of a slider: multiples of `step` from `min` to `max`. */
export interface Range {
  min: number;
  max: number;
  step: number;
}

/** The settings of a lesson. They are in the address, so that a link shows the same. */
export interface State {
  /** The nearest number that the range allows; `otherwise` where the address has no number. */
  number(key: string, otherwise: number, range?: Range): number;
  text(key: string, otherwise: string): string;
  /** One of the options; `otherwise` where the address has none of them. */
  option<Name extends string>(key: string, options: readonly Name[], otherwise: Name): Name;
  set(key: string, value: string | number): void;
}

export interface Page {
  core: Core;
  cornellBox(): Scene;
  state: State;
}

export interface Lesson {
  id: string; // in the address
  title: string;
  /** Builds the lesson; returns what ends its timers, workers and views. */
  show(root: HTMLElement, page: Page): (() => void) | void;
}
