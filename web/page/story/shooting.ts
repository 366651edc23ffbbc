// Steps about light: shots, and the texture that shows radiosity on a wall.
import {encodeSrgb, exposureOf, litColours} from "../colours";
import {element, status} from "../controls";
import type {Scene, Solution} from "../core";
import {sum} from "../numbers";
import {SceneView} from "../scene_view";
import type {Step} from "./step";
import {addHandle} from "./handle";

const lastShot = 120;
const shownShots = [...Array(20).keys(), ...Array.from({length: 20}, (_, k) => 20 + 5 * k), lastShot];

interface Shots {
  solution: Solution;
  radiosity: Float64Array[]; // for each number of shownShots
  unshot: number[]; // over emitted flux
}

/** The light of a scene after each of shownShots. */
function shootAll(scene: Scene): Shots {
  const elements = scene.discretize({texel_size: scene.info().extent / 24, patch: 4, editable: true});
  const solution = elements.solve({resolution: 128, split: 0.2, residual: 1e-6, shots: 0, editable: true});
  const shots: Shots = {solution, radiosity: [], unshot: []};
  let done = 0;
  for (const count of shownShots) {
    if (count > done) solution.shoot(count - done);
    done = count;
    shots.radiosity.push(solution.radiosity());
    shots.unshot.push(solution.info().residual);
  }
  return shots;
}

export const shot: Step = {
  name: "shot",
  title: "Shooting",
  text: `<em>Radiosity</em> B is the light that leaves an element per area. Take the patch with the most unshot flux Φ,
    at first the lamp; draw one hemicube over it, and give each element j its share. It reflects the part ρ of what it
    gets, and this part is unshot in turn:
    <math display="block"><mi>Δ</mi><msub><mi>B</mi><mi>j</mi></msub><mo>=</mo><msub><mi>ρ</mi><mi>j</mi></msub>
    <msub><mi>F</mi><mrow><mi>i</mi><mi>j</mi></mrow></msub><msub><mi>Φ</mi><mi>i</mi></msub><mo>/</mo>
    <msub><mi>A</mi><mi>j</mi></msub></math>
    Then take the next patch (Cohen, Chen, Wallace and Greenberg 1988). After each shot there is a picture, and the
    first shots bring most of the light.`,
  paper: "section 3",
  source: "radiosity/solver/progressive_solver.cpp",
  figure(root, page) {
    const {scene} = page;
    const shots = shootAll(scene);
    const view = new SceneView(root, {label: "The room, lit shot by shot", scene, elements: shots.solution.elements()});
    const found = status(root, "shot-unshot");
    const exposure = exposureOf(shots.radiosity.at(-1)!);
    const draw = (k: number) => {
      view.setColours(litColours(shots.radiosity[k], exposure));
      found.set(`After ${shownShots[k]} shots ${(100 * shots.unshot[k]).toFixed(1)} % of the light is unshot.`);
    };
    addHandle(
      root,
      page,
      "shot",
      {
        label: "Shots",
        range: {min: 0, max: shownShots.length - 1, step: 1},
        otherwise: 16,
        show: (k) => String(shownShots[k]),
      },
      draw,
    );
    return () => view.dispose();
  },
  question(draw) {
    const flux = 10 * draw(2, 9),
      reflectance = draw(3, 7) / 10,
      share = draw(1, 4) / 10;
    return {
      text: `A patch shoots ${flux} W. An element with F = ${share}, ρ = ${reflectance} and an area of 2 m² receives its
        share. By how many W/m² does its radiosity grow?`,
      answer: () => (reflectance * share * flux) / 2,
      tolerance: 0.0051 * reflectance * share * flux,
      why: `${reflectance} · ${share} · ${flux} W / 2 m².`,
      whyNot: (value) =>
        Math.abs(value - reflectance * share * flux) < 1e-6
          ? "That is flux in W. Radiosity is flux per area."
          : Math.abs(value - (share * flux) / 2) < 1e-6
            ? "That arrives. What leaves it again?"
            : undefined,
    };
  },
};

const powers = {min: 1, max: 5, step: 1}; // 2 to 32 texels along a side

/** The radiosity of a surface as RGBA, row 0 at the top. */
function textureOf(scene: Scene, surfaceName: string, texels: number): ImageData {
  const elements = scene.discretize({texels});
  const radiosity = elements.solve({resolution: 64, split: 1, residual: 0.02}).radiosity();
  const {surfaces} = elements.info();
  const surface = surfaces.findIndex(({name}) => name === surfaceName);
  const {columns, rows, first_element, element_count} = surfaces[surface];
  const exposure = exposureOf(radiosity.subarray(3 * first_element, 3 * (first_element + element_count))) * 1.6;
  const image = new ImageData(columns, rows);
  elements.geometry(surface).elementOfTexel.forEach((element, texel) => {
    const at = 4 * ((rows - 1 - Math.floor(texel / columns)) * columns + (texel % columns));
    const value = (band: number) =>
      element === 0xffffffff ? 0 : 255 * encodeSrgb(exposure * radiosity[3 * element + band]);
    image.data.set([value(0), value(1), value(2), 255], at);
  });
  return image;
}

/** The wall at the back, or the surface with the most area that emits nothing. */
function wallOf(scene: Scene): string {
  const {surfaces} = scene.info();
  if (surfaces.some(({name}) => name === "wall-back")) return "wall-back";
  const elements = scene.discretize({texels: 1});
  const areas = elements.areas(),
    {surfaces: parts} = elements.info();
  const dark = parts.filter(({emission}) => sum(emission) === 0);
  return (dark.length ? dark : parts).reduce((best, one) =>
    areas[one.first_element] > areas[best.first_element] ? one : best,
  ).name;
}

export const texture: Step = {
  name: "texture",
  title: "The wall shows a texture",
  text: `At the end each element has a radiosity. How do we look at it? As before: with a texture. Write the radiosity of
    each element into its texel, and draw the undivided wall with it. On the left the card takes the nearest texel, and
    elements show as squares. On the right it <em>filters</em>: between the centres of texels it goes smoothly from one
    to the next. The same table of texels serves twice: with numbers to find the form factors, with light for the
    picture. Nothing is ever cut into a mesh.`,
  paper: "section 3.3",
  source: "radiosity/textures/radiosity_texture.h",
  figure(root, page) {
    const {scene} = page;
    const wall = wallOf(scene),
      known = new Map<number, ImageData>();
    const both = element(root, "div", {className: "side-by-side"});
    const canvases = ["nearest texel", "filtered"].map((name) => {
      const figure = element(both, "figure");
      const canvas = element(figure, "canvas", {width: 288, height: 288, role: "img", ariaLabel: `${wall}: ${name}`});
      element(figure, "figcaption", {textContent: name});
      return canvas;
    });
    const small = document.createElement("canvas");
    const draw = (power: number) => {
      const image = known.get(power) ?? textureOf(scene, wall, 2 ** power);
      known.set(power, image);
      Object.assign(small, {width: image.width, height: image.height});
      small.getContext("2d")!.putImageData(image, 0, 0);
      canvases.forEach((canvas, k) => {
        const context = canvas.getContext("2d")!;
        context.imageSmoothingEnabled = k === 1;
        context.drawImage(small, 0, 0, canvas.width, canvas.height);
      });
    };
    addHandle(
      root,
      page,
      "texture",
      {label: "Texels", range: powers, otherwise: 4, show: (power) => `${2 ** power} × ${2 ** power}`},
      draw,
    );
  },
  question(draw) {
    const [first, second] = [10 * draw(1, 4), 10 * draw(5, 9)];
    return {
      text: `Two neighbouring texels have the radiosity ${first} and ${second}. What shows a filtered texture a quarter
        of the way from the centre of the first to that of the second?`,
      answer: () => first + (second - first) / 4,
      tolerance: 0.01,
      why: `3/4 of ${first} and 1/4 of ${second}.`,
      whyNot: (value) =>
        value === first
          ? "That is the nearest texel, without a filter."
          : value === (first + second) / 2
            ? "That is half of the way."
            : undefined,
    };
  },
};
