// SPDX-License-Identifier: MIT
// Studies of the adult: what they find, what they write, and what they say of mistakes.
#include "risorius/study/run_study.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "message_of.h"
#include "paths.h"
#include "risorius/rig/rig_description.h"
#include "temporary_folder.h"

namespace risorius::study {
namespace {

namespace fs = std::filesystem;

const fs::path kRig = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";

class Studies : public testing::Test {
  protected:
    /// A study of one pose, `more` put over its keys.
    Json study(const std::string& more) const {
        Json json = Json::parse(R"({"format": "risorius-study", "version": 1, "name": "test",
            "poses": ["AU12"], "landmarks": ["ch_l", "ch_r", "bm_l"],
            "vary": {"force": {"of": "tissue/force_scale", "factor": {"uniform": [0.8, 1.25]}}},
            "sample": {"count": 2, "indices": false}})");
        json["rig"] = kRig.string();
        json.update(Json::parse(more));
        return json;
    }
    Json run(const Json& json, int threads = 2, const std::string& out = "out") const {
        return run_study({.study = write(json), .out = folder_ / out, .threads = threads});
    }
    std::string complaint(const std::string& more) const {
        std::string text = message_of([&] { check_study(write(study(more))); });
        const std::string here = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(here)) != std::string::npos;)
            text.erase(at, here.size());
        return text;
    }
    fs::path write(const Json& json) const {
        std::ofstream(folder_ / "study.json") << json.dump();
        return folder_ / "study.json";
    }
    /// The rows of a table, without its head.
    std::vector<std::vector<std::string>> rows(const std::string& table) const {
        std::vector<std::vector<std::string>> out;
        std::istringstream text(bytes_of(folder_ / table));
        for (std::string line; std::getline(text, line);) {
            out.emplace_back();
            std::istringstream cells(line);
            for (std::string cell; std::getline(cells, cell, '\t');) out.back().push_back(cell);
        }
        out.erase(out.begin());
        return out;
    }

    TemporaryFolder folder_;
};

TEST_F(Studies, RigWithItsTablesIsTheSameRig) {
    const rig::RigDescription as_file = rig::read_rig(kRig);
    const rig::RigDescription resolved =
        rig::read_rig(JsonCursor::from_json(rig::resolved_rig(kRig), kRig.string()));
    EXPECT_EQ(resolved.mesh_file, as_file.mesh_file);
    ASSERT_EQ(resolved.atlas.bands.size(), as_file.atlas.bands.size());
    for (std::size_t b = 0; b < as_file.atlas.bands.size(); ++b)
        EXPECT_EQ(resolved.atlas.bands[b].strength, as_file.atlas.bands[b].strength);
    EXPECT_EQ(resolved.tissue.bulk_pa, as_file.tissue.bulk_pa);
    EXPECT_EQ(resolved.facs.units.size(), as_file.facs.units.size());
    EXPECT_EQ(resolved.muscles.channels().column_names(),
              as_file.muscles.channels().column_names());
}

// The law of similarity: in equilibrium only ratios of forces and stiffnesses count. What makes lips stick to each other is no number of the
// rig; it takes half a percent of the way of a brow, and more at the mouth.
TEST_F(Studies, FaceOfAllStiffnessesAndForcesTwiceMovesTheSame) {
    const Json results = run(study(R"({"poses": ["AU1"], "vary": {"all": {"of": [
        "tissue/deep_shear_pa", "tissue/superficial_shear_pa", "tissue/bulk_pa",
        "tissue/contact_pa_per_m", "tissue/force_scale", "skin/membrane_n_per_m",
        "skin/bending_n_m", "anatomy/attachments/attachments/*/*"],
        "factor": {"uniform": [1.9, 2.1]}}}})"));
    EXPECT_EQ(results["unsettled"], 0);
    const Json& brow = results["poses"]["AU1"]["landmarks"]["bm_l"];
    EXPECT_GT(brow["rig_mm"], 3);
    EXPECT_LT(brow["away_p95_mm"], 0.01 * brow["rig_mm"].get<double>()) << brow;
}

TEST_F(Studies, StrongerFaceMovesFartherAndTheIndexOfTheOnlyParameterIsOne) {
    const Json results =
        run(study(R"({"poses": ["AU1"], "sample": {"count": 4, "replicates": 50}})"));
    const auto samples = rows("out/samples.tsv"), moved = rows("out/displacements.tsv");
    ASSERT_EQ(samples.size(), 1u + 4 * 3);
    ASSERT_EQ(moved.size(), samples.size() * 3);
    const auto length = [&](std::size_t sample) {
        const auto& row = moved[3 * sample + 2];
        return std::hypot(std::stod(row[3]), std::stod(row[4]), std::stod(row[5]));
    };
    for (std::size_t s = 1; s < samples.size(); ++s) {
        const double force = std::stod(samples[s][3]);
        EXPECT_GE(force, 0.8);
        EXPECT_LE(force, 1.25);
        if (std::abs(force - 1) > 0.01) {
            EXPECT_EQ(force > 1, length(s) > length(0)) << force;
        }
    }
    const Json& pose = results["poses"]["AU1"];
    EXPECT_NEAR(pose["indices"]["force"]["total"][0], 1, 0.5);  // four rows
    EXPECT_NEAR(pose["landmarks"]["bm_l"]["rig_mm"], length(0), 2e-3);
    for (const char* file : {"index.html", "indices.tsv", "spread_AU1.svg", "indices_AU1.svg"})
        EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
    const Json columns = Json::parse(bytes_of(folder_ / "out/displacements.json"));
    EXPECT_EQ(columns["x_mm"]["Units"], "mm");
}

TEST_F(Studies, SameBytesForAnyNumberOfThreads) {
    const std::string more = R"({"vary": {
        "each": {"of": "anatomy/strength/*", "factor": {"log_uniform": [0.5, 2]}, "each": true},
        "thickness": {"of": "anatomy/thickness/points/prn/thickness_mm", "add": {"normal": [0, 0.5]}},
        "lips": {"of": "tissue/lip_shear_ratio", "set": {"uniform": [0.1, 0.3]}}},
        "sample": {"method": "latin_hypercube", "count": 3, "indices": false, "seed": 4}})";
    run(study(more), 1, "one");
    run(study(more), 3, "three");
    for (const char* file : {"samples.tsv", "displacements.tsv", "spread.tsv", "results.json"})
        EXPECT_EQ(bytes_of(folder_ / "one" / file), bytes_of(folder_ / "three" / file)) << file;
    EXPECT_FALSE(fs::exists(folder_ / "one/indices.tsv"));
}

TEST_F(Studies, SayWhichKeyIsNearestToAWrongPath) {
    const auto of = [&](const std::string& path) {
        return complaint(R"({"vary": {"p": {"of": ")" + path +
                         R"(", "factor": {"uniform": [1, 2]}}}})");
    };
    EXPECT_EQ(of("tissue/deep_sheer_pa"),
              "study.json:/vary/p/of: expected a number of the rig; \"tissue\" has "
              "\"deep_shear_pa\" (did you mean it?), found \"tissue/deep_sheer_pa\"");
    EXPECT_EQ(
        of("tisue/bulk_pa").substr(0, 80),
        "study.json:/vary/p/of: expected a number of the rig; \"/\" has \"tissue\" (did you m");
    EXPECT_EQ(of("anatomy/thickness/points/prnn/thickness_mm"),
              "study.json:/vary/p/of: expected a number of the rig; \"anatomy/thickness/points\" "
              "has \"prn\" (did you mean it?), found "
              "\"anatomy/thickness/points/prnn/thickness_mm\"");
    EXPECT_EQ(of("anatomy/attachments/attachments/tr"),
              "study.json:/vary/p/of: expected the path of a number, found "
              "\"anatomy/attachments/attachments/tr\", which is a list; end it with \"/*\" or an "
              "index");
    EXPECT_EQ(
        of("skin/wrinkles/0"),
        "study.json:/vary/p/of: expected a number of the rig; \"skin/wrinkles\" has no parts, "
        "found \"skin/wrinkles/0\"");
}

TEST_F(Studies, SayWhatElseIsWrong) {
    EXPECT_EQ(complaint(R"({"poses": ["AU121"]})"),
              "study.json:/poses/0: expected an expression, action unit, shape or muscle of the "
              "rig, found \"AU121\"");
    // No side of what has none, and no channel without its value
    for (const char* name :
         {"AU26.l", "orbicularis_oris_upper_marginal.l", "jaw_open", "gaze_yaw_deg"})
        EXPECT_EQ(
            complaint(R"({"poses": [")" + std::string(name) + R"("]})"),
            "study.json:/poses/0: expected an expression, action unit, shape or muscle of the "
            "rig, found \"" +
                std::string(name) + "\"");
    EXPECT_EQ(
        complaint(R"({"poses": [{"name": "x", "activation": {"risorus": 1}}]})"),
        "study.json:/poses/0/activation/risorus: expected a muscle or channel of the rig (did "
        "you mean \"risorius\"?), found \"risorus\"");
    EXPECT_EQ(complaint(R"({"poses": [{"name": "x", "activation": {"risorius": 2}}]})"),
              "study.json:/poses/0/activation/risorius: expected [0, 1], found 2");
    EXPECT_EQ(complaint(R"({"vary": {"p": {"of": "tissue/bulk_pa"}}})"),
              "study.json:/vary/p: expected one of \"factor\", \"add\" and \"set\", found 0 of "
              "them");
    EXPECT_EQ(complaint(R"({"vary": {"a": {"of": "tissue/*", "factor": {"uniform": [1, 2]}},
                                     "b": {"of": "tissue/bulk_pa", "factor": {"uniform": [1, 2]}}}})"),
              "study.json:/vary/b/of: expected numbers that no other parameter has, found "
              "tissue/bulk_pa, which is one of \"a\"");
    EXPECT_EQ(complaint(R"({"sample": {"count": 1}})"),
              "study.json:/sample/count: expected an integer in [2, 65536], found 1");
    // A value that the rig refuses is told before any face is made.
    const std::string text = complaint(
        R"({"vary": {"p": {"of": "tissue/lip_shear_ratio", "set": {"uniform": [-2, -1]}}}})");
    EXPECT_TRUE(
        text.starts_with("study.json:/vary/p: expected values that the rig may have, found -"))
        << text;
    EXPECT_NE(text.find("/tissue/lip_shear_ratio: expected [1e-04, 100]"), std::string::npos)
        << text;
}

}  // namespace
}  // namespace risorius::study
