// Transforms, clips and snaps a triangle by the rules, and computes planes from which the fragment shader derives depth
// and texel. Clipping leaves up to two triangles of one in a scene, and up to four in clip space. So there are six or
// twelve invocations per triangle. Each reads all three corners and computes one corner of the result. No geometry
// shader is needed.

layout(location = 0) flat out dvec3 one;
layout(location = 2) flat out dvec3 column;
layout(location = 4) flat out dvec3 row;
layout(location = 6) flat out dvec3 depth;
layout(location = 8) flat out double volume;
layout(location = 9) flat out uint draw;
layout(location = 10) flat out uint number;  // of the triangle: its value if pixels hold no item IDs

// A snapped corner; its lengths across are in sub-pixels, with 0 in the middle of the picture.
dvec3 snap(dvec3 seen) { return dvec3(snapped(seen.xy / seen.z) * seen.z, seen.z); }

// Let v_k be the corners of a triangle. Its point seen at p = (x/w, y/w, 1) is w p = sum(b_k v_k). Let c_k be the cross
// product of the two other corners and D = v_0 . c_0. Then b_k = w (c_k . p) / D, and since the b_k sum to one,
//
//   1/w = (sum(c_k) . p) / D,  z/w = (sum(z_k c_k) . p) / D,  u = sum(b_k u_k) = (sum(u_k c_k) . p) / (sum(c_k) . p).
//
// So four vectors and D are enough (Olano and Greer 1997). Texels are u N and v M, multiplied last: a driver of OpenGL
// (NVIDIA 580.159.04) rounds what passes through arrays of Vertex to binary32, which u and v survive and u N does not.
void setPlanes(dvec3 v[3], dvec3 texcoord[3], dvec2 texels) {
  dvec3 c[3] = dvec3[3](cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1]));
  one = c[0] + c[1] + c[2];
  column = texels.x * (c[0] * texcoord[0].x + c[1] * texcoord[1].x + c[2] * texcoord[2].x);
  row = texels.y * (c[0] * texcoord[0].y + c[1] * texcoord[1].y + c[2] * texcoord[2].y);
  depth = c[0] * texcoord[0].z + c[1] * texcoord[1].z + c[2] * texcoord[2].z;
  volume = dot(v[0], c[0]);
}

void main() {
  int fans = view.clipDepth == 0 ? 2 : 4;
  int triangle = vertexNumber / (3 * fans), fan = vertexNumber / 3 % fans, k = vertexNumber % 3;
  draw = corners[3 * triangle].draw;
  number = corners[3 * triangle].number;
  one = column = row = depth = dvec3(0);
  volume = 0;
  gl_Position = vec4(0, 0, 0, 1);  // three equal corners cover no pixel

  Vertex polygon[maxVertices];
  for (int j = 0; j < 3; ++j) {
    Corner corner = corners[3 * triangle + j];
    vec3 seen = toView(corner), texcoord = vec3(corner.u, corner.v, corner.clipZ);
    if (!isFinite(seen) || !isFinite(texcoord)) return;
    polygon[j] = Vertex(seen, texcoord);
  }
  int count = 3;
  for (int plane = 0; plane < (view.clipDepth == 0 ? 1 : 3); ++plane) count = clip(plane, count, polygon);
  if (fan + 2 >= count) return;
  Vertex part[3] = Vertex[3](polygon[0], polygon[fan + 1], polygon[fan + 2]);
  dvec3 v[3] = dvec3[3](snap(part[0].seen), snap(part[1].seen), snap(part[2].seen));
  setPlanes(v, dvec3[3](part[0].texcoord, part[1].texcoord, part[2].texcoord),
            dvec2(draws[draw].width, draws[draw].height));
  // z/w is near/w, which is at most 1: the device finds nothing to clip at the near plane.
  gl_Position = vec4(v[k].xy / (128 * view.viewport), view.near, v[k].z);
}
