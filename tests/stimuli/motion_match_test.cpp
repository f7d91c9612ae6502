// SPDX-License-Identifier: MIT
// Steps of intensity that are equal as they are seen, and what of their search is kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cache_setting.h"
#include "message_of.h"
#include "paths.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/core/read_file.h"
#include "risorius/stimuli/batch.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

Json steps_design(double hold_s) {
    Json design = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "Steps",
        "clips": {"quality": "draft", "ending": "mkv"},
        "match": {"motion": {"share": [0.25, 0.75], "of": "intensity"}},
        "sets": [{"name": "steps", "clip": "${expression}_${seen_step}",
            "factors": {"expression": ["happiness", "fear"]},
            "script": {"format": "risorius-script", "version": 1, "fps": 20, "duration_s": 0.8,
                "events": [{"expression": "${expression}", "intensity": "${intensity}",
                    "start_s": 0.05, "onset_s": 0.2, "hold_s": 0, "offset_s": 0.2}],
                "view": {"width_px": 32, "height_px": 32, "antialiasing": 1}}}]})");
    design["sets"][0]["script"]["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
    design["sets"][0]["script"]["events"][0]["hold_s"] = hold_s;
    return design;
}

TEST(MotionMatch, MakesStepsThatAreSeenAsAskedFor) {
    const TemporaryFolder folder;
    for (const double hold_s : {0.05}) {
        std::ofstream(folder / "design.json") << steps_design(hold_s).dump();
        const std::filesystem::path out = folder / ("set" + std::to_string(hold_s));
        EXPECT_TRUE(
            make_batch({.design = folder / "design.json", .out = out, .workers = 2}).complete);
        const animate::FrameRows rows =
            animate::frame_rows(read_file(out / "stimuli/stimuli.tsv", {"a table", kMegabyte}));
        ASSERT_EQ(rows.rows(), 4);
        for (int r = 0; r < rows.rows(); ++r) {
            EXPECT_NEAR(rows.number(r, rows.column("seen_share")),
                        rows.number(r, rows.column("seen_step")), 0.02)
                << rows.cells[static_cast<std::size_t>(r)][0] << " held for " << hold_s;
            EXPECT_NE(rows.number(r, rows.column("intensity")),
                      rows.number(r, rows.column("seen_step")));
        }
    }
}

TEST(MotionMatch, RefusesSharesThatTheTempoCannotReach) {
    const TemporaryFolder folder;
    Json design = steps_design(0);
    design["match"]["motion"]["share"] = {1};
    design["sets"][0]["script"]["events"][0]["onset_s"] = 0.06;
    design["sets"][0]["script"]["events"][0]["offset_s"] = 0.06;
    std::ofstream(folder / "design.json") << design.dump();
    EXPECT_NE(message_of([&] {
                  plan_batch(folder / "design.json");
              }).find("expected a share of match/motion of at most 0."),
              std::string::npos);
    // And a script that does not use the parameter
    design["sets"][0]["script"]["events"] = Json::array();
    std::ofstream(folder / "design.json") << design.dump();
    EXPECT_NE(message_of([&] {
                  plan_batch(folder / "design.json");
              }).find("expected a script whose expression or units follow the parameter"),
              std::string::npos);
}

// With the same onset, fear is at its apex later than happiness.
TEST(MotionMatch, PutsTheApexIntoTheFrameThatIsAskedFor) {
    const TemporaryFolder folder;
    Json design = steps_design(0.1);
    design["match"]["motion"] = {{"apex_s", 0.4}};
    design["sets"][0]["clip"] = "${expression}_${strength}";
    design["sets"][0]["factors"]["strength"] = {0.7};
    design["sets"][0]["script"]["events"][0]["intensity"] = "${strength}";
    design["sets"][0]["script"]["events"][0]["onset_s"] = "${onset_s}";
    std::ofstream(folder / "design.json") << design.dump();
    EXPECT_TRUE(make_batch({.design = folder / "design.json", .out = folder / "set", .workers = 2})
                    .complete);
    const animate::FrameRows rows =
        animate::frame_rows(read_file(folder / "set/stimuli/stimuli.tsv", {"a table", kMegabyte}));
    ASSERT_EQ(rows.rows(), 2);
    std::set<double> onsets;
    for (int r = 0; r < rows.rows(); ++r) {
        EXPECT_NEAR(rows.number(r, rows.column("seen_apex_s")), 0.4, 1e-9)
            << rows.cells[static_cast<std::size_t>(r)][0];
        onsets.insert(rows.number(r, rows.column("onset_s")));
    }
    EXPECT_GT(onsets.size(), 1u) << "every movement has an onset of its own";

    // Together with equal steps
    design["match"]["motion"] = {{"apex_s", 0.4}, {"share", {0.5}}, {"of", "intensity"}};
    design["sets"][0]["clip"] = "${expression}_${seen_step}";
    design["sets"][0]["factors"] = {{"expression", {"fear"}}};
    design["sets"][0]["script"]["events"][0]["intensity"] = "${intensity}";
    std::ofstream(folder / "design.json") << design.dump();
    EXPECT_TRUE(make_batch({.design = folder / "design.json", .out = folder / "both", .workers = 2})
                    .complete);
    const animate::FrameRows both =
        animate::frame_rows(read_file(folder / "both/stimuli/stimuli.tsv", {"a table", kMegabyte}));
    ASSERT_EQ(both.rows(), 1);
    EXPECT_NEAR(both.number(0, both.column("seen_apex_s")), 0.4, 1e-9);
    EXPECT_NEAR(both.number(0, both.column("seen_share")), 0.5, 0.02);
}

TEST(MotionMatch, RefusesAnApexThatTheMovementCannotHave) {
    const TemporaryFolder folder;
    Json design = steps_design(0);
    design["sets"][0]["clip"] = "${expression}";
    // A rig by a relative path, as a design beside its heads has it
    design["sets"][0]["script"]["rig"] =
        std::filesystem::relative(RISORIUS_SOURCE_DIR "/rigs/adult/rig.json",
                                  std::filesystem::canonical(folder.path()))
            .string();
    design["sets"][0]["script"]["events"][0]["intensity"] = 1;
    design["sets"][0]["script"]["events"][0]["onset_s"] = "${onset_s}";
    const auto refusal = [&](const Json& motion) {
        design["match"]["motion"] = motion;
        std::ofstream(folder / "design.json") << design.dump();
        return message_of([&] { plan_batch(folder / "design.json"); });
    };
    EXPECT_NE(refusal({{"apex_s", 0.06}}).find("expected an apex_s of match/motion of 0."),
              std::string::npos);
    EXPECT_NE(refusal({{"apex_s", 0.4}, {"of", "intensity"}})
                  .find("/match/motion/of: expected \"share\" beside it, found none"),
              std::string::npos);
    EXPECT_NE(refusal({{"share", {0.5}}, {"of", "onset_s"}, {"apex_of", "onset_s"}})
                  .find("/match/motion/apex_of: expected \"apex_s\" beside it, found none"),
              std::string::npos);
    design["sets"][0]["script"]["events"][0]["onset_s"] = 0.2;
    EXPECT_NE(refusal({{"apex_s", 0.7}}).find("as late as apex_s of match/motion"),
              std::string::npos);
}

/// What a search finds, and the lines of its progress.
struct Search {
    double intensity;
    std::vector<std::string> told;
};
Search search(const std::filesystem::path& design) {
    Search out{};
    const BatchPlan plan = plan_batch(
        design, {.progress = [&](double, const std::string& what) { out.told.push_back(what); },
                 .stopped = {}});
    for (const auto& [name, value] : plan.clips.at(0).condition.values)
        if (name == "intensity") out.intensity = value.get<double>();
    return out;
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

TEST(MotionMatch, SearchesOnceAndBelievesNoDamagedOrForeignResult) {
    const TemporaryFolder results, folder;
    const CacheSetting own(results.path().string());
    Json design = steps_design(0.05);
    design["match"]["motion"]["share"] = {0.5};
    design["sets"][0]["factors"]["expression"] = {"happiness"};
    const auto write = [&] { std::ofstream(folder / "design.json") << design.dump(); };
    write();
    const Search first = search(folder / "design.json");
    ASSERT_FALSE(first.told.empty());
    EXPECT_EQ(first.told[0], "equal motion: /sets/0, expression happiness, seen_step 0.5");
    const Search second = search(folder / "design.json");
    EXPECT_TRUE(second.told.empty()) << "nothing is simulated again";
    EXPECT_EQ(second.intensity, first.intensity);

    // Damaged files are found out, and the search is made anew with the same result.
    for (const auto& file : files_below(results.path())) {
        std::string bytes = read_file(file, {"a result", 256 * kMegabyte});
        bytes[bytes.size() - 3] = static_cast<char>(bytes[bytes.size() - 3] ^ 1);
        std::ofstream(file, std::ios::binary) << bytes;
    }
    const Search third = search(folder / "design.json");
    EXPECT_EQ(third.told.size(), first.told.size());
    EXPECT_EQ(third.intensity, first.intensity);

    // So are those of another request in their place.
    const std::vector<std::filesystem::path> files = files_below(results.path());
    for (std::size_t i = 0; i + 1 < files.size(); ++i)
        std::filesystem::copy_file(files[i + 1], files[i],
                                   std::filesystem::copy_options::overwrite_existing);
    const Search fourth = search(folder / "design.json");
    EXPECT_FALSE(fourth.told.empty());
    EXPECT_EQ(fourth.intensity, first.intensity);

    // Another course is another request.
    design["sets"][0]["script"]["events"][0]["onset_s"] = 0.15;
    write();
    EXPECT_FALSE(search(folder / "design.json").told.empty());
}

TEST(MotionMatch, GivesTheSameBytesWithAndWithoutKeptResults) {
    const TemporaryFolder results, folder;
    Json design = steps_design(0.05);
    design["match"]["motion"]["share"] = {0.5};
    design["sets"][0]["factors"]["expression"] = {"happiness"};
    std::ofstream(folder / "design.json") << design.dump();
    std::set<std::string> sums;
    for (const char* out : {"without", "first", "second"}) {
        const CacheSetting setting(std::string(out) == "without" ? "off" : results.path().string());
        EXPECT_TRUE(
            make_batch({.design = folder / "design.json", .out = folder / out, .workers = 1})
                .complete);
        sums.insert(read_file(folder / out / "SHA256SUMS", {"a table", kMegabyte}));
    }
    EXPECT_EQ(sums.size(), 1u);
    EXPECT_FALSE(files_below(results.path()).empty());
}

}  // namespace
}  // namespace risorius::stimuli
