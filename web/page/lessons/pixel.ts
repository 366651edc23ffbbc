// The item ID of a pixel: which triangle covers it, which texel it shows, and the sum of offset and index.
import type {Rgb} from "../colours";
import {checkbox, choice, columns, element, question, row, slider, sourceLink, status, text} from "../controls";
import type {Control} from "../controls";
import type {ChannelSum, Core, Explanation, IdLayout, Scene, Vector, VectorJson} from "../core";
import type {Lesson, State} from "../lesson";
import {PixelCanvas} from "../pixels";
import {backgroundColour, bytesOf, cssColour, texelColour} from "./element_colours";

const resolution = 16;
const pixels = {min: 0, max: resolution - 1, step: 1};
const sides = {min: 2, max: 16, step: 1}; // texels along a side of an index map

// Three surfaces over a patch. The board meets the ceiling, and the tile is below both.
const sceneText = `v -1.2 2 -2
v 2 2 -1.2
v 1.2 2 2
v -2 2 1.2
v -1.5 1.1 -0.9
v 0.3 2.3 -1.5
v 0.8 2.3 0.2
v -1.1 1.1 1
v 0.05 1 -0.15
v 0.85 1.1 -0.05
v 0.75 1.2 0.7
v -0.05 1.1 0.6
v -0.1 0 -0.1
v -0.1 0 0.1
v 0.1 0 0.1
v 0.1 0 -0.1
g ceiling
f 1 2 3 4
g board
f 5 6 7 8
g tile
f 9 10 11 12
g patch
f 13 14 15 16
`;
const surfaceNames = ["ceiling", "board", "tile", "patch"];
const hues = [0.72, 0.4, 0.1, 0.8];

const wrongColour: Rgb = [0.72, 0, 0.6];
const selectedTexel = "#ffd400";

interface Settings {
  format: string;
  texels: number; // per side
  aligned: boolean;
}

/** The top face of the hemicube over the patch. */
interface Drawn {
  vector: Vector;
  json: VectorJson;
  layout: IdLayout;
  ids: Uint32Array;
  exact: Uint32Array; // the same with an integer add, which loses no carry
}

function draw(scene: Scene, {format, texels, aligned}: Settings): Drawn {
  const elements = scene.discretize({texels, surface_texels: {patch: 1}});
  const patch = elements.info().elements - 1;
  const settings = {format, aligned, resolution};
  const vector = elements.vector(patch, settings);
  const exact = elements.vector(patch, {...settings, blend: "integer-add"});
  return {
    vector,
    json: vector.json(),
    layout: elements.ids({format, aligned}),
    ids: vector.render()[0],
    exact: exact.render()[0],
  };
}

interface Place {
  surface: number;
  index: number; // in the index map
}

function placeOf({pages}: IdLayout, id: number): Place | undefined {
  const surface = pages.findIndex(({offset, columns, rows}) => id >= offset && id < offset + columns * rows);
  return surface < 0 ? undefined : {surface, index: id - pages[surface].offset};
}

function surfaceOfDraw({json, layout}: Drawn, number: number): number {
  return layout.pages.findIndex(({offset}) => offset === json.draws[number].offset);
}

function colourOf({ids, exact, layout}: Drawn, pixel: number): Rgb {
  if (ids[pixel] !== exact[pixel]) return wrongColour;
  const place = placeOf(layout, ids[pixel]);
  if (!place) return backgroundColour;
  const {columns, rows} = layout.pages[place.surface];
  return texelColour(hues[place.surface], columns, rows, place.index);
}

/** Over the pixels: the triangle that the selected pixel shows, and the item IDs. */
function overlay({ids, exact, json}: Drawn, {derivation}: Explanation): string {
  const numbers = Array.from(ids, (id, pixel) => {
    if (id === json.background) return "";
    const x = (pixel % resolution) + 0.5, y = resolution - Math.floor(pixel / resolution) - 0.35;
    return `<text x="${x}" y="${y}" fill="${id === exact[pixel] ? "#000" : "#fff"}">${id}</text>`;
  });
  const corners = derivation?.corners.map(({snapped: [x, y]}) => `${x / 256},${resolution - y / 256}`);
  const triangle = corners
    ? `<polygon points="${corners.join(" ")}" fill="none" stroke="#fff" stroke-width="0.1"/>`
    : "";
  return `${triangle}<g font-size="0.42" text-anchor="middle">${numbers.join("")}</g>`;
}

function indexMap(texels: number, selected: number | undefined): string {
  const cells = Array.from({length: texels * texels}, (_, index) => {
    const x = index % texels, y = texels - 1 - Math.floor(index / texels);
    const level = Math.round(110 + (130 * index) / (texels * texels));
    const fill = index === selected ? selectedTexel : `rgb(${level} ${level} ${level})`;
    return `<rect x="${x}" y="${y}" width="1" height="1" fill="${fill}"/>
      <text x="${x + 0.5}" y="${y + 0.65}" font-size="0.45" text-anchor="middle">${index}</text>`;
  });
  return `<svg viewBox="0 0 ${texels} ${texels}" role="img" aria-label="Index map, texels 0 to ${texels * texels - 1}">
    ${cells.join("")}</svg>`;
}

function offsets({pages}: IdLayout, current: number): string {
  const lines = pages.map(({offset, columns, rows}, surface) => {
    const colour = cssColour(texelColour(hues[surface], columns, rows, 0));
    return `<tr${surface === current ? ' class="current"' : ""}><th scope="row"><span class="colour-mark"
      style="background: ${colour}"></span>${surfaceNames[surface]}</th><td>${offset}</td></tr>`;
  });
  return `<table><thead><tr><th scope="col">surface</th><th scope="col">offset</th></tr></thead>
    <tbody>${lines.join("")}</tbody></table>`;
}

/** The addition in binary, the most significant channel first, and in decimal. */
function addition(format: string, sums: ChannelSum[], decimal: [offset: number, index: number, id: number]): string {
  const letters = [...format.matchAll(/([rgba])\d/g)].map(([, letter]) => letter.toUpperCase());
  const channels = sums.map((sum, i) => ({...sum, letter: letters[i]})).reverse();
  const line = (head: string, key: "offset" | "texel" | "result", value: number) => {
    const isResult = key === "result";
    const cells = channels.map((sum) => {
      const clamped = isResult && sum.offset + sum.texel !== sum.result;
      return `<td${clamped ? ' class="clamped"' : ""}>${sum[key].toString(2).padStart(sum.bits, "0")}</td>`;
    });
    return `<tr${isResult ? ' class="result"' : ""}><th scope="row">${head}</th>${cells.join("")}
      <td>${value}</td></tr>`;
  };
  const heads = channels.map(({letter}) => `<td>${letter}</td>`);
  return `<table class="sum"><tbody><tr><td></td>${heads.join("")}<td></td></tr>
    ${line("offset", "offset", decimal[0])}
    ${line("+ index", "texel", decimal[1])}
    ${line("= item ID", "result", decimal[2])}
    </tbody></table>`;
}

const rounded = (value: number) => String(Number(value.toPrecision(4)));

function derivationText(drawn: Drawn, format: string, {derivation, word}: Explanation): string {
  if (!derivation?.texel) return `<p>No triangle covers the sample: the pixel keeps the background, all bits set.</p>`;
  const {triangle, edges, texel, sums, inverse_depth, runner_up} = derivation;
  const nameOf = (number: number) => surfaceNames[surfaceOfDraw(drawn, number)];
  const behind = runner_up
    ? `Behind it is the ${nameOf(runner_up.draw)}, 1/w = ${rounded(runner_up.inverse_depth)}.`
    : "There is nothing behind it.";
  const values = edges.map(({value}) => value).join(", ");
  return `<ol>
    <li><b>Edge functions</b> of triangle ${triangle}: ${values}, all ≥ 0.</li>
    <li><b>Depth</b>: 1/w = ${rounded(inverse_depth)} on the ${nameOf(derivation.draw)}. ${behind}</li>
    <li><b>Texel</b>: ⌊uN⌋ = ⌊${rounded(texel.position[0])}⌋ = ${texel.column}, ⌊vN⌋ =
      ⌊${rounded(texel.position[1])}⌋ = ${texel.row}, index ${texel.index}.</li>
    <li><b>Sum</b> of each channel, at most its maximum:
      ${addition(format, sums, [drawn.json.draws[derivation.draw].offset, texel.index, word])}</li>
  </ol>`;
}

/** What a lost carry does. */
function lossText({layout, exact}: Drawn, {column, row, word}: Explanation): string {
  const sum = exact[row * resolution + column];
  if (sum === word) return "";
  const place = placeOf(layout, word);
  const other = place
    ? `texel ${place.index} of the ${surfaceNames[place.surface]}, which gets the light`
    : "the number of no element";
  return `<p><b>The clamp lost a carry:</b> the sum is ${sum}, but the pixel holds ${word}. That is ${other}.</p>`;
}

class PixelLesson {
  private readonly scene: Scene;
  private readonly formats: string[];
  private readonly settings: Settings;
  private readonly picture: PixelCanvas;
  private readonly overlay = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  private readonly sizeObserver = new ResizeObserver(() => this.placeOverlay());
  private readonly maps: HTMLElement;
  private readonly derivation: HTMLElement;
  private readonly id: Control<string>;
  private readonly room: Control<string>;
  private readonly wrong: Control<string>;
  private column: number;
  private row: number;
  private drawn: Drawn;

  constructor(root: HTMLElement, private readonly core: Core, private readonly state: State) {
    this.formats = core.formats().map(({name}) => name);
    this.settings = {
      format: state.option("format", this.formats, "r5g6b5"),
      texels: state.number("texels", 5, sides),
      aligned: state.number("aligned", 1) === 1,
    };
    this.column = state.number("x", 7, pixels);
    this.row = state.number("y", 3, pixels);
    this.scene = core.loadScene({"scene.obj": sceneText}, "scene.obj");
    this.drawn = draw(this.scene, this.settings);

    const [left, right] = columns(root);
    text(left, `Three surfaces, seen from a patch below them. Each pixel holds the number of the element that it shows,
      its <em>item ID</em>. Point at a pixel.`);
    this.picture = this.addPicture(left);
    this.addControls(row(left));
    text(left, "Without aligned offsets, a sum can overflow its channel. Try it.");
    this.wrong = status(left, "pixel-wrong");
    this.room = status(left, "pixel-room");
    text(right, `All surfaces share one texture, the <em>index map</em>. Each has an <em>offset</em>. The rasterizer
      adds both as colours, channel by channel (Nielsen and Christensen 2002, section 3.2).`);
    this.maps = element(right, "div", {className: "pixel-maps"});
    this.id = status(right, "pixel-id");
    this.derivation = element(right, "div", {className: "pixel-derivation"});
    this.addQuestion(right);
    this.show();
  }

  end(): void {
    this.sizeObserver.disconnect();
  }

  private addPicture(parent: HTMLElement): PixelCanvas {
    const box = element(parent, "div", {className: "pixel-picture"});
    const picture = new PixelCanvas(box, {
      label: "Item IDs of 16 x 16 pixels",
      columns: resolution,
      rows: resolution,
      size: 448,
    });
    this.overlay.setAttribute("viewBox", `0 0 ${resolution} ${resolution}`);
    this.overlay.setAttribute("aria-hidden", "true");
    box.append(this.overlay);
    this.sizeObserver.observe(picture.canvas);
    picture.onSelect((column, line) => this.point(column, line));
    return picture;
  }

  private placeOverlay(): void {
    const {offsetLeft, offsetTop, offsetWidth, offsetHeight} = this.picture.canvas;
    const box = {left: offsetLeft, top: offsetTop, width: offsetWidth, height: offsetHeight};
    for (const [key, value] of Object.entries(box)) this.overlay.style.setProperty(key, `${value}px`);
  }

  private addControls(parent: HTMLElement): void {
    const {format, texels, aligned} = this.settings;
    choice(parent, {label: "Format", options: this.formats, value: format}, (to) => this.change({format: to}));
    const show = (side: number) => `${side} x ${side}`;
    slider(parent, {label: "Texels", ...sides, value: texels, show}, (to) => this.change({texels: to}));
    checkbox(parent, {label: "Aligned offsets", value: aligned}, (to) => this.change({aligned: to}));
  }

  private addQuestion(parent: HTMLElement): void {
    question(parent, {
      text: "r5g6b5 without aligned offsets: the board has offset 25. Which item ID has its texel 10?",
      answer: () => this.core.blend("r5g6b5", "clamped-add", 25, 10),
      tolerance: 0,
      whyNot: (value) =>
        value === 35
          ? "35 needs six bits; the lowest channel has five. Switch alignment off and look at the magenta pixels."
          : value === 3
            ? "Integers of five bits begin again at 0. A blend unit clamps."
            : undefined,
      why: `A channel of 5 bits holds at most 31; the carry is lost. Offsets that are multiples of 2<sup>k</sup>, where
        k bits hold the largest index, share no bit with an index. Then no sum overflows.`,
    });
    const links = row(parent);
    sourceLink(links, "raster/interface/item_id.h", "The sum");
    sourceLink(links, "docs/item-buffers.md", "All rules");
  }

  private change(changed: Partial<Settings>): void {
    Object.assign(this.settings, changed);
    this.drawn = draw(this.scene, this.settings);
    this.state.set("format", this.settings.format);
    this.state.set("texels", this.settings.texels);
    this.state.set("aligned", Number(this.settings.aligned));
    this.show();
  }

  private show(): void {
    const {ids, exact, layout} = this.drawn;
    const colours = Array.from(ids, (_, pixel) => bytesOf(colourOf(this.drawn, pixel)));
    this.picture.show(Uint8ClampedArray.from(colours.flat()));
    const {format, texels} = this.settings;
    const room = this.core.maxSurfaces(format, texels ** 2);
    this.wrong.set(`${ids.filter((id, pixel) => id !== exact[pixel]).length} pixels hold a wrong item ID.`);
    const need = `${texels ** 2} texels need k = ${layout.index_bits} of ${layout.bits} bits`;
    this.room.set(`Aligned offsets: ${need}, ${room} surfaces fit.`);
    this.picture.select(this.column, this.row);
    this.explain();
  }

  private point(column: number, line: number): void {
    [this.column, this.row] = [column, line];
    this.state.set("x", column);
    this.state.set("y", line);
    this.explain();
  }

  private explain(): void {
    const explanation = this.drawn.vector.explain(this.drawn.json.faces[0].name, this.column, this.row);
    const {derivation, word} = explanation;
    this.overlay.innerHTML = overlay(this.drawn, explanation);
    this.maps.innerHTML =
      indexMap(this.settings.texels, derivation?.texel?.index) +
      `<span class="plus">+</span>` +
      offsets(this.drawn.layout, derivation ? surfaceOfDraw(this.drawn, derivation.draw) : -1);
    this.id.set(`Pixel (${this.column}, ${this.row}): item ID ${word}`);
    this.derivation.innerHTML =
      derivationText(this.drawn, this.settings.format, explanation) + lossText(this.drawn, explanation);
  }
}

export const lesson: Lesson = {
  id: "pixel",
  title: "1. A pixel's number",
  show(root, {core, state}) {
    const shown = new PixelLesson(root, core, state);
    return () => shown.end();
  },
};
