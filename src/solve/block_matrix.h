// Symmetric sparse matrix of 3 x 3 blocks in single precision, one row of blocks per node: what a preconditioner needs of
// a second derivative. Half the memory of doubles, and a block times a point is three multiplications of four lanes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.h"

namespace risorius::solve {

typedef float FloatRow __attribute__((vector_size(16)));  ///< x y z 0

/// Columns of a 3 x 3 block.
struct Block {
    FloatRow column[3];
};

/// One point per 16 bytes.
using FloatPoints = std::vector<FloatRow>;

class BlockMatrix {
  public:
    /// `cliques`: lists of nodes all of whose pairs may be filled; every node also has its diagonal.
    BlockMatrix(int nodes, const std::vector<std::vector<int>>& cliques);

    int size() const { return static_cast<int>(diagonal_.size()); }
    int slot(int i, int j) const;  ///< of block (i, j); -1 outside the pattern
    /// One past the last block: what must not count can be added there.
    int spare_slot() const { return static_cast<int>(column_.size()); }

    void set_zero();
    Block& block(int slot) { return blocks_[static_cast<std::size_t>(slot)]; }
    const Block& block(int slot) const { return blocks_[static_cast<std::size_t>(slot)]; }
    Block& diagonal(int i) { return block(diagonal_[static_cast<std::size_t>(i)]); }

    /// Inverts the diagonal blocks; call before the sweeps.
    void finish();

    /// x = (D + L)^-1 b, the forward half of a Gauss-Seidel sweep from zero, and r = b - A x of it.
    void forward_from_zero(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const;
    void forward(const FloatPoints& b, FloatPoints& x) const;   ///< sweep
    void backward(const FloatPoints& b, FloatPoints& x) const;  ///< sweep in reverse order
    void residual(const FloatPoints& b, const FloatPoints& x, FloatPoints& r) const;

  private:
    std::vector<std::int32_t> row_begin_;  ///< n + 1
    std::vector<std::int32_t> column_;     ///< ascending within a row
    std::vector<std::int32_t> diagonal_;   ///< slots
    std::vector<Block> blocks_, inverse_;
};

}  // namespace risorius::solve
