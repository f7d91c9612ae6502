// SPDX-License-Identifier: MIT
/// \file
/// The intensity of every action unit of a script at any time, left and right, as a human coder of FACS would rate it.
///
/// Only channels of units, expressions and blinks count, because muscles and recordings do not name a unit. The sum of the
/// sources is limited to 1. A blink is AU45 from the start of its drive until the lids are released.
#pragma once

#include <string>
#include <vector>

#include "risorius/track/script.h"

namespace risorius::track {

/// Evaluates the units of a script.
class UnitIntensity {
  public:
    UnitIntensity(const ScriptDescription& script, const FacsTable& facs);

    /// "AU1.l", "AU1.r", "AU25", ...: two names for every unit with sides. Units that no face can show are left out.
    const std::vector<std::string>& names() const { return names_; }
    /// Intensities in the order of names(), [0, 1].
    std::vector<double> at(double t_s) const;

  private:
    void add(const UnitUse& use, double fraction, std::vector<double>& sums) const;

    struct UnitTrack {
        Curve curve;
        UnitUse use;
    };
    struct Unit {
        std::string id;
        int first = 0;  ///< index of its first name; a unit has one or two
        bool sided = false;
    };
    std::vector<Unit> units_;
    std::vector<std::string> names_;
    std::vector<UnitTrack> tracks_;
    std::vector<ExpressionEvent> expressions_;
    std::vector<BlinkEvent> blinks_;
};

}  // namespace risorius::track
