/// The programs that run on the device where OpenGlPath::Shader draws, and the numbers under which they take their
/// input.
///
/// The vertex program brings a corner into the view, the geometry program makes planes of a triangle's corners, and the
/// fragment program gets depth and texel from these, in binary64, and blends the item ID.
#pragma once

#include <epoxy/gl.h>

namespace hemitex::reference {

/// What each vertex brings along.
struct VertexAttribute {
  static constexpr GLuint position = 0;    ///< vec3
  static constexpr GLuint texel = 1;       ///< vec2
  static constexpr GLuint drawOffset = 2;  ///< uint
};

/// What is the same for all vertices of a call.
struct Uniform {
  // Of a view.
  static constexpr GLint eye = 0;      ///< vec3
  static constexpr GLint columns = 1;  ///< mat3, of the matrix with the rows X, Y, W
  static constexpr GLint near = 2;     ///< float
  static constexpr GLint unit = 3;     ///< double: sub-pixels a unit of x/w
  static constexpr GLint width = 4;    ///< double: of the viewport, in faces
  static constexpr GLint corner = 5;   ///< vec2, of the scissor rectangle
  // Of a draw.
  static constexpr GLint back = 7;       ///< uint
  static constexpr GLint hasBack = 8;    ///< bool
  static constexpr GLint operation = 9;  ///< int: 0 without an index map, else 1 more than raster::Blend
  // Of an item ID format.
  static constexpr GLint allBits = 10;   ///< uint
  static constexpr GLint channels = 11;  ///< int: how many
  static constexpr GLint channel = 12;   ///< uint[32]: the bits of each
};

/// The programs compiled and linked into one, in the context in use. Throws InputError with what the driver says where
/// it refuses them.
GLuint linkOpenGlPrograms();

}  // namespace hemitex::reference
