// The unfolded hemicube, folded to half a cube and seen from inside.
import {element} from "../controls";

// `box`: left and top edge, width and height of a face, in quarters of the cross. Each side turns about the edge that
// it shares with the top face.
const faces = [
  {box: [1, 1, 2, 2], origin: "center", axis: "", sign: 0},
  {box: [0, 1, 1, 2], origin: "right", axis: "Y", sign: 1},
  {box: [1, 0, 2, 1], origin: "bottom", axis: "X", sign: -1},
  {box: [3, 1, 1, 2], origin: "left", axis: "Y", sign: -1},
  {box: [1, 3, 2, 1], origin: "top", axis: "X", sign: 1},
] as const;

export class FoldedHemicube {
  private readonly view: HTMLElement;
  private readonly cube: HTMLElement;
  private readonly canvases: HTMLCanvasElement[];

  /** Covers `parent`, which has the size of the cross. */
  constructor(parent: HTMLElement) {
    this.view = element(parent, "div", {role: "img", ariaLabel: "The hemicube, folded"});
    this.view.style.cssText = "position: absolute; inset: 0; perspective: 700px; pointer-events: none";
    this.cube = element(this.view, "div");
    this.cube.style.cssText = "position: absolute; inset: 0; transform-style: preserve-3d";
    this.canvases = faces.map(({box: [left, top, width, height], origin}) => {
      const canvas = element(this.cube, "canvas");
      canvas.style.cssText = `position: absolute; left: ${25 * left}%; top: ${25 * top}%; width: ${25 * width}%;
        height: ${25 * height}%; transform-origin: ${origin}; image-rendering: pixelated`;
      return canvas;
    });
  }

  /** `degrees`: 0 to 90, between the sides and the plane of the top face. At 0 it is not visible. */
  show(cross: HTMLCanvasElement, degrees: number): void {
    this.view.hidden = degrees === 0;
    cross.style.visibility = degrees === 0 ? "" : "hidden";
    // Tilted, so that two sides show their inside, and smaller, because raised sides are nearer and must cover no text.
    const tilt = degrees / 5;
    const scale = 1 - 0.25 * Math.sin((Math.PI * degrees) / 180);
    this.cube.style.transform = `scale(${scale}) rotateX(${-tilt}deg) rotateY(${tilt}deg)`;
    const quarter = cross.width / 4;
    faces.forEach(({box, axis, sign}, face) => {
      const canvas = this.canvases[face];
      const [left, top, width, height] = box.map((edge) => edge * quarter);
      Object.assign(canvas, {width, height});
      canvas.getContext("2d")!.drawImage(cross, left, top, width, height, 0, 0, width, height);
      if (axis) canvas.style.transform = `rotate${axis}(${sign * degrees}deg)`;
    });
  }
}
