// SPDX-License-Identifier: MIT
/// \file
/// What can be measured on a face: muscles, landmarks, energies, penetration, sizes of the mesh and the history of the solver.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/muscle/detail/solid_figures.h"
#include "risorius/face/step_stats.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct FaceImpl;

/// One side of a muscle.
struct MuscleState {
    /// Mean over its fibres, with their tendons where it is a volume muscle.
    double length_m = 0;
    double stretch = 1;  ///< mean over its fibres, length / optimal length
    /// Sum over its fibres. It is isometric: the force at this length and activation if the fibres did not move.
    double force_n = 0;
    /// force_n / cross-section, Pa; nothing where the rig's table gives no cross-section (csa_mm2).
    std::optional<double> stress_pa;
};

/// A view of a Face, from Face::diagnostics(). Everything refers to the state after the last step or equilibrium, m in the head
/// frame. No function changes the state.
class Diagnostics {
  public:
    explicit Diagnostics(FaceImpl& face) : face_(&face) {}

    // Muscles and landmarks

    /// Returns the drive as the muscles receive it. When muscles move the jaw, it contains what the jaw's channels ask of them.
    track::Drive driven(track::Drive drive) const;
    /// `muscle` is an id of the rig's table, as "zygomaticus_major". Throws Error for an unknown one. Returns nothing for a muscle
    /// that the face does not simulate: one of the jaw while channels place the jaw, or one that only moves a lid.
    std::optional<MuscleState> muscle_state(const std::string& muscle, Side side) const;
    /// Returns the mean length of a muscle's fibres over their rest length, both sides; 1 for an unknown name.
    double mean_stretch(const std::string& muscle) const;
    /// Returns one entry per side of each volume muscle.
    std::vector<SolidFigures> solid_figures() const;
    /// Returns the position of a landmark of Face::head() in Face::pose(), m. A landmark that is no vertex moves with the nearest
    /// vertex of the skin. Throws Error for an unknown landmark. Costs as much as Face::pose().
    Vec3 landmark(const std::string& id) const;

    // Energy and penetration

    /// Potential energy of all energy terms, J: without inertia and damping, with the contact pairs found last. The active work
    /// of muscles counts, so that it may be negative.
    double energy_j() const;
    double kinetic_energy_j() const;
    double tissue_volume_m3() const;  ///< signed sum over all tetrahedra
    Penetration penetration() const;  ///< of the surfaces that Face::pose() shows

    // Mesh of the tissue

    /// T x 4 node indices, rows of Statics::nodes().
    const Tets& tets() const;
    int node_count() const;  ///< of the tissue, without the volume muscles
    int tet_count() const;
    int inverted_tets() const;  ///< number of tetrahedra with negative volume
    int dropped_tets() const;   ///< left out when the mesh was built, since they were too thin
    int fibre_count() const;
    const Shell& shell() const;      ///< the skin mesh and how it was coarsened
    Points skin_nodes() const;       ///< N x 3, m, one row per vertex of shell()
    Points rest_skin_nodes() const;  ///< the same at rest

    // Solver

    /// One entry per substep since Face::start(), or one per quasi-static pose.
    const std::vector<StepStats>& history() const;
    double build_s() const;  ///< wall time of the construction, s

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
