// SPDX-License-Identifier: MIT
#include "risorius/sensitivity/sobol_sequence.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "risorius/core/counter_rng.h"

namespace risorius::sensitivity {

namespace {

using Word = std::uint32_t;
using DirectionWords = std::array<Word, SobolSequence::kBits>;
constexpr int kBits = SobolSequence::kBits;

/// Initial numbers that are tried for a coordinate; of small degrees there are fewer.
constexpr int kCandidates = 32;
/// A candidate is judged by the first 2^2 .. 2^kJudgedBits points.
constexpr int kJudgedBits = 8;

int degree_of(Word polynomial) {
    int degree = 0;
    while (polynomial >> (degree + 1)) ++degree;
    return degree;
}

/// Whether x generates all 2^s - 1 non-zero residues of the polynomial.
bool is_primitive(Word polynomial) {
    const int degree = degree_of(polynomial);
    const Word top = Word{1} << degree;
    Word power = 1;
    for (Word order = 1; order < top; ++order) {
        power <<= 1;
        if (power & top) power ^= polynomial;
        if (power == 1) return order == top - 1;
        if (power == 0) return false;
    }
    return false;
}

/// The primitive polynomials in ascending order, as bits of their coefficients; at first x + 1.
std::vector<Word> primitive_polynomials(int count) {
    std::vector<Word> out;
    for (Word polynomial = 3; static_cast<int>(out.size()) < count; polynomial += 2)
        if (polynomial == 3 || is_primitive(polynomial)) out.push_back(polynomial);
    return out;
}

DirectionWords with_recurrence(Word polynomial, const std::vector<Word>& initial) {
    const int degree = degree_of(polynomial);
    std::array<Word, kBits> m{};
    for (int k = 0; k < kBits; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (k < degree) {
            m[at] = initial[at];
            continue;
        }
        m[at] = m[at - static_cast<std::size_t>(degree)];
        for (int i = 1; i <= degree; ++i)
            if (polynomial >> (degree - i) & 1) m[at] ^= m[at - static_cast<std::size_t>(i)] << i;
    }
    DirectionWords out{};
    for (int k = 0; k < kBits; ++k)
        out[static_cast<std::size_t>(k)] = m[static_cast<std::size_t>(k)] << (kBits - 1 - k);
    return out;
}

/// Row `digit` of the generator matrix, restricted to the first m columns.
Word row_of(const DirectionWords& directions, int digit, int m) {
    Word row = 0;
    for (int k = 0; k < m; ++k)
        row |= (directions[static_cast<std::size_t>(k)] >> (kBits - 1 - digit) & 1) << k;
    return row;
}

/// Rows over GF(2), reduced as they are added.
class RowBasis {
  public:
    /// Returns false when the row depends on those before.
    bool add(Word row) {
        for (int k = 0; k < kBits; ++k) {
            if (!(row >> k & 1)) continue;
            Word& pivot = pivots_[static_cast<std::size_t>(k)];
            if (pivot == 0) {
                pivot = row;
                return true;
            }
            row ^= pivot;
        }
        return false;
    }

  private:
    std::array<Word, kBits> pivots_{};
};

/// t of a (t, m, 2)-net: m less the largest r for which any r leading rows of the two matrices together are independent.
int net_quality_of(const DirectionWords& one, const DirectionWords& other, int m) {
    int independent = m;
    RowBasis leading;
    for (int i = 0; i <= independent; ++i) {
        if (i > 0 && !leading.add(row_of(one, i - 1, m))) return m - (i - 1);
        RowBasis both = leading;
        int j = 0;
        while (j < m && both.add(row_of(other, j, m))) ++j;
        independent = std::min(independent, i + j);
    }
    return m - independent;
}

/// Small when the coordinate goes well with those before it.
double judge(const DirectionWords& candidate, const std::vector<DirectionWords>& before) {
    double sum = 0;
    for (const DirectionWords& other : before)
        for (int m = 2; m <= kJudgedBits; ++m)
            sum += static_cast<double>(1 << net_quality_of(other, candidate, m));
    return sum;
}

/// Odd numbers m_k < 2^k: the largest ones as the first candidate, which gives the usual third coordinate, then random ones.
std::vector<Word> initial_numbers(int degree, int dimension, int candidate) {
    std::vector<Word> out;
    if (candidate == 0) {
        for (int k = 0; k < degree; ++k) out.push_back((Word{1} << (k + 1)) - 1);
        return out;
    }
    CounterRng random(static_cast<std::uint64_t>(dimension));
    random.at(static_cast<std::uint64_t>(candidate));
    for (int k = 0; k < degree; ++k)
        out.push_back(
            static_cast<Word>(CounterRng(random).at(static_cast<std::uint64_t>(k)).bits() &
                              ((Word{1} << (k + 1)) - 1)) |
            1);
    return out;
}

}  // namespace

SobolSequence::SobolSequence(int dimensions) {
    assert(dimensions >= 1 && dimensions <= kMaxDimensions);
    // The first coordinate is the radical inverse: all m are 1.
    Directions radical{};
    for (int k = 0; k < kBits; ++k)
        radical[static_cast<std::size_t>(k)] = Word{1} << (kBits - 1 - k);
    directions_.push_back(radical);
    for (const Word polynomial : primitive_polynomials(dimensions - 1)) {
        const int dimension = this->dimensions();
        double best = std::numeric_limits<double>::infinity();
        Directions chosen{};
        for (int c = 0; c < kCandidates; ++c) {
            const Directions candidate =
                with_recurrence(polynomial, initial_numbers(degree_of(polynomial), dimension, c));
            const double judged = judge(candidate, directions_);
            if (judged < best) {
                best = judged;
                chosen = candidate;
            }
        }
        directions_.push_back(chosen);
    }
}

std::uint32_t SobolSequence::bits(std::uint32_t n, int dimension) const {
    const Directions& directions = directions_[static_cast<std::size_t>(dimension)];
    std::uint32_t out = 0;
    for (std::uint32_t gray = n ^ (n >> 1), k = 0; gray != 0; gray >>= 1, ++k)
        if (gray & 1) out ^= directions[k];
    return out;
}

int SobolSequence::net_quality(int m, int one, int other) const {
    return net_quality_of(directions_[static_cast<std::size_t>(one)],
                          directions_[static_cast<std::size_t>(other)], m);
}

}  // namespace risorius::sensitivity
