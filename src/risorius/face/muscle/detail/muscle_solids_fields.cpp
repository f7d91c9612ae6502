// SPDX-License-Identifier: MIT
// The state of each cell of the volume muscles, for fields.
#include "risorius/face/muscle/detail/muscle_solids.h"

namespace risorius::face {

namespace {

/// Corners of a cell (4 b1 + 2 b2 + b3) in the order of VTK: round its lower face, then round the upper one.
constexpr std::array<int, 8> kRound{0, 4, 6, 2, 1, 5, 7, 3};

}  // namespace

std::vector<SolidCellState> MuscleSolids::cell_states(const Points& x,
                                                      const Eigen::VectorXd& activation) const {
    std::vector<SolidCellState> out;
    Points local;
    for (const Part& part : parts_) {
        take(part, x, local);
        const tissue::CellSolid& cells = *part.cells;
        const tissue::GridShape& grid = part.place.grid;
        const Eigen::VectorXd now = cells.cell_volumes(local), then = cells.cell_volumes(part.rest);
        const std::vector<muscle::ChainSet::State> chains =
            part.chains->states(local, activation[part.place.column]);
        const auto& list = cells.mesh().cells();
        for (std::size_t c = 0; c < list.size(); ++c) {
            const int cell = static_cast<int>(c);
            SolidCellState state;
            state.column = part.place.column;
            state.volume_ratio = now[cell] / then[cell];
            const tissue::CellModuli& moduli = cells.body().moduli[c];
            const Mat3 f = cells.deformation_gradient(local, cell);
            const Mat3 strain = f.transpose() * f - Mat3::Identity();
            state.stress_pa = moduli.mu_pa / f.determinant() * f * strain * f.transpose() +
                              moduli.bulk_pa * (state.volume_ratio - 1) * Mat3::Identity();
            Vec3 along = Vec3::Zero();
            double stretch = 0, tension_n = 0;
            for (std::size_t k = 0; k < 8; ++k) {
                const int vertex = list[c].vertex[static_cast<std::size_t>(kRound[k])];
                state.node[k] = part.place.node[static_cast<std::size_t>(vertex)];
                along += (kRound[k] & 4 ? 1 : -1) * local.row(vertex).transpose();
                // Each of the four chains at the edges has a node at either end of the cell
                const auto& chain = chains[static_cast<std::size_t>(vertex % (grid.n * grid.o))];
                stretch += chain.stretch / 8;
                tension_n += chain.force_n / 8;
            }
            state.direction = along.normalized();
            state.stretch = stretch;
            state.tension_n = tension_n;
            out.push_back(state);
        }
    }
    return out;
}

}  // namespace risorius::face
