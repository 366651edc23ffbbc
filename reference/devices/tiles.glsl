// What the compute shaders that draw share: the twin of tile_drawing.cpp. They draw faces by the rules alone, with
// integers and double precision: one clips and snaps triangles, the other finds the item ID of each pixel.

struct Face {
  View view;
  uint width, height;  // of the scissor rectangle
  uint isMirrored;     // det(X, Y, W) < 0
  uint drawing;        // which triangles it leaves out
};

// A part of a triangle that is left by clipping. Its corners k are in sub-pixels from the sample of the first pixel of
// the scissor rectangle, such that its area is positive. Let e_k(p) be twice the area of the triangle of p and the side
// opposite of corner k: an integer. Let g_k be the product of the w of the two other corners. Then
//
//   1/w = sum(e_k(p) g_k) / (area w_0 w_1 w_2),  u = sum(e_k(p) g_k u_k) / sum(e_k(p) g_k).
//
struct Piece {
  int x[3], y[3];
  uint triangle;  // its number in the draw order
  uint isBack;
  double w[3], u[3], v[3];
  double one[3], volume;  // g_k and 1 / (area w_0 w_1 w_2), rounded
};

layout(std430, binding = 3) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 4) readonly buffer Skipped { uint skipped[]; };  // a bit per triangle of each drawing
layout(std430, binding = 5) buffer Counts { uint counts[]; };             // of the pieces of each face
layout(std430, binding = 6) buffer Boxes { uvec2 boxes[]; };  // of pieces: first and last column, first and last row
layout(std430, binding = 7) buffer Pieces { Piece pieces[]; };
layout(binding = 8, r32ui) uniform writeonly uimage2DArray ids;  // a layer per face

layout(push_constant) uniform List {
  uint triangles;
  uint background;
};

View view;                  // of the face
const int maxVertices = 8;  // of a clipped triangle: each of five planes adds at most one
const uint piecesPerTriangle = 6;  // at most, of eight vertices
