// SPDX-License-Identifier: MIT
/// \file
/// The skin of the left half: a grid of columns (azimuth) and rows (height) over the head. Blocks are cut out of it and filled by edge loops
/// around the eye, the mouth, the nasal wing and the ear. Below the neck follow the shoulders.
#pragma once

#include <map>
#include <string>

#include "risorius/headmodel/detail/eyes.h"
#include "risorius/headmodel/detail/half_mesh.h"
#include "risorius/headmodel/detail/head_surface.h"

namespace risorius::headmodel {

struct Skin {
    HalfMesh mesh;
    std::vector<std::vector<int>> grid;           ///< [row][column], -1 inside a block
    std::vector<int> upper_margin, lower_margin;  ///< lips, midline to corner, corner shared
    std::vector<int> fixed;  ///< vertices that smoothing leaves unchanged: nostril rims, lids, lips
    std::vector<int>
        lid_margin;  ///< outer edge, from the inner canthus along the lower lid and back
    std::map<std::string, int> landmark;  ///< those that are vertices by construction
};

/// Returns the loop of grid vertices round a block of cells, counter-clockwise seen from outside, from its top left corner.
std::vector<int> block_loop(const std::vector<std::vector<int>>& grid, int row0, int row1,
                            int column0, int column1);

void add_lids(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
              const HeadSurface& head, const Globe& globe);
void add_mouth(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
               const HeadSurface& head);
void add_nasal_wing(Skin& skin, const std::vector<int>& block, const DesignTables& tables);
void add_ear(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
             const HeadSurface& head);

/// Names the landmarks on free skin and moves the skin smoothly onto them.
void fit_landmarks(Skin& skin, const DesignTables& tables);

/// Moves a point of the skin outwards, if necessary, so that its distance from the globe is at least `gap`, mm.
Vec3 clear_of_globe(const Vec3& point, const Globe& globe, double gap);

Skin make_skin(const DesignTables& tables, const HeadSurface& head, const Globe& globe);

}  // namespace risorius::headmodel
