// A number by chance that hangs on its place alone: the same whatever else is drawn, on every machine, in any order.
//
// One step of splitmix64 for every part of the place. Source: Steele, Lea, Flood 2014, OOPSLA, 453-472.
#pragma once

#include <cstdint>

namespace risorius {

class PlaceChance {
  public:
    explicit PlaceChance(std::uint64_t seed = 0) : state_(seed) {}

    PlaceChance& at(std::uint64_t part) {
        state_ += part + 0x9e3779b97f4a7c15;
        state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9;
        state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111eb;
        state_ ^= state_ >> 31;
        return *this;
    }
    std::uint64_t bits() const { return state_; }
    double from_zero() const { return static_cast<double>(state_ >> 11) * 0x1p-53; }  ///< [0, 1)
    double inside() const {                                                           ///< (0, 1)
        return (static_cast<double>(state_ >> 11) + 0.5) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

}  // namespace risorius
