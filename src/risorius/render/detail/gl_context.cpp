// SPDX-License-Identifier: MIT
#include "risorius/render/detail/gl_context.h"

#include <cstdlib>
#include <latch>
#include <mutex>
#include <thread>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/parallel.h"
#include "risorius/render/detail/gl_backend.h"

namespace risorius::render {
namespace {

std::mutex& driver_mutex() {
    static std::mutex mutex;
    return mutex;
}

/// Whether the system gives as many threads. Where it refuses one to llvmpipe, llvmpipe waits for it without end.
bool can_start(int threads) {
    // For its pool of compute shaders, and for what it starts beside
    threads = 2 * threads + 2;
    std::latch begun(1);
    std::vector<std::jthread> started;
    bool all = true;
    for (int i = 0; i < threads && all; ++i) all = add_thread(started, [&] { begun.wait(); });
    begun.count_down();
    return all;
}

GLuint compile(const std::string& name, GLenum stage, const std::string& source) {
    const GLuint shader = glCreateShader(stage);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[4096] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        glDeleteShader(shader);
        throw RunError("shader " + name + ": " + log);
    }
    return shader;
}

}  // namespace

GlContext::GlContext(int threads, const GlContext* shared) {
    // The driver reads its thread count from the environment when it creates its only screen.
    const std::lock_guard<std::mutex> lock(driver_mutex());
    setenv("LP_NUM_THREADS", std::to_string(can_start(threads) ? threads : 0).c_str(), 1);
    GlBackend& backend = gl_backend();
    context_ = backend.make_context(shared ? shared->context_ : nullptr);
    if (!context_) throw RunError(std::string("no OpenGL 4.5 context (") + backend.name() + ")");
    if (!backend.make_current(context_))
        throw RunError("the OpenGL context cannot be bound to this thread");
    note_renderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    backend.make_current(nullptr);
}

GlContext::~GlContext() {
    const std::lock_guard<std::mutex> lock(driver_mutex());
    gl_backend().destroy(context_);
}

GlContext::Current::Current(GlContext& context) {
    driver_mutex().lock();
    if (gl_backend().make_current(context.context_)) return;
    driver_mutex().unlock();
    throw RunError("the OpenGL context cannot be bound to this thread");
}

GlContext::Current::~Current() {
    gl_backend().make_current(nullptr);
    driver_mutex().unlock();
}

void finish_drawing() {
    constexpr GLuint64 kSecond_ns = 1'000'000'000;
    const GLsync drawn = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    driver_mutex().unlock();
    while (glClientWaitSync(drawn, 0, kSecond_ns) == GL_TIMEOUT_EXPIRED) {
    }
    driver_mutex().lock();
    glDeleteSync(drawn);
}

GlProgram::GlProgram(const std::string& name, const std::string& vertex,
                     const std::string& fragment) {
    const GLuint vertex_shader = compile(name + " (vertex)", GL_VERTEX_SHADER, vertex);
    id_ = glCreateProgram();
    glAttachShader(id_, vertex_shader);
    glDeleteShader(vertex_shader);
    if (!fragment.empty()) {
        const GLuint fragment_shader = compile(name + " (fragment)", GL_FRAGMENT_SHADER, fragment);
        glAttachShader(id_, fragment_shader);
        glDeleteShader(fragment_shader);
    }
    glLinkProgram(id_);
    GLint linked = 0;
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[4096] = "";
        glGetProgramInfoLog(id_, sizeof log, nullptr, log);
        throw RunError("shader " + name + ": " + log);
    }
}

}  // namespace risorius::render
