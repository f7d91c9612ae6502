// SPDX-License-Identifier: MIT
/// \file
/// A low-pass filter that follows fast motion at once and calms slow one.
///
/// Source: Casiez, Roussel, Vogel 2012, 1 Euro Filter: a simple speed-based low-pass filter for noisy input in interactive systems,
/// CHI '12, 2527-2530.
#pragma once

namespace risorius::perform {

struct OneEuroOptions {
    double cutoff_hz = 1.5;  ///< at rest
    double per_speed = 2;    ///< how much the cutoff grows, Hz, with each unit per second of speed
    double speed_cutoff_hz = 1;
};

class OneEuro {
  public:
    explicit OneEuro(const OneEuroOptions& options = {}) : options_(options) {}
    /// Returns the filtered value. Times must increase; one that does not gives the value before.
    double operator()(double value, double t_s);

  private:
    OneEuroOptions options_;
    bool any_ = false;
    double t_s_ = 0, value_ = 0, speed_ = 0;
};

}  // namespace risorius::perform
