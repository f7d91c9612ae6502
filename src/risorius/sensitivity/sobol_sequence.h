// SPDX-License-Identifier: MIT
/// \file
/// The Sobol sequence: points that fill the unit cube more evenly than random ones. Of any 2^m points from a multiple of 2^m on, every
/// coordinate has one in each interval of length 2^-m.
///
///   x_n = XOR of v_k over the bits k of the Gray code of n          v_k = m_k / 2^k
///   m_k = 2 a_1 m_{k-1} ^ 2^2 a_2 m_{k-2} ^ ... ^ 2^s m_{k-s} ^ m_{k-s}
///
/// a are the coefficients of a primitive polynomial of degree s over GF(2), another one for each coordinate, in the order of their
/// degree. The first m_1..m_s of a coordinate are free; here a search chooses them, see sobol_sequence.cpp.
///
/// Sources: Sobol' 1967, USSR Comput. Math. Math. Phys. 7(4), 86-112; Antonov & Saleev 1979 (order by the Gray code);
/// Joe & Kuo 2008, SIAM J. Sci. Comput. 30, 2635-2654 (choice by projections on two coordinates).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace risorius::sensitivity {

class SobolSequence {
  public:
    static constexpr int kMaxDimensions = 64;
    static constexpr int kBits = 32;

    /// `dimensions`: 1..kMaxDimensions. More dimensions leave the coordinates of the first ones as they are.
    explicit SobolSequence(int dimensions);

    int dimensions() const { return static_cast<int>(directions_.size()); }
    /// Returns coordinate `dimension` of point `n` times 2^32.
    std::uint32_t bits(std::uint32_t n, int dimension) const;
    double at(std::uint32_t n, int dimension) const { return 0x1p-32 * bits(n, dimension); }
    /// Returns the least t such that the first 2^m points, seen in two coordinates, are a (t, m, 2)-net: each box of area 2^(t-m)
    /// with sides 2^-i and 2^-j has 2^t of them.
    int net_quality(int m, int one, int other) const;

  private:
    using Directions = std::array<std::uint32_t, kBits>;
    std::vector<Directions> directions_;
};

}  // namespace risorius::sensitivity
