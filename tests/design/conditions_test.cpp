// SPDX-License-Identifier: MIT
// From a design file to the clips it asks for.
#include "risorius/design/conditions.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "message_of.h"
#include "temporary_folder.h"

namespace risorius::design {
namespace {

const char* const kScript = R"({"format": "risorius-script", "version": 1, "rig": "rig.json",
    "duration_s": "= onset_s + hold_s", "fps": "${fps}",
    "events": [{"expression": "${expression}", "intensity": "${intensity}", "start_s": 0.1,
                "onset_s": "= onset_s * intensity", "hold_s": "${hold_s}"}]})";

class Designs : public testing::Test {
  protected:
    /// A design of one set, `more` put over its keys.
    Json design(const std::string& more = "{}") const {
        Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "test",
            "parameters": {"fps": 30, "onset_s": 0.4, "hold_s": "= onset_s / 2"},
            "sets": [{"name": "faces", "clip": "${expression}_${intensity}",
                      "factors": {"expression": ["happiness", "fear"],
                                  "intensity": {"from": 0.5, "to": 1, "steps": 3}}}]})");
        json["sets"][0]["script"] = Json::parse(kScript);
        json["sets"][0].update(Json::parse(more));
        return json;
    }
    std::vector<Condition> conditions(const Json& json) const { return conditions_of(read(json)); }
    Design read(const Json& json) const {
        write("design.json", json.dump());
        return read_design(folder_.path() / "design.json");
    }
    std::string complaint(const Json& json) const {
        std::string text = message_of([&] { conditions(json); });
        const std::string here = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(here)) != std::string::npos;)
            text.erase(at, here.size());
        return text;
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / name) << text;
    }

  private:
    TemporaryFolder folder_;
};

std::vector<std::string> clips(const std::vector<Condition>& conditions) {
    std::vector<std::string> out;
    for (const Condition& one : conditions) out.push_back(one.clip);
    return out;
}

TEST_F(Designs, CrossEveryLevelWithEveryOther) {
    const std::vector<Condition> all = conditions(design());
    EXPECT_EQ(clips(all), (std::vector<std::string>{"happiness0p5", "happiness0p75", "happiness1",
                                                    "fear0p5", "fear0p75", "fear1"}));
    const Json& script = all[1].script;
    EXPECT_EQ(script.at("fps"), 30);
    EXPECT_TRUE(script.at("fps").is_number_integer());
    EXPECT_NEAR(script.at("duration_s").get<double>(), 0.6, 1e-15);
    EXPECT_EQ(script.at("events")[0].at("expression"), "happiness");
    EXPECT_EQ(script.at("events")[0].at("intensity"), 0.75);
    EXPECT_NEAR(script.at("events")[0].at("onset_s").get<double>(), 0.3, 1e-15);
    EXPECT_EQ(all[1].of, all[1].clip);
}

TEST_F(Designs, RowsOfATableAreCrossedWithFactors) {
    write("people.tsv", "expression\tside\tnote\nhappiness\tl\t\"says \"\"hm\"\"\"\n\nfear\t\tx\n");
    const std::vector<Condition> all = conditions(design(
        R"({"conditions": "people.tsv", "factors": {"intensity": [0.2, 1]}, "parameters": {"side": "both"},
            "clip": "${expression}-${side}-${intensity}"})"));
    EXPECT_EQ(clips(all), (std::vector<std::string>{"happinessL0p2", "happinessL1", "fearBoth0p2",
                                                    "fearBoth1"}));
    for (const auto& [name, value] : all[0].values)
        if (name == "note") {
            EXPECT_EQ(value, "says \"hm\"");
        }
    write("people.tsv", "expression\tside\nhappiness\n");
    EXPECT_EQ(complaint(design(R"({"conditions": "people.tsv"})")),
              "people.tsv:2: expected 2 cells, as in the first row, found 1");
}

TEST_F(Designs, DrawTheSameWhateverElseThereIs) {
    const auto values = [](const std::vector<Condition>& all) {
        std::set<double> out;
        for (const Condition& one : all)
            out.insert(one.script.at("events")[0].at("intensity").get<double>());
        return out;
    };
    Json json = design(
        R"({"factors": {"intensity": {"draw": [0.3, 0.9], "count": 20}, "expression": ["fear"]}})");
    const std::set<double> once = values(conditions(json));
    EXPECT_EQ(once.size(), 20u);
    for (const std::string& clip : clips(conditions(json)))
        EXPECT_LE(clip.size(), std::string("fear0p1234").size()) << "four digits of a drawn number";
    EXPECT_GE(*once.begin(), 0.3);
    EXPECT_LT(*once.rbegin(), 0.9);
    EXPECT_GT(*once.rbegin() - *once.begin(), 0.3);
    json["sets"][0]["factors"]["expression"].push_back("anger");
    EXPECT_EQ(values(conditions(json)), once);
    json["seed"] = 2;
    EXPECT_NE(values(conditions(json)), once);
    // Part of a crossing
    const std::vector<Condition> some = conditions(design(R"({"draw": 4})"));
    EXPECT_EQ(some.size(), 4u);
    EXPECT_EQ(clips(some), clips(conditions(design(R"({"draw": 4})"))));
}

TEST_F(Designs, OverridesHoldForTheirConditionsOnly) {
    const std::vector<Condition> all = conditions(design(
        R"({"overrides": [{"when": {"expression": "fear", "intensity": 1}, "set": {"onset_s": 0.2}}]})"));
    EXPECT_NEAR(all[5].script.at("duration_s").get<double>(), 0.3, 1e-15);
    EXPECT_NEAR(all[4].script.at("duration_s").get<double>(), 0.6, 1e-15);
}

TEST_F(Designs, ControlsComeBesideTheirConditions) {
    const std::vector<Condition> all = conditions(design(
        R"({"factors": {"expression": ["happiness", "fear"]}, "parameters": {"intensity": 1}, "clip": "${expression}",
            "controls": ["reversed", {"control": "knock_out", "muscle": "zygomaticus_major.l"},
                         {"control": "palsy", "side": "right", "weakness": 0.8},
                         {"control": "neutral", "when": {"expression": "fear"}}]})"));
    EXPECT_EQ(clips(all), (std::vector<std::string>{
                              "happiness", "happinessReversed", "happinessWithoutZygomaticusMajorL",
                              "happinessPalsyRight", "fear", "fearReversed",
                              "fearWithoutZygomaticusMajorL", "fearPalsyRight", "fearNeutral"}));
    EXPECT_EQ(all[1].script, all[0].script);
    EXPECT_EQ(all[1].of, "happiness");
    EXPECT_EQ(all[2].script.at("weakness"), Json({{"zygomaticus_major.l", 1}}));
    EXPECT_EQ(all[3].script.at("weakness"), Json({{"right", 0.8}}));
    EXPECT_FALSE(all[8].script.contains("events"));
}

// A head at rest is one clip for all conditions that show it as long and in the same view.
TEST_F(Designs, NeutralFacesAreSharedByConditions) {
    Json json = design(R"({"factors": {"expression": ["happiness", "fear"], "intensity": [0.5, 1],
                                       "hold_s": [0.1, 0.2]},
                           "clip": "face_${expression}_${intensity}_${hold_s}", "controls": ["neutral"]})");
    const auto neutral = [](const std::vector<Condition>& all) {
        std::vector<Condition> out;
        for (const Condition& one : all)
            if (one.control.kind == ControlKind::kNeutral) out.push_back(one);
        return out;
    };
    const std::vector<Condition> all = conditions(json);
    EXPECT_EQ(all.size(), 8u + 2u);
    const std::vector<Condition> two = neutral(all);
    EXPECT_EQ(clips(two), (std::vector<std::string>{"face0p1Neutral", "face0p2Neutral"}));
    EXPECT_EQ(two[0].of, "faceHappiness0p50p1");
    // Only values that hold for all of them
    std::set<std::string> names;
    for (const auto& [name, value] : two[0].values) names.insert(name);
    EXPECT_EQ(names, (std::set<std::string>{"fps", "hold_s", "onset_s", "set"}));
    // A recording of its own makes another clip
    write("a.wav", "");
    write("b.wav", "");
    json["sets"][0]["conditions"] = Json::parse(R"([{"voice": "a.wav"}, {"voice": "b.wav"}])");
    json["sets"][0]["audio"] = "${voice}";
    json["sets"][0]["clip"] = "${expression}_${intensity}_${voice}_${hold_s}";
    EXPECT_EQ(neutral(conditions(json)).size(), 4u);
    // Where nothing in common tells two heads apart, they have the name of their first condition
    json =
        design(R"({"conditions": [{"n": 1, "rig": "a"}, {"n": 2, "rig": "a"}, {"n": 3, "rig": "b"},
                                     {"n": 4, "rig": "b"}],
                      "factors": {}, "parameters": {"expression": "fear", "intensity": 1},
                      "clip": "${n}", "controls": ["neutral"]})");
    json["sets"][0]["script"]["rig"] = "${rig}";
    EXPECT_EQ(clips(neutral(conditions(json))), (std::vector<std::string>{"neutral", "3Neutral"}));
}

TEST_F(Designs, RefuseWhatCannotBeMeant) {
    Json json = design();
    json["parameters"]["onset_s"] = "= hold_s * 2";
    EXPECT_EQ(
        complaint(json),
        "design.json:/parameters/hold_s: expected a value that does not depend on itself, found "
        "hold_s -> onset_s -> hold_s");
    EXPECT_EQ(
        complaint(design(R"({"clip": "${expression}"})")),
        "design.json:/sets/0, condition 2 (happiness): expected a name that no other clip has; "
        "put what differs into \"clip\", found \"happiness\", as in design.json:/sets/0, "
        "condition 1 (happiness)");
    EXPECT_EQ(complaint(design(R"({"clip": "${expresion}"})")),
              "design.json:/sets/0/clip: expected a parameter of the design (did you mean "
              "\"expression\"?), found \"expresion\"");
    EXPECT_EQ(
        complaint(design(R"({"clip": "../../..", "factors": {"expression": ["fear"],
                                   "intensity": [1]}})")),
        "design.json:/sets/0/clip: expected a name with letters or digits, found \"../../..\"");
    EXPECT_EQ(complaint(design(R"({"factors": {"intensity": {"from": 0, "to": 1, "steps": 100000},
                                   "gaze": {"from": 0, "to": 1, "steps": 10000}}})")),
              "design.json:/sets/0/factors: expected 100000 conditions at most, found more");
    EXPECT_EQ(complaint(design(R"({"controls": ["reverse"]})")).substr(0, 44),
              "design.json:/sets/0/controls/0: expected one");
    EXPECT_EQ(complaint(design(R"({"factors": {"intensity": []}})")),
              "design.json:/sets/0/factors/intensity: expected at least one value, found none");
    EXPECT_EQ(complaint(design(R"({"factor": {}})")).substr(0, 24), "design.json:/sets/0/fact");
}

/// Levels a, b, c ... of so many factors x, y, z ..., each with as many levels.
Json crossed(int factors, int levels, const char* fraction) {
    Json set =
        Json::parse(R"({"factors": {}, "clip": "", "script": {"format": "risorius-script"}})");
    for (int f = 0; f < factors; ++f) {
        const std::string name(1, static_cast<char>('p' + f));
        set["clip"] = set["clip"].get<std::string>() + "${" + name + "}";
        for (int l = 0; l < levels; ++l)
            set["factors"][name].push_back(std::string(1, static_cast<char>('a' + l)));
    }
    set["fraction"] = Json::parse(fraction);
    return set;
}

TEST_F(Designs, FractionsAreLatinSquaresAndOrthogonalArrays) {
    // Three factors of three levels: a Latin square, every two levels meet once
    const Json square = design(crossed(3, 3, R"([{"sum": ["p", "q", "r"], "modulo": 3}])").dump());
    EXPECT_EQ(
        clips(conditions(square)),
        (std::vector<std::string>{"aAA", "aBC", "aCB", "bAC", "bBB", "bCA", "cAB", "cBA", "cCC"}));
    Balance balance = balance_of(read(square).sets[0], 1);
    EXPECT_EQ(balance.strength, 2);
    EXPECT_EQ(
        balance.text(),
        "9 of 27 conditions; every level of p 3 times, of q 3 times, of r 3 times; two levels "
        "meet 1 times; orthogonal array of strength 2");
    // 2^(5-2) of resolution III: D = AB, E = AC (Box, Hunter, Hunter, Statistics for Experimenters, table 12.15)
    balance = balance_of(
        read(design(crossed(5, 2, R"([{"sum": ["p", "q", "s"], "modulo": 2, "remainder": 1},
                                      {"sum": ["p", "r", "t"], "modulo": 2, "remainder": 1}])")
                        .dump()))
            .sets[0],
        1);
    EXPECT_EQ(balance.used, 8);
    EXPECT_EQ(balance.strength, 2);
    // 2^(4-1) of resolution IV: every three factors in all combinations
    balance = balance_of(
        read(design(crossed(4, 2, R"([{"sum": ["p", "q", "r", "s"], "modulo": 2}])").dump()))
            .sets[0],
        1);
    EXPECT_EQ(balance.strength, 3);
    // Two orthogonal Latin squares: four factors, one ninth
    balance = balance_of(read(design(crossed(4, 3, R"([{"sum": ["p", "q", "r"], "modulo": 3},
                                      {"sum": {"p": 1, "q": 2, "s": 1}, "modulo": 3}])")
                                         .dump()))
                             .sets[0],
                         1);
    EXPECT_EQ(balance.used, 9);
    EXPECT_EQ(balance.strength, 2);
    // By chance they are not even
    Json drawn = design(crossed(3, 3, R"([{"sum": ["p", "q"], "modulo": 3}])").dump());
    drawn["sets"][0].erase("fraction");
    drawn["sets"][0]["draw"] = 9;
    EXPECT_EQ(balance_of(read(drawn).sets[0], 1).strength, 0);
}

TEST_F(Designs, FractionsAreRefusedWithTheirPlace) {
    const auto complains = [&](const char* fraction) {
        return complaint(design(crossed(3, 3, fraction).dump()));
    };
    const std::string place = "design.json:/sets/0/fraction/0";
    EXPECT_EQ(complains(R"([{"sum": ["p", "z"], "modulo": 3}])").substr(0, place.size() + 6),
              place + "/sum/1");
    EXPECT_EQ(complains(R"([{"sum": ["p", "p"], "modulo": 3}])"),
              place + "/sum/1: expected every factor once, found \"p\" again");
    EXPECT_EQ(complains(R"([{"sum": ["p"], "modulo": 3}])").substr(0, 60),
              (place + "/sum: expected at least two factors").substr(0, 60));
    EXPECT_EQ(complains(R"([{"sum": ["p", "q"], "modulo": 1}])").substr(0, place.size() + 8),
              place + "/modulo:");
    EXPECT_EQ(complains(R"([{"sum": ["p", "q"], "modulo": 100, "remainder": 99}])"),
              "design.json:/sets/0/fraction: expected at least one condition, found none");
}

TEST_F(Designs, SoundIsOfTheCondition) {
    const std::vector<Condition> all =
        conditions(design(R"({"parameters": {"word": "ba"}, "audio": "voices/${word}.wav",
                   "audio_start_s": "= onset_s / 2", "overrides": [
                       {"when": {"expression": "fear"}, "set": {"word": "da"}},
                       {"when": {"expression": "fear", "intensity": 1}, "set": {"word": null}}]})"));
    EXPECT_EQ(all[0].audio->filename(), "ba.wav");
    EXPECT_EQ(all[0].audio->parent_path().filename(), "voices");
    EXPECT_EQ(all[0].audio_start_s, 0.2);
    EXPECT_EQ(all[3].audio->filename(), "da.wav");
    EXPECT_EQ(all[5].audio->filename(), "none.wav");
    EXPECT_EQ(
        conditions(design(R"({"parameters": {"voice": null}, "audio": "${voice}"})"))[0].audio,
        std::nullopt);
    EXPECT_EQ(complaint(design(R"({"audio": "${intensity}"})")),
              "design.json:/sets/0/audio: expected the name of a file, found 0.5");
    EXPECT_EQ(complaint(design(R"({"audio_start_s": 1})")),
              "design.json:/sets/0/audio_start_s: expected \"audio\" beside it, found none");
}

TEST_F(Designs, MatchingNeedsSomethingToMatchTo) {
    Json json = design();
    const auto with = [&](const char* match) {
        json["match"] = Json::parse(match);
        return complaint(json);
    };
    EXPECT_EQ(with(R"({"luminance": {"within": "face", "mean": 0.3}, "loudness": {}})"),
              "no error");
    EXPECT_EQ(read(json).match.loudness_lufs, -23);
    EXPECT_EQ(with(R"({"luminance": {"one_for": "clip"}})"), "no error");
    EXPECT_EQ(with(R"({"luminance": {"within": "face"}})"), "no error") << "one map for each head";
    EXPECT_EQ(with(R"({"luminance": {"within": "picture"}})"),
              "design.json:/match/luminance: expected \"mean\" or \"sd\" to match all clips to, or "
              "\"one_for\": \"identity\" or \"clip\", found none of them");
    EXPECT_NE(with(R"({"motion": {"share": [0.5, 1.5], "of": "intensity"}})")
                  .find("/match/motion/share/1: expected"),
              std::string::npos);
    EXPECT_NE(with(R"({"motion": {"share": [0.5, 1], "of": "intensity"}})")
                  .find("expected no value of \"intensity\", which match/motion finds, found 0.5"),
              std::string::npos)
        << "it is a factor here";
    EXPECT_EQ(read(json).sets[0].factors.back().name, "seen_step");
    EXPECT_NE(with(R"({"luminance": {"mean": 1.5}})").find("/match/luminance/mean: expected"),
              std::string::npos);
    EXPECT_NE(with(R"({"luminance": {"within": "eyes", "mean": 0.3}})").find("/within: expected"),
              std::string::npos);
    EXPECT_NE(with(R"({"contrast": {}})").find("/match/contrast: "), std::string::npos);
}

TEST_F(Designs, LosslessClipsHaveNoQualityToChoose) {
    Json json = design();
    json["clips"] = {{"lossless", true}, {"crf", 14}};
    EXPECT_EQ(complaint(json),
              "design.json:/clips/crf: expected no crf beside \"lossless\": true, which has no "
              "quality to choose, found 14");
}

TEST_F(Designs, ControlsOfTheOvalNeedTheirNumbers) {
    Json json = design();
    const auto with = [&](const char* control) {
        json["sets"][0]["controls"] = Json::array({Json::parse(control)});
        return complaint(json);
    };
    EXPECT_NE(with(R"("low_pass")").find("\"cycles_per_face\""), std::string::npos);
    EXPECT_NE(with(R"("noise")").find("\"snr_db\""), std::string::npos);
    EXPECT_NE(with(R"({"control": "noise", "snr_db": 50})").find("/snr_db: expected"),
              std::string::npos);
    EXPECT_EQ(with(R"({"control": "noise", "snr_db": -6})"), "no error");
    EXPECT_EQ(with(R"({"control": "high_pass", "cycles_per_face": 32, "contrast": "rms"})"),
              "no error");
    EXPECT_EQ(with(R"("oval")"), "no error");
    EXPECT_NE(with(R"("band_pass")").find("\"cycles_per_face\""), std::string::npos);
    EXPECT_NE(
        with(R"({"control": "band_pass", "cycles_per_face": 8})").find("expected [low, high]"),
        std::string::npos);
    EXPECT_NE(with(R"({"control": "band_pass", "cycles_per_face": [16, 8]})")
                  .find("/cycles_per_face/1: expected more than the lower end, found 8"),
              std::string::npos);
    EXPECT_EQ(with(R"({"control": "band_pass", "cycles_per_face": [8, 16]})"), "no error");
    EXPECT_NE(with(R"({"control": "point_light", "dots": 94})").find("/dots: expected"),
              std::string::npos);
    EXPECT_EQ(with(R"({"control": "point_light", "scattered": true})"), "no error");
    EXPECT_NE(with(R"({"control": "mondrian", "dots": 9})").find("dots"), std::string::npos);
    EXPECT_EQ(with(R"("mirrored")"), "no error");
}

// A misspelt parameter would make a control, or an override, vanish without a word.
TEST_F(Designs, WhenAsksForParametersThatThereAre) {
    const auto said = [&](const Json& json) { return message_of([&] { conditions(json); }); };
    Json json = design();
    json["sets"][0]["controls"] = {{{"control", "mirrored"}, {"when", {{"expresion", "fear"}}}}};
    EXPECT_NE(said(json).find(", control mirrored/when: expected"), std::string::npos)
        << said(json);
    EXPECT_NE(said(json).find("\"expression\""), std::string::npos) << said(json);
    json = design();
    json["sets"][0]["overrides"] = {
        {{"when", {{"expresion", "fear"}}}, {"set", {{"onset_s", 0.3}}}}};
    EXPECT_NE(said(json).find("/overrides/0/when/expresion: expected"), std::string::npos)
        << said(json);
}

TEST_F(Designs, CodesTellConditionsOnRequest) {
    Json json = design();
    json["triggers"] = {{"codes", "condition"}, {"code_by", {"expression"}}};
    EXPECT_EQ(complaint(json), "no error");
    json["triggers"] = {{"code_by", {"expression"}}};
    EXPECT_EQ(
        complaint(json),
        "design.json:/triggers/code_by: expected \"codes\": \"condition\" beside it, found none");
}

TEST_F(Designs, AreasOfInterestAreKnownOnes) {
    Json json = design();
    json["clips"]["aois"] = {"eye_l", "nose"};
    EXPECT_EQ(complaint(json), "no error");
    json["clips"]["aois"] = {"eye_l", "eye_l"};
    EXPECT_EQ(complaint(json),
              "design.json:/clips/aois/1: expected each area once, found \"eye_l\" again");
    json["clips"]["aois"] = {"eyes"};
    EXPECT_EQ(complaint(json).substr(0, 39), "design.json:/clips/aois/0: expected one");
    json["clips"] = {{"aoi_margin", 0.3}};
    EXPECT_EQ(complaint(json).substr(0, 41), "design.json:/clips/aoi_margin: expected [");
}

TEST_F(Designs, ExperimentsAskForKeysAndKnownSets) {
    Json json = design();
    const auto with = [&](const char* more) {
        json["experiment"] =
            Json::parse(R"({"programs": ["jspsych"], "answers": {"h": "happiness"}})");
        json["experiment"].update(Json::parse(more));
        return complaint(json);
    };
    EXPECT_EQ(with("{}"), "no error");
    EXPECT_EQ(with(R"({"answers": {"escape": "nothing"}})"),
              "design.json:/experiment/answers/escape: expected a key from a to z or 0 to 9, found "
              "\"escape\"");
    EXPECT_EQ(
        with(R"({"answers": {}})"),
        "design.json:/experiment/answers: expected at least one key to answer with, found none");
    EXPECT_EQ(with(R"({"sets": ["fases"]})").substr(0, 32), "design.json:/experiment/sets/0: ");
    EXPECT_NE(with(R"({"programs": ["e-prime"]})").find("/experiment/programs/0: expected one of"),
              std::string::npos);
}

TEST_F(Designs, HostileOnesAreRefusedInTheirPlace) {
    // A thousand million conditions, in any way
    EXPECT_EQ(complaint(design(R"({"factors": {"a": {"from": 0, "to": 1, "steps": 100000},
                                              "b": {"from": 0, "to": 1, "steps": 10000}},
                                   "fraction": [{"sum": ["a", "b"], "modulo": 1000}]})")),
              "design.json:/sets/0/factors: expected 100000 conditions at most, found more");
    EXPECT_NE(complaint(design(R"({"factors": {"a": {"from": 0, "to": 1, "steps": 1000000000}}})"))
                  .find("/sets/0/factors/a/steps: expected"),
              std::string::npos);
    EXPECT_NE(complaint(design(R"({"factors": {"a": {"draw": [0, 1], "count": 1000000000}}})"))
                  .find("/sets/0/factors/a/count: expected"),
              std::string::npos);
    EXPECT_NE(complaint(design(R"({"draw": 1000000000})")).find("/sets/0/draw: expected"),
              std::string::npos);
    Json many =
        design(R"({"clip": "${i}", "factors": {"i": {"from": 1, "to": 60000, "steps": 60000}}})");
    many["sets"].push_back(many["sets"][0]);
    many["sets"][1]["name"] = "again";
    EXPECT_EQ(complaint(many), "design.json:/sets: expected 100000 clips at most, found more");
    // Circles, the shortest and one through a row of the table
    EXPECT_NE(
        complaint(design(R"({"parameters": {"hold_s": "= hold_s + 1"}})"))
            .find("/sets/0/parameters/hold_s: expected a value that does not depend on itself, "
                  "found hold_s -> hold_s"),
        std::string::npos);
    write("people.tsv", "expression\tside\nfear\t${expression2}\n");
    EXPECT_NE(
        complaint(design(R"({"conditions": "people.tsv", "factors": {"expression2": ["${side}"]},
                                   "clip": "x"})"))
            .find("expression2 -> side -> expression2"),
        std::string::npos);
    // Columns that the script needs and the table does not have, or has twice
    write("people.tsv", "side\nl\n");
    EXPECT_NE(
        complaint(design(R"({"conditions": "people.tsv", "factors": {}, "clip": "${side}"})"))
            .find("design.json:/sets/0/script/events/0/expression: expected a parameter of the "
                  "design, found \"expression\""),
        std::string::npos);
    write("people.tsv", "side\tside\nl\tr\n");
    EXPECT_NE(complaint(design(R"({"conditions": "people.tsv"})")).find("people.tsv:1: expected"),
              std::string::npos);
    write("people.tsv", "");
    EXPECT_NE(complaint(design(R"({"conditions": "people.tsv"})")).find("people.tsv"),
              std::string::npos);
    // Names that are the same where file names know no case, or where signs are left out
    EXPECT_NE(
        complaint(design(R"({"factors": {"expression": ["Fear", "fEAR"]}, "clip": "${expression}",
                                   "parameters": {"intensity": 1}})"))
            .find("expected a name that no other clip has"),
        std::string::npos);
    EXPECT_NE(
        complaint(design(R"({"factors": {"expression": ["a/b", "a.b"]}, "clip": "${expression}",
                                   "parameters": {"intensity": 1}})"))
            .find("expected a name that no other clip has"),
        std::string::npos);
    // Names that would lead out of the folder, or are none
    for (const Condition& one :
         conditions(design(R"({"clip": "../../${expression}/../x${intensity}"})")))
        EXPECT_EQ(one.clip.find_first_of("/.\\"), std::string::npos) << one.clip;
    EXPECT_NE(complaint(design(R"({"name": "../.."})")).find("/sets/0/name: expected"),
              std::string::npos);
    EXPECT_NE(complaint(design(R"({"clip": "${expression}__________", "factors": {
                  "expression": [")" +
                               std::string(300, 'a') + R"("], "intensity": [1]}})"))
                  .find("expected a name of 100 letters at most"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::design
