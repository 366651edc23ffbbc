/// Where OpenGL works: a context through EGL on the first device that has what is needed, without a window. Every call
/// of OpenGL is one to the context that is in use on its thread.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <memory>

namespace hemitex::reference {

/// An OpenGL context that draws into no window; what is made in it dies with it. Its display stays with the process,
/// since EGL does not count who uses one.
class OpenGlContext {
 public:
  /// On the first device that has the compatibility profile of OpenGL 4.5; nothing where none has.
  static std::unique_ptr<OpenGlContext> create();
  ~OpenGlContext();
  OpenGlContext(const OpenGlContext&) = delete;
  OpenGlContext& operator=(const OpenGlContext&) = delete;

  /// While it lives, what OpenGL does on this thread it does in the context, which outlives it.
  class Use {
   public:
    /// Throws InputError where the device is gone.
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

/// A limit of the device in use; the first number where it has one for each axis.
int openGlLimit(GLenum name);

}  // namespace hemitex::reference
