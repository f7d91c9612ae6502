// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_solver.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "risorius/face/diagnostics.h"

namespace risorius::blendshapes {

namespace {

constexpr int kSmallSteps = 6;

// Iteration limits of an equilibrium. Shapes should be accurate to a tenth of a millimetre. On the adult, no vertex is off by
// more than 0.05 mm with these limits, provided that contact allows an equilibrium; a tolerance a hundred times smaller takes
// half as many iterations again.
constexpr int kIterations = 400;      // poses without convergence by then hardly ever converge
constexpr int kIterationsOnce = 250;  // for poses that are not solved again
constexpr double kTolerance_m = 0.05e-3, kPlanes_m = 0.1e-3;

track::Drive at_rest(const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return drive;
}

track::Drive scaled(track::Drive drive, double fraction) {
    drive.excitation *= fraction;
    for (double& value : drive.kinematic) value *= fraction;
    return drive;
}

// Cheeks that are blown up take ten times as long as most poses. Begun last, they would keep one thread busy while the others wait.
std::vector<std::size_t> longest_first(const std::vector<track::Drive>& drives) {
    std::vector<std::size_t> out(drives.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
        return drives[a].at(track::Kinematic::kMouthPressure) >
               drives[b].at(track::Kinematic::kMouthPressure);
    });
    return out;
}

}  // namespace

ShapeSolver::ShapeSolver(const scene::RigFiles& files, const face::Quality& quality, int threads)
    : files_(files),
      quality_(quality),
      first_(another()),
      team_(std::make_unique<face::FaceTeam>(
          *first_, [this] { return std::move(*another()); }, threads)) {
    rest_volume_m3_ = face().diagnostics().tissue_volume_m3();
}
ShapeSolver::~ShapeSolver() = default;

std::unique_ptr<face::Face> ShapeSolver::another() const {
    return std::make_unique<face::Face>(files_.rig, files_.mesh, quality_, files_.place());
}

SolvedPose ShapeSolver::pose(face::Face& face, const track::Drive& drive, const Approach& how,
                             const std::function<bool()>& stopped) const {
    const track::Drive rest = at_rest(files_.rig.channels());
    SolvedPose out;
    const auto approach = [&](int so_many) {
        face.start([&](double) { return rest; });
        for (int step = 1; step <= so_many; ++step) {
            const track::Drive part = scaled(drive, static_cast<double>(step) / so_many);
            out.figures =
                face.solve_equilibrium(part.excitation, part,
                                       {.iterations = how.again ? kIterations : kIterationsOnce,
                                        .tolerance_m = kTolerance_m,
                                        .planes_m = kPlanes_m,
                                        .stopped = stopped});
            if (stopped && stopped()) throw Interrupted();
        }
        out.inverted_tets = face.diagnostics().inverted_tets();
    };
    approach(how.steps);
    if (how.again && how.steps < kSmallSteps && !out.figures.converged) approach(kSmallSteps);
    const face::FacePose pose = face.pose();
    out.moved = pose.vertices - face.head().vertices;
    out.eye_rotation = pose.eye_rotation;
    out.volume_ratio = face.diagnostics().tissue_volume_m3() / rest_volume_m3_;
    return out;
}

std::vector<SolvedPose> ShapeSolver::solve(const std::vector<track::Drive>& drives,
                                           const ProgressMonitor& monitor,
                                           const Approach& how) const {
    std::vector<SolvedPose> out(drives.size());
    TaskProgress progress(monitor, static_cast<int>(drives.size()));
    const std::vector<std::size_t> order = longest_first(drives);
    team_->each(static_cast<int>(drives.size()), [&](int i, face::Face& face) {
        progress.begin("poses");
        const std::size_t at = order[static_cast<std::size_t>(i)];
        out[at] = pose(face, drives[at], how, monitor.stopped);
    });
    return out;
}

}  // namespace risorius::blendshapes
