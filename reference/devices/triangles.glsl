// A triangle in a view, by the rules: its corners as they are seen, clipped, and snapped.

struct Vertex {
  dvec3 seen;      // x, y, w
  dvec3 texcoord;  // u, v and z
};

// docs/item-buffers.md, "view": in binary32, and `precise`, so that nothing is fused or reordered.
vec3 toView(Corner corner) {
  precise vec3 d = vec3(corner.x, corner.y, corner.z) - view.eye;
  vec3 x = view.x, y = view.y, w = view.w;
  precise vec3 seen = (vec3(x.x, y.x, w.x) * d.x + vec3(x.y, y.y, w.y) * d.y) + vec3(x.z, y.z, w.z) * d.z;
  return seen;
}

bool isFinite(vec3 v) { return !any(isnan(v)) && !any(isinf(v)); }

// docs/item-buffers.md, "clip": how far a vertex is inside the near plane (0), a plane of z (1 and 2), or a side.
double distanceTo(int plane, Vertex v) {
  precise double z = v.texcoord.z, w = v.seen.z;
  if (plane == 3) return 8 * w - v.seen.x;
  if (plane == 4) return 8 * w + v.seen.x;
  if (plane == 5) return 8 * w - v.seen.y;
  if (plane == 6) return 8 * w + v.seen.y;
  if (plane == 0) return w - view.near;
  if (plane == 2) return w - z;
  return view.clipDepth == 1 ? z : w + z;
}

// Where the edge from a vertex inside of a plane to one outside crosses it.
Vertex crossing(int plane, Vertex inside, Vertex outside) {
  precise double a = distanceTo(plane, inside);
  precise double t = a / (a - distanceTo(plane, outside));
  precise dvec3 seen = inside.seen + t * (outside.seen - inside.seen);
  precise dvec3 texcoord = inside.texcoord + t * (outside.texcoord - inside.texcoord);
  return Vertex(dvec3(seen.xy, plane == 0 ? view.near : max(seen.z, view.near)), texcoord);
}

// Clips a polygon at the plane. Returns its number of vertices.
int clip(int plane, int count, inout Vertex polygon[maxVertices]) {
  Vertex whole[maxVertices] = polygon;
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    Vertex from = whole[k], to = whole[(k + 1) % count];
    bool fromInside = distanceTo(plane, from) >= 0, toInside = distanceTo(plane, to) >= 0;
    if (fromInside && kept < maxVertices) polygon[kept++] = from;
    if (fromInside != toInside && kept < maxVertices)
      polygon[kept++] = fromInside ? crossing(plane, from, to) : crossing(plane, to, from);
  }
  return kept;
}

// docs/item-buffers.md, "snap": in sub-pixels from the middle of the picture, of (x, y)/w.
dvec2 snapped(dvec2 q) {
  dvec2 unit = 128 * view.size;
  return roundEven((q + 1) * unit) - unit + view.sampleOffset;
}

