// SPDX-License-Identifier: MIT
#include "risorius/track/script.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "paths.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

const std::filesystem::path kRoot = RISORIUS_SOURCE_DIR;

ScriptDescription read(const Json& json) {
    return read_script(JsonCursor::from_json(json, "script.json"), tables().channels, tables().facs,
                       tables().expressions);
}

ScriptDescription read_file(const std::filesystem::path& file) {
    return read_script(file, tables().channels, tables().facs, tables().expressions);
}

Json minimal() {
    return Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rigs/adult/rig.json", "duration_s": 2})");
}

std::string failure(const std::filesystem::path& file) {
    try {
        read_file(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "was read without complaint";
}

TEST(Script, WithOnlyWhatIsNeededGetsTheDefaults) {
    const ScriptDescription script = read(minimal());
    EXPECT_EQ(script.header.fps, 60);
    EXPECT_EQ(script.header.seed, 1);
    EXPECT_EQ(script.header.jaw, JawDrive::kChannels);
    EXPECT_EQ(script.header.frame_count(), 120);
    EXPECT_EQ(script.header.view.width_px, 1024);
    EXPECT_EQ(script.header.view.camera, "front");
    EXPECT_FALSE(script.header.view.transparent);
    EXPECT_DOUBLE_EQ(script.header.view.background_rgb[1], 128 / 255.0);
    EXPECT_TRUE(script.channels.empty() && script.expressions.empty() && script.blinks.empty());
}

TEST(Script, HasNoMoreEventsAndPullsThanMemoryAndTimeAllow) {
    const auto failure_with = [](const char* key, std::size_t count, const char* item) {
        Json json = minimal();
        json[key] = Json(count, Json::parse(item));
        try {
            read(json);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    constexpr const char* kBlink = R"({"blink": {}, "start_s": 0.1})";
    EXPECT_EQ(failure_with("events", 10000, kBlink), "none");
    EXPECT_EQ(failure_with("events", 10001, kBlink),
              "script.json:/events: expected at most 10000 events, found 10001");
    EXPECT_EQ(failure_with("events", 101, R"({"idle": {}})"),
              "script.json:/events: expected at most 100 periods of idle motion, found 101");
    EXPECT_EQ(failure_with("pulls", 1001, R"({"vertex": 1, "keys_mm": [[0, [0, 0, 0]]]})"),
              "script.json:/pulls: expected at most 1000 pulls, found 1001");
}

TEST(Script, NumberOfFramesIsRounded) {
    EXPECT_EQ(frame_count(2.0, 60), 120);
    EXPECT_EQ(frame_count(0.1, 24), 2);   // 2.4
    EXPECT_EQ(frame_count(0.11, 24), 3);  // 2.64
    EXPECT_EQ(frame_count(0.1, 60), 6);   // 0.1 * 60 is not exact
}

TEST(Script, ExampleOfTheFormatIsRead) {
    const ScriptDescription script = read(Json::parse(R"({
      "format": "risorius-script", "version": 1, "rig": "../../rigs/adult/rig.json",
      "fps": 60, "duration_s": 2.0, "seed": 7, "jaw": "muscles",
      "channels": {
        "zygomaticus_major": {"keys": [[0.0, 0], [0.4, 0.8], [1.2, 0.8], [1.7, 0]], "interpolation": "linear"},
        "frontalis_medial.l": {"keys": [[0.5, 0], [0.6, 1]], "activation": true},
        "AU6": {"keys": [[0, 0], [0.5, 0.6]]},
        "jaw_open": {"keys": [[0, 0], [0.3, 0.4]]},
        "gaze_yaw_deg": {"keys": [[0, 0]]}, "gaze_pitch_deg.r": {"keys": [[0, -3]]},
        "head_yaw_deg": {"keys": [[0, 0]]}
      },
      "events": [
        {"expression": "happiness", "intensity": 0.8, "start_s": 0.2, "onset_s": 0.4, "hold_s": 0.8, "offset_s": 0.5},
        {"blink": {}, "start_s": 1.1}
      ],
      "view": {"width_px": 512, "height_px": 256, "camera": "three_quarter_right", "background": "#ff8000"}
    })"));
    EXPECT_EQ(script.header.rig, "../../rigs/adult/rig.json");
    EXPECT_EQ(script.header.seed, 7);
    EXPECT_EQ(script.header.jaw, JawDrive::kMuscles);
    ASSERT_EQ(script.channels.size(), 7u);
    EXPECT_EQ(script.channels[0].name, "zygomaticus_major");
    EXPECT_EQ(script.channels[0].keys.size(), 4u);
    EXPECT_EQ(script.channels[0].interpolation, Interpolation::kLinear);
    EXPECT_EQ(script.channels[0].drives.excitation.sum(), 2.0);
    EXPECT_TRUE(script.channels[1].activation);
    EXPECT_EQ(script.channels[1].drives.excitation.sum(), 1.0);
    EXPECT_EQ(script.channels[1].drives.excitation[tables().column("frontalis_medial.l")], 1.0);
    EXPECT_EQ(script.channels[2].interpolation, Interpolation::kSmooth);
    ASSERT_EQ(script.expressions.size(), 1u);
    EXPECT_EQ(script.expressions[0].intensity, 0.8);
    const ExpressionParts& parts = tables().expressions.find("happiness")->parts;
    EXPECT_EQ(script.expressions[0].parts.size(), parts.units.size() + parts.muscles.size());
    ASSERT_EQ(script.blinks.size(), 1u);
    EXPECT_EQ(script.blinks[0].start_s, 1.1);
    EXPECT_EQ(script.header.view.width_px, 512);
    EXPECT_EQ(script.header.view.background_rgb[0], 1.0);
    EXPECT_DOUBLE_EQ(script.header.view.background_rgb[1], 128 / 255.0);
    EXPECT_EQ(script.header.view.background_rgb[2], 0.0);
}

TEST(Script, ExpressionWithoutTimesTakesTheUsualOnes) {
    Json json = minimal();
    json["events"] = Json::parse(R"([{"expression": "surprise", "start_s": 0}])");
    const ExpressionEvent event = read(json).expressions.at(0);
    const Expression& usual = *tables().expressions.find("surprise");
    EXPECT_EQ(event.onset_s, usual.onset_s);
    EXPECT_EQ(event.hold_s, usual.hold_s);
    EXPECT_EQ(event.offset_s, usual.offset_s);
    EXPECT_EQ(event.intensity, 1.0);
}

TEST(Script, ContemptMovesToTheSideAskedFor) {
    Json json = minimal();
    json["events"] = Json::parse(R"([{"expression": "contempt", "start_s": 0},
                                     {"expression": "contempt", "start_s": 0, "side": "l"}])");
    const ScriptDescription script = read(json);
    const int left = tables().column("buccinator.l"), right = tables().column("buccinator.r");
    EXPECT_EQ(script.expressions[0].parts[0].drives.excitation[left], 0.0);
    EXPECT_EQ(script.expressions[0].parts[0].drives.excitation[right], 0.35);
    EXPECT_EQ(script.expressions[1].parts[0].drives.excitation[left], 0.35);
    EXPECT_EQ(script.expressions[1].parts[0].drives.excitation[right], 0.0);
}

TEST(Script, TransparentBackgroundIsKnown) {
    Json json = minimal();
    json["view"]["background"] = "transparent";
    EXPECT_TRUE(read(json).header.view.transparent);
}

TEST(Script, HeaderIsReadBeforeTheRigIsKnown) {
    // Its channel does not exist, but only a rig can tell.
    const ScriptHeader header = read_script_header(kRoot / "samples/broken/script.json");
    EXPECT_EQ(header.rig, "../../rigs/adult/rig.json");
    EXPECT_EQ(header.rig_file, kRoot / "rigs/adult/rig.json");
    EXPECT_EQ(header.frame_count(), 60);
}

TEST(Script, LevatorMayBeTakenBelowItsToneAndOthersMayNot) {
    Json json = minimal();
    json["channels"]["levator_palpebrae_superioris"]["keys"] = Json::parse("[[0, -1]]");
    EXPECT_EQ(read(json).channels[0].keys[0].value, -1.0);
}

TEST(Script, EveryMuscleUnitAndKinematicChannelCanBeNamed) {
    Json json = minimal();
    std::size_t count = 0;
    const auto add = [&](const std::string& name) {
        json["channels"][name]["keys"] = Json::parse("[[0, 0]]");
        ++count;
    };
    for (const std::string& name : tables().channels.column_names()) add(name);
    for (const ActionUnit& unit : tables().facs.units)
        if (unit.unsupported.empty()) {
            add(unit.id);
            if (unit.sided) add(unit.id + ".r");
        }
    for (const KinematicChannel& channel : kinematic_channels()) add(std::string(channel.name));
    EXPECT_EQ(read(json).channels.size(), count);
}

TEST(Script, SamplesAreReadAndTheBrokenOneSaysWhatItsReadmeQuotes) {
    EXPECT_EQ(read_file(kRoot / "samples/hello/script.json").header.frame_count(), 240);
    EXPECT_EQ(read_file(kRoot / "samples/smile/script.json").header.frame_count(), 120);

    std::ifstream stream(kRoot / "samples/broken/README.md");
    const std::string readme(std::istreambuf_iterator<char>(stream), {});
    const std::string message = failure(kRoot / "samples/broken/script.json");
    ASSERT_EQ(message.substr(0, kRoot.string().size() + 1), kRoot.string() + "/");
    EXPECT_NE(readme.find("\n    risorius: " + message.substr(kRoot.string().size() + 1) + "\n"),
              std::string::npos)
        << message;
}

TEST(Script, EveryBrokenFileSaysWhereAndWhy) {
    const std::filesystem::path folder = kRoot / "tests/data/broken/scripts";
    const JsonCursor expected = JsonCursor::read_file(folder / "expected.json");
    std::set<std::string> known;
    for (const std::string& file : expected.keys()) {
        EXPECT_EQ(failure(folder / file), folder.string() + "/" + expected.at(file).string());
        known.insert(file);
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name != "expected.json") {
            EXPECT_EQ(known.count(name), 1u) << name;
        }
    }
    EXPECT_GE(known.size(), 14u);
}

TEST(Script, MissingFileIsNamed) {
    EXPECT_EQ(failure("nowhere/script.json"),
              "nowhere/script.json: expected a JSON file, found no such file");
}

TEST(Script, NumbersThatAreNotFiniteAreRefused) {
    Json json = minimal();
    json["channels"]["AU12"]["keys"] = Json::array({Json::array({0, std::nan("")})});
    try {
        read(json);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "script.json:/channels/AU12/keys/0/1: expected [0, 1], found null");
    }
}

}  // namespace
}  // namespace risorius::track
