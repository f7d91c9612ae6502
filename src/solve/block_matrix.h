// Symmetric sparse matrix of 3 x 3 blocks in single precision, one row of blocks per node: what a preconditioner needs of
// a second derivative. Only the blocks above the diagonal are kept, nine floats each, since sweeps over a matrix are as
// fast as it comes from memory.
//
//   A = L + D + U,  L = U^T
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"

namespace risorius::solve {

typedef float FloatRow __attribute__((vector_size(16)));  ///< x y z and a fourth nobody reads

/// Columns of a 3 x 3 block; the fourth of each is zero.
struct Block {
    FloatRow column[3];
};

/// One point per 16 bytes.
using FloatPoints = std::vector<FloatRow>;

class BlockMatrix {
  public:
    /// `cliques`: lists of nodes all of whose pairs may be filled.
    BlockMatrix(int nodes, const std::vector<std::vector<int>>& cliques);

    int size() const { return static_cast<int>(diagonal_.size()); }
    long block_count() const { return static_cast<long>(column_.size()); }  ///< above the diagonal

    /// Of block (i, j), i < j; -1 outside the pattern.
    int slot(int i, int j) const;
    /// Takes what must not count.
    int spare_slot() const { return static_cast<int>(column_.size()); }

    void set_zero();
    void add(int slot, const Block& block);
    Block block(int slot) const;
    Block& diagonal(int i) { return diagonal_[static_cast<std::size_t>(i)]; }
    const Block& diagonal(int i) const { return diagonal_[static_cast<std::size_t>(i)]; }

    /// Inverts the diagonal blocks; call before the sweeps.
    void finish();

    /// x = (D + L)^-1 b, a forward Gauss-Seidel sweep from zero, and r = b - A x.
    void forward_from_zero(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const;
    /// A forward sweep from x, and r = b - A x of the result.
    void forward(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const;
    /// A sweep in reverse order; r is scratch.
    void backward(const FloatPoints& b, FloatPoints& x, FloatPoints& r) const;

  private:
    std::vector<std::int32_t> row_begin_;  ///< n + 1
    std::vector<std::int32_t> column_;     ///< ascending within a row
    std::vector<float> values_;            ///< by columns; the last block is the spare one
    std::vector<Block> diagonal_, inverse_;
};

}  // namespace risorius::solve
