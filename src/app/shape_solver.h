// The poses of a face in equilibrium with a list of drives, several at a time. Each is found from rest, so that what comes out hangs
// on nothing but the drive: not on the number of threads, nor on the order.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "app/rig_files.h"
#include "app/watch.h"
#include "sim/face.h"
#include "track/channels.h"

namespace risorius::app {

struct SolvedPose {
    Points moved;  ///< displacement of every vertex, V x 3, m, head frame
    std::array<Mat3, 2> eye_rotation{Mat3::Identity(), Mat3::Identity()};
    sim::StepFigures figures;
    double volume_ratio = 1;  ///< of the tissue, against rest
    int inverted_tets = 0;
};

class ShapeSolver {
  public:
    /// Keeps references.
    ShapeSolver(const RigFiles& files, const sim::Quality& quality, int threads);
    ~ShapeSolver();

    /// In the order of the drives, each approached from rest in so many equal steps; one that does not come to rest is
    /// tried again in small ones. Throws Interrupted.
    std::vector<SolvedPose> solve(const std::vector<track::Drive>& drives, const Watch& watch,
                                  int steps = 1) const;

    /// A face that no pose is being sought with.
    const sim::Face& face() const { return *first_; }

    /// One of the caller's own.
    std::unique_ptr<sim::Face> another() const;

  private:
    SolvedPose pose(sim::Face& face, const track::Drive& drive, int steps) const;

    const RigFiles& files_;
    sim::Quality quality_;
    int threads_;
    double rest_volume_m3_;
    std::unique_ptr<sim::Face> first_;
};

}  // namespace risorius::app
