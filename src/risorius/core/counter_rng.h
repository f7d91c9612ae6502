// SPDX-License-Identifier: MIT
/// \file
/// Counter-based random numbers. Each number depends only on its key, so it is the same on every machine and in any order of
/// calls.
///
/// Source: splitmix64 of Steele, Lea & Flood 2014, OOPSLA, 453-472, with one step for every part of the key.
#pragma once

#include <cstdint>

namespace risorius {

/// A random number for a key: CounterRng(seed).at(row).at(column).uniform().
class CounterRng {
  public:
    static constexpr std::uint64_t kIncrement = 0x9e3779b97f4a7c15;

    explicit CounterRng(std::uint64_t seed = 0) : state_(seed) {}

    CounterRng& at(std::uint64_t part) {
        state_ += part + kIncrement;
        state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9;
        state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111eb;
        state_ ^= state_ >> 31;
        return *this;
    }
    std::uint64_t bits() const { return state_; }
    double uniform() const { return static_cast<double>(state_ >> 11) * 0x1p-53; }  ///< [0, 1)
    double uniform_open() const {                                                   ///< (0, 1)
        return (static_cast<double>(state_ >> 11) + 0.5) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

/// A sequence of random numbers, for cases in which the key would only count the numbers.
class RandomSequence {
  public:
    explicit RandomSequence(std::uint64_t seed) : state_(seed) {}

    double next() {  ///< [0, 1)
        const double number = CounterRng(state_).at(0).uniform();
        state_ += CounterRng::kIncrement;
        return number;
    }

  private:
    std::uint64_t state_;
};

}  // namespace risorius
