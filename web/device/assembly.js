// Assembly: the triangles of strips, fans, restarts and instances, and the value of each, for the backends of browsers
// (docs/item-buffers.md, "assembly").

const round = Math.fround;

// The corners of triangle k of a run of vertices, as places in the run. The provoking vertex comes first or last.
function cornersAt(topology, isLast, k) {
  if (topology === "triangles") return [3 * k, 3 * k + 1, 3 * k + 2];
  if (topology === "fan") return isLast ? [0, k + 1, k + 2] : [k + 1, k + 2, 0];
  if (k % 2 === 0) return [k, k + 1, k + 2];
  return isLast ? [k + 1, k, k + 2] : [k, k + 2, k + 1];
}

// The runs of vertices between the restarts of a draw.
function runsOf({first, count, restart, base_vertex: base}, indices) {
  const end = 2 ** (8 * indices.BYTES_PER_ELEMENT) - 1, runs = [[]];
  for (const index of indices.subarray(first, first + count)) {
    if (restart && index === end) runs.push([]);
    else runs.at(-1).push(index + (base ?? 0));
  }
  return runs;
}

// The triangles of a draw, each with the numbers of its three vertices.
function trianglesOf(vector, draw, indices) {
  const topology = draw.topology ?? "triangles", isLast = vector.provoking === "last";
  return runsOf(draw, indices).flatMap((run) => {
    const count = topology === "triangles" ? Math.floor(run.length / 3) : Math.max(run.length - 2, 0);
    return Array.from({length: count}, (_, k) => cornersAt(topology, isLast, k).map((place) => run[place]));
  });
}

// The instances of a draw; without any it is the mesh itself.
function copiesOf({instances}, {first_instance: first, instance_count: count}) {
  return count ? instances.slice(first ?? 0, (first ?? 0) + count) : [{id: 0}];
}

// The position of a vertex in an instance: x, y, z and, in clip space, w. One product and one sum in binary32, which the
// array of the result rounds.
function positionOf(vertex, {scale, offset}, positions, size) {
  const position = positions.subarray(size * vertex, size * vertex + size);
  if (!scale && !offset) return position;
  return position.map((p, k) => round(p * round(scale?.[k] ?? 1)) + round(offset?.[k] ?? 0));
}

// The value of a triangle in two words, of which only pairs need the second. Item IDs start as offsets.
function valueOf(vector, arrays, offset, triangle, number) {
  switch (vector.values) {
    case "triangle-numbers": return [offset + number, 0];
    case "vertex-values": return [offset + arrays.vertexValues[triangle[vector.provoking === "last" ? 2 : 0]], 0];
    case "pairs": return [number, offset];
    default: return [offset, 0];
  }
}

// The triangles of a draw in the order of drawing, each with the positions and texture coordinates of its three corners
// and its value.
export function assembledTriangles(vector, draw, arrays) {
  const size = (vector.clip_depth ?? "none") === "none" ? 3 : 4;
  const triangles = trianglesOf(vector, draw, arrays.indices);
  return copiesOf(vector, draw).flatMap((instance) => triangles.map((triangle, number) => ({
    corners: triangle.map((vertex) => ({
      position: positionOf(vertex, instance, arrays.positions, size),
      texcoord: arrays.texcoords.subarray(2 * vertex, 2 * vertex + 2),
    })),
    value: valueOf(vector, arrays, draw.offset + instance.id, triangle, number),
  })));
}
