// SPDX-License-Identifier: MIT
/// \file
/// The problems of the kind "verification" (verification.h), each solved on one mesh.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "risorius/tissue/cell_body.h"

namespace risorius::figures {

/// The material of a problem.
struct KnownMaterial {
    double young_pa = 1, poisson_ratio = 0;
    bool bending_cells = false;  ///< tissue::BendingCells in place of tissue::CellSolid
    int lengthwise = 1;          ///< cells along the cantilever for each cell across
    tissue::CellModuli moduli() const;
    double shear_pa() const { return young_pa / (2 * (1 + poisson_ratio)); }
};

/// A problem with a known solution.
struct KnownProblem {
    std::string_view name;     ///< "cantilever"
    std::string_view measure;  ///< name of what solve() returns: "deflection_ratio"
    double exact;              ///< what solve() would return without error
    bool boxes;                ///< whether its cells are boxes, as bending cells need
    /// Returns the measure on a mesh with so many cells. Throws RunError when the solver does not come to rest.
    double (*solve)(const KnownMaterial& material, int cells);
};

const std::vector<KnownProblem>& known_problems();

}  // namespace risorius::figures
