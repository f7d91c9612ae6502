// SPDX-License-Identifier: MIT
// The figure of every muscle shape, on coarse grids.
#include <gtest/gtest.h>

#include "figures/samples.h"

namespace risorius::figures {
namespace {

/// The sample with the runs named, each on a grid of its own.
Json coarse_shapes(const std::vector<std::pair<std::string, Json>>& grids) {
    Json json = sample("muscles");
    forget_numbers(json);
    Json chosen = Json::array();
    for (const auto& [name, grid] : grids)
        for (Json one : json["runs"])
            if (one["name"] == name) {
                one["change"]["grid"] = grid;
                chosen.push_back(one);
            }
    json["runs"] = chosen;
    return json;
}

TEST(MuscleShapesKind, MusclesContractKeepTheirVolumeAndAreDrawnTwice) {
    Json json = coarse_shapes({{"sheet", {4, 3, 2}}, {"ring", {8, 2, 2}}});
    json["runs"][0]["shortening"] = 0.1;
    const FigureResult figure = run(json);
    for (const char* name : {"sheet", "ring"}) {
        const std::string of = std::string("/") + name;
        EXPECT_EQ(measured(figure, "unconverged" + of), 0);
        EXPECT_LT(std::abs(measured(figure, "volume_change_percent" + of)), 0.3) << name;
        EXPECT_GT(measured(figure, "bulge" + of), 1.02) << name;
    }
    EXPECT_LT(measured(figure, "opening_ratio/ring"), 0.7);
    EXPECT_LT(measured(figure, "stretch/sheet"), 0.95);
    ASSERT_EQ(figure.shapes.size(), 4U);
    EXPECT_EQ(figure.shapes[0].name, figure.shapes[1].name) << "side by side";
    EXPECT_EQ(figure.shapes[0].positions.rows(), 24 + 2 * 6) << "belly and plates";
    EXPECT_EQ(figure.shapes[2].positions.rows(), 32) << "a ring has no plates";
}

TEST(MuscleShapesKind, ShapesThatCannotBeBuiltAreNamedByTheirRun) {
    Json json = coarse_shapes({{"ring", {8, 2, 2}}});
    json["runs"][0]["change"]["shape"]["ring"]["thickness_m"] = -1;
    EXPECT_EQ(
        message_of([&] { run(json); }),
        "experiment.json (ring):/muscle/shape/ring/thickness_m: expected a number in (0, inf), "
        "found -1");
}

}  // namespace
}  // namespace risorius::figures
