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

/// State of one side of a muscle.
struct MuscleState {
    /// Mean length of its fibres. In a volume muscle, the length includes their tendons.
    double length_m = 0;
    double stretch = 1;  ///< mean of length / optimal length over its fibres
    /// Sum of the isometric forces of its fibres: the force at this length and activation, without the effect of velocity.
    double force_n = 0;
    /// force_n / cross-sectional area, Pa; empty where the rig's table gives no area (csa_mm2).
    std::optional<double> stress_pa;
};

/// State of a pull (track::Pull) of the last step or equilibrium.
struct HeldPull {
    int vertex;
    Vec3 point;      ///< where the spring holds the skin, m, world frame
    Vec3 hand;       ///< its free end, m, world frame
    double force_n;  ///< of the spring
    double moved_m;  ///< of the point, from its position at rest in the head
};

/// A view of a Face, from Face::diagnostics(). Everything refers to the state after the last step or equilibrium. Positions are
/// in the head frame, m, unless a function says otherwise. No function changes the state.
class Diagnostics {
  public:
    explicit Diagnostics(FaceImpl& face) : face_(&face) {}

    // Muscles and landmarks

    /// Returns the drive with the excitations that the muscles receive. If muscles move the jaw, these include the excitations that
    /// jaw_open, jaw_forward and jaw_side stand for.
    track::Drive driven(track::Drive drive) const;
    /// `muscle` is an id of the rig's muscle table, such as "zygomaticus_major". Throws Error for an unknown id. Returns
    /// std::nullopt for a muscle that the face does not simulate: a jaw muscle while channels place the jaw, or a muscle that only
    /// moves a lid.
    std::optional<MuscleState> muscle_state(const std::string& muscle, Side side) const;
    /// Returns the maximum isometric force of all fibres of one side of a muscle, N, at activation 1 and optimal length. A muscle with one
    /// column gives the same for both sides. Returns std::nullopt where muscle_state() does. Throws Error for an unknown id.
    std::optional<double> greatest_force_n(const std::string& muscle, Side side) const;
    /// Returns length / rest length of a muscle's fibres, mean over both sides; 1 for an unknown id.
    double mean_stretch(const std::string& muscle) const;
    /// Returns measures of the volume muscles, one entry per side of each.
    std::vector<SolidFigures> solid_figures() const;
    /// Returns how stiff the tissue around the volume muscles is, one entry per side of each. It is that of the rig, in any state.
    std::vector<BesideSolid> beside_solids() const;
    /// Returns the position of a landmark of Face::head() in Face::pose(), m, in the world frame. A landmark that is not a vertex
    /// moves with the nearest vertex of the skin. Throws Error for an unknown landmark. Takes as long as Face::pose().
    Vec3 landmark(const std::string& id) const;

    /// Returns one entry per pull of the drive.
    std::vector<HeldPull> pulls() const;
    /// Returns one flag per vertex of the mesh: whether soft tissue moves it, so that it can be pulled.
    std::vector<char> soft_vertices() const;

    // Energy and penetration

    /// Returns the potential energy, the sum of all energy terms, J, with the contacts as the last step or equilibrium found them.
    /// Inertia and damping are left out. The energy may be negative, since it contains the active energy of the muscles.
    double energy_j() const;
    double kinetic_energy_j() const;  ///< of the motion within the head frame, J
    double tissue_volume_m3() const;  ///< sum of the signed volumes of all tetrahedra
    Penetration penetration() const;  ///< of the surfaces that Face::pose() shows

    // Mesh of the tissue

    /// T x 4 node indices, rows of Statics::nodes().
    const Tets& tets() const;
    int node_count() const;  ///< nodes of the tissue, without the volume muscles
    int tet_count() const;
    int inverted_tets() const;       ///< number of tetrahedra with negative volume
    int dropped_tets() const;        ///< tetrahedra too thin to be used in the mesh
    int fibre_count() const;         ///< fibres in bundles, without the volume muscles
    const Shell& shell() const;      ///< the skin mesh and how it was coarsened
    Points skin_nodes() const;       ///< N x 3, m, one row per vertex of shell()
    Points rest_skin_nodes() const;  ///< the same at rest

    // Solver

    /// Returns one entry per substep since Face::start(), or one per quasi-static pose.
    const std::vector<StepStats>& history() const;
    double build_s() const;  ///< wall time of the construction, s

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
