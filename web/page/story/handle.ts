// The slider of a figure: its setting has the name of the figure, and what it shows follows it.
import {slider} from "../controls";
import type {Range} from "../lesson";
import type {StoryPage} from "./step";

interface Handle {
  label: string;
  range: Range;
  otherwise: number; // where the address has no number
  show?: (value: number) => string;
}

/** Draws now, and after each change. */
export function addHandle(
  root: HTMLElement,
  {state}: StoryPage,
  name: string,
  {label, range, otherwise, show}: Handle,
  draw: (value: number) => void,
): void {
  const value = state.number(name, otherwise, range);
  slider(root, {label, ...range, value, show}, (to) => {
    state.set(name, to);
    draw(to);
  });
  draw(value);
}
