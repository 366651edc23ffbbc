// What the backends of browsers set on a device for a test vector, by the keys of vector.json.

// Columns and rows.
export const sizeOf = ({resolution}) => Array.isArray(resolution) ? resolution : [resolution, resolution];

export const countsSamples = (vector) => vector.values === "passed-samples";

// The viewport: first column and row, columns and rows. A device may cut triangles at its sides, which moves edges. No
// check explains other counts, so for these it is eight times as wide and high as the picture, like the guard band.
export function viewportOf(vector) {
  const beside = sizeOf(vector).map((pixels) => countsSamples(vector) ? Math.floor(3.5 * pixels) : 0);
  return [...beside.map((pixels) => -pixels), ...sizeOf(vector).map((pixels, k) => pixels + 2 * beside[k])];
}

const storedPrecision = (vector) => vector.depth_precision ?? "exact";

// Exact depths of a scene are stored as n/w, which is larger for nearer points; all others as the rules say.
export const storesInverseDepth = (vector) =>
    (vector.clip_depth ?? "none") === "none" && storedPrecision(vector) === "exact";

// The comparison that passes, as WebGPU names it, and the cleared depth, which no fragment is beyond.
export function depthTestOf(vector) {
  const test = vector.depth_test ?? "nearer", isGreater = test.startsWith("farther") !== storesInverseDepth(vector);
  const compare = (isGreater ? "greater" : "less") + (test.endsWith("or-equal") ? "-equal" : "");
  return {compare, cleared: isGreater ? 0 : 1};
}

// 32-bit words of a pixel.
export const wordsOf = (vector) => vector.values === "pairs" ? 2 : 1;

// Numbers in shaders: of the blend, which other values than item IDs do not have, and of the culled side.
export const blendOf = (vector) => (vector.values ?? "item-ids") === "item-ids" ?
    ["clamped-add", "integer-add", "replace"].indexOf(vector.blend) : 3;
export const cullOf = ({cull}) => ["none", "front", "back"].indexOf(cull ?? "none");

// Bits of four channels; 0 where there is none.
export const channelBits = (vector) => [0, 1, 2, 3].map((k) => vector.channels[k] ?? 0);

// The format of stored depths, from those of a device. Throws an error that names all keys which it does not draw.
export function depthFormatOf(vector, {largestSide, depthFormats, canCount}) {
  const refused = [];
  if (vector.rules > 2) refused.push("rules");
  if (Math.max(...viewportOf(vector)) > largestSide) refused.push("resolution");
  if (countsSamples(vector) && !canCount) refused.push("values");
  if (!depthFormats[storedPrecision(vector)]) refused.push("depth_precision");
  if (refused.length > 0) throw new Error(`this device does not draw such ${refused.join(", ")}`);
  return depthFormats[storedPrecision(vector)];
}
