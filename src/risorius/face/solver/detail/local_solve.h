// SPDX-License-Identifier: MIT
/// \file
/// A part of a face's tissue that moves while all else is held: what is slow to converge gets more iterations of a step, each
/// at the price of the part alone.
///
/// The energy is that of the whole step (face_tissue.h) but for what no moving node takes part in, over nodes of its own:
/// those that move, then those held beside them.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/muscle/detail/lip_drive.h"
#include "risorius/face/muscle/detail/muscle_solids.h"
#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/muscle/fibre_set.h"
#include "risorius/solve/quasi_newton.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/tissue/contacts.h"
#include "risorius/tissue/dead_loads.h"
#include "risorius/tissue/skin_sheet.h"
#include "risorius/tissue/tet_solid.h"
#include "risorius/tissue/tethers.h"

namespace risorius::face {

class LocalSolve {
  public:
    /// What it is a part of, as it stands in the step; all of it must outlive the part.
    struct Whole {
        const Points& rest;
        const tissue::TetSolid& tets;
        const Triangles& sheet;
        const Eigen::VectorXd& membrane_n_per_m;  ///< per triangle
        const Eigen::VectorXd& bending_n_m;       ///< likewise
        const tissue::ZeroLengthSprings& tethers;
        const muscle::FibreSet& fibres;
        const muscle::HillShape& hill;
        const MuscleSolids& solids;
        const LipDrive& lip_drive;
        const tissue::Contacts& contacts;
        const tissue::DeadLoads& loads;
        const Eigen::VectorXd& mass_kg;
        double damping_s;
        const FaceTerms& terms;
    };
    struct Step {
        double h;
        const Points& start;
        const Points& aim;
        const Eigen::VectorXd& activation;
        solve::Precision precision;
    };

    /// `moves` has a flag per node of the whole. `touching` are nodes that may ever touch and what the metric counts for that,
    /// N/m.
    LocalSolve(const Whole& whole, const std::vector<char>& moves, double h,
               std::span<const std::pair<int, double>> touching);

    double step_s() const { return h_; }
    int moving_nodes() const { return moving_; }

    /// Goes on with a step from x, which is where it ends too.
    solve::StepReport advance(const Step& step, const solve::QuasiNewtonOptions& options,
                              Points& x);

    /// The step's energy but for a constant, and its gradient by the nodes of the part: zero on those held. After begin().
    double energy(const Points& at, Points& gradient) const;
    void begin(const Step& step, const Points& x);
    Points taken(const Points& x) const;  ///< the part's rows of x
    const std::vector<int>& nodes() const { return node_; }

  private:
    bool moves(int node) const {
        // Loads act on the nodes of solid muscles too, which come after the tissue's
        if (static_cast<std::size_t>(node) >= own_.size()) return false;
        const int own = own_[static_cast<std::size_t>(node)];
        return own >= 0 && own < moving_;
    }
    int row_of(int node);  ///< made when first asked for
    void choose_elements();
    void choose_fibres();
    /// Terms without a local form are evaluated over all nodes, those that do not move held where they are.
    void add_whole_metric(const solve::EnergyTerm& term, solve::MetricBuilder& builder) const;
    double add_whole_potential(const Points& at, Points& gradient) const;

    const Whole whole_;
    double h_;
    int moving_ = 0;
    std::vector<int> node_;  ///< of the whole, those that move first
    std::vector<int> own_;   ///< per node of the whole: row here, or -1
    std::optional<tissue::TetSolid> tets_;
    std::optional<tissue::SkinSheet> skin_;
    std::optional<muscle::FibreSet> fibres_;
    std::vector<int> fibre_of_, point_of_;  ///< in the whole's set
    std::vector<int> first_point_;          ///< of each fibre here
    std::vector<int> tether_of_;
    tissue::ZeroLengthSprings tethers_{{}};
    LipDrive lip_drive_;
    tissue::Contacts contacts_;
    tissue::DeadLoads loads_;
    std::vector<MuscleSolids::Spring> springs_;
    Eigen::VectorXd mass_kg_;
    std::optional<solve::SparseCholesky> metric_;
    solve::QuasiNewton newton_;
    solve::Precision precision_ = solve::Precision::kDouble;
    Eigen::VectorXd activation_;
    Points aim_, x_;
    std::vector<const solve::EnergyTerm*> whole_terms_;
    Points whole_start_;
    mutable Points whole_x_, whole_gradient_;
};

}  // namespace risorius::face
