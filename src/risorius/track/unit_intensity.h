// How much of every action unit a script asks for at any moment, left and right: what a FACS coder would be told.
//
// From channels of units, expressions and blinks; muscles and recordings drive the face without saying which unit they are.
// Sources add up to 1 at most. A blink is AU45 from its first drive until the lids are let go.
#pragma once

#include <string>
#include <vector>

#include "risorius/track/script.h"

namespace risorius::track {

class UnitIntensity {
  public:
    UnitIntensity(const ScriptDescription& script, const FacsTable& facs);

    /// "AU1.l", "AU1.r", "AU25", ...: two of every unit that has sides; without units that no face can do.
    const std::vector<std::string>& names() const { return names_; }
    /// In that order, [0, 1].
    std::vector<double> at(double t_s) const;

  private:
    void add(const UnitUse& use, double share, std::vector<double>& sums) const;

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
