// SPDX-License-Identifier: MIT
/// \file
/// Solves the poses of a face in equilibrium with a list of drives, several at a time. Each starts from rest, so the results depend only on
/// the drive, not on the number of threads or the order.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/channels.h"

namespace risorius::blendshapes {

struct SolvedPose {
    Points moved;  ///< displacement of every vertex, V x 3, m, head frame
    std::array<Mat3, 2> eye_rotation{Mat3::Identity(), Mat3::Identity()};
    face::StepStats figures;
    double volume_ratio = 1;  ///< volume of the tissue / that at rest
    int inverted_tets = 0;
};

/// How a pose is reached from rest.
struct Approach {
    int steps = 1;      ///< number of equal steps
    bool again = true;  ///< tries again in small steps when it did not converge
};

class ShapeSolver {
  public:
    /// Keeps references.
    ShapeSolver(const scene::RigFiles& files, const face::Quality& quality, int threads);
    ~ShapeSolver();

    /// Returns the poses in the order of the drives. Throws Interrupted.
    std::vector<SolvedPose> solve(const std::vector<track::Drive>& drives,
                                  const ProgressMonitor& monitor, const Approach& how = {}) const;

    /// A face for reading what does not move; it is used for poses too.
    const face::Face& face() const { return *faces_.front(); }

    /// A face of the caller's own.
    std::unique_ptr<face::Face> another() const;

  private:
    SolvedPose pose(face::Face& face, const track::Drive& drive, const Approach& how,
                    const std::function<bool()>& stopped) const;
    face::Face& idle() const;  ///< a face that is not in use

    const scene::RigFiles& files_;
    face::Quality quality_;
    int threads_;
    double rest_volume_m3_;
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<face::Face>> faces_;  ///< all faces so far; at least one
    mutable std::vector<face::Face*> idle_;
};

}  // namespace risorius::blendshapes
