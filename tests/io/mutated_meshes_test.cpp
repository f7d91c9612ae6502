// SPDX-License-Identifier: MIT
// Files with some bytes changed are read or refused with an Error: nothing else is thrown, and nothing is read beyond memory
// (which the sanitizers see). The environment variable RISORIUS_MUTATIONS sets how often each file is changed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/geom/mesh_checks.h"
#include "risorius/geom/repair_mesh.h"
#include "risorius/io/morph_model.h"
#include "risorius/io/read_mesh.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;

int mutations() {
    const char* asked = std::getenv("RISORIUS_MUTATIONS");
    return asked ? std::atoi(asked) : 40;
}

std::string mutated(std::string bytes, std::mt19937& random) {
    static const std::string kLetters = "0123456789-.,:[]{}\"eE+/#\\\n\r vfgo";
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (std::size_t k = 1 + below(6); k > 0 && !bytes.empty(); --k) {
        const std::size_t at = below(bytes.size());
        switch (below(5)) {
            case 0:
                bytes[at] = static_cast<char>(random());
                break;
            case 1:
                bytes[at] = kLetters[below(kLetters.size())];
                break;
            case 2:
                bytes.insert(at, 1, kLetters[below(kLetters.size())]);
                break;
            case 3:
                bytes.erase(at, 1 + below(8));
                break;
            default:
                bytes.insert(at, bytes.substr(below(bytes.size()), below(40)));
                break;
        }
    }
    return bytes;
}

TEST(MutatedMeshes, AreReadOrRefused) {
    const TemporaryFolder folder;
    std::mt19937 random(20261125);
    int sound = 0, refused = 0;
    for (const char* kind : {"public_cases", "hostile"})
        for (const auto& entry :
             fs::directory_iterator(fs::path(RISORIUS_SOURCE_DIR) / "tests/inputs" / kind)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".obj" && ending != ".glb" && ending != ".vrm") continue;
            const std::string bytes = bytes_of(entry.path());
            const fs::path file = folder / ("mesh" + ending);
            for (int round = 0; round < mutations(); ++round) {
                std::ofstream(file, std::ios::binary) << mutated(bytes, random);
                try {
                    geom::PolygonMesh mesh = read_mesh(file);
                    geom::inspect_mesh(mesh, file.string());
                    geom::repair_mesh(mesh);
                    geom::inspect_mesh(mesh, file.string());
                    ++sound;
                } catch (const Error&) {
                    ++refused;
                }
                if (ending == ".obj") continue;
                try {
                    read_glb(file);
                } catch (const Error&) {
                }
            }
        }
    // The changes are neither all without effect nor all fatal at once.
    EXPECT_GT(sound, refused / 20);
    EXPECT_GT(refused, sound / 20);
}

}  // namespace
}  // namespace risorius::io
