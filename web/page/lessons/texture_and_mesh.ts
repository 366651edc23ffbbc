// The same elements drawn by texture and as polygons: pictures, triangles and times.
import {button, choice, columns, element, question, row, slider, sourceLink, status, text} from "../controls";
import type {Control, Option} from "../controls";
import type {Elements, ElementsInfo, HemicubeView, Scene} from "../core";
import type {Lesson, State} from "../lesson";
import {shortNumber, sum} from "../numbers";
import {PixelCanvas} from "../pixels";
import {Plot, type Point} from "../plot";
import {backgroundColour, bytesOf, texelColour} from "./element_colours";

const ways = ["texture", "mesh"] as const;
type Way = (typeof ways)[number];

const largestPower = 7; // 2^7 elements along a side: a quarter of a million in all
const powers = {min: 0, max: largestPower, step: 1};
const resolutions = ["64", "128", "256", "512"];
const repeats = 9;

/** The scene with 2^power x 2^power elements per surface, and the element in the middle of the floor. */
interface Divided {
  elements: Elements;
  count: number;
  middle: number;
}

function divide(scene: Scene, power: number): Divided {
  const elements = scene.discretize({texels: 2 ** power});
  const {surfaces, elements: count} = elements.info();
  const floor = surfaces.findIndex(({name}) => name === "floor");
  const {columns, rows} = surfaces[floor];
  const texel = Math.floor(rows / 2) * columns + Math.floor(columns / 2);
  return {elements, count, middle: elements.geometry(floor).elementOfTexel[texel]};
}

interface Measured {
  count: number; // of elements
  milliseconds: number;
  triangles: number;
}

/** Times of the hemicube for each way and number of elements. One is measured per time slice. */
class Measurement {
  readonly found: Record<Way, Measured[]> = {texture: [], mesh: []};
  private timer = 0;

  constructor(
    private readonly divided: (power: number) => Divided,
    private readonly changed: (isDone: boolean) => void,
  ) {}

  start(resolution: number): void {
    this.stop();
    for (const way of ways) this.found[way] = [];
    this.continue(resolution, 0);
  }

  stop(): void {
    clearTimeout(this.timer);
  }

  private continue(resolution: number, slice: number): void {
    const power = Math.floor(slice / ways.length);
    this.changed(power > largestPower);
    if (power > largestPower) return;
    this.timer = window.setTimeout(() => {
      const {elements, count, middle} = this.divided(power);
      const way = ways[slice % ways.length];
      this.found[way].push({count, ...elements.timeOfHemicube(middle, {resolution, elements: way}, repeats)});
      this.continue(resolution, slice + 1);
    });
  }
}

/** A hue per surface, and a lightness per element; white where the other way shows another element. */
function topColours({surfaces}: ElementsInfo, elements: Int32Array, others: Int32Array): Uint8ClampedArray {
  const white = [255, 255, 255, 255], background = bytesOf(backgroundColour);
  const colourOf = (shown: number) => {
    if (shown < 0) return background;
    const surface = surfaces.reduce((last, {first_element}, k) => (first_element <= shown ? k : last), 0);
    const {columns, rows, first_element} = surfaces[surface];
    return bytesOf(texelColour((surface * 0.618) % 1, columns, rows, shown - first_element));
  };
  return Uint8ClampedArray.from([...elements].flatMap((shown, k) => (shown === others[k] ? colourOf(shown) : white)));
}

/** How far the hemicubes of both ways differ, in words. */
function describeDifference(texture: HemicubeView, mesh: HemicubeView): string {
  const all = sum(texture.faces.map(({elements}) => elements.length));
  const different = sum(
    texture.faces.map(({elements}, face) => {
      const others = mesh.faces[face].elements;
      return elements.filter((element, pixel) => element !== others[pixel]).length;
    }),
  );
  const difference = sum(texture.formFactors.map((factor, e) => Math.abs(factor - mesh.formFactors[e])));
  return `${different} of ${all} pixels differ; form factors by ${difference.toFixed(6)} in all`;
}

function addText(parent: HTMLElement): void {
  text(
    parent,
    "The usual way before 2002 cuts each surface into one polygon per element. Nielsen and Christensen (2002) draw " +
      "the surface's few triangles with an index map, whose texels are the elements. So the number of triangles is " +
      "that of the scene, for a hundred elements and for a million. With few triangles, filling pixels takes the time: " +
      "the method is then fill-limited, as section 3.1 of the paper says, and no way to divide surfaces makes it faster.",
  );
}

class TextureLesson {
  private readonly known = new Map<number, Divided>();
  private readonly canvases: PixelCanvas[];
  private readonly differences: Control<string>;
  private readonly triangles: Control<string>;
  private readonly times: Control<string>;
  private readonly progress: Control<string>;
  private readonly timePlot: Plot;
  private readonly trianglePlot: Plot;
  private readonly measurement: Measurement;
  private power: number;
  private resolution: number;
  private timer = 0;

  constructor(root: HTMLElement, private readonly scene: Scene, private readonly state: State) {
    this.power = state.number("power", 3, powers);
    this.resolution = Number(state.option("resolution", resolutions, "128"));
    this.measurement = new Measurement((power) => this.divided(power), (isDone) => this.showMeasured(isDone));
    const [left, right] = columns(root);
    this.addSettings(row(left));
    this.canvases = this.addPictures(row(left));
    this.differences = status(left, "differences");
    text(left, "White: rounding moves the border of an element across the centre of the pixel. All five faces count.");
    this.triangles = status(left, "triangles");
    this.times = status(left, "times");
    const measured = row(left);
    button(measured, "Measure again", () => this.measurement.start(this.resolution));
    this.progress = status(measured, "measurement");
    addText(right);
    const axes = {x: "elements", logarithmicX: true, logarithmicY: true};
    this.timePlot = new Plot(right, {label: "Time of a hemicube over elements", y: "ms per hemicube", ...axes});
    this.trianglePlot = new Plot(right, {label: "Triangles over elements", y: "triangles", ...axes});
    this.addQuestion(right);
    this.requestPictures();
    this.measurement.start(this.resolution);
  }

  end(): void {
    clearTimeout(this.timer);
    this.measurement.stop();
    this.timePlot.dispose();
    this.trianglePlot.dispose();
  }

  private divided(power: number): Divided {
    const found = this.known.get(power) ?? divide(this.scene, power);
    this.known.set(power, found);
    return found;
  }

  private addSettings(parent: HTMLElement): void {
    const show = (value: number) => `${2 ** value} x ${2 ** value}`;
    slider(parent, {label: "Elements per surface", ...powers, value: this.power, show}, (value) => {
      this.state.set("power", (this.power = value));
      this.requestPictures();
    });
    const options = resolutions.map((r): Option => [r, `${r} x ${r}`]);
    choice(parent, {label: "Pixels of the top face", options, value: String(this.resolution)}, (value) => {
      this.state.set("resolution", (this.resolution = Number(value)));
      this.requestPictures();
      this.measurement.start(this.resolution);
    });
  }

  private addPictures(parent: HTMLElement): PixelCanvas[] {
    return ways.map((way) => {
      const figure = element(parent, "figure");
      const label = `The top face of the hemicube over the middle of the floor, by ${way}`;
      const canvas = new PixelCanvas(figure, {label, columns: this.resolution, rows: this.resolution, size: 288});
      element(figure, "figcaption", {textContent: `By ${way}: a hue per surface, a lightness per element`});
      return canvas;
    });
  }

  private addQuestion(parent: HTMLElement): void {
    question(parent, {
      text: "256 x 256 elements per surface are about a million. How many triangles does the texture need?",
      answer: () => this.measurement.found.texture[0].triangles,
      tolerance: 0,
      why: "It draws the triangles of the scene, as for one element per surface. The mesh needs about two million.",
    });
    sourceLink(parent, "radiosity/index_maps/scene_draw_list.cpp", "Elements by texture");
    sourceLink(parent, "radiosity/index_maps/meshed_draws.cpp", "Elements as polygons");
  }

  /** The slider does not wait for pictures of every number that it passes. */
  private requestPictures(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.showPictures(), 20);
  }

  private showPictures(): void {
    this.showTimes();
    const {elements, middle} = this.divided(this.power);
    const {resolution} = this;
    const [texture, mesh] = ways.map((way) => elements.hemicube(middle, {resolution, elements: way}));
    const [byTexture, byMesh] = [texture, mesh].map(({faces}) => faces[0].elements);
    const info = elements.info();
    this.canvases[0].show(topColours(info, byTexture, byMesh), resolution, resolution);
    this.canvases[1].show(topColours(info, byMesh, byTexture), resolution, resolution);
    this.differences.set(describeDifference(texture, mesh));
  }

  private showTimes(): void {
    const {count} = this.divided(this.power);
    const [texture, mesh] = ways.map((way) => this.measurement.found[way].find((one) => one.count === count));
    if (!texture || !mesh) return;
    this.triangles.set(`${count} elements: ${texture.triangles} triangles by texture, ${mesh.triangles} by mesh`);
    const ratio = mesh.milliseconds / texture.milliseconds;
    this.times.set(
      `${shortNumber(texture.milliseconds)} ms by texture, ${shortNumber(mesh.milliseconds)} ms by mesh: ` +
        `${shortNumber(ratio)} times`,
    );
  }

  private showMeasured(isDone: boolean): void {
    const series = (value: (one: Measured) => number) =>
      ways.map((way) => ({
        name: way,
        points: this.measurement.found[way].map((one): Point => [one.count, value(one)]),
      }));
    this.timePlot.set(series(({milliseconds}) => milliseconds));
    this.trianglePlot.set(series((one) => one.triangles));
    this.progress.set(isDone ? `The fastest of ${repeats} hemicubes: other work only adds time.` : "Measuring ...");
    this.showTimes();
  }
}

export const lesson: Lesson = {
  id: "texture-and-mesh",
  title: "4. Texture against mesh",
  show(root, {cornellBox, state}) {
    const shown = new TextureLesson(root, cornellBox(), state);
    return () => shown.end();
  },
};
