// SPDX-License-Identifier: MIT
#include "risorius/render/detail/gl_context.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <latch>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/parallel.h"
#include "risorius/core/read_file.h"
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

/// The names of the threads of llvmpipe that run: "llvmpipe-0" and so on.
std::set<std::string> running_threads() {
    constexpr FileKind kName{"the name of a thread", 4096};
    std::set<std::string> names;
    std::error_code ignored;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", ignored)) {
        try {
            const std::string name = read_file(task.path() / "comm", kName);
            if (name.starts_with("llvmpipe-")) names.insert(name);
        } catch (const Error&) {
            // This thread has ended.
        }
    }
    return names;
}

/// Throws RunError when llvmpipe, which has just begun, lacks one of its threads. It would wait for it at the first drawing.
void check_threads(int threads, const std::string& renderer) {
    if (threads == 0 || renderer.find("llvmpipe") == std::string::npos) return;
    constexpr std::chrono::milliseconds kPatience(3000), kAskEvery(2);
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (running_threads().size() < static_cast<std::size_t>(threads)) {
        if (std::chrono::steady_clock::now() > until)
            throw RunError("the system refuses some of the " + std::to_string(threads) +
                           " threads that draw (one thread needs none of them)");
        std::this_thread::sleep_for(kAskEvery);
    }
}

/// What the first context and the drawing of a small picture take: 461 MB of addresses with two threads, Mesa 22.3; and more for
/// what begins beside it.
constexpr std::size_t kToDraw = 640'000'000;

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

void require_memory(std::size_t bytes) {
    // Pages that nobody touches cost nothing, but they count against the limits.
    void* const room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED)
        throw RunError("not enough memory to draw: expected " + std::to_string(bytes / 1'000'000) +
                       " MB more, found a lower limit of the system");
    ::munmap(room, bytes);
}

GlContext::GlContext(int threads, const GlContext* shared) {
    // The driver reads its thread count from the environment when it creates its only screen.
    const std::lock_guard<std::mutex> lock(driver_mutex());
    const int started = can_start(threads) ? threads : 0;
    static bool is_first = true;  // it starts the threads
    if (is_first) require_memory(kToDraw);
    setenv("LP_NUM_THREADS", std::to_string(started).c_str(), 1);
    GlBackend& backend = gl_backend();
    context_ = backend.make_context(shared ? shared->context_ : nullptr);
    if (!context_) throw RunError(std::string("no OpenGL 4.5 context (") + backend.name() + ")");
    if (!backend.make_current(context_))
        throw RunError("the OpenGL context cannot be bound to this thread");
    const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    note_renderer(renderer);
    backend.make_current(nullptr);
    if (is_first) check_threads(started, renderer);
    is_first = false;
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

GLuint make_repeating_texture(int width, int height, const std::vector<std::uint8_t>& texels) {
    const auto levels = std::bit_width(static_cast<unsigned>(std::max(width, height)));
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(levels), GL_RG8, width, height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RG, GL_UNSIGNED_BYTE, texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    return texture;
}

}  // namespace risorius::render
