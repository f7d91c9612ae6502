// SPDX-License-Identifier: MIT
/// \file
/// Solves the equilibrium poses of a face for a list of drives, several at a time. Each pose starts from rest, so results depend
/// only on the drive, not on the number of threads or the order.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/face/face_team.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/channels.h"

namespace risorius::blendshapes {

/// The equilibrium pose of a drive.
struct SolvedPose {
    Points moved;  ///< displacement of every vertex, V x 3, m, head frame
    std::array<Mat3, 2> eye_rotation{Mat3::Identity(), Mat3::Identity()};
    face::StepStats figures;
    double volume_ratio = 1;  ///< volume of the tissue over that at rest
    int inverted_tets = 0;
};

/// How the solver goes from rest to the equilibrium under the drive.
struct Approach {
    int steps = 1;      ///< number of equal load steps
    bool again = true;  ///< true: if the solve does not converge, it is repeated in small steps
};

/// Solves poses in parallel with one face per thread.
class ShapeSolver {
  public:
    /// Keeps references to `files`. Throws Error when the face cannot be built.
    ShapeSolver(const scene::RigFiles& files, const face::Quality& quality, int threads);
    ~ShapeSolver();

    /// Returns the poses in the order of the drives. Throws Interrupted when the monitor asks to stop.
    std::vector<SolvedPose> solve(const std::vector<track::Drive>& drives,
                                  const ProgressMonitor& monitor, const Approach& how = {}) const;

    /// Returns a face for reading properties that no pose changes. The face is also used to solve poses.
    const face::Face& face() const { return *first_; }

    /// A new face that the caller owns.
    std::unique_ptr<face::Face> another() const;

  private:
    SolvedPose pose(face::Face& face, const track::Drive& drive, const Approach& how,
                    const std::function<bool()>& stopped) const;

    const scene::RigFiles& files_;
    face::Quality quality_;
    std::unique_ptr<face::Face> first_;
    std::unique_ptr<face::FaceTeam> team_;
    double rest_volume_m3_;
};

}  // namespace risorius::blendshapes
