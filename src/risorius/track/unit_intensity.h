// SPDX-License-Identifier: MIT
/// \file
/// Intensity of every action unit of a script at any moment, left and right, as a FACS coder would rate it.
///
/// From channels of units, expressions and blinks only; muscles and recordings do not name a unit. The sum of sources is limited to 1. A
/// blink is AU45 from the start of its drive until the lids are released.
#pragma once

#include <string>
#include <vector>

#include "risorius/track/script.h"

namespace risorius::track {

class UnitIntensity {
  public:
    UnitIntensity(const ScriptDescription& script, const FacsTable& facs);

    /// "AU1.l", "AU1.r", "AU25", ...: two names for every unit with sides; without units that no face can show.
    const std::vector<std::string>& names() const { return names_; }
    /// In that order, [0, 1].
    std::vector<double> at(double t_s) const;

  private:
    void add(const UnitUse& use, double fraction, std::vector<double>& sums) const;

    struct UnitTrack {
        Curve curve;
        UnitUse use;
    };
    struct Unit {
        std::string id;
        int first = 0;  ///< of its one or two names
        bool sided = false;
    };
    std::vector<Unit> units_;
    std::vector<std::string> names_;
    std::vector<UnitTrack> tracks_;
    std::vector<ExpressionEvent> expressions_;
    std::vector<BlinkEvent> blinks_;
};

}  // namespace risorius::track
