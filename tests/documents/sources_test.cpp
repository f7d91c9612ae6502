// SPDX-License-Identifier: MIT
// Every number of the standard anatomy says where it is from: works of the bibliography, or the word estimate with its uncertainty.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

const std::filesystem::path kRigs =
    std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs" / "standard";

Json table(const std::string& name) {
    return JsonCursor::read_file(kRigs / (name + ".json")).json();
}

const std::set<std::string>& bibliography() {
    static const std::set<std::string> keys = [] {
        std::set<std::string> out;
        const std::string page = bytes_of(kRigs / "../../docs/references.md");
        const std::regex entry("\n- \\[([A-Za-z]+[0-9]*)\\] ");
        for (std::sregex_iterator i(page.begin(), page.end(), entry), end; i != end; ++i)
            EXPECT_TRUE(out.insert((*i)[1]).second) << (*i)[1] << " is there twice";
        return out;
    }();
    return keys;
}

/// What is wrong with a statement; empty when nothing is.
std::string complaint(const std::string& statement) {
    static const std::regex reference("\\[([^\\]]*)\\]");
    bool named = false;
    for (std::sregex_iterator i(statement.begin(), statement.end(), reference), end; i != end;
         ++i) {
        if (!bibliography().count((*i)[1])) return (*i)[1].str() + " is not in docs/references.md";
        named = true;
    }
    if (statement.find("estimate") == std::string::npos)
        return named ? "" : "names no work and is no estimate";
    static const std::regex uncertainty("factor of [0-9]|\\+- [0-9]|[0-9] to [0-9]+ (mm|degrees)");
    return std::regex_search(statement, uncertainty) ? "" : "an estimate without its uncertainty";
}

TEST(Sources, AStatementWithoutWorkOrUncertaintyIsFound) {
    EXPECT_EQ(complaint("[Zajac1989]: read"), "");
    EXPECT_EQ(complaint("estimate; a factor of 2"), "");
    EXPECT_NE(complaint("[Nobody1999]: read"), "");
    EXPECT_NE(complaint("estimate"), "");
    EXPECT_NE(complaint("well known"), "");
    EXPECT_GT(bibliography().size(), 30u);
}

TEST(Sources, EveryMuscleSaysWhereItsNumbersAreFrom) {
    const Json muscles = table("muscles");
    std::set<std::string> used;
    for (const Json& muscle : muscles["muscles"]) {
        const std::string id = muscle["id"];
        for (const char* quantity :
             {"size", "area", "F0_N", "l0_mm", "tendon_slack_mm", "pennation_deg",
              "rest_norm_fibre_length", "max_shortening_frac", "vmax_l0_per_s", "times", "paths"}) {
            ASSERT_TRUE(muscle.contains("sources") && muscle["sources"].contains(quantity))
                << id << " " << quantity;
            EXPECT_FALSE(muscle["sources"][quantity].empty()) << id << " " << quantity;
        }
        for (const Json& names : muscle["sources"])
            for (const Json& name : names) {
                EXPECT_TRUE(muscles["sources"].contains(name.get<std::string>()))
                    << id << " " << name;
                used.insert(name);
            }
    }
    for (const auto& [name, statement] : muscles["sources"].items()) {
        EXPECT_EQ(complaint(statement), "") << name;
        EXPECT_TRUE(used.count(name)) << name << " is not used";
    }
}

// The statements are about the numbers: forces that are said to be a stress times the area are that.
TEST(Sources, ForcesAreTheStressTimesTheAreaThatTheirSourceSays) {
    const Json muscles = table("muscles")["muscles"];
    for (const Json& muscle : muscles) {
        const std::string from = muscle["sources"]["F0_N"][0];
        const double stress_mpa = muscle["F0_N"].get<double>() / muscle["csa_mm2"].get<double>();
        const std::string id = muscle["id"];
        if (from == "mimetic-force") {
            EXPECT_NEAR(stress_mpa, 0.2, 0.004) << id;
        }
        if (from == "ArtiSynth-jaw") {
            EXPECT_NEAR(stress_mpa, 0.4, 0.004) << id;
        }
        const double force_n = muscle["F0_N"];
        EXPECT_LE(muscle["F0_range_N"][0].get<double>(), force_n) << id;
        EXPECT_GE(muscle["F0_range_N"][1].get<double>(), force_n) << id;
        if (muscle["sources"]["area"][0] == "area") {
            EXPECT_NEAR(muscle["csa_mm2"].get<double>() / (muscle["width_mm"].get<double>() *
                                                           muscle["thickness_mm"].get<double>()),
                        0.8, 0.21)
                << id;
        }
    }
}

TEST(Sources, EveryThicknessSaysWhereItIsFrom) {
    const Json thickness = table("tissue_thickness");
    for (const Json& point : thickness["points"])
        EXPECT_TRUE(thickness["sources"].contains(point.value("source", ""))) << point["id"];
    for (const auto& [name, statement] : thickness["sources"].items())
        EXPECT_EQ(complaint(statement), "") << name;
}

TEST(Sources, BandsSolidsAndAttachmentsSayWhereTheirNumbersAreFrom) {
    const Json bands = table("muscle_bands");
    const std::set<std::string> ends{"origin",
                                     "insertion"};  // what a band is attached to, no numbers
    for (const Json& muscle : bands["muscles"])
        for (const Json& band : muscle)
            for (const auto& [key, value] : band.items())
                EXPECT_TRUE(ends.count(key) || bands["sources"].contains(key)) << key;
    for (const auto& [name, statement] : bands["sources"].items()) {
        const std::string text = statement;
        EXPECT_TRUE(text.starts_with("as ") || complaint(text).empty()) << name;
    }
    const Json solids = table("muscle_solids"), attachments = table("attachments")["sources"];
    for (const auto& [muscle, solid] : solids.items())
        EXPECT_EQ(complaint(solid.value("source", "")), "") << muscle;
    for (const auto& [name, statement] : attachments.items())
        EXPECT_EQ(complaint(statement), "") << name;
}

}  // namespace
}  // namespace risorius
