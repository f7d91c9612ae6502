// SPDX-License-Identifier: MIT
#include "risorius/sensitivity/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "message_of.h"

namespace risorius::sensitivity {
namespace {

Distribution read(const std::string& text) {
    return read_distribution(JsonCursor::from_json(Json::parse(text), "study.json"));
}

// Tables of the normal distribution: Abramowitz & Stegun 1964, table 26.5.
TEST(Distributions, NormalQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
    EXPECT_NEAR(normal_quantile(0.84134474606854293), 1, 1e-12);
    EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-9);
    EXPECT_NEAR(normal_quantile(0.5), 0, 1e-15);
    for (double u = 1e-9; u < 1; u = 1.7 * u + 1e-3)
        EXPECT_NEAR(0.5 * std::erfc(-normal_quantile(u) / std::numbers::sqrt2), u,
                    1e-14 + 1e-13 * u);
}

TEST(Distributions, HaveTheQuantilesThatTheirNamesSay) {
    EXPECT_DOUBLE_EQ(read(R"({"uniform": [2, 6]})").quantile(0.25), 3);
    EXPECT_DOUBLE_EQ(read(R"({"log_uniform": [0.5, 2]})").quantile(0.5), 1);
    EXPECT_DOUBLE_EQ(read(R"({"normal": [4, 2]})").quantile(0.5), 4);
    EXPECT_NEAR(read(R"({"normal": [4, 2]})").quantile(0.975), 4 + 2 * 1.96, 1e-3);
    EXPECT_NEAR(read(R"({"log_normal": [10, 2]})").quantile(0.84134474606854293), 20, 1e-9);
}

TEST(Distributions, SayWhatIsWrongWithThem) {
    EXPECT_EQ(message_of([] { read(R"({"unifrm": [0, 1]})"); }),
              "study.json:/unifrm: expected a known key (did you mean \"uniform\"?), found unknown "
              "key \"unifrm\"");
    EXPECT_EQ(message_of([] { read(R"({"uniform": [1, 1]})"); }),
              "study.json:/uniform: expected [low, high] with low < high, found [1,1]");
    EXPECT_EQ(message_of([] { read(R"({"log_uniform": [0, 1]})"); }),
              "study.json:/log_uniform/0: expected a number above 0, found 0");
    EXPECT_EQ(message_of([] { read(R"({"normal": [0, 0]})"); }),
              "study.json:/normal/1: expected a standard deviation above 0, found 0");
    EXPECT_EQ(message_of([] { read(R"({"log_normal": [1, 0.5]})"); }),
              "study.json:/log_normal/1: expected a factor above 1, found 0.5");
    EXPECT_EQ(message_of([] { read(R"({"uniform": [1]})"); }),
              "study.json:/uniform: expected two numbers, found 1");
    EXPECT_EQ(message_of([] { read("{}"); }),
              "study.json:/: expected one of \"uniform\", \"log_uniform\", \"normal\" and "
              "\"log_normal\", found 0 keys");
}

}  // namespace
}  // namespace risorius::sensitivity
