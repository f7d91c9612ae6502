// SPDX-License-Identifier: MIT
// What a person reads when the description of an integrator is wrong.
#include "risorius/softbody/integrator_description.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "risorius/core/error.h"

namespace risorius::softbody {
namespace {

TEST(IntegratorDescription, SaysWhatIsWrong) {
    const auto message = [](const char* text) -> std::string {
        try {
            read_integrator(JsonCursor::from_json(Json::parse(text), "run.json"));
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(message(R"({"method": "rk4", "step_s": 0})"),
              "run.json:/step_s: expected a number in (0, inf), found 0");
    EXPECT_EQ(message(R"({"method": "rk4", "steps_s": 1})"),
              "run.json:/steps_s: expected a known key (did you mean \"step_s\"?), found unknown "
              "key \"steps_s\"");
    EXPECT_EQ(message(R"({"method": "rk3"})").substr(0, 46),
              "run.json:/method: expected one of \"euler\" \"ver");
    const auto options = read_integrator(JsonCursor::from_json(
        Json::parse(R"({"method": "rkck", "step_s": 1e-3, "tolerance": 1e-6})"), "run.json"));
    EXPECT_EQ(options.method, solve::Method::kCashKarp);
    EXPECT_EQ(options.step_s, 1e-3);
    EXPECT_EQ(options.tolerance, 1e-6);
}

}  // namespace
}  // namespace risorius::softbody
