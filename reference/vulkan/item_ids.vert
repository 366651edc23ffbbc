// Moves a corner of a triangle to clip space, and computes planes from which the fragment shader derives depth and
// texel. Each invocation reads all three corners of its triangle, so that no geometry shader is needed.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_inputs.glsl"

layout(location = 0) flat out dvec3 one;
layout(location = 2) flat out dvec3 column;
layout(location = 4) flat out dvec3 row;
layout(location = 6) flat out double volume;
layout(location = 7) flat out uint draw;

// docs/item-buffers.md, "view": in binary32, and `precise`, so that nothing is fused or reordered.
vec3 toView(Corner corner) {
  precise vec3 d = vec3(corner.x, corner.y, corner.z) - eye;
  precise vec3 view = (vec3(x.x, y.x, w.x) * d.x + vec3(x.y, y.y, w.y) * d.y) + vec3(x.z, y.z, w.z) * d.z;
  return view;
}

// Puts a corner in front of the near plane on the sub-pixel of the rules. Lengths across are in sub-pixels from here
// on.
dvec3 snap(vec3 view) {
  double w = view.z;
  dvec2 across = 128.0lf * resolution * view.xy;
  return dvec3(view.z < near ? across : roundEven(across / w) * w, w);
}

// Let v_k be the corners of a triangle. Its point seen at p = (x/w, y/w, 1) is w p = sum(b_k v_k). Let c_k be the cross
// product of the two other corners and D = v_0 . c_0. Then b_k = w (c_k . p) / D, and since the b_k sum to one,
//
//   1/w = (sum(c_k) . p) / D,    u = sum(b_k u_k) = (sum(u_k c_k) . p) / (sum(c_k) . p).
//
// So three vectors and D are enough (Olano and Greer 1997).
void main() {
  int first = gl_VertexIndex / 3 * 3;
  Corner k0 = corners[first], k1 = corners[first + 1], k2 = corners[first + 2];
  vec3 view[3] = vec3[3](toView(k0), toView(k1), toView(k2));
  draw = k0.draw;
  bool isFinite = true;
  for (int k = 0; k < 3; ++k) isFinite = isFinite && !any(isnan(view[k])) && !any(isinf(view[k]));
  if (!isFinite) {
    one = column = row = dvec3(0);
    volume = 0;
    gl_Position = vec4(0, 0, 0, 1);  // three equal corners cover no pixel
    return;
  }
  dvec3 v[3] = dvec3[3](snap(view[0]), snap(view[1]), snap(view[2]));
  dvec3 c[3] = dvec3[3](cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1]));
  one = c[0] + c[1] + c[2];
  column = c[0] * k0.column + c[1] * k1.column + c[2] * k2.column;
  row = c[0] * k0.row + c[1] * k1.row + c[2] * k2.row;
  volume = dot(v[0], c[0]);
  dvec3 corner = v[gl_VertexIndex - first];
  // z/w is near/w, which is in [0, 1] where w is at least near. So the device clips at the near plane of the rules.
  gl_Position = vec4(corner.xy / (128.0lf * resolution * width), near, corner.z);
}
