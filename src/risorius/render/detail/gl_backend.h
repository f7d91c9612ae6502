// SPDX-License-Identifier: MIT
/// \file
/// An interface to a library that provides OpenGL. It covers what differs between the libraries: the creation of contexts without
/// a window, and the lookup of functions.
#pragma once

#include <memory>
#include <string>

namespace risorius::render {

class GlBackend {
  public:
    virtual ~GlBackend() = default;
    virtual const char* name() const = 0;
    /// Makes a context of OpenGL 4.5 core that shares its objects with `shared`. Returns null on failure.
    virtual void* make_context(void* shared) = 0;
    virtual void destroy(void* context) = 0;
    /// Makes a context current on the calling thread; null releases the current one.
    virtual bool make_current(void* context) = 0;
    using Function = void (*)();
    virtual Function function(const char* name) const = 0;
};

/// Returns the back end of the process, which is made at the first call. Throws RunError when no back end is available, and Error
/// for a wrong value of the environment variable RISORIUS_GL. The function is not thread-safe.
GlBackend& gl_backend();

std::unique_ptr<GlBackend> make_osmesa_backend();
/// Returns null where EGL is missing, or where no EGL device is a graphics processor and one is required.
std::unique_ptr<GlBackend> make_egl_backend(bool needs_graphics_processor);

/// Records the name of the renderer for gl_in_use(). It is called after the first context has been made.
void note_renderer(const std::string& renderer);

}  // namespace risorius::render
