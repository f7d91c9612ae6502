// SPDX-License-Identifier: MIT
// The order in which controls show frames, and the formulas of designs.
#include "risorius/design/detail/controls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "message_of.h"
#include "risorius/design/detail/arithmetic.h"

namespace risorius::design {
namespace {

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
