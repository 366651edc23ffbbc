// Test vectors of a few triangles for the first steps, in pixels of a small picture.
import type {Core, Vector, VectorDraw} from "../core";

type Corner = [column: number, row: number];

type Triangle = [Corner, Corner, Corner];

interface Surface {
  triangles: Triangle[];
  back?: number;
}

const resolution = 12;
const squareMap = {index_map: "map.u32", width: 4, height: 3};

function bytes(numbers: Float32Array | Uint32Array): Uint8Array {
  return new Uint8Array(numbers.buffer);
}

/** Surfaces at distance 1, seen also in a mirror if they have backs. Offsets are multiples of 256. */
function smallVector(core: Core, name: string, surfaces: Surface[], hasMap = false): Vector {
  const points = surfaces.flatMap(({triangles}) => triangles.flat());
  const unit = (place: number) => (2 * place) / resolution - 1;
  let first = 0;
  const draws = surfaces.map(({triangles, back = null}, k): VectorDraw => {
    const count = 3 * triangles.length;
    first += count;
    return {first: first - count, count, offset: 256 * (k + 1), back, ...(hasMap ? squareMap : {})};
  });
  const face = (of: string, x: number) => ({
    ...{name: of, x: [x, 0, 0], y: [0, 1, 0], w: [0, 0, 1]},
    ...{scissor: [0, 0, resolution, resolution], words: `${of}.u32`, hash: ""},
  });
  const json = {
    ...{rules: 1, name, origin: [0, 0, 0], resolution, near: 0.5, eye: [0, 0, 0]},
    ...{channels: [8, 8, 8], blend: "clamped-add", background: 2 ** 24 - 1},
    ...{positions: "positions.f32", texcoords: "texcoords.f32", indices: "indices.u32", draws},
    faces: surfaces.some(({back}) => back) ? [face("front", 1), face("mirrored", -1)] : [face("front", 1)],
  };
  return core.readVector({
    "vector.json": JSON.stringify(json),
    "positions.f32": bytes(Float32Array.from(points.flatMap(([x, y]) => [unit(x), unit(y), 1]))),
    // From beyond one edge of the map to beyond the other
    "texcoords.f32": bytes(Float32Array.from(points.flatMap(([x, y]) => [(x - 2.3) / 7, (y - 1.2) / 9]))),
    "indices.u32": bytes(Uint32Array.from(points.keys())),
    "map.u32": bytes(Uint32Array.from(Array(12).keys())),
  });
}

function rectangle([left, low]: Corner, [right, high]: Corner): Surface {
  const corners: Corner[] = [[left, low], [right, low], [right, high], [left, high]];
  return {triangles: [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]};
}

/** Four triangles about a point, every second one wound the other way. */
function fan([left, low]: Corner, [right, high]: Corner, centre: Corner): Surface[] {
  const around: Corner[] = [[left, low], [right, low], [right, high], [left, high]];
  return around.map((corner, k) => {
    const next = around[(k + 1) % 4];
    return {triangles: [k % 2 ? [next, corner, centre] : [corner, next, centre]]};
  });
}

const first: Triangle = [[1.25, 1.125], [11, 3.375], [3.5, 8]];
const second: Triangle = [[11.5, 5.25], [10, 11.25], [4.75, 10]];
const reversed = ([a, b, c]: Triangle): Triangle => [a, c, b];
const single = (triangle: Triangle, back?: number): Surface => ({triangles: [triangle], back});

/**
 * Sheets that the near plane cuts. The cut lies on the centres of pixels, moved by half of 1/256 pixel: t from the wrong
 * end of an edge, which rounds otherwise, snaps some of these corners to another place. t is 1/n, not exact.
 */
function cutSheets(core: Core): Vector {
  const size = 16, near = 0.5;
  const sheets = Array.from({length: 6}, (_, k) => {
    const pixel = 2 * k + 3, cut = near * ((256 * pixel + 128.5) / (128 * size) - 1), t = [49, 98, 103, 107, 161, 187][k];
    const [low, high] = [-0.75 + 0.25 * k, -0.5 + 0.25 * k].map((y) => y * near);
    const front = cut + 1, back = cut - (t - 1); // on the near plane: cut
    const [frontDepth, backDepth] = [near + 1, near - (t - 1)];
    return [[front, low, frontDepth], [front, high, frontDepth], [back, high, backDepth], [back, low, backDepth]];
  });
  const corners = [0, 1, 2, 0, 2, 3];
  const draws = sheets.map((_, k): VectorDraw => ({first: 6 * k, count: 6, offset: 256 * (k + 1), back: null}));
  const face = {
    ...{name: "front", x: [1, 0, 0], y: [0, 1, 0], w: [0, 0, 1]},
    ...{scissor: [0, 0, size, size], words: "front.u32", hash: ""},
  };
  const json = {
    ...{rules: 1, name: "cut sheets", origin: [0, 0, 0], resolution: size, near, eye: [0, 0, 0], faces: [face], draws},
    ...{channels: [8, 8, 8], blend: "clamped-add", background: 2 ** 24 - 1},
    ...{positions: "positions.f32", texcoords: "texcoords.f32", indices: "indices.u32"},
  };
  return core.readVector({
    "vector.json": JSON.stringify(json),
    "positions.f32": bytes(Float32Array.from(sheets.flat(2))),
    "texcoords.f32": bytes(new Float32Array(8 * sheets.length)),
    "indices.u32": bytes(Uint32Array.from(sheets.flatMap((_, k) => corners.map((corner) => 4 * k + corner)))),
  });
}

/** By name. */
export function smallVectors(core: Core): Record<string, Vector> {
  const vectors = [
    smallVector(core, "two rectangles", [rectangle([1, 1], [6, 5]), rectangle([7, 4], [11, 11])]),
    smallVector(core, "two triangles", [single(first), single(second)]),
    smallVector(core, "two windings", [single(first), single(reversed(second))]),
    smallVector(core, "shared edges", fan([1.5, 1.5], [9.5, 9.5], [5.5, 5.5])),
    smallVector(core, "front and back", [single(first, 2 ** 24 - 2), single(reversed(second), 2 ** 24 - 3)]),
    smallVector(core, "map", [rectangle([1, 1], [11, 11])], true),
    cutSheets(core),
  ];
  return Object.fromEntries(vectors.map((vector) => [vector.name(), vector]));
}
