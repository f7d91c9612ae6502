// Preconditioner of an implicit step of a solid of cells in O(n): geometric multigrid over the same body with fewer cells,
// linearised anew at every step. That the parameters do not depend on the resolution is what makes a coarse level.
//
//   level 0   the solid itself; then refined cells are merged, level by level, then the root grid is halved
//   smoother  one forward Gauss-Seidel sweep down, one backward up, on 3 x 3 blocks in single precision
//   operator  stiffness of each cell at its mean tangents, Gauss-Newton (no stress term, hence positive), M/h^2, and the
//             diagonal of the other terms' metric
//
// Why: nearly incompressible tissue is 20 to 100 times stiffer in volume than in shape, and which motions change volume
// depends on the shape now. A constant matrix cannot know; see the measurements in tests/bench/solids_bench.cpp.
#pragma once

#include <memory>
#include <vector>

#include "solve/preconditioner.h"
#include "tissue/cell_solid.h"

namespace risorius::tissue {

struct MultigridOptions {
    int sweeps = 1;           ///< down and up, each        [1, ...)
    int coarsest_nodes = 64;  ///< a level this small is solved directly
};

class CellMultigrid : public solve::Preconditioner {
  public:
    /// `solid` is a term of `system`, whose nodes are the solid's. Steps are of `step_s`.
    CellMultigrid(const solve::MotionSystem& system, std::shared_ptr<const CellSolid> solid,
                  double step_s, const MultigridOptions& options = {});
    ~CellMultigrid() override;

    void refresh(const solve::ImplicitStep& step, const Points& x) override;
    void apply(const Points& b, Points& x) const override;

    int level_count() const;
    /// Multiplications of one apply() and of one refresh(), counted from the levels' sizes: the same on any machine.
    double apply_flops() const;
    double refresh_flops() const;

  private:
    struct Level;
    void cycle(std::size_t level) const;

    MultigridOptions options_;
    std::vector<std::unique_ptr<Level>> levels_;
};

/// The body on a mesh with fewer cells: merged once where it is finest, or on half the root grid.
CellMesh coarser(const CellMesh& mesh);
/// What `body` is on a coarser mesh: materials and masses averaged, the rest shape sampled.
CellBody coarsened(const CellBody& body, const CellMesh& mesh);

}  // namespace risorius::tissue
