// SPDX-License-Identifier: MIT
// OpenGL in memory by OSMesa.
#include "risorius/render/detail/gl.h"  // the core header comes first
// A comment separates the includes, so that sorting keeps their order.
#include <GL/osmesa.h>

#include <memory>
#include <vector>

#include "risorius/render/detail/gl_backend.h"

namespace risorius::render {
namespace {

constexpr int kWindowSide = 16;

struct Context {
    OSMesaContext osmesa = nullptr;
    /// OSMesa requires a window buffer; nothing is drawn into it.
    std::vector<unsigned char> window = std::vector<unsigned char>(kWindowSide * kWindowSide * 4);
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
        context->osmesa = OSMesaCreateContextAttribs(
            attributes, shared ? static_cast<Context*>(shared)->osmesa : nullptr);
        return context->osmesa ? context.release() : nullptr;
    }

    void destroy(void* context) override {
        const std::unique_ptr<Context> own(static_cast<Context*>(context));
        OSMesaDestroyContext(own->osmesa);
    }

    bool make_current(void* context) override {
        if (!context) return OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        auto& own = *static_cast<Context*>(context);
        return OSMesaMakeCurrent(own.osmesa, own.window.data(), GL_UNSIGNED_BYTE, kWindowSide,
                                 kWindowSide);
    }

    Function function(const char* name) const override {
        return reinterpret_cast<Function>(OSMesaGetProcAddress(name));
    }
};

}  // namespace

std::unique_ptr<GlBackend> make_osmesa_backend() { return std::make_unique<OsmesaBackend>(); }

}  // namespace risorius::render
