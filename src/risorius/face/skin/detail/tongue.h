// The tongue as a body that bends along its middle: its root stays, the rest goes with the mandible, it stretches forwards,
// lifts or lowers its tip, and passes between the teeth and the lips, flatter where they leave little room.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

struct TongueDrive {
    double out = 0;  ///< ratio of the protrusion range, [0, 1]
    double up = 0;   ///< of the tip, [-1, 1]
    Rigid mandible = Rigid::Identity();
};

class Tongue {
  public:
    /// `range_m`: how far `out` at 1 brings the tip forwards.
    Tongue(const rig::Head& head, double range_m);

    /// Moves the tongue's rows of `vertices`, whose skin has moved already.
    void place(const TongueDrive& drive, Points& vertices) const;

    bool empty() const { return members_.empty(); }
    /// The share of `drive.out` for which there is room between the teeth.
    double room(const TongueDrive& drive) const;

  private:
    struct Member {
        int vertex;
        double along;            ///< 0 at the root, 1 at the tip
        double side, up, ahead;  ///< from the middle line there, in its frame at rest, m
    };
    struct Line {
        std::vector<Vec3> point;
        Vec3 at(double along) const;
        Vec3 tangent(double along) const;  ///< unit, upright and forward parts only
    };
    struct Gate {
        double lower_y, upper_y, z;
    };
    Gate teeth(const Rigid& mandible) const;
    Line bent(const TongueDrive& drive, double out) const;

    const rig::Head& head_;
    double range_m_, length_m_ = 0, thickness_m_ = 0;
    Line rest_;
    std::vector<double> over_jaw_;  // by sample of the line
    std::vector<Member> members_;
    Vec3 lower_edge_, upper_edge_;            // of the incisors
    std::vector<int> lower_lip_, upper_lip_;  // skin at stoi, stos
};

}  // namespace risorius::face
