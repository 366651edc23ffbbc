// Transforms, clips and snaps a triangle by the rules, and computes planes from which the fragment shader derives depth
// and texel. A triangle is up to two after the near plane has clipped it, so there are six invocations per triangle.
// Each reads all three corners and computes one corner of the result. No geometry shader is needed.

layout(location = 0) flat out dvec3 one;
layout(location = 2) flat out dvec3 column;
layout(location = 4) flat out dvec3 row;
layout(location = 6) flat out double volume;
layout(location = 7) flat out uint draw;
layout(location = 8) flat out uint number;  // of the triangle: its item ID if pixels hold triangle numbers

struct Vertex {
  dvec3 view;      // x, y, w
  dvec2 texcoord;  // u, v
};

// docs/item-buffers.md, "view": in binary32, and `precise`, so that nothing is fused or reordered.
vec3 toView(Corner corner) {
  precise vec3 d = vec3(corner.x, corner.y, corner.z) - eye;
  precise vec3 view = (vec3(x.x, y.x, w.x) * d.x + vec3(x.y, y.y, w.y) * d.y) + vec3(x.z, y.z, w.z) * d.z;
  return view;
}

bool isFinite(vec3 v) { return !any(isnan(v)) && !any(isinf(v)); }

// Where the edge from a vertex in front of the near plane to one behind it crosses the plane.
Vertex crossing(Vertex inside, Vertex outside) {
  precise double t = (inside.view.z - near) / (inside.view.z - outside.view.z);
  precise dvec3 view = inside.view + t * (outside.view - inside.view);
  precise dvec2 texcoord = inside.texcoord + t * (outside.texcoord - inside.texcoord);
  return Vertex(dvec3(view.xy, near), texcoord);
}

// docs/item-buffers.md, "clip" at the near plane. Returns the number of vertices: 0, 3 or 4.
int clip(Vertex corners[3], out Vertex polygon[4]) {
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    Vertex from = corners[k], to = corners[(k + 1) % 3];
    bool fromInside = from.view.z >= near, toInside = to.view.z >= near;
    if (fromInside) polygon[count++] = from;
    if (fromInside && !toInside) polygon[count++] = crossing(from, to);
    if (!fromInside && toInside) polygon[count++] = crossing(to, from);
  }
  return count;
}

// docs/item-buffers.md, "snap". Lengths across are in sub-pixels from here on, with 0 in the middle of the picture.
dvec3 snap(dvec3 view) {
  double unit = 128 * resolution;
  return dvec3((roundEven((view.xy / view.z + 1) * unit) - unit) * view.z, view.z);
}

// Let v_k be the corners of a triangle. Its point seen at p = (x/w, y/w, 1) is w p = sum(b_k v_k). Let c_k be the cross
// product of the two other corners and D = v_0 . c_0. Then b_k = w (c_k . p) / D, and since the b_k sum to one,
//
//   1/w = (sum(c_k) . p) / D,    u = sum(b_k u_k) = (sum(u_k c_k) . p) / (sum(c_k) . p).
//
// So three vectors and D are enough (Olano and Greer 1997). Texels are u N and v M, multiplied last: a driver of OpenGL
// (NVIDIA 580.159.04) rounds what passes through arrays of Vertex to binary32, which u and v survive and u N does not.
void setPlanes(dvec3 v[3], dvec2 texcoord[3], dvec2 size) {
  dvec3 c[3] = dvec3[3](cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1]));
  one = c[0] + c[1] + c[2];
  column = size.x * (c[0] * texcoord[0].x + c[1] * texcoord[1].x + c[2] * texcoord[2].x);
  row = size.y * (c[0] * texcoord[0].y + c[1] * texcoord[1].y + c[2] * texcoord[2].y);
  volume = dot(v[0], c[0]);
}

void main() {
  int triangle = vertexNumber / 6, fan = vertexNumber / 3 % 2, k = vertexNumber % 3;
  draw = corners[3 * triangle].draw;
  number = draws[draw].offset + uint(triangle - draws[draw].firstTriangle);
  one = column = row = dvec3(0);
  volume = 0;
  gl_Position = vec4(0, 0, 0, 1);  // three equal corners cover no pixel

  Vertex whole[3];
  for (int j = 0; j < 3; ++j) {
    Corner corner = corners[3 * triangle + j];
    vec3 view = toView(corner);
    if (!isFinite(view) || !isFinite(vec3(corner.u, corner.v, 0))) return;
    whole[j] = Vertex(view, dvec2(corner.u, corner.v));
  }
  Vertex polygon[4];
  if (fan + 2 >= clip(whole, polygon)) return;
  Vertex part[3] = Vertex[3](polygon[0], polygon[fan + 1], polygon[fan + 2]);
  dvec3 v[3] = dvec3[3](snap(part[0].view), snap(part[1].view), snap(part[2].view));
  setPlanes(v, dvec2[3](part[0].texcoord, part[1].texcoord, part[2].texcoord),
            dvec2(draws[draw].width, draws[draw].height));
  // z/w is near/w, which is at most 1: the device finds nothing to clip at the near plane.
  gl_Position = vec4(v[k].xy / (128 * resolution * width), near, v[k].z);
}
