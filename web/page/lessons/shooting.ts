// Progressive refinement, shot by shot. After an edit of the scene the light is updated instead of computed again.
import {litColours, valueColour} from "../colours";
import {button, checkbox, choice, columns, element, question, row, slider, sourceLink, status, text} from "../controls";
import type {Control} from "../controls";
import type {Edit, Elements, Scene, SceneInfo, Solution, SolutionInfo, Vec3} from "../core";
import type {Lesson, Page, State} from "../lesson";
import {largestSize, sum} from "../numbers";
import {Plot, type Point} from "../plot";
import {SceneView} from "../scene_view";

// Few patches, so that an update takes less than a fifth of a second. The faces of the blocks are small.
const elementSettings = {texels: 16, surface_texels: {"short-block": 8, "tall-block": 8}, patch: 4, editable: true};
const shotSettings = {resolution: 64, split: 0.2, residual: 0.01, shots: 0, editable: true};
const exposure = 3; // fixed, so that a darker lamp looks darker
const shotsPerEdit = 200; // the rest follows in the next pictures
const shotsAtStart = 20; // the lamp has shot
const pointsOfCurve = 400;

/** Objects that move, and how far along x and z, in mm. */
const objects = [
  {name: "short-block", label: "Short block", x: [-75, 250], z: [-60, 280]},
  {name: "tall-block", label: "Tall block", x: [-250, 75], z: [-240, 75]},
  {name: "light", label: "Lamp", x: [-200, 200], z: [-200, 200]},
] as const;

const paints: Record<string, Vec3> = {
  blue: [0.05, 0.12, 0.6],
  white: [0.74, 0.74, 0.75],
  black: [0.02, 0.02, 0.02],
};
const walls = ["red", ...Object.keys(paints)];
const emissions = {min: 0, max: 2, step: 0.05}; // over that of the file

/** The changes of the scene that the learner asks for. */
interface Changes {
  places: Record<string, [x: number, z: number]>;
  lamp: number; // emission over that of the file
  wall: string; // paint of the red wall
}

function changesOf(state: State): Changes {
  const number = (key: string, [min, max]: readonly [number, number]) => state.number(key, 0, {min, max, step: 5});
  const places = objects.map(({name, x, z}) => [name, [number(`${name}-x`, x), number(`${name}-z`, z)]]);
  return {
    places: Object.fromEntries(places),
    lamp: state.number("lamp", 1, emissions),
    wall: state.option("wall", walls, "red"),
  };
}

const unchanged: Changes = {
  places: Object.fromEntries(objects.map(({name}) => [name, [0, 0]])),
  lamp: 1,
  wall: "red",
};

/** A moved lamp hangs 1 mm below the ceiling, which would cover it otherwise. */
const heightAt = (name: string, [x, z]: [number, number]) => (name === "light" && (x || z) ? -1 : 0);

/** The edits that lead from one state of the scene to another. */
function editsBetween(from: Changes, to: Changes, {surfaces}: SceneInfo): Edit[] {
  const edits: Edit[] = [];
  for (const {name} of objects) {
    const [old, next] = [from.places[name], to.places[name]];
    const by: Vec3 = [next[0] - old[0], heightAt(name, next) - heightAt(name, old), next[1] - old[1]];
    if (by.some((distance) => distance !== 0)) edits.push({edit: "move", name, by});
  }
  if (from.lamp !== to.lamp) {
    const {emission} = surfaces.find(({name}) => name === "light")!;
    edits.push({edit: "emission", name: "light", to: emission.map((band) => band * to.lamp) as Vec3});
  }
  if (from.wall !== to.wall) {
    const {reflectance} = surfaces.find(({name}) => name === "wall-red")!;
    edits.push({edit: "reflectance", name: "wall-red", to: paints[to.wall] ?? reflectance});
  }
  return edits;
}

/** A solution, and what was shot since its start. */
class Shooting {
  solution: Solution;
  info: SolutionInfo;
  shots = 0;
  curve: Point[] = []; // shots and residual
  private readonly scene: SceneInfo;
  private applied = unchanged;

  constructor(scene: Scene) {
    this.scene = scene.info();
    this.solution = scene.discretize(elementSettings).solve(shotSettings);
    this.info = this.solution.info();
    this.record();
  }

  /** Begins without light; edits stay. */
  restart(): void {
    this.solution = this.solution.elements().solve(shotSettings);
    this.info = this.solution.info();
    this.shots = 0;
    this.curve = [];
    this.record();
  }

  /** Few shots at first, so that single ones are seen, and more later. */
  shootSome(atMost = Infinity): void {
    this.info = this.solution.shoot(Math.min(atMost, Math.max(1, Math.floor(this.shots / 16))));
    this.record();
  }

  /** Shoots `count` times, or until little is unshot. */
  shootAll(count: number): void {
    const end = this.shots + count;
    while (this.shots < end && !this.isDone) this.shootSome(end - this.shots);
  }

  /** Updates the light for these changes. Returns the edits. */
  change(to: Changes): Edit[] {
    const edits = editsBetween(this.applied, to, this.scene);
    if (!edits.length) return edits;
    this.info = this.solution.edit(edits, shotsPerEdit);
    this.applied = structuredClone(to);
    this.record();
    return edits;
  }

  get isDone(): boolean {
    return this.info.residual <= shotSettings.residual;
  }

  private record(): void {
    this.shots += this.info.shots;
    if (this.info.residual > 0) this.curve.push([this.shots, this.info.residual]);
    if (this.curve.length > pointsOfCurve) this.curve.shift();
  }
}

/** The radiosity of the elements, with the ambient estimate if wanted. */
function radiosityOf({solution, info}: Shooting, withAmbient: boolean): Float64Array {
  const radiosity = solution.radiosity();
  if (!withAmbient) return radiosity;
  for (const {first_element, element_count, reflectance} of solution.elements().info().surfaces)
    for (let i = 3 * first_element; i < 3 * (first_element + element_count); ++i)
      radiosity[i] += reflectance[i % 3] * info.ambient[i % 3];
  return radiosity;
}

/** The flux that each patch has shot, W, bands summed: what it sends out less what is unshot. */
function shotFlux(solution: Solution, elements: Elements, patchOf: Uint32Array): Float64Array {
  const flux = solution.unshot().map((unshot) => -unshot);
  const radiosity = solution.radiosity();
  elements.areas().forEach((area, e) => {
    flux[patchOf[e]] += area * (radiosity[3 * e] + radiosity[3 * e + 1] + radiosity[3 * e + 2]);
  });
  return flux;
}

/** Colours by the flux of the element's patch: dark to bright, and red where it is negative. */
function fluxColours(flux: Float64Array, patchOf: Uint32Array, largest: number): Float32Array {
  const colours = new Float32Array(3 * patchOf.length);
  patchOf.forEach((patch, e) => {
    const share = largest > 0 ? flux[patch] / largest : 0;
    colours.set(share < 0 ? [0.06 - 0.9 * share, 0.06, 0.12] : valueColour(share), 3 * e);
  });
  return colours;
}

/** Pictures per second since the page was idle, at most the last 20. A picture lasts until the next animation frame. */
class Rate {
  private times: number[] = [];
  private start = 0;

  /** At each animation frame; `isBusy`: it makes a picture. */
  frame(now: number, isBusy: boolean): void {
    this.times = this.start ? [...this.times.slice(-19), now - this.start] : [];
    this.start = isBusy ? now : 0;
  }

  get perSecond(): number {
    return (1000 * this.times.length) / sum(this.times);
  }
}

const parts = [
  ["absorbed", "#0072b2", "#ffffff"],
  ["unshot", "#e69f00", "#000000"],
  ["lost", "#5a5f66", "#ffffff"],
] as const;

/** Where the emitted light went, as a bar and as text. */
function energyBar(parent: HTMLElement): (info: SolutionInfo) => void {
  const bar = element(parent, "div", {className: "energy-bar", ariaHidden: "true"});
  const boxes = parts.map(([name, background, color]) => {
    const box = element(bar, "div", {textContent: name});
    Object.assign(box.style, {background, color});
    return box;
  });
  const account = status(parent, "energy");
  return ({energy}) => {
    const emitted = sum(energy.emitted);
    const share = (name: keyof SolutionInfo["energy"]) => (emitted > 0 ? (100 * sum(energy[name])) / emitted : 0);
    parts.forEach(([name], i) => (boxes[i].style.width = `${Math.max(0, share(name))}%`));
    const terms = parts.map(([name]) => `${name} ${share(name).toFixed(2)} %`);
    account.set(`emitted ${(emitted / 1000).toFixed(2)} kW = ${terms.join(" + ")}`);
  };
}

const shotFormula =
  "<math><mi>Δ</mi><msub><mi>B</mi><mi>j</mi></msub><mo>=</mo><msub><mi>ρ</mi><mi>j</mi></msub>" +
  "<msub><mi>F</mi><mrow><mi>i</mi><mi>j</mi></mrow></msub><msub><mi>Φ</mi><mi>i</mi></msub><mo>/</mo>" +
  "<msub><mi>A</mi><mi>j</mi></msub></math>";
const ambientFormula =
  "<math><mo>∑</mo><msub><mi>Φ</mi><mi>i</mi></msub><mo>/</mo><mo>∑</mo><mo stretchy='false'>(</mo><mn>1</mn>" +
  "<mo>−</mo><msub><mi>ρ</mi><mi>j</mi></msub><mo stretchy='false'>)</mo><msub><mi>A</mi><mi>j</mi></msub></math>";

function addText(right: HTMLElement): void {
  text(
    right,
    "A shot takes the patch <math><mi>i</mi></math> with the most unshot flux Φ and draws one hemicube over it. Each " +
      "element <math><mi>j</mi></math> reflects a part ρ of the flux that it receives. This part is unshot in turn: " +
      `${shotFormula}. The ambient estimate spreads all unshot flux evenly, for display: ` +
      `<math><msub><mi>ρ</mi><mi>j</mi></msub></math>${ambientFormula} (Cohen, Chen, Wallace and Greenberg 1988).`,
  );
}

function addQuestion(right: HTMLElement): void {
  question(right, {
    text: "The room is lit. You make the lamp twice as bright. How many hemicubes does hemitex draw for the new light?",
    options: ["One per patch", "One per patch of the lamp", "None"],
    right: 2,
    why: "Form factors depend on the geometry alone. Only the flux along known rows changes.",
  });
  sourceLink(right, "radiosity/solver/progressive_solver.cpp", "Shots");
  sourceLink(right, "radiosity/solver/dynamic_solution.cpp", "Edits (Chen 1990)");
}

/** Sliders of one object. */
function placeSliders(parent: HTMLElement, name: string, state: State, wanted: Changes, changed: () => void): void {
  parent.replaceChildren();
  const object = objects.find((one) => one.name === name)!;
  const place = wanted.places[object.name];
  const show = (value: number) => `${value} mm`;
  const move = (axis: "x" | "z", to: number) => {
    place[axis === "x" ? 0 : 1] = to;
    state.set(`${object.name}-${axis}`, to);
    changed();
  };
  // The camera looks along z, and x points to the left.
  const toRight = {label: "Move to the right", min: -object.x[1], max: -object.x[0], step: 5, value: -place[0], show};
  slider(parent, toRight, (value) => move("x", -value));
  const toBack = {label: "Move to the back", min: object.z[0], max: object.z[1], step: 5, value: place[1], show};
  slider(parent, toBack, (value) => move("z", value));
}

/** Controls that change the scene; they write into `wanted` and call `changed`. */
function addSceneControls(parent: HTMLElement, state: State, wanted: Changes, changed: () => void): void {
  const line = row(parent);
  const sliders = row(parent);
  const options = objects.map(({name, label}) => [name, label] as const);
  const shown = state.option("object", objects.map(({name}) => name), "short-block");
  choice(line, {label: "Object", options, value: shown}, (name) => {
    state.set("object", name);
    placeSliders(sliders, name, state, wanted, changed);
  });
  placeSliders(sliders, shown, state, wanted, changed);
  choice(line, {label: "Red wall", options: walls, value: wanted.wall}, (wall) => {
    state.set("wall", (wanted.wall = wall));
    changed();
  });
  addLampControls(line, state, wanted, changed);
}

function addLampControls(line: HTMLElement, state: State, wanted: Changes, changed: () => void): void {
  const show = (value: number) => `${Math.round(100 * value)} %`;
  let whenOn = wanted.lamp || 1;
  const change = (to: number) => {
    state.set("lamp", (wanted.lamp = to));
    if (to) whenOn = to;
    lamp.set(to > 0);
    dimmer.set(to);
    changed();
  };
  const dimmer = slider(line, {label: "Emission", ...emissions, value: wanted.lamp, show}, change);
  const lamp = checkbox(line, {label: "Lamp on", value: wanted.lamp > 0}, (isOn) => change(isOn ? whenOn : 0));
}

const colourings = {light: "Light", unshot: "Unshot flux per patch", shot: "Flux that each patch has shot"};

/** The scene in 3-D with its colours, and the controls that choose them. */
class Picture {
  readonly view: SceneView;
  private colouring: string;
  private isAmbient: boolean;
  private readonly legend: Control<string>;

  constructor(
    parent: HTMLElement,
    scene: Scene,
    private readonly shooting: Shooting,
    private readonly state: State,
  ) {
    this.colouring = state.option("colours", Object.keys(colourings), "light");
    this.isAmbient = state.number("ambient", 0) === 1;
    const elements = shooting.solution.elements();
    this.view = new SceneView(parent, {label: "The Cornell box, lit shot by shot", scene, elements});
    this.addControls(row(parent));
    this.legend = status(parent, "legend");
  }

  draw(): void {
    if (this.colouring === "light") this.drawLight();
    else this.drawFlux();
  }

  private drawLight(): void {
    this.view.setColours(litColours(radiosityOf(this.shooting, this.isAmbient), exposure));
    this.legend.set("Outlined: the patch that shoots next.");
  }

  private drawFlux(): void {
    const {solution} = this.shooting;
    const elements = solution.elements(); // patches near their receivers are split before their first shot
    const patchOf = elements.patchOfElement();
    const flux = this.colouring === "unshot" ? solution.unshot() : shotFlux(solution, elements, patchOf);
    const largest = largestSize(flux);
    this.view.setColours(fluxColours(flux, patchOf, largest));
    this.legend.set(`Yellow: ${(largest / 1000).toPrecision(3)} kW. Dark: 0. Red: negative.`);
  }

  private addControls(line: HTMLElement): void {
    choice(line, {label: "Colours", options: Object.entries(colourings), value: this.colouring}, (value) => {
      this.state.set("colours", (this.colouring = value));
      this.draw();
    });
    checkbox(line, {label: "Ambient estimate", value: this.isAmbient}, (value) => {
      this.state.set("ambient", Number((this.isAmbient = value)));
      this.draw();
    });
  }
}

/** How far the solution is: shots, the curve of convergence, and the account of energy. */
class Progress {
  readonly plot: Plot;
  private readonly shots: Control<string>;
  private readonly showEnergy: (info: SolutionInfo) => void;

  constructor(parent: HTMLElement) {
    this.shots = status(parent, "shots");
    this.plot = new Plot(parent, {
      label: "Unshot flux over emitted flux, over the number of shots",
      x: "shots",
      y: "unshot / emitted",
      logarithmicY: true,
    });
    this.showEnergy = energyBar(parent);
  }

  show({shots, info, curve}: Shooting): void {
    const isSigned = sum(info.energy.unshot) < 0.99 * info.residual * sum(info.energy.emitted);
    const negative = isSigned ? ", negative flux counted as positive" : "";
    this.shots.set(`${shots} shots: ${(100 * info.residual).toFixed(3)} % unshot${negative}`);
    this.plot.set([{name: "unshot", points: curve}]);
    this.showEnergy(info);
  }
}

function show(root: HTMLElement, {cornellBox, state}: Page): () => void {
  const scene = cornellBox();
  const shooting = new Shooting(scene);
  const wanted = changesOf(state);
  const rate = new Rate();
  let isRunning = false;
  let frame = 0;

  const [left, right] = columns(root);
  const picture = new Picture(left, scene, shooting, state);
  addSceneControls(left, state, wanted, request);
  const pictures = status(left, "pictures-per-second");
  pictures.set("Move an object, dim the lamp, paint the wall: the light follows.");
  addText(right);
  const buttons = row(right);
  const pauseAnd = (action: () => void) => () => {
    isRunning = false;
    action();
    settle();
  };
  button(buttons, "One shot", pauseAnd(() => shooting.shootAll(1)));
  button(buttons, "Ten shots", pauseAnd(() => shooting.shootAll(10)));
  const run = button(buttons, "Run", () => {
    isRunning = !isRunning;
    settle();
    if (isRunning) request();
  });
  const again = button(buttons, "Start again", pauseAnd(() => shooting.restart()));
  const progress = new Progress(right);
  addQuestion(right);

  function draw(): void {
    picture.draw();
    progress.show(shooting);
    run.textContent = isRunning ? "Pause" : "Run";
  }

  /** Draws before and after a run: with the patch that shoots next. */
  function settle(): void {
    draw();
    picture.view.mark(isRunning ? [] : shooting.solution.brightest());
    again.disabled = wanted.lamp === 0;
    if (shooting.shots !== state.number("shots", shotsAtStart)) state.set("shots", shooting.shots);
  }

  function request(): void {
    frame ||= requestAnimationFrame(step);
  }

  /** One update per animation frame, whatever number of changes came since the last one. */
  function step(now: number): void {
    frame = 0;
    const edits = shooting.change(wanted);
    if (edits.length) isRunning = true;
    else if (isRunning && !shooting.isDone) shooting.shootSome();
    else isRunning = false;
    rate.frame(now, isRunning);
    const update = `the last update took ${shooting.info.milliseconds.toFixed(0)} ms`;
    if (rate.perSecond) pictures.set(`${rate.perSecond.toFixed(1)} pictures per second; ${update}`);
    if (!isRunning) return settle();
    if (edits.some(({edit}) => edit === "move")) picture.view.setElements(shooting.solution.elements());
    draw();
    request();
  }

  shooting.shootAll(state.number("shots", shotsAtStart));
  settle();
  request();
  return () => {
    cancelAnimationFrame(frame);
    progress.plot.dispose();
    picture.view.dispose();
  };
}

export const lesson: Lesson = {id: "shooting", title: "3. Shooting", show};
