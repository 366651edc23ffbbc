// Finds the item IDs of tiles of 16 x 16 pixels: a workgroup per tile, an invocation per pixel. The invocations look
// through the boxes of all pieces of the face together, 256 at a time. Then each tests those in the tile.

layout(local_size_x = 16, local_size_y = 16) in;
shared uint found[256], foundCount;

// The nearest piece at the pixel so far.
struct Nearest {
  double inverse;  // 1/w
  uint piece, triangle;
};

// docs/item-buffers.md, "cover": the values e_k of a pixel inside are above 0, or 0 on a top or a left side.
bool covers(Piece piece, ivec2 p, out dvec3 e) {
  for (int k = 0; k < 3; ++k) {
    int a = (k + 1) % 3, b = (k + 2) % 3;
    double dx = double(piece.x[b] - piece.x[a]), dy = double(piece.y[b] - piece.y[a]);
    e[k] = dx * double(p.y - piece.y[a]) - dy * double(p.x - piece.x[a]);
    if (e[k] < 0 || (e[k] == 0 && !(dy < 0 || (dy == 0 && dx > 0)))) return false;
  }
  return true;
}

double sumOf(dvec3 e, double values[3]) {
  precise double sum = e.x * values[0] + e.y * values[1] + e.z * values[2];
  return sum;
}

// Equal depths may differ in their last bits, and so may a texture coordinate and the border that it lies on. There,
// numbers are sums of two doubles (pairs.glsl). What differs by less than 2^-90 of its size is equal.
const double undecided = 1.7763568394002505e-15;       // 2^-49
const double undecidedTexel = 9.094947017729282e-13;   // 2^-40
const double equal = 8.077935669463161e-28;            // 2^-90

// e_k g_k.
Pair weight(Piece piece, dvec3 e, int k) {
  return times(product(piece.w[(k + 1) % 3], piece.w[(k + 2) % 3]), e[k]);
}

// 1/w times the area and all w.
Pair scaledInverse(Piece piece, dvec3 e) {
  return add(add(weight(piece, e, 0), weight(piece, e, 1)), weight(piece, e, 2));
}

// The area times all w.
Pair scale(Piece piece, dvec3 e) {
  return times(times(product(piece.w[0], piece.w[1]), piece.w[2]), e.x + e.y + e.z);
}

// The sign of the difference of 1/w of two pieces at pixel p.
int nearer(uint first, uint second, ivec2 p) {
  dvec3 e, f;
  Piece a = pieces[first], b = pieces[second];
  covers(a, p, e);
  covers(b, p, f);
  Pair ofA = times(scaledInverse(a, e), scale(b, f)), ofB = times(scaledInverse(b, f), scale(a, e));
  double difference = add(ofA, Pair(-ofB.high, -ofB.low)).high;
  return abs(difference) <= equal * ofA.high ? 0 : difference > 0 ? 1 : -1;
}

void test(uint place, ivec2 p, inout Nearest nearest) {
  dvec3 e;
  Piece piece = pieces[place];
  if (!covers(piece, p, e)) return;
  double inverse = sumOf(e, piece.one) * piece.volume, difference = inverse - nearest.inverse;
  int sign = difference > 0 ? 1 : -1;
  if (abs(difference) <= undecided * inverse) sign = nearer(place, nearest.piece, p);
  // Of equal depths, the triangle drawn first stays.
  if (sign == 0 ? piece.triangle < nearest.triangle : sign > 0) nearest = Nearest(inverse, place, piece.triangle);
}

// floor(size sum(e_k g_k t_k) / sum(e_k g_k)).
double floorOf(Piece piece, dvec3 e, double t[3], int size) {
  dvec3 weights = e * dvec3(piece.one[0], piece.one[1], piece.one[2]);
  double position = size * sumOf(weights, t) / (weights.x + weights.y + weights.z), border = floor(position + 0.5);
  double largest = max(max(abs(t[0]), abs(t[1])), abs(t[2]));
  if (abs(position - border) > undecidedTexel * size * largest) return floor(position);
  Pair beyond = Pair(0, 0);
  double all = 0;
  for (int k = 0; k < 3; ++k) {
    Pair part = times(weight(piece, e, k), add(product(t[k], size), Pair(-border, 0)));
    beyond = add(beyond, part);
    all += abs(part.high);
  }
  return beyond.high >= -equal * all ? border : border - 1;
}

uint idOf(uint place, ivec2 p) {
  dvec3 e;
  Piece piece = pieces[place];
  covers(piece, p, e);
  Draw draw = draws[corners[3 * piece.triangle].draw];
  if (piece.isBack != 0 && draw.hasBack != 0) return draw.back;
  if (draw.width == 0) return draw.offset;
  dvec2 position = dvec2(floorOf(piece, e, piece.u, draw.width), floorOf(piece, e, piece.v, draw.height));
  uvec2 texel = uvec2(clamp(position, dvec2(0), dvec2(draw.width, draw.height) - 1));
  return blended(draw.offset, texels[draw.firstTexel + texel.y * uint(draw.width) + texel.x]);
}

void main() {
  uint f = gl_GlobalInvocationID.z, self = gl_LocalInvocationIndex;
  uvec2 first = 16 * gl_WorkGroupID.xy, pixel = gl_GlobalInvocationID.xy;
  uint width = faces[f].width, height = faces[f].height;
  if (first.x >= width || first.y >= height) return;
  view = faces[f].view;
  ivec2 p = 256 * ivec2(pixel);
  Nearest nearest = Nearest(0, ~0u, ~0u);
  uint firstPiece = f * piecesPerTriangle * triangles, count = counts[f];
  for (uint begin = 0; begin < count; begin += 256) {
    if (self == 0) foundCount = 0;
    barrier();
    uint place = firstPiece + begin + self;
    if (begin + self < count) {
      uvec2 box = boxes[place], from = box & 0xffffu, to = box >> 16;
      if (all(lessThan(from, first + 16)) && all(greaterThanEqual(to, first))) found[atomicAdd(foundCount, 1)] = place;
    }
    barrier();
    for (uint i = 0; i < foundCount; ++i) test(found[i], p, nearest);
    barrier();
  }
  if (pixel.x >= width || pixel.y >= height) return;
  uint id = nearest.piece == ~0u ? background : idOf(nearest.piece, p);
  imageStore(ids, ivec3(pixel, f), uvec4(id));
}
