// SPDX-License-Identifier: MIT
/// \file
/// What differs between the libraries that bring OpenGL: contexts without a window, and where the functions are.
#pragma once

#include <memory>
#include <string>

namespace risorius::render {

class GlBackend {
  public:
    virtual ~GlBackend() = default;
    virtual const char* name() const = 0;
    /// A 4.5 core context that has its objects in common with `shared`, or null.
    virtual void* make_context(void* shared) = 0;
    virtual void destroy(void* context) = 0;
    /// For the calling thread; null: none.
    virtual bool make_current(void* context) = 0;
    using Function = void (*)();
    virtual Function function(const char* name) const = 0;
};

/// The back end of the process, made when first asked for. Throws RunError when there is none, and Error for a wrong
/// RISORIUS_GL. One thread at a time.
GlBackend& gl_backend();

std::unique_ptr<GlBackend> make_osmesa_backend();
/// Null where there is no EGL, or none with a graphics processor when that is asked for.
std::unique_ptr<GlBackend> make_egl_backend(bool needs_graphics_processor);

/// After the first context: what it is drawn with.
void note_renderer(const std::string& renderer);

}  // namespace risorius::render
