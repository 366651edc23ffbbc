#include "reference/devices/opengl/context.h"

#include <array>

#include "raster/base/input_error.h"

namespace hemitex::reference {

OpenGlContext::Use::Use(const OpenGlContext& context) : display_(context.display_) {
  if (!eglMakeCurrent(display_, context.surface_, context.surface_, context.context_))
    throw raster::InputError("the OpenGL device does not answer any more");
}

OpenGlContext::Use::~Use() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

bool OpenGlContext::isMade() {
  constexpr EGLint wanted[]{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  constexpr EGLint size[]{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  constexpr EGLint profile = EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT;
  constexpr EGLint version[]{
      EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK, profile, EGL_NONE};
  EGLConfig config;
  EGLint configs = 0;
  if (!eglInitialize(display_, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display_, wanted, &config, 1, &configs) || configs == 0)
    return false;
  surface_ = eglCreatePbufferSurface(display_, config, size);
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
  return surface_ != EGL_NO_SURFACE && context_ != EGL_NO_CONTEXT;
}

std::unique_ptr<OpenGlContext> OpenGlContext::create(const std::string& name) {
  if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) return nullptr;
  std::array<EGLDeviceEXT, 16> devices;
  EGLint count = 0;
  eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
  for (std::size_t d = 0; d < static_cast<std::size_t>(count); ++d) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[d], nullptr);
    if (display == EGL_NO_DISPLAY) continue;
    std::unique_ptr<OpenGlContext> context(new OpenGlContext(display));
    if (context->isMade() && context->name().find(name) != std::string::npos) return context;
  }
  return nullptr;
}

std::string OpenGlContext::name() const {
  const Use use(*this);
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

OpenGlContext::~OpenGlContext() {
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
}

int openGlLimit(GLenum name) {
  std::array<GLint, 2> values{};
  glGetIntegerv(name, values.data());
  return values[0];
}

}  // namespace hemitex::reference
