// SPDX-License-Identifier: MIT
// Bakes blend shapes of a rig into shapes.glb, with progress on standard error.
//
//   bake_shapes FOLDER [RIG]
#include "risorius/blendshapes/bake_shapes.h"

#include <cstdio>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"

using namespace risorius;

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "expected a folder for the shapes\n");
        return 2;
    }
    blendshapes::ShapesOptions options;
    options.out = argv[1];
    options.rig = argc > 2 ? argv[2] : (data_folder() / "rigs/adult/rig.json").string();
    options.set = "arkit52";
    options.only = {"jawOpen", "mouthSmileLeft", "mouthSmileRight"};  // leave empty for all 52
    options.formats = {"glb"};
    options.pictures = false;
    options.correctives = false;
    options.test_frames = 0;

    const blendshapes::ShapesReport report = blendshapes::bake_shapes(
        options, {.progress =
                      [](double fraction, const std::string& what) {
                          std::fprintf(stderr, "%3.0f %% %s\n", 100 * fraction, what.c_str());
                      },
                  .stopped = {}});
    for (const auto& [file, bytes] : report.sizes)
        std::printf("%s\t%ld bytes\n", file.c_str(), bytes);
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
} catch (const RunError& error) {  // not the input: a full disk, no OpenGL
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
