// SPDX-License-Identifier: MIT
#include "tools/bench/bench_shapes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/core/json_object.h"
#include "risorius/report/median.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/script_drives.h"
#include "tools/bench/bench_steps.h"

namespace risorius::bench {

namespace {

constexpr double kTurned_rad = 0.2;  // the head is turned, so that every vertex is rotated

blendshapes::ShapesOfFile linear_shapes(const scene::RigFiles& files, face::Face& face) {
    blendshapes::ShapesOfFile out;
    out.goals = blendshapes::shape_set(files.rig, "arkit52", {}, files.place()).goals;
    std::vector<Points> linear;
    const blendshapes::ShapeWeights weights(face, files.rig.channels(), out.goals, &linear);
    for (Points& field : linear) {
        risorius::blendshapes::fade_out(field);
        out.rig.shapes.push_back(risorius::blendshapes::sparse(field));
    }
    return out;
}

}  // namespace

Json bench_shapes(const scene::RigFiles& files, const std::filesystem::path& file,
                  const ProgressMonitor& monitor) {
    monitor.report(0, "blend shapes");
    const track::ChannelTable channels = files.rig.channels();
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    blendshapes::ShapesOfFile shapes =
        file.empty() ? linear_shapes(files, face)
                     : blendshapes::read_shapes_of_file(file, files, face.head());
    const blendshapes::ShapeWeights weights(face, channels, shapes.goals);
    std::size_t moved = 0;
    for (const auto& one : shapes.rig.shapes) moved += one.vertex.size();
    for (const auto& one : shapes.rig.correctives) moved += one.shape.vertex.size();
    const blendshapes::ShapePlayer player(std::move(shapes), face, channels);

    const track::ScriptDescription script = step_track(files);
    scene::ScriptDrives drives(script, files.rig);
    std::vector<double> frame_ms, weights_ms;
    const int frames = script.header.frame_count();
    for (int frame = 0; frame < frames; ++frame) {
        track::Drive drive = drives.at(static_cast<double>(frame) / script.header.fps);
        drive.kinematic[static_cast<std::size_t>(track::Kinematic::kHeadYaw)] = kTurned_rad;
        const report::CoreStopwatch whole;
        const face::FacePose pose = player.pose(drive);
        frame_ms.push_back(1e3 * whole.seconds());
        const report::CoreStopwatch part;
        weights.of(drive);
        weights_ms.push_back(1e3 * part.seconds());
    }
    return json_object({{"shapes", player.shapes().rig.shapes.size()},
                        {"correctives", player.shapes().rig.correctives.size()},
                        {"vertices", face.head().vertices.rows()},
                        {"moved_vertices", moved},
                        {"frames", frames},
                        {"frame_ms", report::median(frame_ms)},
                        {"slowest_frame_ms", *std::max_element(frame_ms.begin(), frame_ms.end())},
                        {"weights_ms", report::median(weights_ms)}});
}

}  // namespace risorius::bench
