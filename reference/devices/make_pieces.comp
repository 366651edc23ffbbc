// Transforms, clips and snaps the triangles of faces: an invocation per triangle and face.

layout(local_size_x = 64) in;

bool isOutside(vec3 a, vec3 b, vec3 c) {
  return min(min(a.z, b.z), c.z) >= view.near &&
         (all(greaterThan(vec3(a.x, b.x, c.x), vec3(a.z, b.z, c.z))) ||
          all(lessThan(vec3(a.x, b.x, c.x), -vec3(a.z, b.z, c.z))) ||
          all(greaterThan(vec3(a.y, b.y, c.y), vec3(a.z, b.z, c.z))) ||
          all(lessThan(vec3(a.y, b.y, c.y), -vec3(a.z, b.z, c.z))));
}

void addPiece(uint f, uint triangle, Vertex part[3]) {
  Piece piece;
  for (int k = 0; k < 3; ++k) {
    dvec2 s = snapped(clamp(part[k].seen.xy / part[k].seen.z, dvec2(-8), dvec2(8)));
    ivec2 first = ivec2(256 * view.scissor + 128 - 128 * view.size);
    piece.x[k] = int(s.x) - first.x;
    piece.y[k] = int(s.y) - first.y;
  }
  double area = double(piece.x[1] - piece.x[0]) * double(piece.y[2] - piece.y[0]) -
                double(piece.y[1] - piece.y[0]) * double(piece.x[2] - piece.x[0]);
  if (area == 0) return;
  piece.triangle = triangle;
  piece.isBack = uint((area > 0) == (faces[f].isMirrored == 0));
  if (area < 0) {
    area = -area;
    Vertex second = part[1];
    part[1] = part[2];
    part[2] = second;
    int x = piece.x[1], y = piece.y[1];
    piece.x[1] = piece.x[2];
    piece.y[1] = piece.y[2];
    piece.x[2] = x;
    piece.y[2] = y;
  }
  ivec2 low = ivec2(min(min(piece.x[0], piece.x[1]), piece.x[2]), min(min(piece.y[0], piece.y[1]), piece.y[2]));
  ivec2 high = ivec2(max(max(piece.x[0], piece.x[1]), piece.x[2]), max(max(piece.y[0], piece.y[1]), piece.y[2]));
  ivec2 from = max((low + 255) >> 8, ivec2(0)), to = min(high >> 8, ivec2(faces[f].width, faces[f].height) - 1);
  if (any(greaterThan(from, to))) return;
  for (int k = 0; k < 3; ++k) {
    precise double one = part[(k + 1) % 3].seen.z * part[(k + 2) % 3].seen.z;
    piece.one[k] = one;
    piece.w[k] = part[k].seen.z;
    piece.u[k] = part[k].texcoord.x;
    piece.v[k] = part[k].texcoord.y;
  }
  precise double volume = 1 / (part[0].seen.z * piece.one[0] * area);
  piece.volume = volume;
  uint place = f * piecesPerTriangle * triangles + atomicAdd(counts[f], 1);
  boxes[place] = uvec2(from.x | to.x << 16, from.y | to.y << 16);
  pieces[place] = piece;
}

void main() {
  uint triangle = gl_GlobalInvocationID.x, f = gl_GlobalInvocationID.y;
  if (triangle >= triangles) return;
  if ((skipped[faces[f].drawing * ((triangles + 31) / 32) + triangle / 32] >> triangle % 32 & 1) != 0) return;
  view = faces[f].view;
  vec3 seen[3];
  Vertex polygon[maxVertices];
  for (int k = 0; k < 3; ++k) {
    Corner corner = corners[3 * triangle + k];
    seen[k] = toView(corner);
    vec3 texcoord = vec3(corner.u, corner.v, 0);
    if (!isFinite(seen[k]) || !isFinite(texcoord)) return;
    polygon[k] = Vertex(seen[k], texcoord);
  }
  if (isOutside(seen[0], seen[1], seen[2])) return;
  int count = clip(0, 3, polygon);
  for (int side = 3; side < 7; ++side) count = clip(side, count, polygon);
  for (int fan = 0; fan + 2 < count; ++fan)
    addPiece(f, triangle, Vertex[3](polygon[0], polygon[fan + 1], polygon[fan + 2]));
}
