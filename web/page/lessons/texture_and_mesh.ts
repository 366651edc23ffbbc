// The same elements drawn by texture and as polygons: pictures, triangles and times.
import {button, choice, columns, element, question, row, slider, sourceLink, status, text, type Option} from "../controls";
import type {Elements, HemicubeView, Scene} from "../core";
import type {Lesson, Page} from "../lesson";
import {sum} from "../numbers";
import {idColours, PixelCanvas} from "../pixels";
import {Plot} from "../plot";

const ways = ["texture", "mesh"] as const;
type Way = (typeof ways)[number];

const largestPower = 7; // 2^7 elements along a side: a quarter of a million in all
const powers = {min: 0, max: largestPower, step: 1};
const resolutions = ["64", "128", "256", "512"];
const repeats = 9;
const differing = 0xffffff; // the ID of pixels that differ

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

/** The elements of the top face, and those of pixels that differ replaced. */
function compare(drawn: Record<Way, HemicubeView>): {tops: Record<Way, Int32Array>; different: number; all: number} {
  const tops = {texture: drawn.texture.faces[0].elements.slice(), mesh: drawn.mesh.faces[0].elements.slice()};
  let different = 0;
  let all = 0;
  drawn.texture.faces.forEach((face, f) => {
    const others = drawn.mesh.faces[f].elements;
    face.elements.forEach((element, pixel) => {
      ++all;
      if (element === others[pixel]) return;
      ++different;
      if (f === 0) for (const way of ways) tops[way][pixel] = differing;
    });
  });
  return {tops, different, all};
}

/** As idColours, and white where the ways differ. */
function topColours(elements: Int32Array): Uint8ClampedArray {
  const colours = idColours(elements, -1);
  elements.forEach((element, pixel) => {
    if (element === differing) colours.fill(255, 4 * pixel, 4 * pixel + 4);
  });
  return colours;
}

function addText(parent: HTMLElement): void {
  text(
    parent,
    "The usual way before 2002 cuts each surface into one polygon per element. Nielsen and Christensen (2002) draw " +
      "the surface's few triangles with an index map, whose texels are the elements. So the number of triangles is " +
      "that of the scene, for a hundred elements and for a million.",
  );
}

function show(root: HTMLElement, {cornellBox, state}: Page): () => void {
  const known = new Map<number, Divided>();
  const divided = (power: number): Divided => {
    const elements = known.get(power) ?? divide(cornellBox(), power);
    known.set(power, elements);
    return elements;
  };
  let power = state.number("power", 3, powers);
  let resolution = Number(state.option("resolution", resolutions, "128"));
  let timer = 0;

  const [left, right] = columns(root);
  const settings = row(left);
  const size = (value: number) => `${2 ** value} x ${2 ** value}`;
  slider(
    settings,
    {label: "Elements per surface", ...powers, value: power, show: size},
    (value) => {
      state.set("power", (power = value));
      requestPictures();
    },
  );
  const options = resolutions.map((r): Option => [r, `${r} x ${r}`]);
  choice(settings, {label: "Pixels of the top face", options, value: String(resolution)}, (value) => {
    state.set("resolution", (resolution = Number(value)));
    requestPictures();
    measurement.start(resolution);
  });
  const pictures = row(left);
  const canvases = ways.map((way) => {
    const figure = element(pictures, "figure");
    const label = `The top face of the hemicube over the middle of the floor, by ${way}`;
    const canvas = new PixelCanvas(figure, {label, columns: resolution, rows: resolution, size: 288});
    element(figure, "figcaption", {textContent: `By ${way}: one colour per element`});
    return canvas;
  });
  const differences = status(left, "differences");
  text(
    left,
    "White: rounding moves the border of an element across the centre of the pixel. All five faces count.",
  );
  const triangles = status(left, "triangles");
  const times = status(left, "times");
  const measured = row(left);
  button(measured, "Measure again", () => measurement.start(resolution));
  const progress = status(measured, "measurement");

  addText(right);
  const logarithmic = {x: "elements", logarithmicX: true, logarithmicY: true};
  const timePlot = new Plot(right, {label: "Time of a hemicube over elements", y: "ms per hemicube", ...logarithmic});
  const trianglePlot = new Plot(right, {label: "Triangles over elements", y: "triangles", ...logarithmic});
  question(right, {
    text: "256 x 256 elements per surface are about a million. How many triangles does hemitex draw with the texture?",
    answer: () => measurement.found.texture[0].triangles,
    tolerance: 0,
    why: "It draws the triangles of the scene, as for one element per surface. The mesh needs about two million.",
  });
  sourceLink(right, "radiosity/index_maps/scene_draw_list.cpp", "Elements by texture");
  sourceLink(right, "radiosity/index_maps/meshed_draws.cpp", "Elements as polygons");

  /** The slider does not wait for pictures of every number that it passes. */
  function requestPictures(): void {
    clearTimeout(timer);
    timer = window.setTimeout(showPictures, 20);
  }

  function showPictures(): void {
    showTimes();
    const {elements, middle} = divided(power);
    const draw = (way: Way) => elements.hemicube(middle, {resolution, elements: way});
    const drawn = {texture: draw("texture"), mesh: draw("mesh")};
    const {tops, different, all} = compare(drawn);
    ways.forEach((way, i) => canvases[i].show(topColours(tops[way]), resolution, resolution));
    const byMesh = drawn.mesh.formFactors;
    const difference = sum(drawn.texture.formFactors.map((value, e) => Math.abs(value - byMesh[e])));
    differences.set(`${different} of ${all} pixels differ; form factors by ${difference.toFixed(6)} in all`);
  }

  function showTimes(): void {
    const {count} = divided(power);
    const [texture, mesh] = ways.map((way) => measurement.found[way].find((one) => one.count === count));
    if (!texture || !mesh) return;
    triangles.set(`${count} elements: ${texture.triangles} triangles by texture, ${mesh.triangles} by mesh`);
    const ratio = mesh.milliseconds / texture.milliseconds;
    times.set(
      `${texture.milliseconds.toPrecision(3)} ms by texture, ${mesh.milliseconds.toPrecision(3)} ms by mesh: ` +
        `${ratio.toPrecision(2)} times`,
    );
  }

  function showMeasured(isDone: boolean): void {
    const series = (value: (one: Measured) => number) =>
      ways.map((way) => ({
        name: way,
        points: measurement.found[way].map((one) => [one.count, value(one)] as [number, number]),
      }));
    timePlot.set(series(({milliseconds}) => milliseconds));
    trianglePlot.set(series((one) => one.triangles));
    progress.set(isDone ? `Median of ${repeats} hemicubes.` : "Measuring ...");
    showTimes();
  }

  const measurement = new Measurement(divided, showMeasured);
  requestPictures();
  measurement.start(resolution);
  return () => {
    clearTimeout(timer);
    measurement.stop();
    timePlot.dispose();
    trianglePlot.dispose();
  };
}

export const lesson: Lesson = {id: "texture-and-mesh", title: "4. Texture against mesh", show};
