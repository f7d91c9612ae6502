// SPDX-License-Identifier: MIT
/// \file
/// The belly of one side of a volume muscle: a solid with fibres over nodes of its own. GridBelly is a grid of cells with chains of fibres,
/// MeshBelly a mesh of tetrahedra.
///
/// Positions are in the head frame, m, one row per node of the belly. `activation` is that of the muscle, 0..1.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <vector>

#include "risorius/face/muscle/detail/solid_figures.h"
#include "risorius/face/muscle/detail/solid_placement.h"
#include "risorius/muscle/chain_set.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/rig/rig_description.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/tissue/along_fibres.h"

namespace risorius::solve {
enum class Curvature;
}

namespace risorius::face {

/// A point of a belly as a mean of its nodes.
struct BellyPoint {
    int count = 0;  ///< [0, 8]; 0: none was found
    std::array<int, 8> node{};
    std::array<double, 8> weight{};
};

/// A closed surface for drawing, with the data of MuscleSurfaces.
struct BellySurface {
    Eigen::SparseMatrix<double, Eigen::RowMajor> weights;  ///< of the nodes in each vertex
    Triangles triangles;
    TexCoords fibre;
    std::vector<double> tendon;
};

class SolidBelly {
  public:
    virtual ~SolidBelly() = default;

    const SolidPart& place() const { return place_; }
    const Points& rest() const { return rest_; }
    virtual Eigen::VectorXd mass_kg() const = 0;  ///< of each node

    /// Prepares steps of length h, s, from `start`; h may be infinite.
    virtual void begin_step(double h, const Points& start) = 0;
    /// Adds E to `energy`, J, and dE/dx to `gradient`, N.
    virtual void add_energy(const Points& x, double activation, double& energy,
                            Points& gradient) const = 0;
    /// Adds the second derivative, N/m. Node i is row `row[i]` of the builder.
    virtual void add_hessian(const Points& x, double activation, solve::Curvature curvature,
                             const std::vector<int>& row, solve::HessianBuilder& hessian) const = 0;
    /// Adds an approximation of it without negative part, for a preconditioner.
    virtual void add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                               solve::HessianBuilder& hessian) const = 0;

    /// Maximum isometric force of the whole belly, N.
    virtual double f0_n() const = 0;
    /// Sets it to `factor` times that of the start.
    virtual void set_strength(double factor) = 0;
    /// Mean length of the fibres over that at rest.
    virtual double mean_stretch(const Points& x, double activation) const = 0;
    /// One per chain of fibres; one for all fibres of a mesh.
    virtual std::vector<muscle::ChainSet::State> chain_states(const Points& x,
                                                              double activation) const = 0;
    virtual muscle::ChainProperties chain() const = 0;
    virtual double volume(const Points& x) const = 0;  ///< m^3
    virtual double rest_volume() const = 0;
    virtual SolidFigures figures(const Points& x, double activation) const = 0;
    /// `node` of the result: of all volume muscles.
    virtual void add_cell_states(const Points& x, double activation,
                                 std::vector<SolidCellState>& states) const = 0;
    /// The nodes of each section from origin to insertion.
    virtual std::vector<std::vector<int>> sections() const = 0;
    /// `bone_ends`: whether origin and insertion are on bone.
    virtual BellySurface surface(const std::array<bool, 2>& bone_ends) const = 0;
    /// Finds p in the belly, or near it. `least_excess`: how far outside the best point so far is, over the size of a cell; a better
    /// one replaces it and `best`.
    virtual void find(const Vec3& p, double& least_excess, BellyPoint& best) const = 0;

  protected:
    SolidBelly(SolidPart place, const SolidPlacement& nodes);
    /// Curves of its fibres.
    muscle::ZajacShape curves(const rig::RigDescription& rig) const;
    /// What the isotropic matrix lacks along the fibres. The passive curve of the fibres begins without a slope, so it adds nothing
    /// to the published modulus, which was measured at small strains.
    tissue::AlongFibres::Moduli along_moduli() const;
    SolidPart place_;
    Points rest_;
};

constexpr double kMuscleDensity_kg_m3 = 1060;

/// Adds blocks over the nodes of a belly to a matrix in which node i is row `row[i]`.
void add_blocks(const solve::SymmetricBlocks& blocks, const std::vector<int>& row,
                solve::HessianBuilder& hessian);

/// Throws Error with the name of the muscle for a cell that is folded on this head.
std::unique_ptr<SolidBelly> make_belly(const SolidPart& place, const SolidPlacement& nodes,
                                       const rig::RigDescription& rig);

}  // namespace risorius::face
