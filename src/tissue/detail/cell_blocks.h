// Stiffness of one cell for a preconditioner: 8 x 8 blocks at the mean tangents of the cell, without stress.
//
// With constant tangents the modes of a trilinear map (cell_lanes.h) decouple: {a b c}, {d e f} and k. The blocks are made
// there and taken to the corners by sums and differences.
#pragma once

#include "solve/block_matrix.h"
#include "tissue/cell_body.h"

namespace risorius::tissue::detail {

/// What of a cell does not change: lambda + omega/h (or C with its factor) in the scale of the modes.
struct CellBlockLaw {
    bool physical = false;
    float elastic[6] = {};  ///< 11 22 33 12 13 23; physical: C
    float factor = 0;       ///< physical: mu + eta/h times the volume
    float root_bulk = 0;    ///< sqrt(2 psi) of 64 V
};

constexpr double kCellBlockFlops = 4500;  ///< about, of one cell

CellBlockLaw cell_block_law(const CellBody& body, int cell, const Points& rest_vertices,
                            double rate_hz);

/// Block 8 v + w belongs to corners v and w; written for v <= w only.
void cell_blocks(const CellBlockLaw& law, const CellMesh::Cell& cell, const Points& vertices,
                 solve::Block (&blocks)[64]);

}  // namespace risorius::tissue::detail
