// Steps about cost: triangles by texture and by mesh, and the error of a hemicube over its resolution.
import {status} from "../controls";
import type {Scene} from "../core";
import {shortNumber, sum} from "../numbers";
import {Plot, type Point} from "../plot";
import {factorFromPoint, type Point3} from "./drawing";
import type {Step, StoryPage} from "./step";
import {addHandle} from "./handle";

const powers = {min: 0, max: 6, step: 1}; // 1 to 64 elements along a side
const ways = ["texture", "mesh"] as const;

/** Elements, and the triangles that draw them by texture and as polygons. */
function trianglesOf(scene: Scene, power: number): {count: number; triangles: number[]} {
  const elements = scene.discretize({texels: 2 ** power});
  const triangles = ways.map((way) => elements.timeOfHemicube(0, {resolution: 16, elements: way}, 1).triangles);
  return {count: elements.info().elements, triangles};
}

export const mesh: Step = {
  name: "mesh",
  title: "Texture against mesh",
  text: `Divide the surfaces further: 1, 4, 16, ... elements for each. A mesh of polygons grows with them, and each
    polygon has to be transformed and drawn, five times for every hemicube. With an index map the card draws the same
    few triangles, and only the texture gets finer. So the time of a hemicube depends on its pixels and on the triangles
    of the room, but not on the number of elements: a hundred cost the same as a million.`,
  paper: "sections 3.1 and 4",
  source: "radiosity/index_maps/scene_draw_list.cpp",
  figure(root, page) {
    const {scene} = page;
    const plot = new Plot(root, {
      label: "Triangles over elements",
      x: "elements",
      y: "triangles",
      logarithmicX: true,
      logarithmicY: true,
    });
    const found = status(root, "mesh-triangles");
    const known: {count: number; triangles: number[]}[] = [];
    const draw = (power: number) => {
      while (known.length <= power) known.push(trianglesOf(scene, known.length));
      const {count, triangles} = known[power];
      plot.set([
        ...ways.map((name, way) => ({
          name,
          points: known.slice(0, power + 1).map((one): Point => [one.count, one.triangles[way]]),
        })),
        {name: "shown", points: ways.map((_, way): Point => [count, triangles[way]]), isMarked: true},
      ]);
      found.set(`${count} elements: ${triangles[0]} triangles by texture, ${triangles[1]} by mesh.`);
    };
    addHandle(
      root,
      page,
      "mesh",
      {label: "Elements per surface", range: powers, otherwise: 3, show: (p) => `${2 ** p} × ${2 ** p}`},
      draw,
    );
    return () => plot.dispose();
  },
  question(draw) {
    const surfaces = draw(6, 20),
      side = 2 ** draw(5, 8);
    return {
      text: `A room has ${surfaces} rectangles with ${side} × ${side} elements each. How many triangles does a mesh of
        squares have, two for each element?`,
      answer: () => 2 * surfaces * side * side,
      tolerance: 0,
      why: `${surfaces} · ${side}² · 2. With index maps it has ${2 * surfaces}.`,
      whyNot: (value) =>
        value === surfaces * side * side
          ? "These are the elements. A card draws triangles."
          : value === 2 * surfaces
            ? "That is what the texture needs."
            : undefined,
    };
  },
};

// Two unit squares face each other at distance 1.
const squaresText = `v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
g low
f 1 2 3 4
g high
f 8 7 6 5
`;
const texels = 8;
const resolutions = {min: 2, max: 9, step: 1}; // powers of two

/** The mean of the closed form over the middles of the elements of the lower square. */
function factorBetweenSquares(texels: number): number {
  const high: Point3[] = [
    [0, 0, 1],
    [1, 0, 1],
    [1, 1, 1],
    [0, 1, 1],
  ];
  const middles = Array.from({length: texels ** 2}, (_, k): Point3 => [
    ((k % texels) + 0.5) / texels,
    (Math.floor(k / texels) + 0.5) / texels,
    0,
  ]);
  return sum(middles.map((eye) => factorFromPoint(eye, high))) / middles.length;
}

interface Tried {
  resolution: number;
  error: number;
  milliseconds: number;
}

/** The form factor from one square to the other by hemicubes, less the closed form. */
function errorsOfSquares({core}: StoryPage): Tried[] {
  const elements = core.loadScene({"squares.obj": squaresText}, "squares.obj").discretize({texels, patch: 1});
  const truth = factorBetweenSquares(texels),
    {first_element, element_count} = elements.info().surfaces[1];
  return Array.from({length: resolutions.max - resolutions.min + 1}, (_, k) => {
    const resolution = 2 ** (resolutions.min + k);
    const row = elements.row({surface: "low"}, {resolution, rotated: false, split: 1});
    const found = sum(row.formFactors.subarray(first_element, first_element + element_count));
    return {resolution, error: Math.abs(found - truth) / truth, milliseconds: row.milliseconds};
  });
}

export const accuracy: Step = {
  name: "accuracy",
  title: "What accuracy costs",
  text: `A pixel belongs wholly to one element, so that borders between elements are rough, and so are the sums. Finer
    hemicubes have more pixels and smaller errors, and take longer. For two opposite squares a formula is known, and the
    figure shows how far hemicubes are from it. Twice the resolution is four times the pixels. The error falls, but not
    evenly: where pixels meet borders is a matter of luck. A program that knows its errors can spend its time where it
    counts.`,
  paper: "section 4",
  source: "docs/accuracy.md",
  figure(root, page) {
    const tried = errorsOfSquares(page);
    const plot = new Plot(root, {
      label: "Error over resolution",
      x: "resolution R",
      y: "relative error",
      logarithmicX: true,
      logarithmicY: true,
    });
    const found = status(root, "accuracy-error");
    const draw = (power: number) => {
      const {resolution, error, milliseconds} = tried[power - resolutions.min];
      const points = tried.map((one): Point => [one.resolution, one.error]);
      plot.set([
        {name: "error", points},
        {name: "shown", points: [[resolution, error]], isMarked: true},
      ]);
      found.set(
        `R = ${resolution}: ${shortNumber(100 * error)} % wrong, ${shortNumber(milliseconds)} ms for 64 hemicubes.`,
      );
    };
    addHandle(
      root,
      page,
      "accuracy",
      {label: "Resolution R", range: resolutions, otherwise: 5, show: (p) => String(2 ** p)},
      draw,
    );
    return () => plot.dispose();
  },
  question(draw) {
    const times = 2 ** draw(1, 3);
    return {
      text: `The resolution R becomes ${times} times as large. How many times as many pixels are filled?`,
      answer: () => times ** 2,
      tolerance: 0,
      why: "R counts columns and rows.",
      whyNot: (value) => (value === times ? "That is one row of pixels." : undefined),
    };
  },
};
