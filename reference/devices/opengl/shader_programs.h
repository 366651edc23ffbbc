/// The shader programs of OpenGlPath::Shader and OpenGlPath::Plain, and the locations of their inputs. Those of the
/// first are the shaders of all devices (reference/devices/item_ids.vert and .frag), with the inputs of
/// shader_inputs.h.
#pragma once

#include <epoxy/gl.h>

#include "raster/interface/draw_list.h"

namespace hemitex::reference {

/// Inputs of OpenGlPath::Plain per vertex.
struct VertexAttribute {
  static constexpr GLuint position = 0;    ///< vec3
  static constexpr GLuint texcoord = 1;    ///< vec2
  static constexpr GLuint drawOffset = 2;  ///< uint
};

/// Inputs of OpenGlPath::Plain per call.
struct Uniform {
  static constexpr GLint matrix = 0;  ///< mat4, per view
  // Per draw.
  static constexpr GLint back = 7;     ///< uint
  static constexpr GLint hasBack = 8;  ///< bool
  // Per item ID format.
  static constexpr GLint allBits = 10;   ///< uint
  static constexpr GLint channels = 11;  ///< int: number of channels
  static constexpr GLint channel = 12;   ///< uint[32]: bits of each channel
};

/// Compile and link the shaders of a path to one program. Require a current context. Throw InputError with the message
/// of the driver if it rejects them.
GLuint linkShaderPrograms();
/// `clamps`: sums of offset and texel are clamped per channel.
GLuint linkPlainPrograms(bool clamps);

/// Set the inputs per item ID format, and those per draw, of the plain program in use.
void setFormat(const raster::IdFormat& format);
void setBack(const raster::Draw& draw);

}  // namespace hemitex::reference
