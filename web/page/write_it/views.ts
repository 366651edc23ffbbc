// What the student's rasterizer gets: a face of a test vector after the vertex stage.
import {isMirrored, viewTriangles} from "../../device/geometry.js";
import type {Vector, VectorArrays, VectorDraw, VectorFace, VectorJson} from "../core";

interface Corner {
  x: number; // to the right
  y: number; // up
  w: number; // forward
  u: number;
  v: number;
}

export interface View {
  column: number; // of the first pixel in the viewport
  row: number;
  width: number; // in pixels
  height: number;
  resolution: number; // of the viewport
  near: number;
  mirrored: boolean;
  background: number;
  blend: VectorJson["blend"];
  channels: {unit: number; size: number}[]; // channel = floor(id / unit) modulo size
  triangles: {
    corners: Corner[];
    offset: number;
    back: number | null;
    map: {width: number; height: number; ids: Uint32Array} | null;
  }[];
}

/** The views of all faces. */
export function viewsOf(vector: Vector): View[] {
  const json = vector.json();
  const arrays = vector.arrays();
  return json.faces.map((face) => viewOf(json, face, arrays));
}

function viewOf(vector: VectorJson, face: VectorFace, arrays: VectorArrays): View {
  const [column, row, width, height] = face.scissor;
  const {resolution, background, blend} = vector;
  return {
    ...{column, row, width, height, resolution, background, blend},
    near: Math.fround(vector.near),
    mirrored: isMirrored(face),
    channels: channelsOf(vector.channels),
    triangles: vector.draws.flatMap((draw) => trianglesOf(vector, draw, face, arrays)),
  };
}

function channelsOf(bits: number[]): View["channels"] {
  let unit = 1;
  return bits.map((count) => {
    const channel = {unit, size: 2 ** count};
    unit *= channel.size;
    return channel;
  });
}

function trianglesOf(
  vector: VectorJson,
  draw: VectorDraw,
  face: VectorFace,
  arrays: VectorArrays,
): View["triangles"] {
  const {offset, back = null, index_map, width = 0, height = 0} = draw;
  const map = index_map ? {width, height, ids: arrays.maps[index_map]} : null;
  return viewTriangles(vector, draw, face, arrays).map((triangle) => ({
    corners: triangle.corners.map(([x, y, w, u, v]) => ({x, y, w, u, v})),
    ...{offset, back, map},
  }));
}
