// SPDX-License-Identifier: MIT
// The order in which controls show frames, and the formulas of designs.
#include "risorius/design/detail/controls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "message_of.h"
#include "paths.h"
#include "risorius/design/detail/arithmetic.h"

namespace risorius::design {
namespace {

TEST(Controls, AreAllInTheSchema) {
    std::ifstream file(RISORIUS_SOURCE_DIR "/docs/formats/schema/risorius-design.schema.json");
    const Json schema = Json::parse(file);
    std::set<std::string> known;
    const std::function<void(const Json&)> look = [&](const Json& value) {
        if (value.is_object() && value.contains("enum") && value["enum"].size() > 10)
            for (const Json& name : value["enum"]) known.insert(name.get<std::string>());
        if (value.is_structured())
            for (const Json& inner : value) look(inner);
    };
    look(schema);
    for (const std::string& name : control_names()) EXPECT_EQ(known.count(name), 1u) << name;
}

TEST(FrameOrder, IsThatOfTheControl) {
    const auto order = [](ControlKind kind, unsigned seed = 1) {
        Control control;
        control.kind = kind;
        return frame_order(control, 6, 4, seed);
    };
    using Order = std::vector<int>;
    EXPECT_EQ(order(ControlKind::kNone), (Order{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(order(ControlKind::kReversed), (Order{5, 4, 3, 2, 1, 0}));
    EXPECT_EQ(order(ControlKind::kApex), (Order{4, 4, 4, 4, 4, 4}));
    Order scrambled = order(ControlKind::kScrambled);
    EXPECT_NE(scrambled, order(ControlKind::kNone));
    EXPECT_NE(scrambled, order(ControlKind::kScrambled, 2));
    std::sort(scrambled.begin(), scrambled.end());
    EXPECT_EQ(scrambled, order(ControlKind::kNone));
}

TEST(RetimedOrder, MakesTheWayFollowTheProfile) {
    // A minimum-jerk course in a film of 8 times as many frames, from frame 8 to frame 72
    std::vector<double> way;
    for (int i = 0; i < 81; ++i) {
        const double u = std::clamp((i - 8) / 64.0, 0.0, 1.0);
        way.push_back(10 * (10 * u * u * u - 15 * u * u * u * u + 6 * u * u * u * u * u));
    }
    const double largest_step = 10 * 1.875 / 64;
    for (const Speed speed : {Speed::kConstant, Speed::kAccelerated, Speed::kDecelerated}) {
        const std::vector<int> order = retimed_order(speed, way, 8, 72, 8, 11);
        ASSERT_EQ(order.size(), 11u);
        EXPECT_EQ(order[0], 0);
        EXPECT_EQ(order[1], 8);
        EXPECT_EQ(order[9], 72);
        EXPECT_EQ(order[10], 80);
        for (int i = 1; i < 10; ++i) {
            const double t = (i - 1) / 8.0;
            const double share = speed == Speed::kConstant      ? t
                                 : speed == Speed::kAccelerated ? t * t
                                                                : 1 - (1 - t) * (1 - t);
            EXPECT_NEAR(way[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])],
                        10 * share, largest_step / 2 + 1e-9)
                << i;
        }
    }
}

TEST(Arithmetic, IsThatOfSchool) {
    const auto value = [](const std::string& text) {
        return arithmetic(text, "here", [](const std::string& name) -> double {
            if (name == "a") return 3;
            throw Error("here", "a", name);
        });
    };
    EXPECT_EQ(value("1 + 2 * a"), 7);
    EXPECT_EQ(value("-(a - 1) / 4 - -2"), 1.5);
    EXPECT_EQ(value("max(a, min(2.5e1, 7)) * .5"), 3.5);
    const auto complaint = [&](const std::string& text) {
        return message_of([&] { value(text); });
    };
    EXPECT_EQ(complaint("1 +"),
              "here: expected a number, a parameter or a bracket in \"1 +\", found its end");
    EXPECT_EQ(complaint("(1"), "here: expected \")\" in \"(1\", found its end");
    EXPECT_EQ(complaint("1 a"), "here: expected an operator in \"1 a\", found \"a\"");
    EXPECT_EQ(complaint("1 / 0"), "here: expected a finite value of \"1 / 0\", found none");
    EXPECT_EQ(complaint(std::string(100, '(')).substr(0, 30), "here: expected fewer brackets ");
}

}  // namespace
}  // namespace risorius::design
