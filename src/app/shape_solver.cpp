#include "app/shape_solver.h"

#include <mutex>

#include "experiment/experiment_kind.h"
#include "experiment/spare_threads.h"

namespace risorius::app {

namespace {

constexpr int kSmallSteps = 6;

track::Drive at_rest(const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return drive;
}

track::Drive scaled(track::Drive drive, double share) {
    drive.excitation *= share;
    for (double& value : drive.kinematic) value *= share;
    return drive;
}

}  // namespace

ShapeSolver::ShapeSolver(const RigFiles& files, const sim::Quality& quality, int threads)
    : files_(files), quality_(quality), threads_(threads) {
    first_ = another();
    rest_volume_m3_ = first_->tissue_volume_m3();
}
ShapeSolver::~ShapeSolver() = default;

std::unique_ptr<sim::Face> ShapeSolver::another() const {
    return std::make_unique<sim::Face>(files_.rig, files_.mesh, quality_, files_.place());
}

SolvedPose ShapeSolver::pose(sim::Face& face, const track::Drive& drive, int steps) const {
    const track::Drive rest = at_rest(files_.rig.channels());
    SolvedPose out;
    const auto approach = [&](int so_many) {
        face.start([&](double) { return rest; });
        for (int step = 1; step <= so_many; ++step) {
            const track::Drive part = scaled(drive, static_cast<double>(step) / so_many);
            out.figures = face.settle(part.excitation, part);
        }
        out.inverted_tets = face.inverted_tets();
    };
    approach(steps);
    if (steps < kSmallSteps && !out.figures.converged) approach(kSmallSteps);
    const sim::FacePose pose = face.pose();
    out.moved = pose.vertices - face.head().vertices;
    out.eye_rotation = pose.eye_rotation;
    out.volume_ratio = face.tissue_volume_m3() / rest_volume_m3_;
    return out;
}

std::vector<SolvedPose> ShapeSolver::solve(const std::vector<track::Drive>& drives,
                                           const Watch& watch, int steps) const {
    std::vector<SolvedPose> out(drives.size());
    std::mutex telling;
    std::size_t done = 0;
    experiment::SpareThreads spare(experiment::ThreadLimit(threads_).count() - 1);
    experiment::parallel_for(static_cast<int>(drives.size()), {threads_, &spare}, [&](int i) {
        if (watch.stopped && watch.stopped()) throw Interrupted();
        // A face of its own for each, that has been nowhere before: what it finds hangs on the drive alone
        const std::unique_ptr<sim::Face> face = another();
        const auto at = static_cast<std::size_t>(i);
        out[at] = pose(*face, drives[at], steps);
        const std::lock_guard<std::mutex> lock(telling);
        ++done;
        watch.tell(static_cast<double>(done) / static_cast<double>(drives.size()), "poses");
    });
    return out;
}

}  // namespace risorius::app
