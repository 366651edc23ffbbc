// Wrong solutions of each step of "Write it": [part of the solution, what stands there instead]. Each must fail in its
// own step, not in a later one.
export const wrongSolutions = [
  // A box of pixels: corners of pixels instead of centres; the box begins one pixel late
  [
    ["[key]) - 128) / 256));\n    const last", "[key])) / 256));\n    const last"],
    ["(clip + 1) * 128", "clip * 128"],
  ],
  // Edge functions
  [
    ["value <= 0", "value < -200000"],
    ["[b, c], [c, a], [a, b]]", "[b, c], [c, a]]"],
  ],
  // Both windings: never exchanged; always exchanged
  [
    ["if (edge(a, b, c) < 0)", "if (false)"],
    ["if (edge(a, b, c) < 0)", "if (true)"],
  ],
  // The fill rule: all edges; none
  [
    ["value === 0 && isTopOrLeft(...sides[k])", "value === 0"],
    ["|| value === 0 && isTopOrLeft(...sides[k])", ""],
  ],
  // Snapping: down; halves up
  [
    ["roundEven(", "Math.floor("],
    ["roundEven(", "Math.round("],
  ],
  // Depth: the last of equals wins; the farther one wins
  [
    ["depth <= depths", "depth < depths"],
    ["depth <= depths[pixel(column, row)]", "depth >= (depths[pixel(column, row)] || 9e9)"],
  ],
  // Clipping: the near plane alone; t from the outside end
  [
    [", p => 8 * p.w - p.x, p => 8 * p.w + p.x, p => 8 * p.w - p.y, p => 8 * p.w + p.y]", "]"],
    ["mix(p, q, inside(p) / (inside(p) - inside(q)))", "mix(q, p, inside(q) / (inside(q) - inside(p)))"],
  ],
  // Back faces: mirrors ignored; the other side
  [
    [" !== view.mirrored", ""],
    ["edge(a, b, c) > 0", "edge(a, b, c) < 0"],
  ],
  // The texel: not clamped; columns and rows exchanged
  [
    ["Math.min(size - 1, Math.max(0, Math.floor(size * coordinate(key))))", "Math.floor(size * coordinate(key))"],
    ['ids[texel("v", height) * width + texel("u", width)]', 'ids[texel("u", height) * width + texel("v", width)]'],
  ],
  // Perspective: divided once; by the depth twice
  [
    [" / p.w)) / area / depth", " / p.w)) / area"],
    ["/ area / depth;", "/ area / depth / depth;"],
  ],
  // Offset, texel and clamp: a carry; no clamp
  [
    ["Math.min(part(offset) + part(texel), size - 1)", "(part(offset) + part(texel))"],
    ['if (blend === "replace") return texel;', ""],
  ],
  // Exact decisions: depths by doubles; texels by doubles
  [
    [
      "signOfSum([...depth(other.area), ...other.depth(-area)]) <= 0",
      "sum(depth(other.area).map(([a, b, c, d]) => a * b * c / d)) <= sum(other.depth(area).map(([a, b, c, d]) => a * b * c / d))",
    ],
    [
      "floorOfQuotient(coordinate(key, size), depth(1))",
      "Math.floor(sum(coordinate(key, size).map(([a, b, c, d]) => a * b * c / d)) / sum(depth(1).map(([a, b, c, d]) => a * b * c / d)))",
    ],
  ],
  // Delta form factors: π is missing; the height of a side is missing
  [
    ["Math.PI * ", ""],
    ["(isSide ? y : 1)", "1"],
  ],
  // A row: one pixel too many counts; the shares of the first face for all
  [
    ["id >= 0", "id > 0"],
    ["shares[f][k]", "shares[0][k]"],
  ],
  // The brightest: radiosity instead of flux; the faintest
  [
    ["value * area[k] > unshot[best] * area[best]", "value > unshot[best]"],
    ["> unshot", "< unshot"],
  ],
  // A shot: radiosity is shot; nothing is reflected on
  [
    ["unshot[source] * area[source]", "unshot[source]"],
    ["    unshot[k] += gain;\n", ""],
  ],
  // Refinement: one shot; until half is unshot
  [
    ["while (", "if ("],
    ["residual * flux", "10 * residual * flux"],
  ],
  // The ambient estimate: reflected light is absorbed; areas do not count
  [
    ["(1 - reflectance[k])", "reflectance[k]"],
    ["sum(unshot.map((value, k) => value * area[k]))", "sum(unshot)"],
  ],
  // The texture: the nearest texel; centres at corners
  [
    ["x - left)", "0)"],
    ["u * width - 0.5", "u * width"],
  ],
  // The whole method: the top face for all; the surface is ignored
  [
    ["face > 0", "false"],
    ["id >> indexBits", "0"],
  ],
];
