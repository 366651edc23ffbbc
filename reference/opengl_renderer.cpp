#include "reference/opengl_renderer.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include "raster/clip.h"
#include "raster/input_error.h"

namespace hemitex::reference {
namespace {

using raster::InputError;
using raster::Word;

// --- the device ---

/// An OpenGL context that draws into no window; what is made in it dies with it. Its display stays with the process,
/// since EGL does not count who uses one.
class Context {
 public:
  /// On the first device that has what is needed; nothing where none has.
  static std::unique_ptr<Context> create();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// While it lives, what OpenGL does on this thread it does in the context.
  class Use {
   public:
    explicit Use(const Context& context) : display_(context.display_) {
      if (!eglMakeCurrent(display_, context.surface_, context.surface_, context.context_))
        throw InputError("the OpenGL device does not answer any more");
    }
    ~Use() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    EGLDisplay display_;
  };

 private:
  explicit Context(EGLDisplay display) : display_(display) {}
  bool isMade();

  EGLDisplay display_;
  EGLSurface surface_ = EGL_NO_SURFACE;
  EGLContext context_ = EGL_NO_CONTEXT;
};

bool Context::isMade() {
  constexpr std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                         EGL_NONE};
  constexpr std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  constexpr EGLint profile = EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT;
  constexpr std::array<EGLint, 7> version{
      EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK, profile, EGL_NONE};
  EGLConfig config;
  EGLint configs = 0;
  if (!eglInitialize(display_, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display_, wanted.data(), &config, 1, &configs) || configs == 0)
    return false;
  surface_ = eglCreatePbufferSurface(display_, config, size.data());
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version.data());
  return surface_ != EGL_NO_SURFACE && context_ != EGL_NO_CONTEXT;
}

std::unique_ptr<Context> Context::create() {
  if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) return nullptr;
  std::array<EGLDeviceEXT, 16> devices;
  EGLint count = 0;
  eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
  for (std::size_t d = 0; d < static_cast<std::size_t>(count); ++d) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[d], nullptr);
    if (display == EGL_NO_DISPLAY) continue;
    std::unique_ptr<Context> context(new Context(display));
    if (context->isMade()) return context;
  }
  return nullptr;
}

Context::~Context() {
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
}

/// A limit of the device; the first number where it has one for each axis.
int limitOf(GLenum name) {
  std::array<GLint, 2> values{};
  glGetIntegerv(name, values.data());
  return values[0];
}

// --- the scene ---

/// A vertex of a triangle, its texture coordinates in texels.
struct Corner {
  glm::vec3 position;
  glm::vec2 texel;
};
using Corners = std::array<Corner, 3>;

/// u N, which binary32 may not hold, rounded down: that changes no floor.
float texelPosition(float u, int size) {
  constexpr float largest = std::numeric_limits<float>::max();
  const double exact = std::clamp<double>(static_cast<double>(u) * size, -largest, largest);
  const float nearest = static_cast<float>(exact);
  return static_cast<double>(nearest) > exact ? std::nextafter(nearest, -largest) : nearest;
}

/// The triangles of all draws, one after the other; where a value is not finite, one without any area.
std::vector<Corners> trianglesOf(const raster::DrawList& list) {
  std::vector<Corners> triangles;
  for (const raster::Draw& draw : list.draws) {
    const raster::IndexMap* map = draw.indexMap ? &list.indexMaps[static_cast<std::size_t>(*draw.indexMap)] : nullptr;
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
      Corners& corners = triangles.emplace_back();
      bool isFinite = true;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const glm::vec3& position = list.positions[list.indices[first + k]];
        const glm::vec2& texcoord = list.texcoords[list.indices[first + k]];
        isFinite &= raster::isFinite({position.x, position.y, position.z, texcoord.x, texcoord.y});
        corners[k].position = position;
        if (map) corners[k].texel = {texelPosition(texcoord.x, map->width), texelPosition(texcoord.y, map->height)};
      }
      if (!isFinite) corners = {};
    }
  }
  return triangles;
}

/// Runs of vertices that are drawn together.
struct Runs {
  std::vector<GLint> first;
  std::vector<GLsizei> count;

  void add(GLint from, GLint end) {
    if (from == end) return;
    if (!first.empty() && first.back() + count.back() == from) {
      count.back() += end - from;
      return;
    }
    first.push_back(from);
    count.push_back(end - from);
  }
  void draw() const { glMultiDrawArrays(GL_TRIANGLES, first.data(), count.data(), static_cast<GLsizei>(first.size())); }
};

/// Whether the device may draw `next` together with `draw` before it.
using Joins = std::function<bool(const raster::Draw& draw, const raster::Draw& next)>;

/// Draws that are drawn together, by the first of them.
struct Batch {
  const raster::Draw* draw;
  Runs runs;
};

/// What is left of the draws without the skipped triangles, in the order of trianglesOf.
std::vector<Batch> batchesOf(const raster::DrawList& list, std::span<const std::uint32_t> skipped, const Joins& joins) {
  std::vector<Batch> batches;
  GLint firstVertex = 0;
  for (const raster::Draw& draw : list.draws) {
    if (batches.empty() || !joins(*batches.back().draw, draw)) batches.push_back({&draw, {}});
    Runs& runs = batches.back().runs;
    const GLint endVertex = firstVertex + static_cast<GLint>(draw.count);
    GLint vertex = firstVertex;
    for (auto skip = std::lower_bound(skipped.begin(), skipped.end(), draw.first / 3);
         skip != skipped.end() && 3 * *skip < draw.first + draw.count; ++skip) {
      const GLint hole = firstVertex + static_cast<GLint>(3 * *skip - draw.first);
      runs.add(vertex, hole);
      vertex = hole + 3;
    }
    runs.add(vertex, endVertex);
    firstVertex = endVertex;
  }
  return batches;
}

// --- the paths ---

/// How words lie in textures and framebuffers.
struct PixelFormat {
  GLint storage;
  GLenum format, type;
};

/// What the paths do each in their way; clip coordinates are (x / width, y / width, n, w).
class Pipeline {
 public:
  virtual ~Pipeline() = default;
  virtual PixelFormat pixels() const = 0;
  virtual void clear(Word background) = 0;
  virtual void setView(const raster::Face& face, int width) = 0;
  /// Draws that join are drawn as one.
  virtual bool joins(const raster::Draw& draw, const raster::Draw& next) const = 0;
  virtual void draw(const raster::Draw& draw, const Runs& runs) = 0;
};

void fillBuffer(const void* data, std::size_t bytes, GLenum usage) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
}

/// The offset of a vertex's member, as OpenGL wants it.
const void* at(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

// --- fixed function ---

class FixedFunction final : public Pipeline {
 public:
  explicit FixedFunction(const raster::DrawList& list);
  PixelFormat pixels() const override { return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV}; }
  void clear(Word background) override;
  void setView(const raster::Face& face, int width) override;
  /// An offset is a colour, which is set for a draw; and the fronts of a draw come before its backs.
  bool joins(const raster::Draw&, const raster::Draw&) const override { return false; }
  void draw(const raster::Draw& draw, const Runs& runs) override;

 private:
  /// What the device is given: clip coordinates, and texture coordinates in texels.
  struct Vertex {
    glm::vec4 position;
    glm::vec2 texel;
  };

  std::vector<Corners> triangles_;
  std::vector<Vertex> vertices_;
};

/// Whether adding byte by byte, each clamped, gives the words of the list.
bool addsAsBytes(const raster::DrawList& list) {
  const std::vector<int>& bits = list.format.channelBits;
  const bool areBytes = std::all_of(bits.begin(), bits.end(), [](int width) { return width == 8; });
  if (list.blend == raster::Blend::Replace || (list.blend == raster::Blend::ClampedAdd && areBytes)) return true;
  // Words that share no bits make no carry, whatever the channels are.
  return std::all_of(list.draws.begin(), list.draws.end(), [&list](const raster::Draw& draw) {
    if (!draw.indexMap) return true;
    const std::vector<Word>& words = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)].words;
    return std::all_of(words.begin(), words.end(), [&draw](Word word) { return (word & draw.offset) == 0; });
  });
}

/// OpenGL promises the same depths only for the same corners in the same order. Triangles that coincide must tie, so
/// their order is that of their positions, as far as the winding does not matter.
void sortCorners(Corners& corners, bool isTwoSided) {
  const auto less = [](const Corner& a, const Corner& b) {
    return std::tie(a.position.x, a.position.y, a.position.z) < std::tie(b.position.x, b.position.y, b.position.z);
  };
  if (isTwoSided) {
    std::sort(corners.begin(), corners.end(), less);
  } else {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
  }
}

/// A sample on the border of two texels shows the upper one. What interpolation rounds off a coordinate that is not
/// constant, some units in its last place, must not take the sample below the border: coordinates move up by 16 such
/// units, at most 2^-10 texel.
void liftTexels(Corners& corners) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({corners[0].texel[axis], corners[1].texel[axis], corners[2].texel[axis]});
    if (low == high) continue;
    const float lift = std::min(0x1p-10f, 0x1p-20f * std::max(std::abs(low), std::abs(high)));
    for (Corner& corner : corners) corner.texel[axis] += lift;
  }
}

/// The lowest byte is red.
glm::vec4 colourOf(Word word) { return glm::vec4(word & 255, word >> 8 & 255, word >> 16 & 255, word >> 24) / 255.0f; }

FixedFunction::FixedFunction(const raster::DrawList& list) : triangles_(trianglesOf(list)) {
  if (!addsAsBytes(list))
    throw InputError("fixed-function hardware cannot add words of these channels",
                     "use r8g8b8 or r8g8b8a8 with a clamped add, aligned offsets, or the shader path");
  std::size_t triangle = 0;
  for (const raster::Draw& draw : list.draws)
    for (std::uint32_t i = 0; i < draw.count; i += 3, ++triangle) {
      sortCorners(triangles_[triangle], !draw.back.has_value());
      liftTexels(triangles_[triangle]);
    }

  glDepthFunc(GL_GREATER);
  glDisable(GL_DITHER);
  glShadeModel(GL_FLAT);
  const GLint operation = list.blend == raster::Blend::Replace ? GL_REPLACE : GL_ADD;
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
  glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, operation);
  glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, operation);

  fillBuffer(nullptr, 0, GL_STREAM_DRAW);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_TEXTURE_COORD_ARRAY);
  glVertexPointer(4, GL_FLOAT, sizeof(Vertex), at(offsetof(Vertex, position)));
  glTexCoordPointer(2, GL_FLOAT, sizeof(Vertex), at(offsetof(Vertex, texel)));
}

void FixedFunction::clear(Word background) {
  const glm::vec4 colour = colourOf(background);
  const float farthest = 0;
  glClearBufferfv(GL_COLOR, 0, &colour[0]);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

/// A corner in front of the near plane is put on the sub-pixel that the rules snap it to.
glm::vec4 clipPosition(const raster::Face& face, const raster::ViewVertex& view, int width) {
  const double subPixels = 128.0 * face.resolution;  // a unit of x/w
  const auto across = [&](double x) {
    return view.w < face.nearDistance ? x : std::nearbyint(x / view.w * subPixels) / subPixels * view.w;
  };
  return glm::dvec4(across(view.x) / width, across(view.y) / width, face.nearDistance, view.w);
}

void FixedFunction::setView(const raster::Face& face, int width) {
  vertices_.clear();
  for (const Corners& corners : triangles_) {
    std::array<raster::ViewVertex, 3> views;
    for (std::size_t k = 0; k < 3; ++k) views[k] = raster::transform(face, corners[k].position, corners[k].texel);
    if (!std::all_of(views.begin(), views.end(), raster::isFinite)) views.fill({0, 0, 1, 0, 0});
    for (std::size_t k = 0; k < 3; ++k) vertices_.push_back({clipPosition(face, views[k], width), corners[k].texel});
  }
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(Vertex)), vertices_.data(),
               GL_STREAM_DRAW);
}

void FixedFunction::draw(const raster::Draw& draw, const Runs& runs) {
  const auto drawSide = [&runs](Word colour, bool isTextured, GLenum culled) {
    isTextured ? glEnable(GL_TEXTURE_RECTANGLE) : glDisable(GL_TEXTURE_RECTANGLE);
    culled == GL_NONE ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    if (culled != GL_NONE) glCullFace(culled);
    glColor4fv(&colourOf(colour)[0]);
    runs.draw();
  };
  drawSide(draw.offset, draw.indexMap.has_value(), draw.back ? GL_BACK : GL_NONE);
  if (draw.back) drawSide(*draw.back, false, GL_FRONT);
}

// --- shaders ---

// Raster rules, 2: in binary32, and `precise`, so that nothing is fused or reordered.
constexpr const char* vertexProgram = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texelPosition;
layout(location = 2) in uint drawOffset;
layout(location = 0) uniform vec3 eye;
layout(location = 1) uniform mat3 columns;  // of the matrix with the rows X, Y, W
out vec3 view;
out vec2 texel;
out uint vertexOffset;

void main() {
  precise vec3 d = position - eye;
  precise vec3 sum = (columns[0] * d.x + columns[1] * d.y) + columns[2] * d.z;
  view = sum;
  texel = texelPosition;
  vertexOffset = drawOffset;
}
)";

// Depth and coordinates as planes (Olano and Greer 1997). The point of a triangle with corners v_k that is seen at
// p = (x/w, y/w, 1) is w p = sum(b_k v_k). With c_k the cross product of the two other corners and D = v_0 . c_0 this
// gives b_k = w (c_k . p) / D, and since the b_k sum to one,
//
//   1/w = (sum(c_k) . p) / D,    s = sum(b_k s_k) = (sum(s_k c_k) . p) / (sum(c_k) . p):
//
// three vectors say all. Lengths across are in sub-pixels, whole numbers for corners in front of the near plane.
constexpr const char* geometryProgram = R"(#version 450
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 2) uniform float near;
layout(location = 3) uniform double unit;  // sub-pixels a unit of x/w
layout(location = 4) uniform double width;
in vec3 view[];
in vec2 texel[];
in uint vertexOffset[];
flat out dvec3 one, s, t;
flat out double volume;
flat out uint offset;

dvec3 snapped(vec3 v) {
  dvec2 across = unit * v.xy;
  double w = v.z;
  return dvec3(v.z < near ? across : roundEven(across / w) * w, w);
}

void main() {
  for (int k = 0; k < 3; ++k)
    if (any(isnan(view[k])) || any(isinf(view[k]))) return;
  dvec3 v[3] = dvec3[3](snapped(view[0]), snapped(view[1]), snapped(view[2]));
  dvec3 c[3] = dvec3[3](cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1]));
  for (int k = 0; k < 3; ++k) {
    one = c[0] + c[1] + c[2];
    s = c[0] * texel[0].x + c[1] * texel[1].x + c[2] * texel[2].x;
    t = c[0] * texel[0].y + c[1] * texel[1].y + c[2] * texel[2].y;
    volume = dot(v[0], c[0]);
    offset = vertexOffset[0];
    gl_Position = vec4(v[k].xy / (unit * width), near, v[k].z);
    EmitVertex();
  }
}
)";

// The depth is w itself, which is often a binary32 number where 1/w is none, brought below 1 by a power of two.
constexpr const char* fragmentProgram = R"(#version 450
layout(location = 3) uniform double unit;
layout(location = 5) uniform vec2 corner;  // of the scissor rectangle
layout(location = 7) uniform uint back;
layout(location = 8) uniform bool hasBack;
layout(location = 9) uniform int operation;  // 0: no index map, 1: clamped add, 2: integer add, 3: replace
layout(location = 10) uniform uint allBits;
layout(location = 11) uniform int channels;
layout(location = 12) uniform uint channel[32];  // the bits of each
layout(binding = 0) uniform usampler2DRect map;
flat in dvec3 one, s, t;
flat in double volume;
flat in uint offset;
out uint word;

uint clampedAdd(uint a, uint b) {
  uint sum = 0u;
  for (int c = 0; c < channels; ++c) {
    uint x = a & channel[c], y = b & channel[c];
    sum |= y + min(x, channel[c] - y);
  }
  return sum;
}

void main() {
  dvec3 p = dvec3(256 * (gl_FragCoord.xy + corner) - unit, 1);
  gl_FragDepth = float(volume / dot(one, p)) * 5.421010862427522e-20;  // 2^-64
  word = offset;
  if (hasBack && !gl_FrontFacing) {
    word = back;
  } else if (operation != 0) {
    dvec2 position = dvec2(dot(s, p), dot(t, p)) / dot(one, p);
    uint texel = texelFetch(map, ivec2(clamp(floor(position), dvec2(0), dvec2(textureSize(map) - 1)))).x;
    if (operation == 1) word = clampedAdd(offset, texel);
    if (operation == 2) word = (offset + texel) & allBits;
    if (operation == 3) word = texel;
  }
}
)";

class Shader final : public Pipeline {
 public:
  explicit Shader(const raster::DrawList& list);
  PixelFormat pixels() const override { return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}; }
  void clear(Word background) override;
  void setView(const raster::Face& face, int width) override;
  /// Each vertex brings the offset of its draw along.
  bool joins(const raster::Draw& draw, const raster::Draw& next) const override {
    return draw.back == next.back && draw.indexMap == next.indexMap;
  }
  void draw(const raster::Draw& draw, const Runs& runs) override;

 private:
  GLint operation_;
};

void attach(GLuint program, GLenum stage, const char* text) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
}

GLuint linkPrograms() {
  const GLuint program = glCreateProgram();
  attach(program, GL_VERTEX_SHADER, vertexProgram);
  attach(program, GL_GEOMETRY_SHADER, geometryProgram);
  attach(program, GL_FRAGMENT_SHADER, fragmentProgram);
  glLinkProgram(program);
  GLint isLinked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &isLinked);
  if (isLinked) return program;
  std::array<GLchar, 4096> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw InputError(std::string("the OpenGL device refuses the programs: ") + log.data());
}

Shader::Shader(const raster::DrawList& list) : operation_(1 + static_cast<GLint>(list.blend)) {
  glUseProgram(linkPrograms());
  glUniform1ui(10, raster::backgroundWord(list.format));
  std::vector<GLuint> channels;
  int shift = 0;
  for (const int bits : list.format.channelBits) {
    channels.push_back(raster::backgroundWord({{bits}}) << shift);
    shift += bits;
  }
  glUniform1i(11, static_cast<GLint>(channels.size()));
  glUniform1uiv(12, static_cast<GLsizei>(channels.size()), channels.data());

  glDepthFunc(GL_LESS);
  const std::vector<Corners> triangles = trianglesOf(list);
  fillBuffer(triangles.data(), triangles.size() * sizeof(Corners), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), at(offsetof(Corner, position)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Corner), at(offsetof(Corner, texel)));
  std::vector<Word> offsets;
  for (const raster::Draw& draw : list.draws) offsets.insert(offsets.end(), draw.count, draw.offset);
  fillBuffer(offsets.data(), offsets.size() * sizeof(Word), GL_STATIC_DRAW);
  glEnableVertexAttribArray(2);
  glVertexAttribIPointer(2, 1, GL_UNSIGNED_INT, sizeof(Word), at(0));
}

void Shader::clear(Word background) {
  const float farthest = 1;
  glClearBufferuiv(GL_COLOR, 0, &background);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void Shader::setView(const raster::Face& face, int width) {
  const glm::mat3 columns = glm::transpose(glm::mat3(face.x, face.y, face.w));
  glUniform3fv(0, 1, &face.eye[0]);
  glUniformMatrix3fv(1, 1, GL_FALSE, &columns[0][0]);
  glUniform1f(2, face.nearDistance);
  glUniform1d(3, 128.0 * face.resolution);
  glUniform1d(4, width);
  glUniform2f(5, static_cast<float>(face.scissor.column), static_cast<float>(face.scissor.row));
}

void Shader::draw(const raster::Draw& draw, const Runs& runs) {
  glUniform1ui(7, draw.back.value_or(0));
  glUniform1i(8, draw.back.has_value());
  glUniform1i(9, draw.indexMap ? operation_ : 0);
  runs.draw();
}

std::unique_ptr<Pipeline> makePipeline(const raster::DrawList& list, OpenGlPath path) {
  if (path == OpenGlPath::FixedFunction) return std::make_unique<FixedFunction>(list);
  return std::make_unique<Shader>(list);
}

/// Textures with the words of the index maps, in their order.
std::vector<GLuint> makeTextures(const std::vector<raster::IndexMap>& maps, const PixelFormat& pixels) {
  const int largest = limitOf(GL_MAX_RECTANGLE_TEXTURE_SIZE);
  std::vector<GLuint> textures(maps.size());
  glGenTextures(static_cast<GLsizei>(textures.size()), textures.data());
  for (std::size_t m = 0; m < maps.size(); ++m) {
    if (std::max(maps[m].width, maps[m].height) > largest)
      throw InputError("index map " + std::to_string(m) + " is larger than the textures of the OpenGL device",
                       "use at most " + std::to_string(largest) + " texels a side");
    glBindTexture(GL_TEXTURE_RECTANGLE, textures[m]);
    glTexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_RECTANGLE, 0, pixels.storage, maps[m].width, maps[m].height, 0, pixels.format, pixels.type,
                 maps[m].words.data());
  }
  return textures;
}

}  // namespace

// --- drawing ---

class OpenGlRenderer::Implementation {
 public:
  Implementation(const raster::DrawList& list, OpenGlPath path);
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers);

 private:
  void setSize(int width, int height);
  void setView(const raster::Face& face);
  void draw(const raster::Face& face, const std::vector<Batch>& batches, raster::ItemBuffer& buffer);

  raster::DrawList list_;
  std::unique_ptr<Context> context_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<GLuint> textures_;
  GLuint colour_ = 0, depth_ = 0;
};

OpenGlRenderer::Implementation::Implementation(const raster::DrawList& list, OpenGlPath path)
    : list_(list), context_(Context::create()) {
  raster::validate(list);
  if (!context_)
    throw InputError("no OpenGL device answers through EGL",
                     "install a driver with the compatibility profile of OpenGL 4.5; Mesa's needs no graphics card");
  const Context::Use use(*context_);
  pipeline_ = makePipeline(list, path);
  textures_ = makeTextures(list.indexMaps, pipeline_->pixels());
  glEnable(GL_DEPTH_TEST);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);

  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenRenderbuffers(1, &colour_);
  glGenRenderbuffers(1, &depth_);
}

/// Renderbuffers as large as the scissor rectangle.
void OpenGlRenderer::Implementation::setSize(int width, int height) {
  const auto attach = [=](GLuint buffer, GLenum attachment, GLint storage) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, static_cast<GLenum>(storage), width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(colour_, GL_COLOR_ATTACHMENT0, pipeline_->pixels().storage);
  attach(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
}

/// The device cuts triangles at the sides of its viewport: it is as much wider than the face as the rules' guard band,
/// or as the device allows.
void OpenGlRenderer::Implementation::setView(const raster::Face& face) {
  const int resolution = face.resolution, largest = limitOf(GL_MAX_VIEWPORT_DIMS);
  if (resolution > largest)
    throw InputError("a face is larger than the viewport of the OpenGL device",
                     "use a resolution of at most " + std::to_string(largest));
  int width = 8;
  while (width * resolution > largest) width /= 2;
  const int beside = (width - 1) * resolution / 2;
  glViewport(-beside - face.scissor.column, -beside - face.scissor.row, width * resolution, width * resolution);
  // Raster rules, 5: a triangle faces the eye where its area and the determinant differ in sign. OpenGL calls a
  // negative area, taken over columns and rows as well, clockwise.
  glFrontFace(raster::determinant(face) > 0 ? GL_CW : GL_CCW);
  pipeline_->setView(face, width);
}

void OpenGlRenderer::Implementation::draw(const raster::Face& face, const std::vector<Batch>& batches,
                                          raster::ItemBuffer& buffer) {
  buffer.resize(face.scissor);
  setSize(buffer.width, buffer.height);
  setView(face);
  pipeline_->clear(raster::backgroundWord(list_.format));
  for (const Batch& batch : batches) {
    const raster::Draw& draw = *batch.draw;
    if (draw.indexMap) glBindTexture(GL_TEXTURE_RECTANGLE, textures_[static_cast<std::size_t>(*draw.indexMap)]);
    pipeline_->draw(draw, batch.runs);
  }
  const PixelFormat pixels = pipeline_->pixels();
  glReadPixels(0, 0, buffer.width, buffer.height, pixels.format, pixels.type, buffer.words.data());
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw InputError("the OpenGL device fails with error " + std::to_string(error));
}

void OpenGlRenderer::Implementation::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                                          std::vector<raster::ItemBuffer>& buffers) {
  for (const raster::Face& face : faces) raster::validate(face);
  const Context::Use use(*context_);
  const std::vector<Batch> batches =
      batchesOf(list_, skipped,
                [this](const raster::Draw& draw, const raster::Draw& next) { return pipeline_->joins(draw, next); });
  buffers.resize(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) draw(faces[i], batches, buffers[i]);
}

OpenGlRenderer::OpenGlRenderer(const raster::DrawList& list, OpenGlPath path)
    : implementation_(std::make_unique<Implementation>(list, path)) {}

OpenGlRenderer::~OpenGlRenderer() = default;

void OpenGlRenderer::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers) {
  implementation_->draw(faces, skipped, buffers);
}

std::optional<std::string> openGlDevice() {
  const std::unique_ptr<Context> context = Context::create();
  if (!context) return {};
  const Context::Use use(*context);
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return text(GL_VENDOR) + ", " + text(GL_RENDERER) + ", " + text(GL_VERSION);
}

}  // namespace hemitex::reference
