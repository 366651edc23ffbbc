// The scene in 3-D, lit shot by shot, or with the flux of its patches.
import {litColours, valueColour} from "../colours";
import {checkbox, choice, row, status, type Control} from "../controls";
import type {Elements, Scene, Solution} from "../core";
import type {State} from "../lesson";
import {largestSize} from "../numbers";
import {SceneView} from "../scene_view";
import type {Shooting} from "./solution";

const exposure = 3; // fixed, so that a darker lamp looks darker

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

const colourings = {light: "Light", unshot: "Unshot flux per patch", shot: "Flux that each patch has shot"};

/** The scene in 3-D with its colours, and the controls that choose them. */
export class Picture {
  readonly view: SceneView;
  private colouring: string;
  private isAmbient: boolean;
  private readonly legend: Control<string>;
  private readonly squareMetres: number;

  constructor(
    parent: HTMLElement,
    scene: Scene,
    private readonly shooting: Shooting,
    private readonly state: State,
  ) {
    this.colouring = state.option("colours", Object.keys(colourings), "light");
    this.squareMetres = scene.info().square_metres;
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
    this.legend.set(`Yellow: ${(this.squareMetres * largest).toPrecision(3)} W. Dark: 0. Red: negative.`);
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
