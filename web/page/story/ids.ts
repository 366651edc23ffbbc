// Steps about numbers in pixels: index map, offset, clamp and alignment.
import {status} from "../controls";
import {drawing, label} from "./drawing";
import type {Step} from "./step";
import {addHandle} from "./handle";

const side = 4; // texels

function cells(x: number, numberOf: (index: number) => number, hue: string): string {
  return Array.from({length: side * side}, (_, index) => {
    const left = x + 28 * (index % side),
      top = 40 + 28 * (side - 1 - Math.floor(index / side));
    return (
      `<rect x="${left}" y="${top}" width="28" height="28" fill="${hue}" stroke="var(--page)"/>` +
      `<text x="${left + 14}" y="${top + 19}" text-anchor="middle" font-size="12" fill="#000">${numberOf(index)}</text>`
    );
  }).join("");
}

export const indexMap: Step = {
  name: "index-map",
  title: "Index map and offset",
  text: `How can a graphics card write the number of an element into each pixel? It draws <em>textures</em>. Take a
    texture whose texel number i holds the number i: an <em>index map</em>. Draw the whole surface with it, and take the
    nearest texel: each pixel then holds the number of the element that it shows, on this surface. All surfaces share
    one map. A second colour, the <em>offset</em>, is added to tell surfaces apart. Element 5 of the surface with offset
    32 is number 37. The surface is never cut, however many elements it has.`,
  paper: "sections 3.1 and 3.2",
  source: "radiosity/index_maps/id_layout.h",
  figure(root, page) {
    const show = drawing(root, "Index map plus offset gives item IDs", 400, 170);
    const draw = (offset: number) =>
      show(
        label([10, 26], "index map", 'font-size="14"') +
          cells(10, (index) => index, "#c9ced6") +
          label([126, 102], `+ ${offset} =`, 'font-size="18"') +
          label([230, 26], "numbers of elements", 'font-size="14"') +
          cells(230, (index) => offset + index, "#e8b45a"),
      );
    addHandle(
      root,
      page,
      "index-map",
      {label: "Offset of the surface", range: {min: 0, max: 240, step: 16}, otherwise: 32},
      draw,
    );
  },
  question(draw) {
    const width = draw(4, 9),
      column = draw(1, 3),
      row = draw(1, 3),
      offset = 64 * draw(1, 3);
    const id = offset + row * width + column;
    return {
      text: `The map is ${width} texels wide, rows and columns count from 0, the offset is ${offset}. Which number has
        the texel in column ${column} of row ${row}?`,
      answer: () => id,
      tolerance: 0,
      why: `${offset} + ${row} · ${width} + ${column}.`,
      whyNot: (value) =>
        value === id - offset
          ? "That is the index. Add the offset."
          : value === offset + column * width + row
            ? "Rows come first: a row has as many texels as the map is wide."
            : undefined,
    };
  },
};

const index = 60;
const bitsOf = (value: number) => value.toString(2).padStart(8, "0");

function bits(value: number, y: number, isRed: (bit: number) => boolean): string {
  return [...bitsOf(value)]
    .map(
      (digit, k) =>
        `<rect x="${90 + 30 * k}" y="${y}" width="28" height="30" fill="${isRed(7 - k) ? "#f0a8a0" : "#c9ced6"}"/>` +
        `<text x="${104 + 30 * k}" y="${y + 21}" text-anchor="middle" font-size="16" fill="#000">${digit}</text>`,
    )
    .join("");
}

export const clamp: Step = {
  name: "clamp",
  title: "The clamp, and why offsets are aligned",
  text: `The graphics card adds offset and index as colours. A channel of a colour has few bits, here eight: it holds 0
    to 255. A larger sum is not carried to the next channel, it is <em>clamped</em> to 255, and the number of the
    element is lost. The cure: let the map need k bits, and let every offset be a multiple of 2<sup>k</sup>. Then an
    offset has zeros where an index has bits. No bit meets another one, no sum is too large, and no carry is needed.
    Find the offsets for which no box is red.`,
  paper: "section 3.2",
  source: "raster/interface/item_id.h",
  figure(root, page) {
    const {core} = page;
    const show = drawing(root, "Offset plus index in binary", 400, 150);
    const found = status(root, "clamp-sum");
    const draw = (offset: number) => {
      const result = core.blend("r8g8b8a8", "clamped-add", offset, index);
      const meets = (bit: number) => ((offset & index) >> bit) % 2 === 1;
      const row = (name: string, value: number, y: number, isRed: (bit: number) => boolean) =>
        label([4, y + 21], name, 'font-size="14"') +
        bits(value, y, isRed) +
        label([344, y + 21], String(value), 'font-size="15"');
      show(
        row("offset", offset, 5, meets) +
          row("+ index", index, 45, meets) +
          row("pixel", result, 100, () => result !== offset + index),
      );
      found.set(
        result !== offset + index
          ? `${offset} + ${index} = ${offset + index}, but the pixel holds ${result}: the clamp lost a carry.`
          : offset % 64 === 0
            ? `${offset} is a multiple of 64 = 2⁶: no bit of it meets a bit of an index below 64.`
            : `${offset} + ${index} = ${result} is right, but another index may be lost.`,
      );
    };
    addHandle(root, page, "clamp", {label: "Offset", range: {min: 0, max: 255, step: 1}, otherwise: 200}, draw);
  },
  question(draw, {core}) {
    const offset = draw(197, 230),
      sum = offset + index;
    return {
      text: `One channel of eight bits: offset ${offset}, index ${index}. What does the pixel hold?`,
      answer: () => core.blend("r8g8b8a8", "clamped-add", offset, index),
      tolerance: 0,
      why: `${sum} is above 255, and the channel stays at its largest value.`,
      whyNot: (value) =>
        value === sum
          ? `${sum} needs nine bits. This channel has eight.`
          : value === sum - 256
            ? "That is what integers of eight bits do: they begin again at 0. The blend unit of a graphics card clamps."
            : undefined,
    };
  },
};
