// Steps about the hemicube: how it stands in the room, what its pixels hold, and the row that they add up to.
import {element, status} from "../controls";
import type {HemicubeFace, Vec3} from "../core";
import {backgroundColour, cssColour, texelColour} from "../lessons/element_colours";
import {FoldedHemicube} from "../lessons/folded_hemicube";
import {unfoldedHemicube} from "../lessons/unfolded_hemicube";
import {PixelCanvas} from "../pixels";
import {SceneView} from "../scene_view";
import {drawing, label} from "./drawing";
import {roomOf, type Room} from "./room";
import type {Step} from "./step";
import {addHandle} from "./handle";

const resolution = 64;

/** The pixels of the cross, of which `isShown` says which are bright; the order is that of a sum over all faces. */
function crossColours(room: Room, isShown: (face: number, pixel: number) => boolean): Uint8ClampedArray {
  const cross = unfoldedHemicube(resolution),
    {faces} = room.hemicube(resolution);
  const colours = room.bytes();
  const pixels = new Uint8ClampedArray(4 * cross.length);
  cross.forEach((place, i) => {
    if (!place) return;
    const colour = colours[faces[place.face].elements[place.pixel]];
    const level = isShown(place.face, place.pixel) ? 1 : 0.25;
    pixels.set([...colour.slice(0, 3).map((value) => level * value), 255], 4 * i);
  });
  return pixels;
}

function crossPicture(parent: HTMLElement): PixelCanvas {
  const options = {columns: 2 * resolution, rows: 2 * resolution, size: 320};
  return new PixelCanvas(parent, {label: "The five faces of the hemicube, unfolded", ...options});
}

/** The pixels of a face as a picture. */
function facePicture(room: Room, {elements, width, height}: HemicubeFace): HTMLCanvasElement {
  const picture = Object.assign(document.createElement("canvas"), {width, height});
  const image = new ImageData(width, height),
    colours = room.bytes();
  elements.forEach((shown, pixel) => {
    const line = height - 1 - Math.floor(pixel / width);
    image.data.set(colours[shown], 4 * (line * width + (pixel % width)));
  });
  picture.getContext("2d")!.putImageData(image, 0, 0);
  return picture;
}

/** The hemicube stands over its patch; its faces show what they see. */
function stand(view: SceneView, room: Room): void {
  const {faces} = room.hemicube(resolution);
  const vector = room.elements.vector(room.source, {resolution}).json();
  const size = room.scene.info().extent / 16;
  vector.faces.forEach(({eye = vector.eye, x, y, w}, k) => {
    const low = k === 0 ? -1 : 0;
    const corner = eye.map(
      (value, axis) => value + vector.origin[axis] + size * (w[axis] - x[axis] + low * y[axis]),
    ) as Vec3;
    const along = (axis: Vec3, times: number) => axis.map((value) => times * size * value) as Vec3;
    view.addPicture(facePicture(room, faces[k]), corner, along(x, 2), along(y, k === 0 ? 2 : 1));
  });
}

export const hemicube: Step = {
  name: "hemicube",
  title: "Half a cube instead of half a sphere",
  text: `A graphics card draws onto planes, not onto spheres. So Cohen and Greenberg (1985) put half a cube over the
    patch: a top face and four sides of half the height. The card draws the room five times, once for each face, as a
    camera in the middle of the patch sees it. Nearer surfaces hide farther ones, as in any picture. On the left the
    cube stands in the room, over its patch. On the right you look into it from below: unfold it.`,
  paper: "section 3.1, after Cohen and Greenberg 1985",
  source: "radiosity/projection/projection_kinds.cpp",
  figure(root, page) {
    const {scene} = page;
    const room = roomOf(scene);
    const both = element(root, "div", {className: "side-by-side"});
    const view = new SceneView(both, {label: "The room and the patch", scene, elements: room.elements});
    view.setColours(room.colours());
    view.mark([room.source]);
    stand(view, room);
    const box = element(both, "div", {className: "cross"});
    const picture = crossPicture(box);
    picture.show(crossColours(room, () => true));
    const folded = new FoldedHemicube(box);
    addHandle(
      root,
      page,
      "hemicube",
      {label: "Fold", range: {min: 0, max: 90, step: 5}, otherwise: 45, show: (d) => `${d}°`},
      (to) => folded.show(picture.canvas, to),
    );
    return () => view.dispose();
  },
  question(draw) {
    const r = 32 * draw(2, 9);
    return {
      text: `The top face has ${r} × ${r} pixels. How many pixels have all five faces together?`,
      answer: () => 3 * r * r,
      tolerance: 0,
      why: `The sides are half as high: ${r}² + 4 · ${r} · ${r / 2} = 3 · ${r}².`,
      whyNot: (value) => (value === 5 * r * r ? "The sides are half a cube: how high are they?" : undefined),
    };
  },
};

export const pixelNumber: Step = {
  name: "pixel-number",
  title: "A pixel needs a number",
  text: `The picture on the hemicube is for no eye. It answers one question: which element does each pixel show? So a
    pixel holds a number instead of a colour, the <em>item ID</em> of the element; the picture is an <em>item
    buffer</em>. Point at pixels, and read their numbers. The usual way before 2002 was to cut each surface into
    polygons, one for each element, and to draw each in a colour of its own. A wall of a thousand elements then has a
    thousand polygons.`,
  paper: "section 3",
  source: "raster/interface/item_id.h",
  figure(root, {scene, state}) {
    const room = roomOf(scene),
      columns = 32;
    const face = room.hemicube(columns).faces[0].elements;
    // As seen from below: columns of a face run to the left.
    const elements = face.map((_, pixel) => face[pixel - (pixel % columns) + columns - 1 - (pixel % columns)]);
    const colours = room.bytes();
    const picture = new PixelCanvas(root, {
      label: "The top face: a number per pixel",
      columns,
      rows: columns,
      size: 384,
    });
    picture.show(Uint8ClampedArray.from([...elements].flatMap((shown) => colours[shown])));
    const found = status(root, "pixel-number-shown");
    const point = (column: number, line: number) => {
      state.set("pixel-number", line * columns + column);
      const shown = elements[line * columns + column];
      const number = shown < 0 ? "no element" : `element ${shown}`;
      found.set(`Pixel (${column}, ${line}) holds the number of ${number}: ${room.nameOf(shown)}.`);
    };
    const start = state.number("pixel-number", 12 * columns + 20, {min: 0, max: columns * columns - 1, step: 1});
    picture.onSelect(point);
    picture.select(start % columns, Math.floor(start / columns));
    point(start % columns, Math.floor(start / columns));
  },
  question(draw) {
    const bits = draw(9, 12);
    return {
      text: `A pixel has ${bits} bits. How many elements can be told apart, if one number stands for the background?`,
      answer: () => 2 ** bits - 1,
      tolerance: 0,
      why: `${bits} bits have 2<sup>${bits}</sup> = ${2 ** bits} values.`,
      whyNot: (value) =>
        value === 2 ** bits ? "One of these numbers is taken: what does a pixel of the sky hold?" : undefined,
    };
  },
};

interface Bar {
  name: string;
  share: number;
  colour: string;
}

/** The sum of delta form factors of the first pixels, by surface. */
function partOfRow(room: Room, share: number): {bars: Bar[]; total: number; last: [face: number, pixel: number]} {
  const {faces} = room.hemicube(resolution);
  const sums = new Map<string, number>(room.names.map((name) => [name, 0]));
  const count = Math.round(share * 3 * resolution ** 2);
  let done = 0,
    total = 0;
  let last: [number, number] = [0, -1];
  faces.forEach(({elements, weights}, face) => {
    for (let pixel = 0; pixel < elements.length && done < count; ++pixel, ++done) {
      const shown = elements[pixel],
        name = shown >= 0 ? room.surfaceOf(shown) : "outside";
      sums.set(name, (sums.get(name) ?? 0) + weights[pixel]);
      total += weights[pixel];
      last = [face, pixel];
    }
  });
  const colour = (name: string) =>
    cssColour(name === "outside" ? backgroundColour : texelColour(room.hueOf(name), 1, 1, 0));
  const bars = [...sums]
    .filter(([, sum]) => sum > 0 || share === 1)
    .map(([name, sum]) => ({name, share: sum, colour: colour(name)}));
  return {bars, total, last};
}

export const row: Step = {
  name: "row",
  title: "Pixels add up to a row",
  text: `Each pixel stands for a fixed share of the light of the patch, its <em>delta form factor</em>: large in the
    middle of the top face, small in corners and near the horizon. It depends on the hemicube alone, and is computed
    once. Add the shares of all pixels that show an element: that is the form factor of this element. One pass over the
    item buffer gives the form factors to all elements, a whole <em>row</em> of the matrix. The shares of all pixels sum
    to 1: no light is lost.`,
  paper: "section 3.1",
  source: "radiosity/form_factors/item_buffer_sum.h",
  figure(root, page) {
    const {scene} = page;
    const room = roomOf(scene);
    const both = element(root, "div", {className: "side-by-side"});
    const picture = crossPicture(element(both, "div"));
    const show = drawing(element(both, "div"), "Form factors by surface", 300, 200);
    const found = status(root, "row-sum");
    const draw = (percent: number) => {
      const {bars, total, last} = partOfRow(room, percent / 100);
      picture.show(crossColours(room, (face, pixel) => face < last[0] || (face === last[0] && pixel <= last[1])));
      const height = Math.min(22, 190 / Math.max(1, bars.length));
      show(
        bars
          .map(
            ({name, share, colour}, k) =>
              `<rect x="100" y="${4 + height * k}" width="${190 * share}" height="${height - 4}" fill="${colour}"/>` +
              label([2, 4 + height * (k + 0.6)], `${name.slice(0, 13)}`, 'font-size="11"') +
              label([104 + 190 * share, 4 + height * (k + 0.6)], share.toFixed(3), 'font-size="11"'),
          )
          .join(""),
      );
      found.set(`${percent} % of the pixels carry ${total.toFixed(4)} of the light.`);
    };
    addHandle(
      root,
      page,
      "row",
      {label: "Pixels that are added", range: {min: 0, max: 100, step: 1}, otherwise: 40, show: (p) => `${p} %`},
      draw,
    );
  },
  question(draw) {
    const r = 64 * draw(1, 4);
    const middle = 4 / (Math.PI * r * r);
    return {
      text: `ΔF = ΔA / (π (x² + y² + 1)²) on the top face, which has side 2 and distance 1. What is ΔF of a pixel in the
        middle for R = ${r}, in millionths?`,
      answer: () => 1e6 * middle,
      tolerance: 0.01e6 * middle,
      why: `In the middle x = y = 0, and a pixel has ΔA = (2 / ${r})².`,
      whyNot: (value) =>
        Math.abs(value - 1e6 * middle * Math.PI) < 1e4 * middle * Math.PI
          ? "The π is missing."
          : Math.abs(value - (1e6 * middle) / 4) < 2.5e3 * middle
            ? "The face goes from −1 to 1: a pixel has the side 2 / R."
            : undefined,
    };
  },
};
