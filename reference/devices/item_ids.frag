// The depth and the item ID of a pixel (docs/item-buffers.md, "depth and texel" and "blend"), in double precision from
// the planes of item_ids.vert.

layout(location = 0) flat in dvec3 one;
layout(location = 2) flat in dvec3 column;
layout(location = 4) flat in dvec3 row;
layout(location = 6) flat in dvec3 depth;
layout(location = 8) flat in double volume;
layout(location = 9) flat in uint draw;
layout(location = 10) flat in uint number;
layout(location = 0) out uint id;
layout(location = 1) out float passed;  // where pixels hold counts, a blend unit adds it

void main() {
  dvec3 p = dvec3(256 * (gl_FragCoord.xy + view.scissor) - 128 * view.size, 1);
  // In a scene the depth is w itself, scaled below 1 by a power of two. It is often a binary32 number where 1/w is not.
  gl_FragDepth = view.depthScale == 0 ? float(volume / dot(one, p)) * 5.421010862427522e-20  // 2^-64
                                 : float(clamp(view.depthScale * (dot(depth, p) / volume) + view.depthOffset, 0, 1));
  passed = 1;
  Draw drawn = draws[draw];
  if (drawn.cull == (gl_FrontFacing ? 1 : 2)) discard;
  bool isBack = drawn.hasBack != 0 && !gl_FrontFacing;
  id = isBack ? drawn.back : view.value == 0 ? drawn.offset : number;
  if (drawn.width == 0) return;
  dvec2 position = dvec2(dot(column, p), dot(row, p)) / dot(one, p);
  uvec2 texel = uvec2(clamp(floor(position), dvec2(0), dvec2(drawn.width, drawn.height) - 1));
  uint index = texels[drawn.firstTexel + texel.y * uint(drawn.width) + texel.x];
  if (index == ~0u) discard;  // a hole
  if (!isBack && view.value == 0) id = blended(drawn.offset, index);
}
