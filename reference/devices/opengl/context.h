/// An OpenGL context without a window, through EGL, on the first device with the required features. OpenGL calls use
/// the context that is current on their thread.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <memory>
#include <string>

namespace hemitex::reference {

/// An OpenGL context without a window; its objects are destroyed with it. Its display stays open until the process
/// ends, because EGL does not count the users of a display.
class OpenGlContext {
 public:
  /// Uses the first device with the compatibility profile of OpenGL 4.5 whose name contains `name`; returns null if
  /// there is none.
  static std::unique_ptr<OpenGlContext> create(const std::string& name = "");
  ~OpenGlContext();
  OpenGlContext(const OpenGlContext&) = delete;
  OpenGlContext& operator=(const OpenGlContext&) = delete;

  /// The renderer of the device, as its driver names it, and the version of the driver.
  std::string name() const;

  /// Makes the context current on this thread during its lifetime; the context must outlive it.
  class Use {
   public:
    /// Throws InputError if the device is lost.
    explicit Use(const OpenGlContext& context);
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    EGLDisplay display_;
  };

 private:
  explicit OpenGlContext(EGLDisplay display) : display_(display) {}
  bool isMade();

  EGLDisplay display_;
  EGLSurface surface_ = EGL_NO_SURFACE;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// A limit of the current device; the first number if there is one per axis.
int openGlLimit(GLenum name);

}  // namespace hemitex::reference
