#include "reference/devices/opengl/opengl_renderer.h"

#include <algorithm>
#include <map>
#include <utility>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/devices/batches.h"
#include "reference/devices/opengl/context.h"
#include "reference/devices/opengl/fixed_function_pipeline.h"
#include "reference/devices/opengl/pipeline.h"
#include "reference/devices/opengl/plain_pipeline.h"
#include "reference/devices/opengl/shader_pipeline.h"

namespace hemitex::reference {
namespace {

using raster::InputError;

std::unique_ptr<OpenGlPipeline> makePipeline(const raster::DrawList& list, OpenGlPath path) {
  if (path == OpenGlPath::FixedFunction) return makeFixedFunction(list);
  return path == OpenGlPath::Shader ? makeShader(list) : makePlain(list);
}

GLuint makeTexture(const raster::IndexMap& map, const OpenGlPipeline& pipeline) {
  const OpenGlPixels pixels = pipeline.pixels();
  const GLenum target = pipeline.textureTarget();
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(target, texture);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexImage2D(target, 0, pixels.storage, map.width, map.height, 0, pixels.format, pixels.type, map.ids.data());
  return texture;
}

/// Textures with the item IDs of the index maps, in their order, and one with a single texel 0.
std::vector<GLuint> makeTextures(const std::vector<raster::IndexMap>& maps, const OpenGlPipeline& pipeline) {
  const GLenum target = pipeline.textureTarget();
  const int largest = openGlLimit(target == GL_TEXTURE_2D ? GL_MAX_TEXTURE_SIZE : GL_MAX_RECTANGLE_TEXTURE_SIZE);
  std::vector<GLuint> textures;
  for (const raster::IndexMap& map : maps) {
    if (std::max(map.width, map.height) > largest)
      throw InputError(
          "index map " + std::to_string(textures.size()) + " is larger than the textures of the OpenGL device",
          "use at most " + std::to_string(largest) + " texels a side");
    textures.push_back(makeTexture(map, pipeline));
  }
  textures.push_back(makeTexture({1, 1, {0}}, pipeline));
  return textures;
}

/// A framebuffer and its renderbuffers.
struct Framebuffer {
  GLuint framebuffer = 0, colour = 0, depth = 0;
};

/// Makes and binds a framebuffer.
Framebuffer makeFramebuffer(int width, int height, GLint colourStorage) {
  Framebuffer made;
  glGenFramebuffers(1, &made.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, made.framebuffer);
  const auto attach = [=](GLuint& buffer, GLenum attachment, GLint storage) {
    glGenRenderbuffers(1, &buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, static_cast<GLenum>(storage), width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(made.colour, GL_COLOR_ATTACHMENT0, colourStorage);
  attach(made.depth, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
  return made;
}

}  // namespace

class OpenGlRenderer::Implementation {
 public:
  Implementation(const raster::DrawList& list, OpenGlPath path);
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers);

 private:
  void setSize(int width, int height);
  void deleteFramebuffers();
  void setView(const raster::Face& face);
  void draw(const raster::Face& face, const std::vector<DrawBatch>& batches, raster::ItemBuffer& buffer);

  raster::DrawList list_;
  std::unique_ptr<OpenGlContext> context_;
  std::unique_ptr<OpenGlPipeline> pipeline_;
  std::vector<GLuint> textures_;  ///< one per index map, and the last for draws without; none if not used
  std::map<std::pair<int, int>, Framebuffer> framebuffers_;  ///< by width and height
};

OpenGlRenderer::Implementation::Implementation(const raster::DrawList& list, OpenGlPath path)
    : list_(list), context_(OpenGlContext::create()) {
  raster::validate(list);
  if (!context_)
    throw InputError("no OpenGL device answers through EGL",
                     "install a driver with the compatibility profile of OpenGL 4.5; Mesa's needs no graphics card");
  const OpenGlContext::Use use(*context_);
  pipeline_ = makePipeline(list_, path);
  if (pipeline_->textureTarget() != GL_NONE) textures_ = makeTextures(list.indexMaps, *pipeline_);
  glEnable(GL_DEPTH_TEST);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

/// Binds a framebuffer of the size of the scissor rectangle. The faces of a hemicube have two sizes, so those of some
/// sizes are kept.
void OpenGlRenderer::Implementation::setSize(int width, int height) {
  constexpr std::size_t maxKept = 16;
  const auto known = framebuffers_.find({width, height});
  if (known != framebuffers_.end()) return glBindFramebuffer(GL_FRAMEBUFFER, known->second.framebuffer);
  if (framebuffers_.size() == maxKept) deleteFramebuffers();
  framebuffers_[{width, height}] = makeFramebuffer(width, height, pipeline_->pixels().storage);
}

void OpenGlRenderer::Implementation::deleteFramebuffers() {
  for (const auto& [size, framebuffer] : framebuffers_) {
    glDeleteFramebuffers(1, &framebuffer.framebuffer);
    glDeleteRenderbuffers(1, &framebuffer.colour);
    glDeleteRenderbuffers(1, &framebuffer.depth);
  }
  framebuffers_.clear();
}

/// The device clips triangles at the sides of its viewport. So the viewport is as wide as the pipeline asks, or as the
/// device allows.
void OpenGlRenderer::Implementation::setView(const raster::Face& face) {
  const int resolution = face.resolution, largest = openGlLimit(GL_MAX_VIEWPORT_DIMS);
  if (resolution > largest)
    throw InputError("a face is larger than the viewport of the OpenGL device",
                     "use a resolution of at most " + std::to_string(largest));
  int width = pipeline_->viewportWidth();
  while (width * resolution > largest) width /= 2;
  const int beside = (width - 1) * resolution / 2;
  glViewport(-beside - face.scissor.column, -beside - face.scissor.row, width * resolution, width * resolution);
  // docs/item-buffers.md, "facing": front-facing if the area and the determinant differ in sign. OpenGL also computes
  // the area in columns and rows, and calls a negative area clockwise.
  glFrontFace(raster::determinant(face) > 0 ? GL_CW : GL_CCW);
  pipeline_->setView(face, width);
}

void OpenGlRenderer::Implementation::draw(const raster::Face& face, const std::vector<DrawBatch>& batches,
                                          raster::ItemBuffer& buffer) {
  buffer.resize(face.scissor);
  setSize(buffer.width, buffer.height);
  setView(face);
  pipeline_->clear(raster::backgroundId(list_.format));
  for (const DrawBatch& batch : batches) {
    const raster::Draw& draw = *batch.draw;
    const std::size_t map = draw.indexMap ? static_cast<std::size_t>(*draw.indexMap) : textures_.size() - 1;
    if (!textures_.empty()) glBindTexture(pipeline_->textureTarget(), textures_[map]);
    pipeline_->draw(draw, batch.runs);
  }
  const OpenGlPixels pixels = pipeline_->pixels();
  glReadPixels(0, 0, buffer.width, buffer.height, pixels.format, pixels.type, buffer.ids.data());
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw InputError("the OpenGL device fails with error " + std::to_string(error));
}

void OpenGlRenderer::Implementation::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                                          std::vector<raster::ItemBuffer>& buffers) {
  for (const raster::Face& face : faces) raster::validate(face);
  const OpenGlContext::Use use(*context_);
  const std::vector<DrawBatch> batches =
      batchesOf(list_, skipped,
                [this](const raster::Draw& draw, const raster::Draw& next) { return pipeline_->joins(draw, next); });
  buffers.resize(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) draw(faces[i], batches, buffers[i]);
}

OpenGlRenderer::OpenGlRenderer(const raster::DrawList& list, OpenGlPath path)
    : implementation_(std::make_unique<Implementation>(list, path)) {}

OpenGlRenderer::~OpenGlRenderer() = default;

void OpenGlRenderer::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  implementation_->draw(faces, skipped, buffers);
  raster::parallelFor(faces.size(), drawn);
}

}  // namespace hemitex::reference
