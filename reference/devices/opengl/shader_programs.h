/// The shaders for OpenGlPath::Shader and OpenGlPath::Plain, and the locations of their inputs.
///
/// OpenGlPath::Shader: the vertex shader transforms a corner to the view. The geometry shader computes planes from a
/// triangle's corners. The fragment shader computes depth and texel from these, in double precision, and blends the
/// item ID.
#pragma once

#include <epoxy/gl.h>

#include "raster/interface/draw_list.h"

namespace hemitex::reference {

/// Inputs per vertex.
struct VertexAttribute {
  static constexpr GLuint position = 0;    ///< vec3
  static constexpr GLuint texcoord = 1;    ///< vec2
  static constexpr GLuint drawOffset = 2;  ///< uint
};

/// Inputs per call.
struct Uniform {
  // Per view.
  static constexpr GLint eye = 0;      ///< vec3
  static constexpr GLint columns = 1;  ///< mat3, of the matrix with the rows X, Y, W
  static constexpr GLint near = 2;     ///< float
  static constexpr GLint unit = 3;     ///< double: sub-pixels per unit of x/w
  static constexpr GLint width = 4;    ///< double: width of the viewport, in faces
  static constexpr GLint corner = 5;   ///< vec2, of the scissor rectangle
  // Per draw.
  static constexpr GLint back = 7;       ///< uint
  static constexpr GLint hasBack = 8;    ///< bool
  static constexpr GLint operation = 9;  ///< int: 0 without an index map, else 1 + raster::Blend
  // Per item ID format.
  static constexpr GLint allBits = 10;   ///< uint
  static constexpr GLint channels = 11;  ///< int: number of channels
  static constexpr GLint channel = 12;   ///< uint[32]: bits of each channel
};

/// Input that only OpenGlPath::Plain has, next to those per item ID format and those of back-facing triangles.
struct PlainUniform {
  static constexpr GLint matrix = 0;  ///< mat4
};

/// Compile and link the shaders of a path to one program. Require a current context. Throw InputError with the message
/// of the driver if it rejects them.
GLuint linkShaderPrograms();
/// `clamps`: sums of offset and texel are clamped per channel.
GLuint linkPlainPrograms(bool clamps);

/// Set the inputs per item ID format, and those per draw, of the program in use. OpenGlPath::Plain has no operation.
void setFormat(const raster::IdFormat& format);
void setBack(const raster::Draw& draw);
void setOperation(const raster::Draw& draw, raster::Blend blend);

}  // namespace hemitex::reference
