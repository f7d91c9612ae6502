// SPDX-License-Identifier: MIT
/// \file
/// A context of OpenGL 4.5 core without a window, and ownership of GL programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "risorius/render/detail/gl.h"

namespace risorius::render {

/// Throws RunError when the process may not have as many bytes more (ulimit -v). llvmpipe and its compiler do not ask whether
/// they got memory: without it, the process would crash.
void require_memory(std::size_t bytes);

class GlContext {
  public:
    /// `threads`: number of worker threads of llvmpipe; the first context of a process decides for all later ones. The new
    /// context and `shared` share their textures and buffers. Throws RunError when no such context is available.
    explicit GlContext(int threads, const GlContext* shared = nullptr);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Binds the context to the calling thread as long as this object exists. Drawing goes to framebuffer objects. Only one
    /// context of the process is current at a time: when a texture or buffer is touched, llvmpipe of Mesa 22.3 reads the pending
    /// draws of all contexts without a lock while they free them (about one video in a hundred ended with a segmentation fault).
    /// Other threads get their turn in finish_drawing().
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

/// Waits until all drawing of the current context is done. Meanwhile other threads may submit drawing of their own contexts.
void finish_drawing();

/// A compiled and linked program of a vertex and a fragment shader. An empty fragment source draws depth only. The constructor
/// throws RunError with the message of the compiler.
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

/// Makes a mip-mapped texture of two 8-bit channels that can be repeated. The sides are powers of two, and `texels` has the rows from
/// the bottom. The context must be current.
GLuint make_repeating_texture(int width, int height, const std::vector<std::uint8_t>& texels);

}  // namespace risorius::render
