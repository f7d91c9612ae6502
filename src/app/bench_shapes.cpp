#include "app/bench_shapes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/bench_steps.h"
#include "app/median.h"
#include "app/script_drives.h"
#include "app/shape_player.h"
#include "app/stopwatch.h"

namespace risorius::app {

namespace {

constexpr double kTurned_rad = 0.2;  // the head, which costs a turn of every vertex

ShapesOfFile linear_shapes(const RigFiles& files, sim::Face& face) {
    ShapesOfFile out;
    out.goals = shape_set(files.rig, "arkit52", {}, files.place()).goals;
    std::vector<Points> linear;
    const ShapeWeights weights(face, files.rig.channels(), out.goals, &linear);
    for (Points& field : linear) {
        risorius::shapes::fade_out(field);
        out.rig.shapes.push_back(risorius::shapes::sparse(field));
    }
    return out;
}

}  // namespace

Json bench_shapes(const RigFiles& files, const std::filesystem::path& file, const Watch& watch) {
    watch.tell(0, "blend shapes");
    const track::ChannelTable channels = files.rig.channels();
    sim::Face face(files.rig, files.mesh, sim::quality_named("preview"), files.place());
    ShapesOfFile shapes =
        file.empty() ? linear_shapes(files, face) : read_shapes_of_file(file, files, face.head());
    const ShapeWeights weights(face, channels, shapes.goals);
    std::size_t moved = 0;
    for (const auto& one : shapes.rig.shapes) moved += one.vertex.size();
    for (const auto& one : shapes.rig.correctives) moved += one.shape.vertex.size();
    const ShapePlayer player(std::move(shapes), face, channels);

    const track::ScriptDescription script = step_track(files);
    ScriptDrives drives(script, files.rig);
    std::vector<double> frame_ms, weights_ms;
    const int frames = script.header.frame_count();
    for (int frame = 0; frame < frames; ++frame) {
        track::Drive drive = drives.at(static_cast<double>(frame) / script.header.fps);
        drive.kinematic[static_cast<std::size_t>(track::Kinematic::kHeadYaw)] = kTurned_rad;
        const CoreStopwatch whole;
        const sim::FacePose pose = player.pose(drive);
        frame_ms.push_back(1e3 * whole.seconds());
        const CoreStopwatch part;
        weights.of(drive);
        weights_ms.push_back(1e3 * part.seconds());
    }
    return {{"shapes", player.shapes().rig.shapes.size()},
            {"correctives", player.shapes().rig.correctives.size()},
            {"vertices", face.head().vertices.rows()},
            {"moved_vertices", moved},
            {"frames", frames},
            {"frame_ms", median(frame_ms)},
            {"slowest_frame_ms", *std::max_element(frame_ms.begin(), frame_ms.end())},
            {"weights_ms", median(weights_ms)}};
}

}  // namespace risorius::app
