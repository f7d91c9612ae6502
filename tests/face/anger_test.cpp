// SPDX-License-Identifier: MIT
// What a viewer needs to see in the anger of the adult: eyes that glare, and a mouth that does not smile.
#include <nlohmann/json.hpp>

#include "face/adult_face.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::face {
namespace {

/// The drive of an expression at its apex.
track::Drive apex_of(const std::string& expression) {
    const Json json = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 6, "events": [{"expression": ")" +
        expression + R"(", "start_s": 0}]})");
    const rig::RigDescription& rig = rig::adult().rig;
    return track::Timeline(track::read_script(JsonCursor::from_json(json, "script.json"),
                                              channels(), rig.facs, rig.expressions),
                           channels())
        .at(1.4);
}

TEST(Anger, OpensTheEyesAndLevelsTheCornersOfTheMouth) {
    Face face = adult_face();
    const Points moved =
        moved_mm(face, equilibrium_pose(face, apex_of("anger"), nullptr, kWithinATenth));
    for (const std::string side : {"_l", "_r"}) {
        // Pressed lips alone raise them by 2.5 mm against the middle of the mouth, and AU7 shuts the eyes by 2.8 mm.
        EXPECT_LT(at(moved, "ch" + side).y() - at(moved, "stos").y(), 0.3) << side;
        const double opened = at(moved, "ps" + side).y() - at(moved, "pi" + side).y();
        EXPECT_GT(opened, -1.5) << side;
    }
}

}  // namespace
}  // namespace risorius::face
