// The error of a row of form factors against its time: resolution, rotation, subdivision, rays.
import {okLch} from "../colours";
import {button, checkbox, choice, columns, element, question, row, slider, sourceLink, status, text} from "../controls";
import type {Control, Option} from "../controls";
import type {Elements, Row, RowSettings, Scene} from "../core";
import type {Lesson, Range, State} from "../lesson";
import {largestSize, shortNumber, sum} from "../numbers";
import {Plot, type Point, type Series} from "../plot";
import {SceneView} from "../scene_view";

const texels = 8;
const truthSlices = 8; // each has rays of its own seed
const truthSamples = 2 ** 18; // per slice
const split = 0.003; // the default of the command line
const shortestMeasurement = 20; // ms
const resolutionPowers = {min: 4, max: 9, step: 1}; // a subdivided row of 1,024 would stop the page for seconds
const samplePowers = {min: 8, max: 18, step: 1};

const sources: [name: string, label: string][] = [
  ["light", "The lamp"],
  ["wall-red", "The red wall"],
  ["short-block#1", "A side of the short block"],
  ["element", "One element of the back wall"],
];

const methods: readonly Option[] = [
  ["hemicube", "Hemicubes"],
  ["rays", "Rays"],
];

/** Settings of a row: those of the learner, or of the sweep over all. */
interface Setting {
  method: "hemicube" | "rays";
  resolution: number;
  isRotated: boolean;
  isSplit: boolean;
  samples: number;
}

/** The nearest power of two whose exponent is in the range. */
function powerOfTwo(value: number, {min, max}: Range): number {
  return 2 ** Math.min(max, Math.max(min, Math.round(Math.log2(Math.max(1, value)))));
}

function settingOf(state: State): Setting {
  return {
    method: state.text("method", "hemicube") === "rays" ? "rays" : "hemicube",
    resolution: powerOfTwo(state.number("resolution", 64), resolutionPowers),
    isRotated: state.number("rotated", 1) === 1,
    isSplit: state.number("split", 0) === 1,
    samples: powerOfTwo(state.number("samples", 4096), samplePowers),
  };
}

function rowSettings(setting: Setting): RowSettings {
  if (setting.method === "rays") return {method: "rays", samples: setting.samples};
  return {resolution: setting.resolution, rotated: setting.isRotated, split: setting.isSplit ? split : 1};
}

/** Settings with the same name are one line of the plot. */
function nameOf({method, isRotated, isSplit}: Setting): string {
  if (method === "rays") return "rays";
  return `${isRotated ? "rotated" : "aligned"}${isSplit ? ", subdivided" : ""}`;
}

const lines = ["aligned", "rotated", "aligned, subdivided", "rotated, subdivided", "rays"];

function* allSettings(): Generator<Setting> {
  const common = {method: "hemicube", resolution: 0, samples: 0} as const;
  for (let power = resolutionPowers.min; power <= resolutionPowers.max; ++power)
    for (const isSplit of [false, true])
      for (const isRotated of [false, true]) yield {...common, resolution: 2 ** power, isSplit, isRotated};
  for (let power = samplePowers.min; power <= samplePowers.max; power += 2)
    yield {...common, method: "rays", samples: 2 ** power, isSplit: false, isRotated: false};
}

interface Truth {
  formFactors: Float64Array;
  standardError: number; // sum over all elements
}

interface Tried {
  setting: Setting;
  milliseconds: number;
  error: number;
}

/** A source of light: its rows of form factors and their truth. */
class Source {
  readonly elements: number[];
  readonly tried = new Map<string, Tried>();
  truth: Truth | null = null;
  private readonly from: {element: number} | {surface: string};
  private readonly slices: Row[] = [];

  constructor(
    private readonly divided: Elements,
    name: string,
  ) {
    const isElement = name === "element";
    const surface = divided.info().surfaces.find((one) => one.name === (isElement ? "wall-back" : name))!;
    const all = Array.from({length: surface.element_count}, (_, i) => surface.first_element + i);
    this.elements = isElement ? [all[(texels * texels + texels) / 2]] : all;
    this.from = isElement ? {element: this.elements[0]} : {surface: name};
  }

  /** Casts a part of the rays of the truth. */
  castSlice(): void {
    const seed = this.slices.length + 1;
    this.slices.push(this.divided.row(this.from, {method: "rays", samples: truthSamples, seed}));
    if (this.slices.length === truthSlices) this.truth = meanOf(this.slices);
  }

  /** Form factors less the truth. */
  errors(setting: Setting): Float64Array {
    const {formFactors, milliseconds} = this.row(setting);
    const errors = formFactors.map((value, e) => value - this.truth!.formFactors[e]);
    const error = sum(errors.map(Math.abs));
    this.tried.set(JSON.stringify(rowSettings(setting)), {setting: {...setting}, milliseconds, error});
    return errors;
  }

  get(setting: Setting): Tried {
    return this.tried.get(JSON.stringify(rowSettings(setting)))!;
  }

  /** With the mean time of several rows if one is too short for the clock. */
  private row(setting: Setting): Row {
    const end = performance.now() + shortestMeasurement;
    let [row, total, count] = [null as Row | null, 0, 0];
    while (!row || performance.now() < end) {
      row = this.divided.row(this.from, rowSettings(setting));
      total += row.milliseconds;
      ++count;
    }
    return {...row, milliseconds: total / count};
  }
}

function meanOf(rows: Row[]): Truth {
  const formFactors = new Float64Array(rows[0].formFactors.length);
  const variances = new Float64Array(formFactors.length);
  for (const row of rows) {
    row.formFactors.forEach((value, e) => (formFactors[e] += value / rows.length));
    row.standardErrors!.forEach((value, e) => (variances[e] += (value / rows.length) ** 2));
  }
  return {formFactors, standardError: sum(variances.map(Math.sqrt))};
}

/** Orange for too much, blue for too little, dark for none. */
function errorColours(errors: Float64Array, largest: number): Float32Array {
  const colours = new Float32Array(3 * errors.length);
  errors.forEach((error, e) => {
    const size = largest > 0 ? Math.sqrt(Math.abs(error) / largest) : 0;
    colours.set(okLch(0.2 + 0.6 * size, 0.14 * size, error > 0 ? 0.16 : 0.7), 3 * e);
  });
  return colours;
}

const bar = "<mo stretchy='false'>|</mo>";
const errorFormula =
  `<math><munder><mo>∑</mo><mi>j</mi></munder>${bar}<msub><mi>F</mi><mrow><mi>i</mi><mi>j</mi></mrow></msub>` +
  `<mo>−</mo><msubsup><mi>F</mi><mrow><mi>i</mi><mi>j</mi></mrow><mtext>true</mtext></msubsup>${bar}</math>`;

function addText(parent: HTMLElement): void {
  text(
    parent,
    "A pixel shows one element, even if it covers many: <em>resolution</em>. <em>Rotation</em>, by another angle per " +
      "patch, turns the pattern of errors into noise. Light leaves all of a patch, but a hemicube has one centre: " +
      "<em>subdivision</em> draws a near patch from several centres (Baum, Rushmeier and Winget 1989). Rays have " +
      `neither error, but noise. The error is the sum over all elements, ${errorFormula}.`,
  );
}

function addQuestion(parent: HTMLElement): void {
  question(parent, {
    text: "The red wall, hemicubes without subdivision: 512 pixels instead of 64 hardly lower the error. Why?",
    options: [
      "Rotation is needed, too: the pixels form a pattern",
      "The centres are the larger error: light leaves all of a patch",
      "The truth has noise of the same size",
    ],
    right: 1,
    why: "More pixels help until another error is larger. Then only more centres help.",
  });
  sourceLink(parent, "radiosity/form_factors/patch_subdivision.h", "Subdivision");
}

/** The lines of the plot: what was tried, the error of the truth, and the setting now. */
function seriesOf({tried, truth}: Source, now: Tried): Series[] {
  const points = (name: string) =>
    [...tried.values()]
      .filter(({setting}) => nameOf(setting) === name)
      .map(({milliseconds, error}): Point => [milliseconds, error])
      .sort((a, b) => a[0] - b[0]);
  const times = [...tried.values()].map(({milliseconds}) => milliseconds);
  const noise = [Math.min(...times) / 2, Math.max(...times) * 2].map((time): Point => [time, truth!.standardError]);
  return [
    ...lines.map((name) => ({name, points: points(name)})),
    {name: "standard error of the truth", points: noise},
    {name: "your setting", points: [[now.milliseconds, now.error]], isMarked: true},
  ];
}

class AccuracyLesson {
  private readonly divided: Elements;
  private readonly known = new Map<string, Source>();
  private readonly setting: Setting;
  private readonly view: SceneView;
  private readonly legend: Control<string>;
  private readonly ofHemicubes: HTMLElement[] = []; // controls
  private readonly ofRays: HTMLElement[] = [];
  private readonly plot: Plot;
  private readonly result: Control<string>;
  private readonly progress: Control<string>;
  private source: Source;
  private timer = 0;

  constructor(root: HTMLElement, scene: Scene, private readonly state: State) {
    this.divided = scene.discretize({texels});
    this.setting = settingOf(state);
    const first = state.option("source", sources.map(([name]) => name), "wall-red");
    this.source = this.sourceNamed(first);
    const [left, right] = columns(root);
    const label = "The Cornell box, coloured by the error of each element";
    this.view = new SceneView(left, {label, scene, elements: this.divided});
    this.legend = status(left, "legend");
    this.addChoices(row(left), first);
    this.addControls(row(left));
    this.showControls();
    addText(right);
    this.plot = new Plot(right, {
      label: "Error of a row of form factors over its time",
      x: "ms per row",
      y: "error",
      logarithmicX: true,
      logarithmicY: true,
    });
    this.result = status(right, "error");
    const buttons = row(right);
    button(buttons, "Try all settings", () => this.tryAll());
    this.progress = status(buttons, "truth");
    addQuestion(right);
    this.start();
  }

  end(): void {
    clearTimeout(this.timer);
    this.plot.dispose();
    this.view.dispose();
  }

  private sourceNamed(name: string): Source {
    const source = this.known.get(name) ?? new Source(this.divided, name);
    this.known.set(name, source);
    return source;
  }

  private addChoices(parent: HTMLElement, source: string): void {
    choice(parent, {label: "Source", options: sources, value: source}, (name) => {
      this.state.set("source", name);
      this.source = this.sourceNamed(name);
      this.start();
    });
    choice(parent, {label: "Method", options: methods, value: this.setting.method}, (value) => {
      this.setting.method = value === "rays" ? "rays" : "hemicube";
      this.state.set("method", value);
      this.showControls();
      this.changed();
    });
  }

  private addControls(parent: HTMLElement): void {
    const resolution = this.addPower(parent, "resolution", "Pixels along the side of the top face", resolutionPowers);
    const samples = this.addPower(parent, "samples", "Rays", samplePowers);
    const checkboxes = element(parent, "div");
    checkbox(checkboxes, {label: "Rotate hemicubes", value: this.setting.isRotated}, (value) => {
      this.state.set("rotated", Number((this.setting.isRotated = value)));
      this.changed();
    });
    checkbox(checkboxes, {label: "Subdivide patches", value: this.setting.isSplit}, (value) => {
      this.state.set("split", Number((this.setting.isSplit = value)));
      this.changed();
    });
    this.ofHemicubes.push(resolution, checkboxes);
    this.ofRays.push(samples);
  }

  /** A slider over powers of two. */
  private addPower(parent: HTMLElement, key: "resolution" | "samples", label: string, powers: Range): HTMLElement {
    const box = element(parent, "div", {className: "power"});
    const show = (value: number) => String(2 ** value);
    slider(box, {label, ...powers, value: Math.log2(this.setting[key]), show}, (value) => {
      this.state.set(key, (this.setting[key] = 2 ** value));
      this.changed();
    });
    return box;
  }

  private showControls(): void {
    const isRays = this.setting.method === "rays";
    for (const box of this.ofHemicubes) box.style.display = isRays ? "none" : "";
    for (const box of this.ofRays) box.style.display = isRays ? "" : "none";
  }

  private changed(): void {
    if (this.source.truth) this.start();
  }

  /** Casts the rays of the truth in time slices, if they are not known. Then shows the row. */
  private start(): void {
    const {source} = this;
    clearTimeout(this.timer);
    this.view.mark(source.elements);
    this.progress.set(source.truth ? "Drawing ..." : "Casting the rays of the truth ...");
    this.timer = window.setTimeout(() => {
      if (source.truth) return this.showRow();
      source.castSlice();
      this.start();
    }, 20);
  }

  private showRow(): void {
    const errors = this.source.errors(this.setting);
    const {error, milliseconds} = this.source.get(this.setting);
    const largest = largestSize(errors);
    this.view.setColours(errorColours(errors, largest));
    this.legend.set(`Orange: too much, up to ${largest.toPrecision(3)}. Blue: too little. Outlined: the source.`);
    this.result.set(`error ${error.toFixed(6)} in ${shortNumber(milliseconds)} ms`);
    this.showPlot();
  }

  private showPlot(): void {
    this.plot.set(seriesOf(this.source, this.source.get(this.setting)));
    const rays = truthSlices * truthSamples;
    this.progress.set(`Truth: ${rays} rays, standard error ${this.source.truth!.standardError.toFixed(4)}.`);
  }

  private tryAll(): void {
    if (!this.source.truth) return;
    this.showRow();
    this.sweep(allSettings());
  }

  private sweep(rest: Iterator<Setting>): void {
    clearTimeout(this.timer);
    const next = rest.next();
    this.showPlot();
    if (next.done) return;
    this.progress.set(`Trying ${nameOf(next.value)} ...`);
    this.timer = window.setTimeout(() => {
      this.source.errors(next.value);
      this.sweep(rest);
    });
  }
}

export const lesson: Lesson = {
  id: "accuracy",
  title: "5. What accuracy costs",
  show(root, {cornellBox, state}) {
    const shown = new AccuracyLesson(root, cornellBox(), state);
    return () => shown.end();
  },
};
