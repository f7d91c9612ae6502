// SPDX-License-Identifier: MIT
/// \file
/// Fields over a grid in one flat array of floats, processed eight at a time. A cell has the number of the node at its lowest
/// corner, and the array has zeros before and behind it, so each neighbour is at a fixed distance. The cells of the last layer
/// along each axis do not exist; their values are zero.
#pragma once

#include <array>
#include <cstring>
#include <vector>

#include "risorius/tissue/solid_material.h"

namespace risorius::tissue::detail {

typedef float Lanes8 __attribute__((vector_size(32)));

inline Lanes8 load8(const float* from) {
    Lanes8 lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}
inline void store8(float* to, const Lanes8& lanes) { std::memcpy(to, &lanes, sizeof lanes); }

/// The layout of the array: numbers of nodes and distances between neighbours.
struct PaddedGrid {
    GridShape nodes;

    /// End of the loops, which run in steps of eight.
    int size() const { return (nodes.size() + 7) / 8 * 8; }
    int distance(int i, int j, int k) const { return (i * nodes.n + j) * nodes.o + k; }
    int halo() const { return distance(1, 1, 1) + 8; }
    /// Distance in the array from a cell to its corner v = 4 b1 + 2 b2 + b3.
    int corner(int v) const { return distance(v >> 2 & 1, v >> 1 & 1, v & 1); }
};

/// One number per cell or node of a PaddedGrid, with zeros before and behind.
class Field {
  public:
    Field() = default;
    explicit Field(const PaddedGrid& grid)
        : halo_(static_cast<std::size_t>(grid.halo())),
          values_(static_cast<std::size_t>(grid.size()) + 2 * halo_, 0.0f) {}

    float* data() { return values_.data() + halo_; }
    const float* data() const { return values_.data() + halo_; }
    float& operator[](int i) { return data()[i]; }
    float operator[](int i) const { return data()[i]; }
    void set_zero() { std::memset(values_.data(), 0, values_.size() * sizeof(float)); }

  private:
    std::size_t halo_ = 0;
    std::vector<float> values_;
};

/// The 13 of a cell's 26 neighbours that have higher numbers.
constexpr int kBehind[13][3] = {{0, 0, 1},  {0, 1, -1}, {0, 1, 0},  {0, 1, 1}, {1, -1, -1},
                                {1, -1, 0}, {1, -1, 1}, {1, 0, -1}, {1, 0, 0}, {1, 0, 1},
                                {1, 1, -1}, {1, 1, 0},  {1, 1, 1}};

}  // namespace risorius::tissue::detail
