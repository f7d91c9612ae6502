// SPDX-License-Identifier: MIT
// OpenGL by EGL without a window or surface. The library is loaded at run time, so that programs also run on machines without it.
//
// Source: EGL_MESA_platform_surfaceless, EGL_EXT_platform_device, EGL_KHR_no_config_context, EGL_KHR_surfaceless_context
#define EGL_NO_X11 1  // X11 defines macros with common names
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <string>
#include <type_traits>
#include <vector>

#include "risorius/render/detail/gl_backend.h"

namespace risorius::render {
namespace {

/// The EGL functions in use, loaded at run time.
struct Egl {
    decltype(&eglGetProcAddress) get_proc_address = nullptr;
    decltype(&eglQueryString) query_string = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglTerminate) terminate = nullptr;
    decltype(&eglBindAPI) bind_api = nullptr;
    decltype(&eglCreateContext) create_context = nullptr;
    decltype(&eglDestroyContext) destroy_context = nullptr;
    decltype(&eglMakeCurrent) make_current = nullptr;
    decltype(&eglReleaseThread) release_thread = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;

    bool load() {
        void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
        if (!library) return false;
        const auto find = [&](auto& function, const char* name) {
            function =
                reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
            return function != nullptr;
        };
        const auto find_extension = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
                get_proc_address(name));
            return function != nullptr;
        };
        const bool found =
            find(get_proc_address, "eglGetProcAddress") && find(query_string, "eglQueryString") &&
            find(initialize, "eglInitialize") && find(terminate, "eglTerminate") &&
            find(bind_api, "eglBindAPI") && find(create_context, "eglCreateContext") &&
            find(destroy_context, "eglDestroyContext") && find(make_current, "eglMakeCurrent") &&
            find(release_thread, "eglReleaseThread") &&
            find_extension(get_platform_display, "eglGetPlatformDisplayEXT");
        if (!found) return false;
        find_extension(query_devices, "eglQueryDevicesEXT");
        find_extension(query_device_string, "eglQueryDeviceStringEXT");
        return true;
    }
};

bool has(const char* extensions, const std::string& name) {
    return extensions &&
           (" " + std::string(extensions) + " ").find(" " + name + " ") != std::string::npos;
}

/// The first device that is not the CPU, or EGL_NO_DISPLAY.
EGLDisplay graphics_processor(const Egl& egl) {
    if (!egl.query_devices || !egl.query_device_string) return EGL_NO_DISPLAY;
    EGLint count = 0;
    if (!egl.query_devices(0, nullptr, &count) || count < 1) return EGL_NO_DISPLAY;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!egl.query_devices(count, devices.data(), &count)) return EGL_NO_DISPLAY;
    for (EGLDeviceEXT device : devices) {
        const char* extensions = egl.query_device_string(device, EGL_EXTENSIONS);
        if (!extensions || has(extensions, "EGL_MESA_device_software")) continue;
        const EGLDisplay display =
            egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        if (display != EGL_NO_DISPLAY && egl.initialize(display, nullptr, nullptr)) return display;
    }
    return EGL_NO_DISPLAY;
}

EGLDisplay without_surface(const Egl& egl) {
    const EGLDisplay display =
        egl.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    return display != EGL_NO_DISPLAY && egl.initialize(display, nullptr, nullptr) ? display
                                                                                  : EGL_NO_DISPLAY;
}

class EglBackend : public GlBackend {
  public:
    EglBackend(const Egl& egl, EGLDisplay display) : egl_(egl), display_(display) {}
    ~EglBackend() override { egl_.terminate(display_); }

    const char* name() const override { return "egl"; }

    bool can_draw() {
        const char* extensions = egl_.query_string(display_, EGL_EXTENSIONS);
        if (!has(extensions, "EGL_KHR_surfaceless_context") ||
            !has(extensions, "EGL_KHR_no_config_context"))
            return false;
        void* context = make_context(nullptr);
        if (context) destroy(context);
        return context != nullptr;
    }

    void* make_context(void* shared) override {
        // The bound API is a state of the thread.
        if (!egl_.bind_api(EGL_OPENGL_API)) return nullptr;
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        const EGLContext context = egl_.create_context(
            display_, EGL_NO_CONFIG_KHR, shared ? shared : EGL_NO_CONTEXT, attributes);
        return context == EGL_NO_CONTEXT ? nullptr : context;
    }

    void destroy(void* context) override { egl_.destroy_context(display_, context); }

    bool make_current(void* context) override {
        if (!egl_.bind_api(EGL_OPENGL_API)) return false;
        return egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE,
                                 context ? context : EGL_NO_CONTEXT);
    }

    Function function(const char* name) const override { return egl_.get_proc_address(name); }

  private:
    Egl egl_;
    EGLDisplay display_;
};

}  // namespace

std::unique_ptr<GlBackend> make_egl_backend(bool needs_graphics_processor) {
    Egl egl;
    if (!egl.load()) return nullptr;
    EGLDisplay display = graphics_processor(egl);
    if (display == EGL_NO_DISPLAY && !needs_graphics_processor) display = without_surface(egl);
    if (display == EGL_NO_DISPLAY) return nullptr;
    auto backend = std::make_unique<EglBackend>(egl, display);
    if (!backend->can_draw()) return nullptr;
    return backend;
}

}  // namespace risorius::render
