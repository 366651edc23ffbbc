// The vertex stage and the clipping of the raster rules, for the backends of browsers. Input is the object of
// vector.json and the arrays of a test vector (docs/backend.md). Output is a list of vertices that a device draws.
import {assembledTriangles} from "./assembly.js";
import {sizeOf, storesInverseDepth, viewportOf} from "./states.js";

const round = Math.fround;

// A corner in the view of the face, in binary32: [x, y, w, u, v, z]. In clip space the position has z and w.
function viewed({position, texcoord}, face, eye) {
  const [px, py, pz, pw] = position, place = pw === undefined ? [px, py, pz] : [px, py, pw];
  const d = place.map((p, k) => round(p - round(eye[k])));
  const dot = ([a, b, c]) => round(round(round(round(a) * d[0]) + round(round(b) * d[1])) + round(round(c) * d[2]));
  return [dot(face.x), dot(face.y), dot(face.w), ...texcoord, pz];
}

// The triangles of a draw in the view of the face, each with its corners [x, y, w, u, v, z] and its value. A triangle
// with a number that is not finite is left out.
export function viewTriangles(vector, draw, face, arrays) {
  return assembledTriangles(vector, draw, arrays)
      .map(({corners, value}) => ({corners: corners.map((c) => viewed(c, face, face.eye ?? vector.eye)), value}))
      .filter(({corners}) => corners.every((corner) => corner.every(Number.isFinite)));
}

// The planes that clip, as distances of a corner [x, y, w, u, v, z]: near plane, planes of z in clip space, guard band.
function planesOf(vector) {
  const near = round(vector.near), depths = {
    "zero-to-one": [(c) => c[5], (c) => c[2] - c[5]],
    "minus-one-to-one": [(c) => c[2] + c[5], (c) => c[2] - c[5]],
  };
  const sides = [(c) => 8 * c[2] - c[0], (c) => 8 * c[2] + c[0], (c) => 8 * c[2] - c[1], (c) => 8 * c[2] + c[1]];
  return [(c) => c[2] - near, ...depths[vector.clip_depth] ?? [], ...sides];
}

// The part of a polygon where `distance` is not negative. JavaScript computes in binary64.
function clip(polygon, distance) {
  return polygon.flatMap((from, k) => {
    const to = polygon[(k + 1) % polygon.length], a = distance(from), b = distance(to), kept = a >= 0 ? [from] : [];
    if (a >= 0 === b >= 0) return kept;
    const [inside, outside, f, g] = a >= 0 ? [from, to, a, b] : [to, from, b, a];
    return [...kept, inside.map((value, i) => value + f / (f - g) * (outside[i] - value))];
  });
}

// The corners of the triangles of a clipped triangle.
function clippedCorners(corners, planes) {
  const polygon = planes.reduce((part, plane) => part.some((c) => plane(c) < 0) ? clip(part, plane) : part, corners);
  return polygon.slice(2).flatMap((corner, k) => [polygon[0], polygon[k + 1], corner]);
}

// The z of a device with depths z/w from 0 to 1.
function deviceZ(vector, w, z) {
  if (storesInverseDepth(vector)) return round(vector.near);
  switch (vector.clip_depth) {
    case "zero-to-one": return z;
    case "minus-one-to-one": return (z + w) / 2;
    default: return w - round(vector.near);
  }
}

// Bytes of a vertex: x, y, z, w, u, v in binary32, and two words of its triangle's value.
export const vertexBytes = 32;

// The triangles of a face as vertices, and the first vertex and the number of vertices of each draw.
export function faceTriangles(vector, face, arrays) {
  const planes = planesOf(vector), vertices = [];
  const viewport = viewportOf(vector).slice(2), [scaleX, scaleY] = sizeOf(vector).map((size, k) => size / viewport[k]);
  // Samples at the corners of pixels are samples in the middle of a moved picture. Half a pixel is 1/columns of w.
  const [right, down] = viewport.map((pixels) => vector.sample === "corner" ? 1 / pixels : 0);
  const runs = vector.draws.map((draw) => {
    const first = vertices.length;
    for (const {corners, value} of viewTriangles(vector, draw, face, arrays))
      for (const [x, y, w, u, v, z] of clippedCorners(corners, planes))
        vertices.push({place: [scaleX * x + right * w, scaleY * y + down * w, deviceZ(vector, w, z), w, u, v], value});
    return {first, count: vertices.length - first};
  });
  const bytes = new ArrayBuffer(vertexBytes * vertices.length);
  const floats = new Float32Array(bytes), words = new Uint32Array(bytes);
  vertices.forEach(({place, value}, k) => {
    floats.set(place, 8 * k);
    words.set(value, 8 * k + 6);
  });
  return {vertices: bytes, runs};
}

// det(X, Y, W) < 0: such a view reverses windings.
export function isMirrored({x, y, w}) {
  return x[0] * (y[1] * w[2] - y[2] * w[1]) - x[1] * (y[0] * w[2] - y[2] * w[0]) +
             x[2] * (y[0] * w[1] - y[1] * w[0]) < 0;
}

// Whether front-facing triangles are clockwise, where row 0 is at the top.
export const areFrontsClockwise = (vector, face) => isMirrored(face) !== (vector.front === "clockwise");
