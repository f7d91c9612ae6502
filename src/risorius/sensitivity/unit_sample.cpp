// SPDX-License-Identifier: MIT
#include "risorius/sensitivity/unit_sample.h"

#include <algorithm>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/sensitivity/sobol_sequence.h"

namespace risorius::sensitivity {

namespace {

/// A random order of 0..count-1 (Fisher and Yates).
std::vector<int> random_order(int count, CounterRng random) {
    std::vector<int> order(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
    for (int i = count - 1; i > 0; --i) {
        const double u = CounterRng(random).at(static_cast<std::uint64_t>(i)).uniform();
        std::swap(order[static_cast<std::size_t>(i)],
                  order[static_cast<std::size_t>(u * static_cast<double>(i + 1))]);
    }
    return order;
}

}  // namespace

Eigen::MatrixXd unit_sample(Sampling sampling, int count, int dimensions, std::uint64_t seed) {
    Eigen::MatrixXd out(count, dimensions);
    if (dimensions == 0) return out;
    // Each kind has random numbers of its own.
    const CounterRng random = CounterRng(seed).at(static_cast<std::uint64_t>(sampling));
    const auto chance = [&](int column, int row) {
        return CounterRng(random)
            .at(static_cast<std::uint64_t>(column))
            .at(static_cast<std::uint64_t>(row));
    };
    if (sampling == Sampling::kSobol) {
        const SobolSequence sequence(dimensions);
        for (int d = 0; d < dimensions; ++d) {
            const auto shift = static_cast<std::uint32_t>(chance(d, 0).bits() >> 32);
            for (int i = 0; i < count; ++i)
                out(i, d) =
                    0x1p-32 * (0.5 + static_cast<double>(
                                         sequence.bits(static_cast<std::uint32_t>(i), d) ^ shift));
        }
        return out;
    }
    for (int d = 0; d < dimensions; ++d) {
        const std::vector<int> order =
            sampling == Sampling::kLatinHypercube
                ? random_order(count,
                               CounterRng(random).at(static_cast<std::uint64_t>(d)).at(~0ull))
                : std::vector<int>(static_cast<std::size_t>(count), 0);
        const double cell = sampling == Sampling::kLatinHypercube ? 1.0 / count : 1.0;
        for (int i = 0; i < count; ++i)
            out(i, d) = cell * (order[static_cast<std::size_t>(i)] + chance(d, i).uniform_open());
    }
    return out;
}

}  // namespace risorius::sensitivity
