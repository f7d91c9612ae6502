// SPDX-License-Identifier: MIT
/// \file
/// Displacements of the landmarks of brows, eyes, nose and lips when a head makes an expression. They are scaled to the size of the
/// atlas head, so that expressions of different heads can be compared.
///
/// File: {"format": "risorius-landmark-ways", "version": 1, "source": "...", "expressions": {name: {landmark: [x, y, z]}}}, mm.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/track/channels.h"

namespace risorius::scene {

class LandmarkDisplacements {
  public:
    /// `face` and `rig` must outlive this object; `place` names the rig in messages.
    LandmarkDisplacements(face::Face& face, const rig::RigDescription& rig,
                          const std::string& place);

    const std::vector<std::string>& landmarks() const { return ids_; }
    int vertex(std::size_t landmark) const { return points_.vertex(ids_[landmark]); }
    /// Returns the drive of an expression from the rig's tables. Throws Error for an unknown name.
    track::Drive drive(const std::string& expression) const;
    /// Solves the equilibrium of the face under the drive, from rest, and returns the displacements of landmarks(): n x 3, m, at
    /// the size of the atlas head.
    /// `tolerance_m`: of the equilibrium, see StaticOptions.
    Points solve_equilibrium(const track::Drive& drive, int iterations = face::kRestIterations,
                             double tolerance_m = face::StaticOptions{}.tolerance_m);
    /// Whether the last call of solve_equilibrium() reached equilibrium.
    bool in_equilibrium() const { return in_equilibrium_; }

  private:
    face::Face& face_;
    const rig::RigDescription& rig_;
    std::string place_;
    LandmarkPoints points_;
    std::vector<std::string> ids_;
    track::Drive at_rest_;
    bool in_equilibrium_ = true;
};

/// A map from the name of an expression to a map from the id of a landmark to its displacement, m.
using DisplacementTable = std::map<std::string, std::map<std::string, Vec3>>;

/// Reads a file of the format above. Throws Error for a wrong file.
DisplacementTable read_landmark_displacements(const std::filesystem::path& file);
Json landmark_displacements_json(const DisplacementTable& displacements, const std::string& source);

}  // namespace risorius::scene
