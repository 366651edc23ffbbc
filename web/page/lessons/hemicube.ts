// The hemicube over an element of the Cornell box, unfolded, and the form factors that it gives.
import {valueColour, type Rgb} from "../colours";
import {choice, columns, element, question, row, slider, sourceLink, status, text} from "../controls";
import type {Control, Option} from "../controls";
import type {Elements, HemicubeView, Scene} from "../core";
import type {Lesson, State} from "../lesson";
import {largestSize, sum} from "../numbers";
import {PixelCanvas} from "../pixels";
import {SceneView} from "../scene_view";
import {backColour, backgroundColour, bytesOf, cssColour, texelColour} from "./element_colours";
import {FoldedHemicube} from "./folded_hemicube";
import {Texels, type Texel} from "./texel_names";
import {unfoldedHemicube, type FacePixel} from "./unfolded_hemicube";

const texelsPerSide = 8;
const resolutions = {min: 16, max: 256, step: 16};
const angles = {min: 0, max: 90, step: 5}; // degrees
const faceNames = ["top", "side +x", "side +y", "side -x", "side -y"];
const hues: Record<string, number> = {
  floor: 0.72,
  ceiling: 0.6,
  "wall-back": 0.25,
  "wall-green": 0.4,
  "wall-red": 0.07,
  "short-block": 0.95,
  "tall-block": 0.83,
  light: 0.3,
};
const palette = Array.from({length: 256}, (_, level) => valueColour(level / 255));
const paletteBytes = palette.map(bytesOf);

const introduction = `A hemicube is half a cube over a patch (Cohen and Greenberg 1985). The renderer draws the scene on
its five faces. The share of the patch's light that passes through a pixel is its <em>delta form factor</em>. For a
pixel of area ΔA at (x, y) on the top face, at distance 1, it is
<math><mi>ΔF</mi><mo>=</mo><mi>ΔA</mi><mo>/</mo><mo stretchy="false">(</mo><mi>π</mi><msup><mrow>
<mo stretchy="false">(</mo><msup><mi>x</mi><mn>2</mn></msup><mo>+</mo><msup><mi>y</mi><mn>2</mn></msup><mo>+</mo>
<mn>1</mn><mo stretchy="false">)</mo></mrow><mn>2</mn></msup><mo stretchy="false">)</mo></math>.
The form factor to a surface is the sum over its pixels.`;

const levelOf = (share: number, largest: number) => Math.round((255 * share) / largest);

/** How many times larger the delta form factor in the middle of the top face is than in its corner. */
function middleOverCorner(elements: Elements): number {
  const {weights, width, height} = elements.hemicube(0, {resolution: 256}).faces[0];
  return weights[(height / 2) * width + width / 2] / weights[0];
}

class HemicubeLesson {
  private readonly elements: Elements;
  private readonly texels: Texels;
  private readonly surfaces: string[]; // the blocks are one surface each
  private readonly colours: Rgb[]; // of elements
  private readonly sceneView: SceneView;
  private readonly picture: PixelCanvas;
  private readonly folded: FoldedHemicube;
  private readonly table: HTMLElement;
  private readonly pixel: Control<string>;
  private readonly command: Control<string>;
  private showFrom = () => {};
  private from: Texel;
  private source!: number; // the element of `from`
  private resolution: number;
  private byShare: boolean;
  private foldedBy: number; // degrees
  private cross: (FacePixel | undefined)[] = [];
  private pointed: [column: number, row: number] = [0, 0];
  private view!: HemicubeView;

  constructor(root: HTMLElement, scene: Scene, private readonly state: State) {
    this.elements = scene.discretize({texels: texelsPerSide});
    this.texels = new Texels(this.elements);
    const {surfaces, elements} = this.texels.info;
    this.surfaces = [...new Set(surfaces.map((_, surface) => this.texels.whole(surface)))];
    this.colours = Array.from({length: elements}, (_, element) => this.colourOf(element));
    this.from = this.texels.named(state.text("from", "")) ?? {surface: 0, column: 3, row: 1};
    this.resolution = state.number("resolution", 64, resolutions);
    this.byShare = state.text("colours", "elements") === "shares";
    this.foldedBy = state.number("fold", 0, angles);

    const [left, right] = columns(root);
    this.sceneView = new SceneView(left, {label: "The Cornell box and its elements", scene, elements: this.elements});
    this.sceneView.onPick((picked) => this.move(this.texels.of(picked)));
    this.addPlace(row(left));
    this.addSettings(row(left));
    this.command = status(left, "hemicube-command");
    text(right, introduction);
    const result = element(right, "div", {className: "hemicube-result"});
    const box = element(result, "div", {className: "hemicube-cross"});
    this.picture = new PixelCanvas(box, {
      label: "The five faces of the hemicube, unfolded",
      columns: 2 * this.resolution,
      rows: 2 * this.resolution,
      size: 320,
    });
    this.addFaceNames(box);
    this.folded = new FoldedHemicube(box);
    this.table = element(result, "div");
    this.pixel = status(right, "hemicube-pixel");
    this.addQuestion(right);
    this.picture.onSelect((column, line) => this.point(column, line));
    this.setResolution(this.resolution);
  }

  end(): void {
    this.sceneView.dispose();
  }

  private colourOf(element: number): Rgb {
    const {surface, column, row} = this.texels.of(element);
    const {columns, rows} = this.texels.info.surfaces[surface];
    return texelColour(hues[this.texels.whole(surface)], columns, rows, row * columns + column);
  }

  /** The place of the patch. */
  private addPlace(parent: HTMLElement): void {
    const span = {min: 0, max: texelsPerSide - 1, step: 1};
    const surfaces = this.texels.info.surfaces.map(({name}, number): Option => [String(number), name]);
    const surface = choice(parent, {label: "Patch on", options: surfaces, value: String(this.from.surface)}, (to) =>
      this.move({...this.from, surface: Number(to)}),
    );
    const column = slider(parent, {label: "Column", ...span, value: this.from.column}, (to) =>
      this.move({...this.from, column: to}),
    );
    const line = slider(parent, {label: "Row", ...span, value: this.from.row}, (to) =>
      this.move({...this.from, row: to}),
    );
    this.showFrom = () => {
      surface.set(String(this.from.surface));
      column.set(this.from.column);
      line.set(this.from.row);
    };
  }

  private addSettings(parent: HTMLElement): void {
    const pixels = {label: "Resolution R", ...resolutions, value: this.resolution};
    slider(parent, pixels, (to) => this.setResolution(to));
    const options = ["elements", ["shares", "delta form factors"]] as const;
    choice(parent, {label: "Colours", options, value: this.byShare ? "shares" : "elements"}, (to) => {
      this.byShare = to === "shares";
      this.state.set("colours", to);
      this.paint();
    });
    const fold = {label: "Fold", ...angles, value: this.foldedBy, show: (to: number) => `${to}°`};
    slider(parent, fold, (to) => {
      this.foldedBy = to;
      this.state.set("fold", to);
      this.folded.show(this.picture.canvas, to);
    });
  }

  /** In the corners of the cross, beside the faces. */
  private addFaceNames(box: HTMLElement): void {
    const places = ["left: 0; top: 0", "left: 0; bottom: 0", "right: 0; top: 0", "right: 0; bottom: 0"];
    const texts = ["middle: top", "left: side +x", "up: side +y, down: −y", "right: side −x"];
    places.forEach((place, k) => {
      const name = element(box, "span", {className: "face-name", textContent: texts[k]});
      name.style.cssText = place;
    });
  }

  private addQuestion(parent: HTMLElement): void {
    question(parent, {
      text: "ΔF in the middle of the top face over ΔF in its corner, at R = 256?",
      answer: () => middleOverCorner(this.elements),
      tolerance: 0.15,
      why: "In the middle x = y = 0, in the corner x = y = 1: the ratio of the denominators is (1 + 1 + 1)² = 9.",
    });
    sourceLink(parent, "radiosity/projection/projection_kinds.cpp", "Delta form factors");
  }

  private setResolution(resolution: number): void {
    this.resolution = resolution;
    this.cross = unfoldedHemicube(resolution);
    this.pointed = [resolution, resolution];
    this.state.set("resolution", resolution);
    this.draw();
  }

  private move(to: Texel): void {
    this.from = to;
    this.showFrom();
    this.draw();
  }

  /** Draws from the patch, or from the last one where a block stands on it. */
  private draw(): void {
    const name = this.texels.name(this.from);
    const source = this.texels.element(this.from);
    if (source === undefined) {
      this.command.set(`A block stands on ${name}.`);
    } else {
      this.source = source;
      this.state.set("from", name);
      this.command.set(
        `hemitex formfactors data/cornell-box.obj --from ${name} --resolution ${this.resolution} ` +
          `--texels ${texelsPerSide} --by-surface`,
      );
    }
    this.view = this.elements.hemicube(this.source, {resolution: this.resolution});
    this.showSums();
    this.paint();
  }

  private formFactorOf(surface: string): number {
    const parts = this.texels.info.surfaces.filter((_, part) => this.texels.whole(part) === surface);
    return sum(
      parts.flatMap(({first_element, element_count}) => [
        ...this.view.formFactors.subarray(first_element, first_element + element_count),
      ]),
    );
  }

  private showSums(): void {
    const {formFactors, background, backs} = this.view;
    const line = (name: string, value: number, colour: string) => `<tr data-name="${name}"><th scope="row">
      <span class="colour-mark" style="background: ${colour}"></span>${name}</th><td>${value.toFixed(4)}</td></tr>`;
    const surfaces = this.surfaces.map((name) =>
      line(name, this.formFactorOf(name), cssColour(texelColour(hues[name], 1, 1, 0))),
    );
    const total = sum(formFactors) + background + backs;
    this.table.innerHTML = `<table><thead><tr><th scope="col">to</th><th scope="col">form factor</th></tr></thead>
      <tbody>${surfaces.join("")}
      ${line("background", background, cssColour(backgroundColour))}
      ${line("backs", backs, cssColour(backColour))}
      ${line("sum", total, "none")}</tbody></table>`;
  }

  private paint(): void {
    const {faces, formFactors} = this.view;
    const largest = largestSize(faces.map(({weights}) => largestSize(weights)));
    const ofElement = this.colours.map(bytesOf), background = bytesOf(backgroundColour), back = bytesOf(backColour);
    const pixels = new Uint8ClampedArray(4 * this.cross.length);
    this.cross.forEach((place, i) => {
      if (!place) return;
      const {elements, weights} = faces[place.face];
      const shown = elements[place.pixel];
      if (this.byShare) pixels.set(paletteBytes[levelOf(weights[place.pixel], largest)], 4 * i);
      else pixels.set(shown >= 0 ? ofElement[shown] : shown === -1 ? background : back, 4 * i);
    });
    this.picture.show(pixels, 2 * this.resolution, 2 * this.resolution);

    // Square roots, so that the scene does not become too dark to be seen.
    const largestRoot = Math.sqrt(largestSize(formFactors));
    const colours = this.byShare
      ? Array.from(formFactors, (factor) => palette[levelOf(Math.sqrt(factor), largestRoot)])
      : [...this.colours];
    colours[this.source] = [1, 1, 1];
    this.sceneView.setColours(Float32Array.from(colours.flat()));
    this.point(...this.pointed);
  }

  /** Says what a pixel of the picture shows, and marks its element in the scene. */
  private point(column: number, line: number): void {
    this.pointed = [column, line];
    this.picture.select(column, line);
    this.folded.show(this.picture.canvas, this.foldedBy);
    const place = this.cross[line * 2 * this.resolution + column];
    const shown = place ? this.view.faces[place.face].elements[place.pixel] : -1;
    this.pixel.set(place ? this.textOf(place, shown) : "No pixel");
    this.sceneView.mark(shown < 0 ? [] : [shown]);
    const name = place ? this.nameOf(shown) : "";
    for (const line of this.table.querySelectorAll<HTMLElement>("tbody tr"))
      line.classList.toggle("current", line.dataset.name === name);
  }

  private nameOf(shown: number): string {
    return shown >= 0 ? this.texels.whole(this.texels.of(shown).surface) : shown === -1 ? "background" : "backs";
  }

  private textOf({face, pixel}: FacePixel, shown: number): string {
    const {width, weights} = this.view.faces[face];
    const what = shown >= 0 ? this.texels.name(this.texels.of(shown)) : this.nameOf(shown);
    return (
      `Pixel (${pixel % width}, ${Math.floor(pixel / width)}) of ${faceNames[face]}: ${what}, ` +
      `ΔF = ${weights[pixel].toPrecision(4)}`
    );
  }
}

export const lesson: Lesson = {
  id: "hemicube",
  title: "2. The hemicube",
  show(root, {cornellBox, state}) {
    const shown = new HemicubeLesson(root, cornellBox(), state);
    return () => shown.end();
  },
};
