// SPDX-License-Identifier: MIT
/// \file
/// A GL 4.5 core context without a window, and the little ownership GL objects need.
#pragma once

#include <string>

#include "risorius/render/detail/gl.h"

namespace risorius::render {

class GlContext {
  public:
    /// `threads` are llvmpipe workers; the first context of a process decides for all later ones. Textures and buffers are
    /// those of `shared`, and the other way round. Throws RunError when there is no such context.
    explicit GlContext(int threads, const GlContext* shared = nullptr);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Binds to the calling thread for a scope; draws go to framebuffer objects. One context of the process at a time: where a texture
    /// or buffer is touched, llvmpipe of Mesa 22.3 looks through what all contexts have to draw, without a lock, while they free it
    /// (about one film in a hundred ended with a segmentation fault). Others have their turn in finish_drawing().
    class Current {
      public:
        explicit Current(GlContext& context);
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;
    };

  private:
    void* context_ = nullptr;  ///< of gl_backend()
};

/// Waits until what was drawn in the context of this thread is drawn; meanwhile other threads may give theirs something to draw.
void finish_drawing();

/// Compiles and links; throws RunError with the compiler's words. An empty fragment source draws depth only.
class GlProgram {
  public:
    GlProgram(const std::string& name, const std::string& vertex, const std::string& fragment);
    ~GlProgram() { glDeleteProgram(id_); }
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    void use() const { glUseProgram(id_); }
    GLint location(const char* uniform) const { return glGetUniformLocation(id_, uniform); }

  private:
    GLuint id_ = 0;
};

}  // namespace risorius::render
