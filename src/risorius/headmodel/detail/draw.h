// SPDX-License-Identifier: MIT
/// \file
/// Numbers drawn from a seed, the same on every machine.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace risorius::headmodel {

/// Even numbers from a generator whose sequence the standard fixes; its distributions are not fixed.
class Draw {
  public:
    explicit Draw(unsigned seed) : generator_(seed) {}
    double even() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }
    /// Twelve even ones are normal enough, and need no library function.
    double normal() {
        double sum = -6;
        for (int k = 0; k < 12; ++k) sum += even();
        return sum;
    }
    const std::string& one_of(const std::vector<std::string>& names) {
        return names[static_cast<std::size_t>(even() * static_cast<double>(names.size()))];
    }

  private:
    std::mt19937_64 generator_;
};

inline double to_hundredths(double value) { return std::round(value * 100) / 100 + 0.0; }

}  // namespace risorius::headmodel
