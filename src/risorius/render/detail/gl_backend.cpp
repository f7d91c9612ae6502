// SPDX-License-Identifier: MIT
#include "risorius/render/detail/gl_backend.h"

#include <cstdlib>
#include <mutex>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/render/detail/gl.h"
#include "risorius/render/gl_choice.h"

namespace risorius::render {

#define RISORIUS_GL_POINTER(type, name) type name = nullptr;
RISORIUS_GL_FUNCTIONS(RISORIUS_GL_POINTER)
#undef RISORIUS_GL_POINTER

namespace {

struct InUse {
    std::mutex mutex;
    std::string chosen;  ///< empty: RISORIUS_GL decides
    std::string renderer;
    std::unique_ptr<GlBackend> backend;
};

/// Never destroyed: threads may still draw during static destruction.
InUse& in_use() {
    static InUse& one = *new InUse;
    return one;
}

std::unique_ptr<GlBackend> make_backend(std::string name) {
    if (name.empty()) {
        const char* asked = std::getenv("RISORIUS_GL");
        name = asked && *asked ? asked : "auto";
        index_of_name("RISORIUS_GL", name, gl_names());
    }
    if (name == "osmesa") return make_osmesa_backend();
    std::unique_ptr<GlBackend> egl = make_egl_backend(name == "auto");
    if (!egl && name == "egl") throw RunError("no OpenGL without a window by EGL (libEGL)");
    return egl ? std::move(egl) : make_osmesa_backend();
}

}  // namespace

const std::vector<std::string>& gl_names() {
    static const std::vector<std::string> names{"auto", "osmesa", "egl"};
    return names;
}

void choose_gl(const std::string& name, const std::string& place) {
    index_of_name(place, name, gl_names());
    const std::lock_guard lock(in_use().mutex);
    in_use().chosen = name;
}

std::string gl_in_use() {
    const std::lock_guard lock(in_use().mutex);
    if (!in_use().backend) return {};
    return std::string(in_use().backend->name()) + ", " + in_use().renderer;
}

void note_renderer(const std::string& renderer) {
    const std::lock_guard lock(in_use().mutex);
    in_use().renderer = renderer;
}

GlBackend& gl_backend() {
    const std::lock_guard lock(in_use().mutex);
    std::unique_ptr<GlBackend>& backend = in_use().backend;
    if (backend) return *backend;
    std::unique_ptr<GlBackend> made = make_backend(in_use().chosen);
#define RISORIUS_GL_POINTER(type, name)                   \
    name = reinterpret_cast<type>(made->function(#name)); \
    if (!name) throw RunError(std::string("OpenGL without ") + #name);
    RISORIUS_GL_FUNCTIONS(RISORIUS_GL_POINTER)
#undef RISORIUS_GL_POINTER
    backend = std::move(made);
    return *backend;
}

}  // namespace risorius::render
