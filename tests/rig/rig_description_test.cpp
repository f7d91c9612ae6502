// SPDX-License-Identifier: MIT
// A rig file means the same after it is written and read again, and says what is wrong with it.
#include "risorius/rig/rig_description.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "message_of.h"
#include "paths.h"
#include "rig/heads.h"
#include "risorius/rig/head.h"

namespace risorius::rig {
namespace {

namespace fs = std::filesystem;

/// A folder of one test, beside which the project's tables are found.
class RigFile : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(RISORIUS_BINARY_DIR) / "rig_test" /
                  testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        before_ = fs::current_path();
        fs::current_path(folder_);
    }
    void TearDown() override {
        fs::current_path(before_);
        fs::remove_all(folder_);
    }

    /// The adult's rig file as JSON, its paths made to work from the test's folder.
    static Json adult_json() {
        std::ifstream in(adult_rig_file());
        Json json = Json::parse(in);
        json["mesh"]["file"] = adult().rig.mesh_file.string();
        const auto standard = [](const Json& path) {
            return (adult_rig_file().parent_path() / path.get<std::string>()).string();
        };
        for (const char* table :
             {"landmarks", "thickness", "attachments", "muscle_bands", "muscles"})
            if (json["anatomy"][table].is_string())
                json["anatomy"][table] = standard(json["anatomy"][table]);
        for (const char* table : {"facs", "expressions", "calibrated_on"})
            if (json[table].is_string()) json[table] = standard(json[table]);
        return json;
    }
    static void write(const Json& json, const fs::path& file = "rig.json") {
        std::ofstream(file) << json.dump(1);
    }
    /// What is wrong with the file, or with the mesh it is for.
    static std::string complaint(const Json& json) {
        write(json);
        try {
            const RigDescription rig = read_rig("rig.json");
            place_head(rig, adult().mesh, "rig.json");
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing";
    }

    fs::path folder_, before_;
};

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

void expect_same(const RigDescription& a, const RigDescription& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.metres_per_unit, b.metres_per_unit);
    EXPECT_EQ(a.parts, b.parts);
    EXPECT_EQ(fs::weakly_canonical(a.mesh_file), fs::weakly_canonical(b.mesh_file));
    ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
    for (const auto& [id, landmark] : a.landmarks) {
        EXPECT_EQ(landmark.vertex, b.landmarks.at(id).vertex) << id;
        EXPECT_EQ(landmark.xyz, b.landmarks.at(id).xyz) << id;
    }
    ASSERT_EQ(a.atlas.bands.size(), b.atlas.bands.size());
    for (std::size_t i = 0; i < a.atlas.bands.size(); ++i) {
        EXPECT_EQ(a.atlas.bands[i].muscle, b.atlas.bands[i].muscle);
        EXPECT_EQ(a.atlas.bands[i].strength, b.atlas.bands[i].strength);
        EXPECT_EQ(a.atlas.bands[i].points.size(), b.atlas.bands[i].points.size());
    }
    EXPECT_EQ(a.atlas.landmarks.size(), b.atlas.landmarks.size());
    EXPECT_EQ(a.atlas.thickness.size(), b.atlas.thickness.size());
    EXPECT_EQ(a.atlas.attachments.size(), b.atlas.attachments.size());
    EXPECT_EQ(a.channels().column_names(), b.channels().column_names());
    EXPECT_EQ(a.facs.units.size(), b.facs.units.size());
    EXPECT_EQ(a.jaw.hinge_mm, b.jaw.hinge_mm);
    EXPECT_EQ(a.jaw.open_deg, b.jaw.open_deg);
    EXPECT_EQ(a.eyes.wide_deg, b.eyes.wide_deg);
    EXPECT_EQ(a.tissue.deep_shear_pa, b.tissue.deep_shear_pa);
    EXPECT_EQ(a.tissue.fibre_passive_strain, b.tissue.fibre_passive_strain);
    ASSERT_EQ(a.tissue.collagen.size(), b.tissue.collagen.size());
    for (std::size_t i = 0; i < a.tissue.collagen.size(); ++i) {
        const CollagenRegion &one = a.tissue.collagen[i], &other = b.tissue.collagen[i];
        EXPECT_EQ(one.at + " " + one.from + " " + one.to + " " + one.layer,
                  other.at + " " + other.from + " " + other.to + " " + other.layer);
        EXPECT_EQ(one.radius_mm, other.radius_mm);
        EXPECT_EQ(one.k1_pa, other.k1_pa);
        EXPECT_EQ(one.k2, other.k2);
    }
    EXPECT_EQ(a.skin.bending_n_m, b.skin.bending_n_m);
    EXPECT_EQ(a.appearance.skin_tone, b.appearance.skin_tone);
    EXPECT_EQ(a.appearance.seed, b.appearance.seed);
}

RigDescription unusual_rig() {
    RigDescription rig = adult().rig;
    rig.name = "someone \"else\"";
    rig.landmarks["prn"] = {-1, Vec3(0.125, 1.0 / 3.0, -7e-5)};
    rig.jaw.open_deg = 22.7;
    rig.jaw.hinge_mm = Vec3(0, -4.1, 1.0 / 7.0);
    rig.eyes.wide_deg = 9;
    rig.tissue.deep_shear_pa = 812.5;
    rig.tissue.fibre_passive_strain = 0.1 + 0.2;
    rig.tissue.collagen = {{"zy_l", 31, "deep", "t_l", "ch_l", 1500, 0.5}};
    rig.skin.bending_n_m = 3e-5;
    rig.appearance.skin_tone = Vec3(0.1, 0.2, 0.3);
    rig.appearance.seed = 77;
    for (MuscleBand& band : rig.atlas.bands)
        if (band.muscle == "mentalis") band.strength = 0.31;
    return rig;
}

TEST_F(RigFile, WrittenAndReadAgainIsTheSame) {
    const RigWriteOptions options{source_folder() / "rigs" / "standard", true};
    const RigDescription rig = unusual_rig();
    write_rig(rig, "rig.json", options);
    expect_same(rig, read_rig("rig.json"));
}

TEST_F(RigFile, WrittenWithPathsToTheTablesIsTheSame) {
    const RigWriteOptions options{source_folder() / "rigs" / "standard", false};
    const RigDescription rig = unusual_rig();
    write_rig(rig, "deeper.json", options);
    fs::create_directories("a/b");
    write_rig(rig, "a/b/rig.json", options);
    expect_same(rig, read_rig("a/b/rig.json"));
    EXPECT_LT(fs::file_size("a/b/rig.json"), 20000u) << "the tables themselves were written";
}

TEST_F(RigFile, WrittenTwiceIsTheSameToTheByte) {
    const RigWriteOptions options{source_folder() / "rigs" / "standard", true};
    write_rig(adult().rig, "one.json", options);
    write_rig(read_rig("one.json"), "two.json", options);
    EXPECT_EQ(text_of("one.json"), text_of("two.json"));
}

TEST_F(RigFile, ThatCannotBeWrittenLeavesNothingBehind) {
    std::ofstream("no_folder") << "a file";
    EXPECT_THROW(
        write_rig(adult().rig, "no_folder/rig.json", {source_folder() / "rigs" / "standard"}),
        Error);
    fs::remove("no_folder");
    EXPECT_TRUE(fs::is_empty("."));
}

TEST_F(RigFile, TheAdultTakesEveryDefaultOfTheFormat) {
    // What the adult's file spells out and what a file without these tables gets.
    Json json = adult_json();
    for (const char* key : {"tissue", "skin", "appearance"}) json.erase(key);
    json["anatomy"].erase("jaw");
    json["anatomy"].erase("eyes");
    write(json);
    EXPECT_NO_THROW(read_rig("rig.json"));
}

TEST_F(RigFile, TheOldNameOfAppearanceIsReadWithANote) {
    Json json = adult_json();
    EXPECT_TRUE(adult().rig.notes.empty());
    json["look"] = json["appearance"];
    json["look"]["age"] = 0.5;
    json.erase("appearance");
    write(json);
    const RigDescription rig = read_rig("rig.json");
    EXPECT_EQ(rig.appearance.age, 0.5);
    ASSERT_EQ(rig.notes.size(), 1u);
    EXPECT_EQ(rig.notes[0], "the key \"look\" is now named \"appearance\"");

    json["appearance"] = json["look"];
    write(json);
    EXPECT_NE(
        risorius::message_of([] { read_rig("rig.json"); }).find("rig.json:/look: expected either"),
        std::string::npos);
}

TEST_F(RigFile, EveryDocumentedPlaceForATableTakesAPath) {
    Json json = adult_json();
    for (const char* key : {"tissue", "skin", "appearance"}) {
        write(json[key], std::string(key) + ".json");
        json[key] = std::string(key) + ".json";
    }
    for (const char* key : {"jaw", "eyes"}) {
        write(json["anatomy"][key], std::string(key) + ".json");
        json["anatomy"][key] = std::string(key) + ".json";
    }
    write({{"format", "risorius-landmarks"}, {"version", 1}, {"landmarks", json["landmarks"]}},
          "landmarks.json");
    json["landmarks"] = "landmarks.json";
    write(json["anatomy"], "anatomy.json");
    json["anatomy"] = "anatomy.json";
    write(json);
    expect_same(adult().rig, read_rig("rig.json"));
}

TEST_F(RigFile, EveryRoleOfTheGuideIsKnownAndNoOther) {
    const std::string guide = text_of(source_folder() / "rigs" / "README.md");
    const std::size_t begin = guide.find("Roles: ") + 7, end = guide.find(". `teeth`", begin);
    ASSERT_NE(end, std::string::npos);
    std::vector<std::string> documented;
    std::istringstream roles(guide.substr(begin, end - begin));
    for (std::string role; std::getline(roles >> std::ws, role, ',');) documented.push_back(role);
    EXPECT_EQ(documented, std::vector<std::string>(part_roles().begin(), part_roles().end()));
}

TEST_F(RigFile, EveryFieldOfTheTablesIsAdjustable) {
    // Halving or moving each number of each table by a little must be read back as written.
    Json json = adult_json();
    for (const char* table : {"tissue", "skin"})
        for (auto& [key, value] : json[table].items()) {
            Json changed = json;
            changed[table][key] = 0.9 * value.get<double>();
            write(changed);
            write_rig(read_rig("rig.json"), "again.json",
                      {source_folder() / "rigs" / "standard", true});
            std::ifstream in("again.json");
            EXPECT_EQ(Json::parse(in)[table][key], changed[table][key]) << table << "/" << key;
        }
}

TEST_F(RigFile, TheLawOfActivationIsThelensUnlessTheAnatomySaysOtherwise) {
    Json json = adult_json();
    write(json);
    EXPECT_EQ(read_rig("rig.json").activation.law, "thelen2003");
    json["anatomy"]["activation"] = {{"law", "smooth"}, {"steepness", 20}};
    write(json);
    write_rig(read_rig("rig.json"), "again.json", {source_folder() / "rigs" / "standard", true});
    EXPECT_EQ(read_rig("again.json").activation.law, "smooth");
    EXPECT_EQ(read_rig("again.json").activation.steepness, 20);
    json["anatomy"]["activation"]["law"] = "instant";
    EXPECT_EQ(complaint(json),
              "rig.json:/anatomy/activation/law: expected one of \"thelen2003\" \"smooth\", found "
              "\"instant\"");
}

TEST_F(RigFile, AnUnknownRoleIsNamedWithItsNeighbour) {
    Json json = adult_json();
    json["mesh"]["parts"]["teeth_uper"] = {"teeth_upper"};
    EXPECT_EQ(complaint(json),
              "rig.json:/mesh/parts/teeth_uper: expected a known key (did you mean "
              "\"teeth_upper\"?), found unknown key \"teeth_uper\"");
}

TEST_F(RigFile, AGroupTheMeshDoesNotHaveIsNamedBesideThoseItHas) {
    Json json = adult_json();
    json["mesh"]["parts"]["tongue"] = {"tounge"};
    EXPECT_EQ(complaint(json),
              "rig.json:/mesh/parts/tongue: expected a group of the mesh: \"skin\" \"mouth\" "
              "\"eye_l\" \"eye_r\" \"teeth_upper\" \"teeth_lower\" \"gums_upper\" \"gums_lower\" "
              "\"tongue\" \"lashes_l\" \"lashes_r\", found \"tounge\"");
}

TEST_F(RigFile, EachRequiredLandmarkIsMissed) {
    for (const std::string& id : required_landmarks()) {
        RigDescription rig = adult().rig;
        rig.landmarks.erase(id);
        try {
            place_head(rig, adult().mesh, "rig.json");
            ADD_FAILURE() << id << " was not missed";
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()),
                      "rig.json:/landmarks: expected the landmark \"" + id + "\", found none");
        }
    }
}

TEST_F(RigFile, AWrongScaleIsFoundWithAProposal) {
    Json json = adult_json();
    json["mesh"]["metres_per_unit"] = 0.01;
    const std::string found = complaint(json);
    EXPECT_NE(found.find("rig.json:/mesh/metres_per_unit: expected a head of adult or child size "
                         "(about 0.001"),
              std::string::npos)
        << found;
    EXPECT_NE(found.find("found 0.01, a head "), std::string::npos) << found;
    EXPECT_NE(found.find(" times the average adult"), std::string::npos) << found;
}

TEST_F(RigFile, AVertexBeyondTheMeshIsFound) {
    Json json = adult_json();
    json["landmarks"]["ch_l"] = {{"vertex", 12345678}};
    EXPECT_EQ(complaint(json), "rig.json:/landmarks/ch_l/vertex: expected a vertex in [0, " +
                                   std::to_string(adult().mesh.vertex_count() - 1) +
                                   "], found 12345678");
}

TEST_F(RigFile, AnUnknownLandmarkIsNamedWithItsNeighbour) {
    Json json = adult_json();
    json["landmarks"]["stomi"] = {{"vertex", 1}};
    EXPECT_EQ(complaint(json),
              "rig.json:/landmarks/stomi: expected a landmark of the atlas (did you mean "
              "\"stoi\"?), found \"stomi\"");
}

TEST_F(RigFile, ARegionOfFibresNeedsLandmarksADirectionAndAStiffness) {
    const auto complaint_of = [&](const char* key, const Json& value) {
        Json json = adult_json();
        json["tissue"]["collagen"] = {
            {{"at", "zy_l"}, {"radius_mm", 30}, {"from", "t_l"}, {"to", "ch_l"}, {"k1_pa", 1500}}};
        if (key) json["tissue"]["collagen"][0][key] = value;
        return complaint(json);
    };
    EXPECT_EQ(complaint_of("at", "zy_"),
              "rig.json:/tissue/collagen/0/at: expected a landmark of the atlas (did you mean "
              "\"zy_l\"?), found \"zy_\"");
    EXPECT_EQ(complaint_of("to", "t_l"),
              "rig.json:/tissue/collagen/0/to: expected another landmark than \"from\", found "
              "\"t_l\"");
    EXPECT_EQ(complaint_of("k1_pa", 0),
              "rig.json:/tissue/collagen/0/k1_pa: expected [1, 1e+07], found 0");
    EXPECT_EQ(
        complaint_of("layer", "skin"),
        "rig.json:/tissue/collagen/0/layer: expected one of \"deep\" \"superficial\" \"both\", "
        "found \"skin\"");
    Json json = adult_json();
    json["tissue"]["collagen"] = std::vector<int>(101);
    EXPECT_EQ(complaint(json),
              "rig.json:/tissue/collagen: expected at most 100 regions, found 101");
}

TEST_F(RigFile, AStrengthForNoMuscleIsFound) {
    Json json = adult_json();
    json["anatomy"]["strength"]["masseter_deep"] = 1.0;
    EXPECT_EQ(complaint(json),
              "rig.json:/anatomy/strength/masseter_deep: expected a muscle of the muscle bands, "
              "found \"masseter_deep\"");
}

TEST_F(RigFile, ARigWithoutSkinIsRefused) {
    Json json = adult_json();
    json["mesh"]["parts"].erase("skin");
    EXPECT_EQ(complaint(json),
              "rig.json:/mesh/parts: expected at least one group for \"skin\", found none");
}

TEST_F(RigFile, ALandmarkIsEitherAVertexOrAPoint) {
    Json json = adult_json();
    json["landmarks"]["prn"] = {{"vertex", 1}, {"xyz", {0, 0, 0}}};
    EXPECT_EQ(complaint(json),
              "rig.json:/landmarks/prn: expected either \"vertex\" or \"xyz\", found an object "
              "with 2 keys");
}

}  // namespace
}  // namespace risorius::rig
