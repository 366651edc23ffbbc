// The steps from an empty picture to a rasterizer that passes the suite, and on to a lit room. Each has a solution, and
// test vectors or calls on which the solution of the step before fails.
//
// The rules are those of docs/item-buffers.md. The order of steps is that of a graphics pipeline built backwards: first
// pixels, then corners, then what a pixel holds.

import {lightSteps} from "./light_steps";
import type {LightTask} from "./light_tasks";

export interface Step {
  title: string;
  text: string; // HTML
  vectors: string[] | null; // names of small vectors and of the suite; null: the whole suite
  light?: LightTask; // asks other functions than draw
  solution: string;
}

type Change = [before: string, after: string][];

const start = `// Returns an item ID per pixel of the view, row by row.
function draw(view) {
  const ids = new Uint32Array(view.width * view.height).fill(view.background);
  // The place of a pixel in ids
  const pixel = (column, row) => (row - view.row) * view.width + column - view.column;
  for (const triangle of view.triangles) {
    const [a, b, c] = triangle.corners;
  }
  return ids;
}
`;

const steps: {title: string; text: string; vectors: string[] | null; change: Change}[] = [
  {
    title: "A box of pixels",
    text: `A corner (x, y, w) is seen at column (x / w + 1) · 128 R, and likewise its row, where R is the
      resolution. The unit is 1/256 pixel: the centre of pixel (i, j) is at (256 i + 128, 256 j + 128). Give each pixel
      whose centre lies in the box around the three corners the <code>offset</code> of the triangle.`,
    vectors: ["two rectangles"],
    change: [[`    const [a, b, c] = triangle.corners;
`, `    const place = clip => (clip + 1) * 128 * view.resolution;
    const [a, b, c] = triangle.corners.map(p => ({...p, x: place(p.x / p.w), y: place(p.y / p.w)}));
    const first = (key, begin) => Math.max(begin, Math.ceil((Math.min(a[key], b[key], c[key]) - 128) / 256));
    const last = (key, end) => Math.min(end - 1, Math.floor((Math.max(a[key], b[key], c[key]) - 128) / 256));
    for (let row = first("y", view.row); row <= last("y", view.row + view.height); ++row)
      for (let column = first("x", view.column); column <= last("x", view.column + view.width); ++column) {
        ids[pixel(column, row)] = triangle.offset;
      }
`]],
  },
  {
    title: "Edge functions",
    text: `A triangle fills less than its box. The edge function of a, b and p is the cross product
      (b − a) × (p − a): twice the area of the triangle a, b, p, negative on the other side of the edge (Pineda 1988).
      Keep the pixels where those of all three edges are positive.`,
    vectors: ["two triangles"],
    change: [[`// Returns`, `const edge = (a, b, p) => (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);

// Returns`],
[`        ids[pixel`, `        const sample = {x: 256 * column + 128, y: 256 * row + 128};
        const edges = [[b, c], [c, a], [a, b]].map(([from, to]) => edge(from, to, sample));
        if (edges.some(value => value <= 0)) continue;
        ids[pixel`]],
  },
  {
    title: "Both windings",
    text: `The second triangle runs the other way round: all its edge functions are negative. Exchange two
      of its corners if its area, the edge function of its own corners, is negative.`,
    vectors: ["two windings"],
    change: [[`    const [a, b, c] = triangle`, `    let [a, b, c] = triangle`],
[`    const first`, `    if (edge(a, b, c) < 0) [b, c] = [c, b];
    const first`]],
  },
  {
    title: "The fill rule",
    text: `A centre on the edge of two triangles must belong to one of them. The rule: to the one whose
      <em>top</em> edge (horizontal, the inside at larger rows) or <em>left</em> edge (not horizontal, the inside at
      larger columns) it is. Row 0 counts as the top, though the pictures here show it at the bottom.
      Ask for the direction of an edge where its function is 0.`,
    vectors: ["shared edges", "sample-grid-later-nearer", "sample-grid-earlier-nearer"],
    change: [[`
// Returns`, `const isTopOrLeft = (from, to) => from.y === to.y ? to.x > from.x : to.y < from.y;

// Returns`],
[`        const edges = [[b, c], [c, a], [a, b]].map(([from, to]) => edge(from, to, sample));
        if (edges.some(value => value <= 0)) continue;
`, `        const sides = [[b, c], [c, a], [a, b]], edges = sides.map(([from, to]) => edge(from, to, sample));
        if (!edges.every((value, k) => value > 0 || value === 0 && isTopOrLeft(...sides[k]))) continue;
`]],
  },
  {
    title: "Snapping",
    text: `Edge functions must be exact, or shared edges get holes. Devices round corners to 1/256 pixel:
      then all numbers are integers. Of two integers equally near, take the even one.`,
    vectors: ["snapping-columns", "snapping-rows", "fans-later-nearer"],
    change: [[`(clip + 1) * 128 * view.resolution`, `roundEven((clip + 1) * 128 * view.resolution)`]],
  },
  {
    title: "Depth",
    text: `The nearer surface wins in each pixel. 1/w is linear on the picture: 1/w = Σ e<sub>k</sub> /
      w<sub>k</sub> / area, where e<sub>k</sub> is the edge function of the edge opposite to corner k. Draw where it is
      larger than what the pixel shows. Of equal depths the first stays.`,
    vectors: ["crossing", "coplanar-slope"],
    change: [[`  // The place`, `  const depths = new Float64Array(ids.length);
  // The place`],
[`    const first`, `    const points = [a, b, c], area = edge(a, b, c);
    const first`],
[`        ids[pixel(column, row)] = triangle.offset;
`, `        const depth = sum(points.map((p, k) => edges[k] / p.w)) / area;
        if (depth <= depths[pixel(column, row)]) continue;
        depths[pixel(column, row)] = depth;
        ids[pixel(column, row)] = triangle.offset;
`]],
  },
  {
    title: "Clipping",
    text: `A corner behind the eye cannot be divided by w. Cut each triangle at w ≥ near, then at x ≤ 8w,
      x ≥ −8w, y ≤ 8w and y ≥ −8w (Sutherland and Hodgman 1974). From the inside end of an edge, t = f<sub>in</sub> /
      (f<sub>in</sub> − f<sub>out</sub>); then w is <code>near</code> on the first plane and at least that on the
      others. Draw the polygon as a fan from its first corner. Clamp x / w and y / w to ±8.`,
    vectors: ["near-plane-sheet", "behind-the-eye", "frustum-sheet", "guard-band-sheet", "cut sheets"],
    change: [[`
// Returns`, `function clipped(corners, near) {
  const planes = [p => p.w - near, p => 8 * p.w - p.x, p => 8 * p.w + p.x, p => 8 * p.w - p.y, p => 8 * p.w + p.y];
  const polygon = planes.reduce((points, inside) => points.flatMap((start, k) => {
    const end = points[(k + 1) % points.length], kept = inside(start) >= 0 ? [start] : [];
    if (inside(start) >= 0 === inside(end) >= 0) return kept;
    const [p, q] = inside(start) >= 0 ? [start, end] : [end, start];
    const crossing = mix(p, q, inside(p) / (inside(p) - inside(q)));
    return [...kept, {...crossing, w: inside === planes[0] ? near : Math.max(crossing.w, near)}];
  }), corners);
  return polygon.slice(2).map((corner, k) => [polygon[0], polygon[k + 1], corner]);
}

// Returns`],
[`  for (const triangle of view.triangles) {
    const place = clip => roundEven((clip + 1) * 128 * view.resolution);
`, `  const place = clip => roundEven((Math.min(8, Math.max(-8, clip)) + 1) * 128 * view.resolution);
  for (const triangle of view.triangles.flatMap(t => clipped(t.corners, view.near).map(corners => ({...t, corners})))) {
`]],
  },
  {
    title: "Back faces",
    text: `A triangle with a <code>back</code> shows that ID where it faces away: where its area, before you
      exchange corners, is positive, or negative in a <code>mirrored</code> view.`,
    vectors: ["front and back", "edge-offsets-r8g8b8"],
    change: [[`    if (edge(a, b, c) < 0) [b, c]`, `    const isBack = triangle.back !== null && edge(a, b, c) > 0 !== view.mirrored;
    if (edge(a, b, c) < 0) [b, c]`],
[`] = triangle.offset;`, `] = isBack ? triangle.back : triangle.offset;`]],
  },
  {
    title: "The texel",
    text: `Now the idea of the method: the ID is the offset of the surface plus the texel of its index map.
      Column = ⌊u · width⌋, row = ⌊v · height⌋, each clamped to the map. Interpolate u and v with the edge
      functions.`,
    vectors: ["map", "magnified", "rectangular-map"],
    change: [[`        ids[pixel(column, row)] = isBack ? triangle.back : triangle.offset;
`, `        const texel = (key, size) => Math.min(size - 1, Math.max(0, Math.floor(size * coordinate(key))));
        const coordinate = key => sum(points.map((p, k) => edges[k] * p[key])) / area;
        const fetch = ({width, height, ids}) => ids[texel("v", height) * width + texel("u", width)];
        const id = triangle.map ? triangle.offset + fetch(triangle.map) : triangle.offset;
        ids[pixel(column, row)] = isBack ? triangle.back : id;
`]],
  },
  {
    title: "Perspective",
    text: `The texels of a tilted surface are in the wrong places: u is not linear on the picture. u / w and
      1/w are; u is their quotient.`,
    vectors: ["perspective-floor", "perspective-twist", "perspective-clipped"],
    change: [[`edges[k] * p[key])) / area;`, `edges[k] * p[key] / p.w)) / area / depth;`]],
  },
  {
    title: "Offset, texel and clamp",
    text: `A blend unit adds channel by channel, and each channel clamps to its maximum: no carry passes to
      the next one. Do so for <code>clamped-add</code>. <code>integer-add</code> adds whole IDs modulo background + 1;
      <code>replace</code> takes the texel alone.`,
    vectors: ["layout-r5g6b5", "byte-pairs", "integer-add-24", "unique-maps"],
    change: [[`
// Returns`, `function blended(offset, texel, {blend, channels, background}) {
  if (blend === "replace") return texel;
  if (blend === "integer-add") return (offset + texel) % (background + 1);
  return sum(channels.map(({unit, size}) => {
    const part = id => Math.floor(id / unit) % size;
    return Math.min(part(offset) + part(texel), size - 1) * unit;
  }));
}

// Returns`],
[`triangle.offset + fetch(triangle.map)`, `blended(triangle.offset, fetch(triangle.map), view)`]],
  },
  {
    title: "Exact decisions: the whole suite",
    text: `A double rounds. Where two depths or a texel's border are closer than its last bits, it decides
      wrongly. Compare depths with <code>signOfSum</code>: Σ e<sub>k</sub> A′ / w<sub>k</sub> − Σ e′<sub>k</sub> A /
      w′<sub>k</sub>, without divisions by the areas A and A′. Find texels with <code>floorOfQuotient</code>.`,
    vectors: null,
    change: [[`  const depths = new Float64Array(ids.length);
`, `  const shown = [];
`],
[`        const depth = sum(points.map((p, k) => edges[k] / p.w)) / area;
        if (depth <= depths[pixel(column, row)]) continue;
        depths[pixel(column, row)] = depth;
`, `        const depth = factor => points.map((p, k) => [edges[k], factor, 1, p.w]);
        const other = shown[pixel(column, row)];
        if (other && signOfSum([...depth(other.area), ...other.depth(-area)]) <= 0) continue;
        shown[pixel(column, row)] = {depth, area};
`],
[`        const texel = (key, size) => Math.min(size - 1, Math.max(0, Math.floor(size * coordinate(key))));
        const coordinate = key => sum(points.map((p, k) => edges[k] * p[key] / p.w)) / area / depth;
`, `        const coordinate = (key, size) => points.map((p, k) => [edges[k], size, p[key], p.w]);
        const texel = (key, size) => Math.min(size - 1, Math.max(0, floorOfQuotient(coordinate(key, size), depth(1))));
`]],
  },
];

function changed(code: string, change: Change): string {
  return change.reduce((text, [before, after]) => {
    const parts = text.split(before);
    if (parts.length !== 2) throw new Error(`not once in the solution before: ${before}`);
    return parts.join(after);
  }, code);
}

/** In order. */
export const allSteps: Step[] = [];
let solution = start;
for (const {change, ...step} of steps) {
  solution = changed(solution, change);
  allSteps.push({...step, solution});
}
for (const {added, ...step} of lightSteps) {
  solution += added;
  allSteps.push({...step, vectors: [], solution});
}

/** The code at the start of a step: the solution of the one before. */
export function startOf(step: number): string {
  return step === 0 ? start : allSteps[step - 1].solution;
}
