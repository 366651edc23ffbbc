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

// Equal depths may differ in their last bits. Then the triangle drawn first stays.
void test(uint place, ivec2 p, inout Nearest nearest) {
  dvec3 e;
  Piece piece = pieces[place];
  if (!covers(piece, p, e)) return;
  double inverse = sumOf(e, piece.one) * piece.volume, difference = inverse - nearest.inverse;
  bool isEqual = abs(difference) <= 1.7763568394002505e-15 * inverse;  // 2^-49
  if (isEqual ? piece.triangle < nearest.triangle : difference > 0) nearest = Nearest(inverse, place, piece.triangle);
}

uint idOf(uint place, ivec2 p) {
  dvec3 e;
  Piece piece = pieces[place];
  covers(piece, p, e);
  Draw draw = draws[corners[3 * piece.triangle].draw];
  if (piece.isBack != 0 && draw.hasBack != 0) return draw.back;
  if (draw.width == 0) return draw.offset;
  dvec2 position = dvec2(sumOf(e, piece.column), sumOf(e, piece.row)) / sumOf(e, piece.one);
  uvec2 texel = uvec2(clamp(floor(position), dvec2(0), dvec2(draw.width, draw.height) - 1));
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
