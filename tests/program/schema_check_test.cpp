// SPDX-License-Identifier: MIT
// Schemas against the readers: what the project's own files say is accepted by both, and mistakes that a schema can tell are told.
#include "tools/risorius/schema_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "temporary_folder.h"
#include "tools/risorius/check_files.h"

namespace risorius::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RISORIUS_SOURCE_DIR;

/// JSON files of the formats that have a schema; templates of a design, whose values are still names, are none.
std::vector<fs::path> own_files() {
    std::vector<fs::path> files;
    for (const char* folder : {"rigs", "models", "samples"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            const std::string text =
                entry.path().extension() == ".json" ? bytes_of(entry.path()) : "";
            if (text.find("\"risorius-") != std::string::npos &&
                text.find("\"${") == std::string::npos)
                files.push_back(entry.path());
        }
    return files;
}

TEST(SchemaCheck, EveryFileOfTheProjectFollowsTheSchemaOfItsFormat) {
    int checked = 0;
    for (const fs::path& file : own_files()) {
        const JsonCursor json = JsonCursor::read_file(file);
        if (!json.has("format")) continue;
        EXPECT_NO_THROW(check_against_schema(json, json.at("format").string())) << file;
        ++checked;
    }
    EXPECT_GT(checked, 30);
}

TEST(SchemaCheck, EveryFormatThatAUserWritesHasOne) {
    const std::vector<std::string> formats = schema_formats();
    for (const char* format :
         {"risorius-script", "risorius-rig", "risorius-landmarks", "risorius-design",
          "risorius-experiment", "risorius-identity", "risorius-run", "risorius-study"})
        EXPECT_NE(std::find(formats.begin(), formats.end(), format), formats.end()) << format;
}

TEST(SchemaCheck, AMistakeIsToldWithItsPlace) {
    const JsonCursor json = JsonCursor::from_json(
        Json{{"format", "risorius-script"},
             {"version", 1},
             {"rig", "rig.json"},
             {"duration_s", 1},
             {"channels", {{"jaw_open", {{"keys", {{0, 0}}}, {"interpolation", "wavy"}}}}}},
        "wavy.json");
    const std::string message = message_of([&] { check_against_schema(json, "risorius-script"); });
    EXPECT_TRUE(
        message.starts_with("wavy.json:/channels/jaw_open/interpolation: expected what the "
                            "schema of risorius-script says, found otherwise: "))
        << message;
}

// Readers and schemas say the same of keys: one that a reader takes and a schema does not, or the other way round, is a
// mistake in one of them.
TEST(SchemaCheck, RefusesUnknownKeysOfEveryScriptThatTheReaderRefuses) {
    int both = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests/data/broken")) {
        if (entry.path().extension() != ".json") continue;
        const CheckResult result = check_file(entry.path());
        if (result.error.find("unknown key") == std::string::npos) continue;
        const JsonCursor json = JsonCursor::read_file(entry.path());
        if (!json.has("format")) continue;
        EXPECT_NE(message_of([&] { check_against_schema(json, json.at("format").string()); }),
                  "no error")
            << entry.path();
        ++both;
    }
    EXPECT_GT(both, 2);
}

TEST(CheckFiles, HoldsWhatOnlyProgramsWriteAgainstItsSchema) {
    const TemporaryFolder folder;
    std::ofstream(folder / "identity.json")
        << R"({"format": "risorius-identity", "version": 1, "sex": 1, "age": 200})";
    const CheckResult result = check_file(folder / "identity.json");
    EXPECT_EQ(result.format, "identity");
    EXPECT_NE(result.error.find("identity.json:/age: expected"), std::string::npos) << result.error;
}

// An editor shows help from it; every reader passes over it.
TEST(CheckFiles, AFileMayNameItsSchema) {
    const TemporaryFolder folder;
    Json script = JsonCursor::read_file(kRoot / "samples/smile/script.json").json();
    script["$schema"] = "risorius-script.schema.json";
    script["rig"] = (kRoot / "rigs/adult/rig.json").string();
    std::ofstream(folder / "script.json") << script.dump();
    EXPECT_EQ(check_file(folder / "script.json").error, "");
}

TEST(CheckFiles, FindsWhatRenderWouldRefuse) {
    const TemporaryFolder folder;
    std::ofstream(folder / "room.hdr", std::ios::binary)
        << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
    Json script = JsonCursor::read_file(kRoot / "samples/smile/script.json").json();
    script["rig"] = (kRoot / "rigs/adult/rig.json").string();
    script["view"]["light"] = {{"file", "room.hdr"}};
    std::ofstream(folder / "script.json") << script.dump();
    EXPECT_EQ(check_file(folder / "script.json").error,
              (folder / "room.hdr").string() +
                  ": expected pixels of the whole picture, found the end of the file");
}

TEST(CheckFiles, APulledVertexIsOneThatSoftTissueMoves) {
    const TemporaryFolder folder;
    Json script = JsonCursor::read_file(kRoot / "samples/smile/script.json").json();
    script["rig"] = (kRoot / "rigs/adult/rig.json").string();
    const auto error_of = [&](int vertex) {
        script["pulls"] = Json::parse(R"([{"stiffness_n_per_m": 100,
                                           "keys_mm": [[0, [0, 0, 0]], [0.1, [0, 0, 5]]]}])");
        script["pulls"][0]["vertex"] = vertex;
        std::ofstream(folder / "script.json") << script.dump();
        return check_file(folder / "script.json").error;
    };
    EXPECT_EQ(error_of(4235), "") << "the left corner of the mouth";
    EXPECT_EQ(error_of(5301), (folder / "script.json").string() +
                                  ":/pulls/0/vertex: expected a vertex of the mesh that soft "
                                  "tissue moves, found 5301");
}

}  // namespace
}  // namespace risorius::cli
