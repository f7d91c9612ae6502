// SPDX-License-Identifier: MIT
// OpenGL in memory by OSMesa. The library is loaded when something is drawn: with LLVM it takes as long as all others together.
#include "risorius/render/detail/gl.h"  // the core header comes first
// A comment separates the includes, so that sorting keeps their order.
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/render/detail/gl_backend.h"

namespace risorius::render {
namespace {

constexpr int kWindowSide = 16;

struct Context {
    OSMesaContext osmesa = nullptr;
    /// OSMesa requires a window buffer; nothing is drawn into it.
    std::vector<unsigned char> window = std::vector<unsigned char>(kWindowSide * kWindowSide * 4);
};

/// The functions in use. The library stays loaded: threads may still draw during static destruction.
struct Osmesa {
    decltype(&OSMesaCreateContextAttribs) create_context = nullptr;
    decltype(&OSMesaDestroyContext) destroy_context = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetProcAddress) get_proc_address = nullptr;

    /// Throws RunError when the library or one of its functions is missing.
    Osmesa() {
        void* library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
        const auto find = [&](auto& function, const char* name) {
            function = library ? reinterpret_cast<std::remove_reference_t<decltype(function)>>(
                                     dlsym(library, name))
                               : nullptr;
            if (function) return;
            const char* why = dlerror();
            throw RunError(std::string("OSMesa draws the pictures, but cannot be loaded: ") +
                           (why ? why : name) + " (in Debian, the package libosmesa6)");
        };
        find(create_context, "OSMesaCreateContextAttribs");
        find(destroy_context, "OSMesaDestroyContext");
        find(make_current, "OSMesaMakeCurrent");
        find(get_proc_address, "OSMesaGetProcAddress");
    }
};

class OsmesaBackend : public GlBackend {
  public:
    const char* name() const override { return "osmesa"; }

    void* make_context(void* shared) override {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  4,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  5,
                                  0};
        auto context = std::make_unique<Context>();
        context->osmesa = osmesa_.create_context(
            attributes, shared ? static_cast<Context*>(shared)->osmesa : nullptr);
        return context->osmesa ? context.release() : nullptr;
    }

    void destroy(void* context) override {
        const std::unique_ptr<Context> own(static_cast<Context*>(context));
        osmesa_.destroy_context(own->osmesa);
    }

    bool make_current(void* context) override {
        if (!context) return osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        auto& own = *static_cast<Context*>(context);
        return osmesa_.make_current(own.osmesa, own.window.data(), GL_UNSIGNED_BYTE, kWindowSide,
                                    kWindowSide);
    }

    Function function(const char* name) const override {
        return reinterpret_cast<Function>(osmesa_.get_proc_address(name));
    }

  private:
    Osmesa osmesa_;
};

}  // namespace

std::unique_ptr<GlBackend> make_osmesa_backend() { return std::make_unique<OsmesaBackend>(); }

}  // namespace risorius::render
