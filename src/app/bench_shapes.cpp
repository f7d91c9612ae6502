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

Json bench_shapes(const RigFiles& files, const Watch& watch) {
    watch.tell(0, "blend shapes");
    const track::ChannelTable channels = files.rig.channels();
    sim::Face face(files.rig, files.mesh, sim::quality_named("preview"), files.place());
    ShapesOfFile shapes;
    shapes.goals = shape_set(files.rig, "arkit52", {}, files.place()).goals;
    std::vector<Points> linear;
    const ShapeWeights weights(face, channels, shapes.goals, &linear);
    long moved = 0;
    for (Points& field : linear) {
        risorius::shapes::fade_out(field);
        shapes.rig.shapes.push_back(risorius::shapes::sparse(field));
        moved += static_cast<long>(shapes.rig.shapes.back().vertex.size());
    }
    const std::size_t count = shapes.goals.size();
    const ShapePlayer player(std::move(shapes), face, channels);

    const track::ScriptDescription script = step_track(files);
    ScriptDrives drives(script, files.rig);
    std::vector<double> frame_ms, weights_ms;
    const int frames = script.header.frame_count();
    for (int frame = 0; frame < frames; ++frame) {
        const track::Drive drive = drives.at(static_cast<double>(frame) / script.header.fps);
        const CoreStopwatch whole;
        const sim::FacePose pose = player.pose(drive);
        frame_ms.push_back(1e3 * whole.seconds());
        const CoreStopwatch part;
        weights.of(drive);
        weights_ms.push_back(1e3 * part.seconds());
    }
    return {{"shapes", count},
            {"vertices", face.head().vertices.rows()},
            {"moved_vertices", moved},
            {"frames", frames},
            {"frame_ms", median(frame_ms)},
            {"slowest_frame_ms", *std::max_element(frame_ms.begin(), frame_ms.end())},
            {"weights_ms", median(weights_ms)}};
}

}  // namespace risorius::app
