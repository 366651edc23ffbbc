#include "reference/devices/opengl/opengl_renderer.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "raster/interface/depth_test.h"
#include "reference/devices/batches.h"
#include "reference/devices/opengl/context.h"
#include "reference/devices/opengl/pipeline.h"
#include "reference/devices/passed_samples.h"
#include "reference/devices/viewport.h"

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

GLint depthStorage(raster::DepthPrecision precision) {
  if (precision == raster::DepthPrecision::Unorm16) return GL_DEPTH_COMPONENT16;
  return precision == raster::DepthPrecision::Unorm24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32F;
}

/// Counts are the second output of the shaders, the only one that is then drawn.
Framebuffer makeFramebuffer(const raster::ItemBuffer& size, GLint colourStorage, GLint depthStorage, bool areCounts) {
  Framebuffer made;
  glCreateFramebuffers(1, &made.framebuffer);
  const auto attach = [&](GLuint& buffer, GLenum attachment, GLint storage) {
    glCreateRenderbuffers(1, &buffer);
    glNamedRenderbufferStorage(buffer, static_cast<GLenum>(storage), size.width, size.height);
    glNamedFramebufferRenderbuffer(made.framebuffer, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(made.colour, GL_COLOR_ATTACHMENT0, colourStorage);
  attach(made.depth, GL_DEPTH_ATTACHMENT, depthStorage);
  constexpr std::array<GLenum, 2> second{GL_NONE, GL_COLOR_ATTACHMENT0};
  if (areCounts) glNamedFramebufferDrawBuffers(made.framebuffer, 2, second.data());
  return made;
}

/// The nearer or the farther fragment passes. Depths are cleared to the end of their range that always loses.
void setDepthTest(raster::DepthTest test, bool areReversed) {
  const bool keepsLarger = raster::keepsFarther(test) != areReversed;
  const bool keepsLast = raster::keepsLast(test);
  const GLenum larger = keepsLast ? GL_GEQUAL : GL_GREATER, smaller = keepsLast ? GL_LEQUAL : GL_LESS;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(keepsLarger ? larger : smaller);
  glClearDepth(keepsLarger ? 0 : 1);
}

class OpenGlRenderer final : public raster::ItemBufferRenderer {
 public:
  OpenGlRenderer(const raster::DrawList& list, OpenGlPath path, const std::string& name);
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  void bindFramebuffer(const raster::ItemBuffer& size);
  void setView(const raster::Face& face);
  void drawFace(const raster::Face& face, const std::vector<DrawBatch>& batches, raster::ItemBuffer& buffer);
  bool areCounts() const { return list_.value == raster::PixelValue::PassedSamples; }
  OpenGlPixels targetPixels() const;

  raster::DrawList list_;
  std::unique_ptr<OpenGlContext> context_;
  std::unique_ptr<OpenGlPipeline> pipeline_;
  std::vector<GLuint> textures_;  ///< one per index map, and the last for draws without; none if not used
  std::map<std::pair<int, int>, Framebuffer> framebuffers_;  ///< by width and height
};

std::unique_ptr<OpenGlContext> openDevice(const std::string& name) {
  std::unique_ptr<OpenGlContext> context = OpenGlContext::create(name);
  if (!context)
    throw InputError(
        "no OpenGL device" + (name.empty() ? "" : " with \"" + name + "\" in its name") + " answers through EGL",
        "install a driver with the compatibility profile of OpenGL 4.5; Mesa's needs no graphics card");
  return context;
}

OpenGlRenderer::OpenGlRenderer(const raster::DrawList& list, OpenGlPath path, const std::string& name)
    : list_(raster::assembled(list)), context_(openDevice(name)) {
  raster::validate(list_);
  const OpenGlContext::Use use(*context_);
  pipeline_ = makePipeline(list_, path);
  if (pipeline_->textureTarget() != GL_NONE) textures_ = makeTextures(list_.indexMaps, *pipeline_);
  setDepthTest(list_.depthTest, pipeline_->hasReversedDepths());
  glClipControl(GL_LOWER_LEFT,
                list_.clipDepth == raster::ClipDepth::MinusOneToOne ? GL_NEGATIVE_ONE_TO_ONE : GL_ZERO_TO_ONE);
  if (areCounts()) glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
}

OpenGlPixels OpenGlRenderer::targetPixels() const {
  return areCounts() ? OpenGlPixels{GL_R32F, GL_RED, GL_FLOAT} : pipeline_->pixels();
}

/// The faces of a hemicube have two sizes, so the framebuffers of some sizes are kept.
void OpenGlRenderer::bindFramebuffer(const raster::ItemBuffer& size) {
  constexpr std::size_t maxKept = 16;
  const std::pair key{size.width, size.height};
  if (framebuffers_.size() == maxKept && !framebuffers_.contains(key)) {
    for (const auto& [kept, framebuffer] : framebuffers_) {
      glDeleteFramebuffers(1, &framebuffer.framebuffer);
      glDeleteRenderbuffers(1, &framebuffer.colour);
      glDeleteRenderbuffers(1, &framebuffer.depth);
    }
    framebuffers_.clear();
  }
  if (!framebuffers_.contains(key))
    framebuffers_[key] = makeFramebuffer(size, targetPixels().storage, depthStorage(list_.depthPrecision), areCounts());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[key].framebuffer);
}

void OpenGlRenderer::setView(const raster::Face& face) {
  const DeviceViewport viewport =
      viewportOf(face, pipeline_->viewportWidth(), openGlLimit(GL_MAX_VIEWPORT_DIMS), "OpenGL");
  glViewport(viewport.x, viewport.y, viewport.columns, viewport.rows);
  // docs/item-buffers.md, "facing": front-facing if the area and the determinant differ in sign. OpenGL also computes
  // the area in columns and rows, and calls a negative area clockwise.
  glFrontFace((raster::determinant(face) > 0) != (list_.front == raster::Winding::Clockwise) ? GL_CW : GL_CCW);
  pipeline_->setView(face, viewport);
}

void OpenGlRenderer::drawFace(const raster::Face& face, const std::vector<DrawBatch>& batches,
                              raster::ItemBuffer& buffer) {
  buffer.resize(face.scissor);
  bindFramebuffer(buffer);
  setView(face);
  if (areCounts()) {
    constexpr std::array<GLfloat, 4> none{};
    glClearBufferfv(GL_COLOR, 1, none.data());
  } else {
    pipeline_->clear(raster::clearedValue(list_));
  }
  glClear(GL_DEPTH_BUFFER_BIT);
  for (const DrawBatch& batch : batches) {
    const raster::Draw& draw = *batch.draw;
    const std::size_t map = draw.indexMap ? static_cast<std::size_t>(*draw.indexMap) : textures_.size() - 1;
    if (!textures_.empty()) glBindTexture(pipeline_->textureTarget(), textures_[map]);
    pipeline_->draw(draw, batch.runs);
  }
  const OpenGlPixels pixels = targetPixels();
  glReadPixels(0, 0, buffer.width, buffer.height, pixels.format, pixels.type, buffer.ids.data());
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw InputError("the OpenGL device fails with error " + std::to_string(error));
  if (areCounts()) readCounts(buffer);
}

void OpenGlRenderer::draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  for (const raster::Face& face : faces) raster::validate(face);
  const OpenGlContext::Use use(*context_);
  const auto joins = [this](const raster::Draw& draw, const raster::Draw& next) {
    return pipeline_->joins(draw, next);
  };
  const std::vector<DrawBatch> batches = batchesOf(list_, skipped, joins);
  buffers.resize(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) drawFace(faces[i], batches, buffers[i]);
  raster::parallelFor(faces.size(), drawn);
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, OpenGlPath path,
                                                               const std::string& name) {
  return std::make_unique<OpenGlRenderer>(list, path, name);
}

std::string openGlDeviceName(const std::string& name) { return openDevice(name)->name(); }

}  // namespace hemitex::reference
