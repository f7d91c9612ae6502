// SPDX-License-Identifier: MIT
#include "tools/bench/bench_poses.h"

#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/statics.h"
#include "risorius/report/stopwatch.h"
#include "risorius/rig/expression_drive.h"

namespace risorius::bench {

namespace {

constexpr double kCloser = 100;

track::Drive drive_of(const scene::RigFiles& files, const std::string& unit) {
    const auto expansion = rig::expansion_at(files.rig, unit, 1);
    if (!expansion) throw Error(files.place(), "a unit of its tables", "\"" + unit + "\"");
    return rig::clamped_drive(*expansion, files.rig.channels());
}

Json solve_equilibrium(face::Face& face, const std::string& unit, const track::Drive& drive) {
    track::Drive rest = drive;
    rest.excitation.setZero();
    rest.kinematic = {};
    face.start([&](double) { return rest; });
    const report::CoreStopwatch stopwatch;
    const face::StepStats figures = face.solve_equilibrium(drive.excitation, drive);
    const double seconds = stopwatch.seconds();
    const int inverted = face.diagnostics().inverted_tets();
    const Points at_rest = face.statics().nodes();
    face::StaticOptions closer{.iterations = face::kRestIterations};
    closer.tolerance_m /= kCloser;
    closer.planes_m /= kCloser;
    face.solve_equilibrium(drive.excitation, drive, closer);
    return json_object(
        {{"name", unit},
         {"iterations", figures.iterations},
         {"seconds", seconds},
         {"at_rest", figures.converged},
         {"inverted", inverted},
         {"left_mm", 1e3 * (face.statics().nodes() - at_rest).rowwise().norm().maxCoeff()}});
}

}  // namespace

Json bench_poses(const scene::RigFiles& files, const PoseBench& bench,
                 const ProgressMonitor& monitor) {
    std::vector<track::Drive> drives;
    for (const std::string& unit : bench.units) drives.push_back(drive_of(files, unit));
    // Progress is counted in nodes, because time is proportional to them.
    double all = 0, done = 0;
    for (const int vertices : bench.shell_vertices)
        all += static_cast<double>(vertices) * static_cast<double>(drives.size());
    Json out = Json::array();
    for (const int vertices : bench.shell_vertices) {
        face::Quality quality = face::quality_named("fine");
        quality.shell_vertices = vertices;
        face::Face face(files.rig, files.mesh, quality, files.place());
        Json poses = Json::array();
        for (std::size_t i = 0; i < drives.size(); ++i) {
            monitor.report(
                done / all,
                bench.units[i] + ", " + std::to_string(face.diagnostics().node_count()) + " nodes");
            poses.push_back(solve_equilibrium(face, bench.units[i], drives[i]));
            done += vertices;
        }
        out.push_back(json_object({{"shell_vertices", vertices},
                                   {"nodes", face.diagnostics().node_count()},
                                   {"tets", face.diagnostics().tet_count()},
                                   {"poses", std::move(poses)}}));
    }
    return out;
}

}  // namespace risorius::bench
