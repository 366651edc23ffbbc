// The vertex stage and the clipping of the raster rules, for the backends of browsers. Input is the object of
// vector.json and the arrays of a test vector (docs/backend.md). Output is a list of vertices that a device draws.

const round = Math.fround;

// The vertex in the view of the face, in binary32: [x, y, w, u, v].
export function viewVertex(index, face, eye, arrays) {
  const d = [0, 1, 2].map((k) => round(arrays.positions[3 * index + k] - round(eye[k])));
  const dot = ([a, b, c]) => round(round(round(round(a) * d[0]) + round(round(b) * d[1])) + round(round(c) * d[2]));
  const texcoord = arrays.texcoords.subarray(2 * index, 2 * index + 2);
  return [dot(face.x), dot(face.y), dot(face.w), ...texcoord];
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

// The triangles of a clipped triangle: in front of the near plane and inside the guard band.
function clippedTriangles(triangle, nearDistance) {
  const inFront = clip(triangle, (vertex) => vertex[2] - nearDistance);
  const sides = [(v) => 8 * v[2] - v[0], (v) => 8 * v[2] + v[0], (v) => 8 * v[2] - v[1], (v) => 8 * v[2] + v[1]];
  const polygon = sides.reduce(clip, inFront);
  return polygon.slice(2).flatMap((corner, k) => [polygon[0], polygon[k + 1], corner]);
}

// Bytes of a vertex: x, y, w, u, v in binary32.
export const vertexBytes = 20;

// The triangles of a face as vertices, and the first vertex and the number of vertices of each draw.
export function faceTriangles(vector, face, arrays) {
  const vertices = [];
  const runs = vector.draws.map((draw) => {
    const first = vertices.length;
    for (let i = draw.first; i < draw.first + draw.count; i += 3) {
      const corners = [0, 1, 2].map((k) => viewVertex(arrays.indices[i + k], face, face.eye ?? vector.eye, arrays));
      for (const corner of clippedTriangles(corners, round(vector.near))) vertices.push(corner);
    }
    return {first, count: vertices.length - first};
  });
  return {vertices: new Float32Array(vertices.flat()), runs};
}

// det(X, Y, W) < 0: such a view reverses windings.
export function isMirrored({x, y, w}) {
  return x[0] * (y[1] * w[2] - y[2] * w[1]) - x[1] * (y[0] * w[2] - y[2] * w[0]) +
             x[2] * (y[0] * w[1] - y[1] * w[0]) < 0;
}

// What these backends draw of version 2, besides holes and culling: the values of version 1.
const drawn = {
  values: "item-ids", depth_test: "nearer", sample: "middle", clip_depth: "none", depth_precision: "exact",
  front: "counter-clockwise"
};
const isPlain = ({topology, restart, base_vertex: base, instance_count: instances}) =>
    (topology ?? "triangles") === "triangles" && !restart && !base && !instances;

// Throws an error for what these backends do not draw.
export function requireDrawable(vector) {
  const other = Object.keys(drawn).filter((key) => (vector[key] ?? drawn[key]) !== drawn[key]);
  if (Array.isArray(vector.resolution)) other.push("resolution");
  if (!vector.draws.every(isPlain)) other.push("draws");
  if (other.length > 0) throw new Error(`this backend does not draw such ${other.join(", ")}`);
}

// Numbers of the blends, and of the culled sides, in shaders.
export const blends = ["clamped-add", "integer-add", "replace"];
export const cullOf = ({cull}) => ["none", "front", "back"].indexOf(cull ?? "none");

// Bits of four channels; 0 where there is none.
export const channelBits = (vector) => [0, 1, 2, 3].map((k) => vector.channels[k] ?? 0);
