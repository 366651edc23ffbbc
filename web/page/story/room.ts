// The room of the story: its elements, a patch in the middle, and the hemicube over it.
import {type Rgb} from "../colours";
import type {Elements, HemicubeView, Scene} from "../core";
import {backColour, backgroundColour, bytesOf, texelColour} from "../lessons/element_colours";
import {Texels, type Texel} from "../lessons/texel_names";

const goldenRatio = 0.6180339887498949;

export class Room {
  readonly elements: Elements;
  readonly texels: Texels;
  readonly names: string[]; // of surfaces; the parts of one count as one
  readonly source: number; // the element over which the hemicube stands

  constructor(
    readonly scene: Scene,
    texelsPerSide = 8,
  ) {
    this.elements = scene.discretize({texels: texelsPerSide});
    this.texels = new Texels(this.elements);
    const {surfaces} = this.texels.info;
    this.names = [...new Set(surfaces.map((_, surface) => this.texels.whole(surface)))];
    this.source = this.texels.element(this.middle())!;
  }

  /** A texel of the floor in front of the blocks, or of the largest surface where none has this name. */
  private middle(): Texel {
    const {surfaces} = this.texels.info;
    const areas = this.elements.areas();
    const areaOf = ({first_element, element_count}: (typeof surfaces)[0]) =>
      areas.subarray(first_element, first_element + element_count).reduce((total, area) => total + area, 0);
    const largest = surfaces.reduce((best, one, k) => (areaOf(one) > areaOf(surfaces[best]) ? k : best), 0);
    const floor = surfaces.findIndex(({name}) => name === "floor");
    const surface = floor < 0 ? largest : floor;
    const {columns, rows, first_element, element_count} = surfaces[surface];
    const wanted = {surface, column: Math.floor(0.3 * columns), row: Math.floor(0.2 * rows)};
    if (this.texels.element(wanted) !== undefined) return wanted;
    return this.texels.of(first_element + Math.floor(element_count / 2));
  }

  hemicube(resolution: number): HemicubeView {
    return this.elements.hemicube(this.source, {resolution});
  }

  /** What a pixel shows, in words. */
  nameOf(shown: number): string {
    return shown >= 0 ? this.texels.name(this.texels.of(shown)) : shown === -1 ? "the background" : "a back";
  }

  surfaceOf(element: number): string {
    return this.texels.whole(this.texels.of(element).surface);
  }

  hueOf(name: string): number {
    return (0.1 + this.names.indexOf(name) * goldenRatio) % 1;
  }

  colourOf(shown: number): Rgb {
    if (shown < 0) return shown === -1 ? backgroundColour : backColour;
    const {surface, column, row} = this.texels.of(shown);
    const {columns, rows} = this.texels.info.surfaces[surface];
    return texelColour(this.hueOf(this.texels.whole(surface)), columns, rows, row * columns + column);
  }

  /** RGBA in bytes of the elements, and from -2 on those of backs and of the background. */
  bytes(): Record<number, number[]> {
    const numbers = Array.from({length: this.texels.info.elements + 2}, (_, k) => k - 2);
    return Object.fromEntries(numbers.map((shown) => [shown, bytesOf(this.colourOf(shown))]));
  }

  /** sRGB of the elements, for a view of the scene. */
  colours(): Float32Array {
    const numbers = [...Array(this.texels.info.elements).keys()];
    return Float32Array.from(numbers.flatMap((element) => this.colourOf(element)));
  }
}

const rooms = new WeakMap<Scene, Room>();

/** The room of a scene; it is made once. */
export function roomOf(scene: Scene): Room {
  const room = rooms.get(scene) ?? new Room(scene);
  rooms.set(scene, room);
  return room;
}
