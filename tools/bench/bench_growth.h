// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of how cost grows with work: processor time and memory for more nodes, vertices, frames, clips and threads.
///
/// Each size is measured in a process of its own, so that its memory is that of this size alone. Processor time counts all
/// threads, so that it says what more threads cost even where there are fewer cores.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/scene/rig_files.h"

namespace risorius::bench {

/// What a work tells about itself: processor time, s, and its size where that is known only afterwards, else 0.
struct Measured {
    double seconds = 0, size = 0;
};

/// What one size costs.
struct Cost {
    Measured measured;
    double megabytes = 0;  ///< the most memory that its process had
};

/// Runs `work` in a process of its own. Throws RunError with the message of what `work` throws, or when the process dies.
Cost cost_apart(const std::function<Measured()>& work);

/// Which sizes are measured. An empty list leaves the series out.
struct GrowthSizes {
    std::vector<int> skin_vertices = {400, 800, 1700, 3300, 6600, 13200};
    std::vector<int> refinements = {0, 1, 2};  ///< how often each polygon of the mesh is divided
    std::vector<int> frames = {30, 120, 480, 1920};
    std::vector<int> planned_clips = {10, 100, 1000, 10000, 100000};
    std::vector<int> rendered_clips = {5, 20, 80, 400};
    std::vector<int> threads = {1, 2, 4, 8, 16};
};

/// Returns the mesh with each polygon of n corners divided into n quads. Vertices keep their places and come first.
geom::PolygonMesh finer_mesh(const geom::PolygonMesh& mesh);

/// Returns one entry for each series: `series`, `size` (what is counted), `cases` (`size`, `seconds`, `megabytes`), and
/// `exponents`: e of each case but the first, if its seconds are those of the case before times (ratio of their sizes)^e.
/// Temporary files are written to the folder.
Json bench_growth(const scene::RigFiles& files, const std::filesystem::path& folder,
                  const GrowthSizes& sizes = {}, const ProgressMonitor& monitor = {});

/// Draws growth.svg and growth.png into a folder: seconds against size, each relative to the first case of its series. Throws
/// RunError when they cannot be drawn.
void draw_growth(const Json& growth, const std::filesystem::path& folder);

}  // namespace risorius::bench
