// SPDX-License-Identifier: MIT
// risorius-import-mesh FILE: reads a mesh with assimp and writes it to standard output, see risorius/io/mesh_message.h. It is
// run by the library, not by people. assimp reads 50 formats, and some files make it crash, hang, or take all memory; then
// only this process ends.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>

#include "risorius/core/error.h"
#include "risorius/io/mesh_message.h"
#include "tools/import_mesh/scene_reader.h"

namespace {

void limit(__rlimit_resource what, rlim_t soft, rlim_t hard) {
    const rlimit both{soft, hard};
    ::setrlimit(what, &both);
}

void set_limits(std::size_t file_bytes) {
    const risorius::io::ImportLimits limits = risorius::io::import_limits(file_bytes);
    const auto seconds = static_cast<rlim_t>(limits.processor_s);
    limit(RLIMIT_CPU, seconds, seconds + 1);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);
#ifndef __SANITIZE_ADDRESS__  // which needs terabytes of addresses
    limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
#endif
    std::set_new_handler([] { ::_exit(risorius::io::kOutOfMemory); });
    // Nobody waits for this process once the one that started it has ended.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

void write_all(const void* data, std::size_t size) {
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t done = ::write(STDOUT_FILENO, from, size);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) ::_exit(1);
        from += done;
        size -= static_cast<std::size_t>(done);
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2 || ::isatty(STDOUT_FILENO) == 1) {
        std::fprintf(stderr, "risorius-import-mesh FILE: reads a mesh for the program risorius\n");
        return 2;
    }
    // It ends with the program that started it, however that one ends.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::filesystem::path file = arguments[1];
    std::error_code problem;
    const auto size = std::filesystem::file_size(file, problem);
    set_limits(problem ? 0 : size);
    try {
        risorius::io::write_mesh_message(risorius::import_mesh::read_scene(file), write_all);
    } catch (const risorius::import_mesh::NoMesh& error) {
        risorius::io::write_mesh_message(error.problem, write_all);
    } catch (const std::exception& error) {
        risorius::io::write_mesh_message(
            {file.string(), "a mesh that can be read", "one that cannot"}, write_all);
    }
    // Without destructors, which would walk through all that was read
    ::_exit(0);
}
