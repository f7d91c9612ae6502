// SPDX-License-Identifier: MIT
// References between parameters may multiply what they refer to. What they make is limited.
#include "risorius/design/detail/parameters.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "message_of.h"

namespace risorius::design {
namespace {

/// The parameters p0, p1 ... of which each is made of the next one.
std::vector<Given> chain_of(int count,
                            const std::function<Json(const std::string& next)>& made_of) {
    Json all = Json::object();
    for (int i = 0; i < count; ++i)
        all["p" + std::to_string(i)] = made_of("${p" + std::to_string(i + 1) + "}");
    all["p" + std::to_string(count)] = "x";
    const JsonCursor cursor = JsonCursor::from_json(all, "design.json");
    std::vector<Given> given;
    for (const std::string& name : cursor.keys()) given.push_back({name, cursor.at(name)});
    return given;
}

TEST(Parameters, ChainsOfReferencesAreFilledIn) {
    const Parameters texts(chain_of(10, [](const std::string& next) { return Json(next + next); }));
    EXPECT_EQ(texts.text("p0"), std::string(1024, 'x'));
    const Parameters lists(
        chain_of(50, [](const std::string& next) { return Json::array({next}); }));
    EXPECT_EQ(lists.at("p49"), Json::array({"x"}));
}

TEST(Parameters, WhatReferencesMakeIsLimited) {
    EXPECT_EQ(
        message_of([] {
            Parameters(chain_of(64, [](const std::string& next) { return Json(next + next); }));
        }),
        "design.json:/p44: expected at most 1000000 letters and values, found more with the "
        "values of parameters");
    EXPECT_NE(message_of([] {
                  Parameters(chain_of(64, [](const std::string& next) {
                      return Json::array({next, next});
                  }));
              }).find("expected at most 1000000 letters and values"),
              std::string::npos);
    EXPECT_NE(message_of([] {
                  Parameters(chain_of(90, [](const std::string& next) {
                      return Json::array({Json::array({Json::array({next})})});
                  }));
              }).find("expected at most 200 lists and objects in one another"),
              std::string::npos);
    EXPECT_NE(message_of([] {
                  Parameters(chain_of(1000, [](const std::string& next) { return Json(next); }));
              }).find("expected a chain of at most 100 parameters"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::design
