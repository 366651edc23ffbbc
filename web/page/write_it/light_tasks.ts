// Judges the functions after the rasterizer: delta form factors, a row, shots, refinement and the texture.
import type {Elements, Scene} from "../core";
import {largestSize, sum} from "../numbers";
import {CodeError, type Sandbox} from "./sandbox";
import {viewsOf, type View} from "./views";

/** What is wrong first; nothing if all is right. */
export type LightTask = (sandbox: Sandbox, room: StudentRoom) => Promise<Finding>;

export interface Finding {
  wrong?: string;
  /** The light of the elements by the student and by the core, three numbers per element. */
  light?: {own: Float64Array; right: Float64Array};
}

/** What the student's functions get: one number per element, for one band. */
export interface StudentElements {
  area: number[];
  reflectance: number[];
  emission: number[];
  radiosity: number[];
  unshot: number[]; // radiosity that was not shot yet
}

const texels = 4;
const resolution = 24;
export const residual = 0.05;

/** The Cornell box in few elements. */
export class StudentRoom {
  readonly elements: Elements;
  readonly count: number;
  private rowsOfCore: Float64Array[] | undefined;

  constructor(readonly scene: Scene) {
    this.elements = scene.discretize({texels, patch: 1});
    this.count = this.elements.info().elements;
  }

  /** For red, green or blue. Scaled so that areas are near 1. */
  band(band: number): StudentElements {
    const area = this.elements.areas(),
      largest = largestSize(area);
    const of = (key: "reflectance" | "emission") =>
      this.elements.info().surfaces.flatMap((surface) => Array<number>(surface.element_count).fill(surface[key][band]));
    const emission = of("emission");
    return {
      area: Array.from(area, (value) => value / largest),
      ...{reflectance: of("reflectance"), emission, radiosity: [...emission], unshot: [...emission]},
    };
  }

  /** Form factors from each element to all. */
  rows(): Float64Array[] {
    return (this.rowsOfCore ??= Array.from(
      {length: this.count},
      (_, element) => this.elements.hemicube(element, {resolution}).formFactors,
    ));
  }

  /** Five views of each element, and how item IDs give elements. */
  forDrawing(): {views: View[][]; indexBits: number; tables: Record<number, number[]>} {
    const views = Array.from({length: this.count}, (_, element) =>
      viewsOf(this.elements.vector(element, {resolution})),
    );
    const {index_bits: indexBits, pages} = this.elements.ids({});
    const tables = Object.fromEntries(
      pages.map(({offset}, surface): [number, number[]] => [
        Math.floor(offset / 2 ** indexBits),
        Array.from(this.elements.geometry(surface).elementOfTexel, (element) => (element < this.count ? element : -1)),
      ]),
    );
    return {views, indexBits, tables};
  }
}

const near = (found: number, right: number, tolerance: number) =>
  Math.abs(found - right) <= tolerance * Math.max(1e-12, Math.abs(right));

function numbers(value: unknown, count: number, what: string): number[] {
  const isList = Array.isArray(value) || ArrayBuffer.isView(value);
  const list = isList ? Array.from(value as ArrayLike<number>) : [];
  if (list.length !== count || list.some((one) => typeof one !== "number" || !Number.isFinite(one)))
    throw new CodeError(`${what} must return ${count} finite numbers`, null);
  return list;
}

/** The first number that is not near to the right one, in words. */
function firstWrong(
  found: number[],
  right: ArrayLike<number>,
  tolerance: number,
  name: (k: number) => string,
): Finding {
  const k = found.findIndex((value, i) => !near(value, right[i], tolerance));
  if (k < 0) return {};
  return {wrong: `${name(k)} is ${found[k].toPrecision(4)}, and should be ${right[k].toPrecision(4)}`};
}

/** Delta form factors of the top face and of a side. */
export const sharesTask: LightTask = async (sandbox, {elements}) => {
  for (const r of [8, 32])
    for (const isSide of [false, true]) {
      const {weights} = elements.hemicube(0, {resolution: r}).faces[isSide ? 1 : 0];
      const [answer] = await sandbox.call("pixelShares", [[r, isSide]]);
      const found = numbers(answer, weights.length, "pixelShares");
      const place = (k: number) =>
        `R = ${r}, ${isSide ? "side" : "top"}, pixel (${k % r}, ${Math.floor(k / r)}): the share`;
      const finding = firstWrong(found, weights, 2 / r, place); // the core integrates over the pixel
      if (finding.wrong) return finding;
    }
  return {};
};

/** A row of a few pixels, and one of the room. */
export const rowTask: LightTask = async (sandbox, room) => {
  const small = {shares: [[0.5, 0.25, 0.125, 0.0625]], ids: [[2, -1, 2, 0]]};
  const {faces, formFactors} = room.elements.hemicube(0, {resolution});
  const whole = {
    shares: faces.map(({weights}) => Array.from(weights)),
    ids: faces.map((face) => Array.from(face.elements)),
  };
  const calls: [typeof small, number, ArrayLike<number>][] = [
    [small, 3, [0.0625, 0, 0.625]],
    [whole, room.count, formFactors],
  ];
  for (const [{ids, shares}, count, right] of calls) {
    const [answer] = await sandbox.call("row", [[ids, shares, count]]);
    const found = numbers(answer, count, "row");
    const finding = firstWrong(found, right, 1e-9, (k) => `with ${count} elements, the form factor to element ${k}`);
    if (finding.wrong) return finding;
  }
  return {};
};

/** A few elements whose light has to be shot: other numbers in each call. */
function someElements(seed: number): StudentElements {
  const number = (k: number) => 1 + ((7 * k + 3 * seed) % 5);
  const list = (of: (k: number) => number) => Array.from({length: 4}, (_, k) => of(k));
  return {
    area: list((k) => number(k + 1)),
    reflectance: list((k) => number(k) / 10),
    emission: list((k) => (k === seed % 4 ? 3 : 0)),
    radiosity: list((k) => number(k) + 2),
    unshot: list((k) => number(k + seed) / 2),
  };
}

const largestFlux = ({unshot, area}: StudentElements) =>
  unshot.reduce((best, one, k) => (one * area[k] > unshot[best] * area[best] ? k : best), 0);

export const brightestTask: LightTask = async (sandbox) => {
  for (let seed = 0; seed < 5; ++seed) {
    const elements = someElements(seed),
      right = largestFlux(elements);
    const [found] = await sandbox.call("brightest", [[elements]]);
    if (found !== right)
      return {
        wrong: `of unshot ${elements.unshot} and area ${elements.area} the brightest is element ${right}, not ${found}`,
      };
  }
  return {};
};

/** Element `source` shoots along its row. */
function shootRight(elements: StudentElements, source: number, row: ArrayLike<number>): void {
  const flux = elements.unshot[source] * elements.area[source];
  elements.unshot[source] = 0;
  for (let k = 0; k < elements.area.length; ++k) {
    const gain = (elements.reflectance[k] * row[k] * flux) / elements.area[k];
    elements.radiosity[k] += gain;
    elements.unshot[k] += gain;
  }
}

export const shootTask: LightTask = async (sandbox) => {
  for (let seed = 0; seed < 4; ++seed) {
    const elements = someElements(seed),
      row = [0, 0.3, 0.2, 0.4].map((_, k, all) => all[(k + 4 - seed) % 4]);
    const right = structuredClone(elements);
    shootRight(right, seed, row);
    const [answer] = await sandbox.call("shoot", [[elements, seed, row]], {returns: 0});
    const found = answer as StudentElements;
    for (const key of ["radiosity", "unshot"] as const) {
      const finding = firstWrong(
        numbers(found[key], 4, "shoot"),
        right[key],
        1e-9,
        (k) => `after element ${seed} has shot, ${key} of element ${k}`,
      );
      if (finding.wrong) return finding;
    }
  }
  return {};
};

/** The radiosity when nothing is unshot, by iteration. */
function solved(elements: StudentElements, rows: Float64Array[]): number[] {
  let radiosity = [...elements.emission];
  for (let round = 0; round < 200; ++round) {
    const received = Array<number>(radiosity.length).fill(0);
    rows.forEach((row, i) => row.forEach((factor, k) => (received[k] += factor * radiosity[i] * elements.area[i])));
    radiosity = elements.emission.map((own, k) => own + (elements.reflectance[k] * received[k]) / elements.area[k]);
  }
  return radiosity;
}

const fluxOf = (values: number[], area: number[]) => sum(values.map((value, k) => Math.abs(value) * area[k]));

/** How far a solution with this residual may be from the end: what is unshot is reflected on and on. */
function judgeLight(
  found: number[],
  {area, emission, reflectance}: StudentElements,
  right: number[],
  left: number,
): Finding {
  const missing =
    fluxOf(
      right.map((value, k) => value - found[k]),
      area,
    ) / fluxOf(emission, area);
  const most = left / (1 - Math.max(...reflectance));
  if (missing <= most + 0.001) return {};
  const k = right.reduce(
    (worst, _, i) => (Math.abs(right[i] - found[i]) > Math.abs(right[worst] - found[worst]) ? i : worst),
    0,
  );
  return {
    wrong:
      `the light is wrong by ${(100 * missing).toFixed(1)} % of the lamp's; most in element ${k}: ` +
      `${found[k].toPrecision(3)} for ${right[k].toPrecision(3)}`,
  };
}

export const refineTask: LightTask = async (sandbox, room) => {
  const elements = room.band(0),
    right = solved(elements, room.rows());
  const [answer] = await sandbox.call("refine", [[elements, room.rows().map((row) => Array.from(row)), residual]], {
    returns: 0,
    rows: 1,
  });
  const found = answer as StudentElements;
  const radiosity = numbers(found.radiosity, room.count, "refine"),
    unshot = numbers(found.unshot, room.count, "refine");
  const left = fluxOf(unshot, found.area) / fluxOf(elements.emission, elements.area);
  if (left > residual)
    return {
      wrong: `${(100 * left).toFixed(1)} % of the light is unshot; refine until it is at most ${100 * residual} %`,
    };
  if (left < residual / 20)
    return {wrong: `only ${(100 * left).toFixed(3)} % is unshot: end as soon as it is at most ${100 * residual} %`};
  return judgeLight(radiosity, elements, right, residual);
};

export const ambientTask: LightTask = async (sandbox) => {
  for (let seed = 0; seed < 4; ++seed) {
    const elements = someElements(seed),
      {area, reflectance, unshot} = elements;
    const right =
      sum(unshot.map((value, k) => value * area[k])) / sum(area.map((value, k) => value * (1 - reflectance[k])));
    const [found] = await sandbox.call("ambient", [[elements]]);
    if (typeof found !== "number" || !near(found, right, 1e-9))
      return {wrong: `the estimate is ${found}, and should be ${right.toPrecision(5)}`};
  }
  return {};
};

const textureValues = [4, 8, 2, 10, 6, 12];

/** Between the centres of texels, linear; beyond the outermost ones their values. */
function filteredRight(u: number, v: number): number {
  const clamp = (value: number, size: number) => Math.min(size - 1, Math.max(0, value));
  const [x, y] = [clamp(3 * u - 0.5, 3), clamp(2 * v - 0.5, 2)];
  const [left, low] = [Math.min(1, Math.floor(x)), 0];
  const at = (column: number, row: number) => textureValues[3 * row + column];
  const mix = (a: number, b: number, t: number) => a + t * (b - a);
  const rowAt = (row: number) => mix(at(left, row), at(left + 1, row), x - left);
  return mix(rowAt(low), rowAt(low + 1), y - low);
}

export const textureTask: LightTask = async (sandbox) => {
  const places: [number, number][] = [
    [0.5, 0.5],
    [0.3, 0.4],
    [0.62, 0.7],
    [1 / 6, 1 / 4],
    [0.02, 0.6],
    [0.98, 0.03],
    [0.4, 1],
  ];
  const texture = {width: 3, height: 2, values: textureValues};
  const found = await sandbox.call(
    "filtered",
    places.map(([u, v]) => [texture, u, v]),
  );
  return firstWrong(
    numbers(found, places.length, "filtered"),
    places.map(([u, v]) => filteredRight(u, v)),
    1e-9,
    (k) => `at u = ${places[k][0].toFixed(2)}, v = ${places[k][1].toFixed(2)} the texture`,
  );
};

/** All together: item buffers by draw, rows, refinement; red, green and blue. */
export const wholeTask: LightTask = async (sandbox, room) => {
  const drawing = room.forDrawing(),
    own = new Float64Array(3 * room.count),
    right = new Float64Array(3 * room.count);
  for (let band = 0; band < 3; ++band) {
    const elements = room.band(band),
      exact = solved(elements, room.rows());
    const [answer] = await sandbox.call("light", [[elements, drawing, residual]]);
    const found = numbers(answer, room.count, "light");
    found.forEach((value, k) => (own[3 * k + band] = value));
    exact.forEach((value, k) => (right[3 * k + band] = value));
    const finding = judgeLight(found, elements, exact, 1.2 * residual);
    if (finding.wrong) return {...finding, light: {own, right}};
  }
  return {light: {own, right}};
};
