// SPDX-License-Identifier: MIT
// Objects from lists of fields.
#include "risorius/core/json_object.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace risorius {
namespace {

TEST(JsonObject, KeepsTheOrderAndTheTypesOfItsFields) {
    const std::vector<double> ways{0.5, 1.0};
    const std::string name = "smile";
    const Json fields = json_object({{"name", name},
                                     {"count", 3},
                                     {"share", 0.25},
                                     {"on", true},
                                     {"none", nullptr},
                                     {"ways", ways},
                                     {"size", {640, 480}},
                                     {"rest", Json::array()},
                                     {"head", json_object({{"yaw_deg", -4}})}});
    EXPECT_EQ(fields.dump(),
              R"({"name":"smile","count":3,"share":0.25,"on":true,"none":null,"ways":[0.5,1.0],)"
              R"("size":[640,480],"rest":[],"head":{"yaw_deg":-4}})");
    EXPECT_EQ(json_object({}).dump(), "{}");
}

TEST(JsonObject, KeepsTheFirstOfTwoFieldsWithOneName) {
    EXPECT_EQ(json_object({{"a", 1}, {"b", 2}, {"a", 3}}).dump(), R"({"a":1,"b":2})");
}

}  // namespace
}  // namespace risorius
