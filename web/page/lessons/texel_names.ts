// The names of texels, as --from of hemitex takes them: floor:3,4, or short-block#1:3,4 on a part of a surface.
import type {Elements, ElementsInfo} from "../core";

export interface Texel {
  surface: number;
  column: number;
  row: number;
}

/** The texels of all surfaces, and their elements. */
export class Texels {
  readonly info: ElementsInfo;
  private readonly elementsOf: Uint32Array[];
  private readonly texelOf: Texel[] = [];

  constructor(elements: Elements) {
    this.info = elements.info();
    this.elementsOf = this.info.surfaces.map((_, surface) => elements.geometry(surface).elementOfTexel);
    this.elementsOf.forEach((elementOfTexel, surface) => {
      const {columns} = this.info.surfaces[surface];
      elementOfTexel.forEach((element, texel) => {
        this.texelOf[element] ??= {surface, column: texel % columns, row: Math.floor(texel / columns)};
      });
    });
  }

  /** Nothing where another surface covers the texel, or outside the surface. */
  element({surface, column, row}: Texel): number | undefined {
    const {columns} = this.info.surfaces[surface];
    const element = this.elementsOf[surface][row * columns + column];
    return column < columns && element < this.info.elements ? element : undefined;
  }

  /** The first texel of an element. */
  of(element: number): Texel {
    return this.texelOf[element];
  }

  name({surface, column, row}: Texel): string {
    return `${this.info.surfaces[surface].name}:${column},${row}`;
  }

  named(name: string): Texel | undefined {
    const [, surfaceName, column, row] = /^(.*):(\d+),(\d+)$/.exec(name) ?? [];
    const texel = {
      surface: this.info.surfaces.findIndex((one) => one.name === surfaceName),
      column: Number(column),
      row: Number(row),
    };
    return texel.surface >= 0 && this.element(texel) !== undefined ? texel : undefined;
  }

  /** The name of a surface without the number of the part. */
  whole(surface: number): string {
    return this.info.surfaces[surface].name.replace(/#\d+$/, "");
  }
}
