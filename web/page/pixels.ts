// Pictures of pixels, enlarged, in which a pixel can be selected.
import {idColour, type Rgb} from "./colours";
import {element} from "./controls";

interface PixelOptions {
  label: string;
  columns: number;
  rows: number;
  size: number; // CSS pixels of the longer side
}

/** Row 0 is at the bottom. Pointer and arrow keys select a pixel. */
export class PixelCanvas {
  readonly canvas: HTMLCanvasElement;
  private columns: number;
  private rows: number;
  private readonly size: number;
  private readonly picture = document.createElement("canvas");
  private selected: [column: number, row: number] | null = null;

  constructor(parent: HTMLElement, {label, columns, rows, size}: PixelOptions) {
    this.canvas = element(parent, "canvas", {className: "pixels", role: "img", ariaLabel: label});
    this.columns = columns;
    this.rows = rows;
    this.size = size;
    this.resize();
  }

  /** @param colours RGBA per pixel, row 0 first */
  show(colours: Uint8ClampedArray, columns = this.columns, rows = this.rows): void {
    if (columns !== this.columns || rows !== this.rows) {
      this.columns = columns;
      this.rows = rows;
      this.selected = null;
      this.resize();
    }
    const image = new ImageData(columns, rows);
    for (let y = 0; y < rows; ++y)
      image.data.set(colours.subarray(4 * columns * y, 4 * columns * (y + 1)), 4 * columns * (rows - 1 - y));
    this.picture.getContext("2d")!.putImageData(image, 0, 0);
    this.draw();
  }

  /** Calls `selected` when the pointer or the arrow keys select another pixel. */
  onSelect(selected: (column: number, row: number) => void): void {
    const choose = (column: number, row: number) => {
      if (this.selected?.[0] === column && this.selected[1] === row) return;
      this.select(column, row);
      selected(...this.selected!);
    };
    this.canvas.tabIndex = 0;
    this.canvas.role = "application";
    this.canvas.ariaRoleDescription = "picture whose pixels the arrow keys select";
    const point = (event: PointerEvent) => {
      const box = this.canvas.getBoundingClientRect();
      const x = (event.clientX - box.left) / box.width;
      const y = (box.bottom - event.clientY) / box.height;
      choose(Math.floor(x * this.columns), Math.floor(y * this.rows));
    };
    this.canvas.addEventListener("pointerdown", point);
    this.canvas.addEventListener("pointermove", point);
    this.canvas.addEventListener("keydown", (event) => {
      const step = arrows[event.key];
      if (!step) return;
      event.preventDefault();
      const [column, row] = this.selected ?? [0, 0];
      choose(column + step[0], row + step[1]);
    });
  }

  /** Clamps to the picture. */
  select(column: number, row: number): void {
    const clamp = (value: number, count: number) => Math.min(count - 1, Math.max(0, value));
    this.selected = [clamp(column, this.columns), clamp(row, this.rows)];
    this.draw();
  }

  private resize(): void {
    const longer = Math.max(this.columns, this.rows);
    const scale = Math.max(1, Math.round((this.size * Math.min(2, devicePixelRatio)) / longer));
    this.canvas.width = this.columns * scale;
    this.canvas.height = this.rows * scale;
    this.canvas.style.width = `${(this.size * this.columns) / longer}px`;
    this.picture.width = this.columns;
    this.picture.height = this.rows;
  }

  private draw(): void {
    const {width, height} = this.canvas;
    const context = this.canvas.getContext("2d")!;
    context.imageSmoothingEnabled = false;
    context.drawImage(this.picture, 0, 0, width, height);
    if (!this.selected) return;
    const scale = width / this.columns;
    const side = Math.max(scale, 7); // also a small pixel has a frame that can be seen
    const x = (this.selected[0] + 0.5) * scale - side / 2;
    const y = (this.rows - this.selected[1] - 0.5) * scale - side / 2;
    for (const [colour, inset] of [["white", 0.5], ["black", 1.5]] as const) {
      context.strokeStyle = colour;
      context.strokeRect(x + inset, y + inset, side - 2 * inset, side - 2 * inset);
    }
  }
}

const arrows: Record<string, [number, number] | undefined> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowDown: [0, -1],
  ArrowUp: [0, 1],
};

/** RGBA in bytes: a colour of its own per item ID; the background is dark. */
export function idColours(ids: ArrayLike<number>, background: number): Uint8ClampedArray {
  const pixels = new Uint8ClampedArray(4 * ids.length);
  const known = new Map<number, Rgb>([[background, [0.1, 0.1, 0.12]]]);
  for (let i = 0; i < ids.length; ++i) {
    let rgb = known.get(ids[i]);
    if (!rgb) known.set(ids[i], (rgb = idColour(ids[i])));
    pixels.set([255 * rgb[0], 255 * rgb[1], 255 * rgb[2], 255], 4 * i);
  }
  return pixels;
}
