// SPDX-License-Identifier: MIT
// What a person reads when a JSON file is wrong: place, expected, found. Whole messages are compared.
#include "risorius/core/json_cursor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/core/json_text.h"

namespace risorius {
namespace {

JsonCursor rig(const char* json) { return JsonCursor::from_json(Json::parse(json), "rig.json"); }

/// A file in a temporary folder of its own, which is removed again.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& content, const std::string& name = "script.json") {
        static int count = 0;
        folder_ = std::filesystem::temp_directory_path() /
                  ("risorius core " + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(folder_);
        file_ = folder_ / name;
        std::ofstream(file_, std::ios::binary) << content;
    }
    ~TemporaryFile() { std::filesystem::remove_all(folder_); }
    const std::filesystem::path& file() const { return file_; }
    const std::filesystem::path& folder() const { return folder_; }

    /// The message of reading the file, without the folder.
    std::string message() const {
        const std::string text = message_of([&] { JsonCursor::read_file(file_); });
        const std::string before = folder_.string() + "/";
        return text.starts_with(before) ? text.substr(before.size()) : text;
    }

  private:
    std::filesystem::path folder_, file_;
};

TEST(JsonCursor, MissingFileIsNamed) {
    EXPECT_EQ(message_of([] { JsonCursor::read_file("no/such.json"); }),
              "no/such.json: expected a JSON file, found no such file");
}

TEST(JsonCursor, FolderInPlaceOfAFileIsNamed) {
    const TemporaryFile any("{}");
    EXPECT_EQ(message_of([&] { JsonCursor::read_file(any.folder()); }),
              any.folder().string() + ": expected a JSON file, found a folder");
}

TEST(JsonCursor, EmptyFileIsNamed) {
    EXPECT_EQ(TemporaryFile("").message(),
              "script.json: expected a JSON file, found an empty file");
}

TEST(JsonCursor, MalformedJsonIsPlacedByLineAndColumn) {
    EXPECT_EQ(TemporaryFile("{\n  \"fps\": 60,\n  \"seed\" 1\n}\n").message(),
              "script.json:3:10: expected valid JSON, found '1' that does not belong there");
    EXPECT_EQ(TemporaryFile("x").message(),
              "script.json:1:1: expected valid JSON, found 'x' that does not belong there");
    EXPECT_EQ(TemporaryFile("{\"a\": [1, 2,]}").message(),
              "script.json:1:13: expected valid JSON, found ']' that does not belong there");
}

TEST(JsonCursor, CharactersThatDoNotPrintAreDescribed) {
    EXPECT_EQ(
        TemporaryFile("{\"rig\": \"a.json\n}").message(),
        "script.json:1:16: expected valid JSON, found a line break that does not belong there");
    EXPECT_EQ(TemporaryFile("[\xc3\xa4]").message(),
              "script.json:1:2: expected valid JSON, found a character that does not belong there");
}

TEST(JsonCursor, JsonCutShortSaysThatTheFileEnds) {
    EXPECT_EQ(TemporaryFile("{\"fps\": 60").message(),
              "script.json:1:11: expected valid JSON, found the end of the file");
    EXPECT_EQ(TemporaryFile("{\n\"fps\": 60,\n").message(),
              "script.json:3:1: expected valid JSON, found the end of the file");
}

TEST(JsonCursor, KeyGivenTwiceIsRefused) {
    EXPECT_EQ(TemporaryFile("{\"a\": {\"AU6\": 1, \"b\": {}, \"AU6\": 2}}").message(),
              "script.json: expected every key once in its object, found \"AU6\" twice");
    EXPECT_EQ(TemporaryFile("{\"a\": {\"x\": 1}, \"b\": {\"x\": 1}, \"x\": 1}").message(),
              "no error");
}

TEST(JsonCursor, PlaceIsAJsonPointerWithItsEscapes) {
    const JsonCursor root = rig(R"({"muscles": [{}, {"a/b": {"c~d": 1}}]})");
    EXPECT_EQ(root.place(), "rig.json:/");
    EXPECT_EQ(root.at("muscles").items()[1].at("a/b").at("c~d").place(),
              "rig.json:/muscles/1/a~1b/c~0d");
}

TEST(JsonCursor, MissingKeyIsNamedAtTheObjectThatLacksIt) {
    EXPECT_EQ(message_of([] { rig(R"({"jaw": {}})").at("jaw").at("width_m"); }),
              "rig.json:/jaw: expected the key \"width_m\", found none");
    EXPECT_EQ(message_of([] { rig(R"({"jaw": 3})").at("jaw").at("width_m"); }),
              "rig.json:/jaw: expected an object, found 3");
    EXPECT_FALSE(rig("{}").find("jaw"));
    EXPECT_TRUE(rig(R"({"jaw": 3})").find("jaw"));
    EXPECT_TRUE(rig(R"({"jaw": 3})").has("jaw"));
    EXPECT_FALSE(rig("[]").has("jaw"));
}

TEST(JsonCursor, MisspeltKeyNamesTheNearestOne) {
    EXPECT_EQ(
        message_of([] {
            rig(R"({"duration": 2})").allow_keys({"fps", "duration_s", "seed"});
        }),
        "rig.json:/duration: expected a known key (did you mean \"duration_s\"?), found unknown "
        "key \"duration\"");
}

TEST(JsonCursor, KeyLikeNoneListsThoseThereAre) {
    EXPECT_EQ(message_of([] {
                  rig(R"({"fps": 1, "colour": 2})").allow_keys({"fps", "seed"});
              }),
              "rig.json:/colour: expected one of fps seed, found unknown key \"colour\"");
    EXPECT_EQ(message_of([] { rig(R"({"fps": 1})").allow_keys({"fps", "seed"}); }), "no error");
    EXPECT_EQ(message_of([] { rig("[1, 2]").allow_keys({"fps"}); }),
              "rig.json:/: expected an object, found [1,2]");
}

TEST(JsonCursor, KeysAndItemsKeepTheOrderOfTheFile) {
    EXPECT_EQ(rig(R"({"z": 1, "a": 2, "m": 3})").keys(), (std::vector<std::string>{"z", "a", "m"}));
    std::vector<double> values;
    for (const JsonCursor& item : rig("[3, 1, 2]").items()) values.push_back(item.number());
    EXPECT_EQ(values, (std::vector<double>{3, 1, 2}));
    EXPECT_EQ(message_of([] { rig("{}").items(); }),
              "rig.json:/: expected an array, found an object with 0 keys");
    EXPECT_EQ(message_of([] { rig("true").keys(); }), "rig.json:/: expected an object, found true");
}

TEST(JsonCursor, AnArrayOfMillionsOfItemsIsRefused) {
    const JsonCursor root = JsonCursor::from_json(Json(1000001, Json(0)), "rig.json");
    EXPECT_EQ(message_of([&] { root.items(); }),
              "rig.json:/: expected an array of at most 1000000, found one of 1000001");
}

TEST(JsonCursor, NumberOutsideItsRangeSaysBoth) {
    const JsonCursor root = rig(R"({"a": -0.01, "b": "x", "c": 1e-3, "d": null})");
    EXPECT_EQ(message_of([&] {
                  root.at("a").number({0, 1});
              }),
              "rig.json:/a: expected [0, 1], found -0.01");
    EXPECT_EQ(message_of([&] {
                  root.at("a").number({0, std::numeric_limits<double>::infinity()});
              }),
              "rig.json:/a: expected [0, inf), found -0.01");
    EXPECT_EQ(message_of([&] {
                  root.at("c").number({-std::numeric_limits<double>::infinity(), -1});
              }),
              "rig.json:/c: expected (-inf, -1], found 0.001");
    EXPECT_EQ(message_of([&] {
                  root.at("b").number({0, 1});
              }),
              "rig.json:/b: expected a number in [0, 1], found \"x\"");
    EXPECT_EQ(message_of([&] { root.at("d").number(); }),
              "rig.json:/d: expected a number, found null");
    EXPECT_EQ(root.at("c").number({0, 1}), 1e-3);
    EXPECT_EQ(rig("1").number({0, 1}), 1.0);
    EXPECT_EQ(rig("0").number({0, 1}), 0.0);
}

TEST(JsonCursor, NumberTooLargeForADoubleIsRefused) {
    const JsonCursor infinite = JsonCursor::from_json(Json(HUGE_VAL), "rig.json");
    EXPECT_EQ(message_of([&] { infinite.number(); }),
              "rig.json:/: expected a finite number, found null");
    EXPECT_EQ(TemporaryFile("{\"a\": 1e999}").message(),
              "script.json: expected numbers within +-1.8e308, found '1e999'");
}

TEST(JsonCursor, IntegerRefusesFractionsAndTheWrongSize) {
    EXPECT_EQ(rig("60").integer(1, 1000), 60);
    for (const char* wrong : {"0", "1001", "2.5", "60.0", "\"60\"", "4294967356", "-1"})
        EXPECT_EQ(message_of([&] { rig(wrong).integer(1, 1000); }),
                  "rig.json:/: expected an integer in [1, 1000], found " + std::string(wrong));
}

TEST(JsonCursor, WordsAndFlagsAreNotGuessedFromOtherTypes) {
    EXPECT_EQ(rig("true").boolean(), true);
    EXPECT_EQ(message_of([] { rig("1").boolean(); }),
              "rig.json:/: expected true or false, found 1");
    EXPECT_EQ(rig("\"left\"").string(), "left");
    EXPECT_EQ(message_of([] { rig("1").string(); }), "rig.json:/: expected a string, found 1");
    EXPECT_EQ(rig("\"step\"").one_of({"step", "linear"}), "step");
    EXPECT_EQ(message_of([] {
                  rig("\"cubic\"").one_of({"step", "linear"});
              }),
              "rig.json:/: expected one of \"step\" \"linear\", found \"cubic\"");
    EXPECT_EQ(message_of([] { rig("0").one_of({"step"}); }),
              "rig.json:/: expected one of \"step\", found 0");
}

TEST(JsonCursor, VectorHasThreeFiniteNumbers) {
    EXPECT_EQ(rig("[1, -2, 0.5]").vec3(), Vec3(1, -2, 0.5));
    EXPECT_EQ(message_of([] { rig("[1, 2]").vec3(); }),
              "rig.json:/: expected three numbers, found [1,2]");
    EXPECT_EQ(message_of([] { rig("[1, 2, \"3\"]").vec3(); }),
              "rig.json:/2: expected a number, found \"3\"");
}

TEST(JsonCursor, LongValuesAreShortenedInMessages) {
    EXPECT_EQ(message_of([] { rig(R"({"a": 1, "b": 2})").number(); }),
              "rig.json:/: expected a number, found an object with 2 keys");
    const JsonCursor numbers = JsonCursor::from_json(Json(std::vector<int>(100, 7)), "rig.json");
    EXPECT_EQ(message_of([&] { numbers.number(); }),
              "rig.json:/: expected a number, found an array of 100");
    const JsonCursor prose = JsonCursor::from_json(Json(std::string(200, 'a')), "rig.json");
    EXPECT_EQ(message_of([&] { prose.number(); }),
              "rig.json:/: expected a number, found \"" + std::string(59, 'a') + "...");
}

TEST(JsonCursor, PathsStartFromTheFolderOfTheirFile) {
    const JsonCursor root = JsonCursor::from_json(
        Json::parse(R"({"a": "../mesh.obj", "b": "/data/mesh.obj"})"), "rigs/anna/rig.json");
    EXPECT_EQ(root.folder(), "rigs/anna");
    EXPECT_EQ(root.at("a").path(), "rigs/mesh.obj");
    EXPECT_EQ(root.at("b").path(), "/data/mesh.obj");
}

TEST(JsonCursor, APathWithAZeroByteIsNotThatOfAnotherFile) {
    const JsonCursor root =
        JsonCursor::from_json(Json::parse(R"({"a": "mesh.obj\u0000.png"})"), "rig.json");
    EXPECT_EQ(message_of([&] { root.at("a").path(); }),
              "rig.json:/a: expected a path without a zero byte, found \"mesh.obj\\u0000.png\"");
}

TEST(JsonCursor, TableIsFollowedIntoItsFile) {
    const TemporaryFile table("{\"x\": 0.25}", "table.json");
    const JsonCursor root =
        JsonCursor::from_json(Json::parse(R"({"a": "table.json", "b": {"x": 1}, "c": "no.json"})"),
                              (table.folder() / "rig.json").string());
    EXPECT_EQ(follow_table(root.at("a")).at("x").number(), 0.25);
    EXPECT_EQ(follow_table(root.at("a")).at("x").place(), table.file().string() + ":/x");
    EXPECT_EQ(follow_table(root.at("b")).at("x").number(), 1.0);
    EXPECT_EQ(message_of([&] { follow_table(root.at("c")); }),
              (table.folder() / "rig.json").string() + ":/c: expected an existing file, found \"" +
                  (table.folder() / "no.json").string() + "\"");
}

TEST(JsonCursor, CursorOutlivesTheOneItCameFrom) {
    const JsonCursor inner = [] { return rig(R"({"a": [1, 2, 3]})").at("a").items()[2]; }();
    EXPECT_EQ(inner.number(), 3.0);
    EXPECT_EQ(inner.place(), "rig.json:/a/2");
}

TEST(NearestName, IsFoundWithinTwoEditsOrAThirdOfTheWord) {
    const std::vector<std::string_view> known = {"zygomaticus_major", "zygomaticus_minor",
                                                 "mentalis"};
    EXPECT_EQ(nearest_name("zygomaticus_mayor", known), "zygomaticus_major");
    EXPECT_EQ(nearest_name("mentals", known), "mentalis");
    EXPECT_EQ(nearest_name("frontalis_medial", known), "");
    EXPECT_EQ(nearest_name("", {}), "");
    EXPECT_EQ(nearest_name("mussels", {"muscles", "cells"}), "muscles");  // two letters swapped
}

TEST(FormatNumber, IsTheShortestThatReadsBackTheSame) {
    EXPECT_EQ(format_number(0.1), "0.1");
    EXPECT_EQ(format_number(-2), "-2");
    EXPECT_EQ(format_number(1e-9), "1e-09");
    // std::stod would reject the smallest denormal; strtod does not.
    for (double value : {1.0 / 3, 0.1 + 0.2, 1e300, 5e-324, -0.0})
        EXPECT_EQ(std::strtod(format_number(value).c_str(), nullptr), value);
}

TEST(JsonText, MayBeNested200TimesAndNoDeeper) {
    const auto nested = [](int times, const std::string& inner) {
        return std::string(static_cast<std::size_t>(times), '[') + inner +
               std::string(static_cast<std::size_t>(times), ']');
    };
    // A message that quotes a value of the greatest depth
    const JsonCursor deep = parse_json_text(nested(200, "\"[[[[\\\"[\""), "deep.json");
    EXPECT_EQ(message_of([&] { deep.number(); }),
              "deep.json:/: expected a number, found an array of 1");
    const std::string message =
        "deep.json:2:200: expected at most 200 arrays and objects in one another, found one more";
    EXPECT_EQ(message_of([&] { parse_json_text("[\n" + nested(200, "1") + "]", "deep.json"); }),
              message);
    EXPECT_EQ(message_of([&] { parse_json_text("[\n" + nested(100'000, ""), "deep.json"); }),
              message);
}

TEST(JsonText, QuotesWholeCharactersInMessages) {
    const JsonCursor text = parse_json_text("\"" + std::string(58, 'x') + "ää\"", "cut.json");
    EXPECT_EQ(message_of([&] { text.number(); }),
              "cut.json:/: expected a number, found \"" + std::string(58, 'x') + "...");
}

TEST(JsonText, IsWrittenFromAnyBytes) {
    EXPECT_EQ(json_text(Json{{"file", "a\xff.png"}}), "{\"file\":\"a\xEF\xBF\xBD.png\"}");
}

}  // namespace
}  // namespace risorius
