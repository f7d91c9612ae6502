// The poses of a face in equilibrium with a list of drives, several at a time. Each is found from rest, so that what comes out hangs
// on nothing but the drive: not on the number of threads, nor on the order.
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
    double volume_ratio = 1;  ///< of the tissue, against rest
    int inverted_tets = 0;
};

/// How a pose is approached from rest.
struct Approach {
    int steps = 1;      ///< equal ones
    bool again = true;  ///< in small ones, when it did not come to rest
};

class ShapeSolver {
  public:
    /// Keeps references.
    ShapeSolver(const scene::RigFiles& files, const face::Quality& quality, int threads);
    ~ShapeSolver();

    /// In the order of the drives. Throws Interrupted, and soon.
    std::vector<SolvedPose> solve(const std::vector<track::Drive>& drives,
                                  const ProgressMonitor& monitor, const Approach& how = {}) const;

    /// For what does not move: poses are sought with it.
    const face::Face& face() const { return *faces_.front(); }

    /// One of the caller's own.
    std::unique_ptr<face::Face> another() const;

  private:
    SolvedPose pose(face::Face& face, const track::Drive& drive, const Approach& how,
                    const std::function<bool()>& stopped) const;
    face::Face& idle() const;  ///< one that is not in use

    const scene::RigFiles& files_;
    face::Quality quality_;
    int threads_;
    double rest_volume_m3_;
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<face::Face>> faces_;  ///< all that were made; one at least
    mutable std::vector<face::Face*> idle_;
};

}  // namespace risorius::blendshapes
