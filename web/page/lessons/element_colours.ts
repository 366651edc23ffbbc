// Colours of elements: a hue per surface; lightness grows with the index of the texel, and neighbours differ.
import {okLch, type Rgb} from "../colours";

/** Of what is no element. */
export const backgroundColour: Rgb = [0.24, 0.24, 0.27];

/** Of backs of faces, which absorb. */
export const backColour: Rgb = [0.5, 0.16, 0.14];

/** @param hue of OKLab, in [0, 1) */
export function texelColour(hue: number, columns: number, rows: number, index: number): Rgb {
  const odd = ((index % columns) + Math.floor(index / columns)) % 2;
  return okLch(0.6 + (0.2 * index) / (columns * rows) + 0.07 * odd, 0.1, hue);
}

/** RGBA in bytes. */
export function bytesOf(colour: Rgb): number[] {
  return [...colour.map((channel) => Math.round(255 * channel)), 255];
}

export function cssColour(colour: Rgb): string {
  return `rgb(${bytesOf(colour).slice(0, 3).join(" ")})`;
}
