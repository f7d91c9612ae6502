// From a design file to the clips it asks for.
#include "stimuli/conditions.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "message_of.h"
#include "stimuli/arithmetic.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
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

TEST_F(Designs, RefuseWhatCannotBeMeant) {
    Json json = design();
    json["parameters"]["onset_s"] = "= hold_s * 2";
    EXPECT_EQ(
        complaint(json),
        "design.json:/parameters/hold_s: expected a value that does not hang on itself, found "
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
              "design.json:/sets/0/factors/intensity: expected a value at least, found none");
    EXPECT_EQ(complaint(design(R"({"factor": {}})")).substr(0, 24), "design.json:/sets/0/fact");
}

TEST(ClipWord, HasLettersAndDigitsOnly) {
    EXPECT_EQ(clip_word("zygomaticus_major.l"), "zygomaticusMajorL");
    EXPECT_EQ(clip_word("0.25"), "0p25");
    EXPECT_EQ(clip_word("-3.5"), "m3p5");
    EXPECT_EQ(clip_word("../etc/passwd"), "etcPasswd");
    EXPECT_EQ(clip_word("happy face 2"), "happyFace2");
    EXPECT_EQ(clip_word("über"), "ber");
}

TEST(FrameOrder, IsThatOfTheControl) {
    const auto order = [](ControlKind kind, unsigned seed = 1) {
        Control control;
        control.kind = kind;
        return frame_order(control, 6, 4, seed);
    };
    using Order = std::vector<int>;
    EXPECT_EQ(order(ControlKind::kNone), (Order{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(order(ControlKind::kReversed), (Order{5, 4, 3, 2, 1, 0}));
    EXPECT_EQ(order(ControlKind::kApex), (Order{4, 4, 4, 4, 4, 4}));
    Order scrambled = order(ControlKind::kScrambled);
    EXPECT_NE(scrambled, order(ControlKind::kNone));
    EXPECT_NE(scrambled, order(ControlKind::kScrambled, 2));
    std::sort(scrambled.begin(), scrambled.end());
    EXPECT_EQ(scrambled, order(ControlKind::kNone));
}

TEST(Arithmetic, IsThatOfSchool) {
    const auto value = [](const std::string& text) {
        return arithmetic(text, "here", [](const std::string& name) -> double {
            if (name == "a") return 3;
            throw Error("here", "a", name);
        });
    };
    EXPECT_EQ(value("1 + 2 * a"), 7);
    EXPECT_EQ(value("-(a - 1) / 4 - -2"), 1.5);
    EXPECT_EQ(value("max(a, min(2.5e1, 7)) * .5"), 3.5);
    const auto complaint = [&](const std::string& text) {
        return message_of([&] { value(text); });
    };
    EXPECT_EQ(complaint("1 +"),
              "here: expected a number, a parameter or a bracket in \"1 +\", found its end");
    EXPECT_EQ(complaint("(1"), "here: expected \")\" in \"(1\", found its end");
    EXPECT_EQ(complaint("1 a"), "here: expected an operator in \"1 a\", found \"a\"");
    EXPECT_EQ(complaint("1 / 0"), "here: expected a finite value of \"1 / 0\", found none");
    EXPECT_EQ(complaint(std::string(100, '(')).substr(0, 30), "here: expected fewer brackets ");
}

}  // namespace
}  // namespace risorius::stimuli
