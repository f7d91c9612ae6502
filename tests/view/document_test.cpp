// SPDX-License-Identifier: MIT
// A script that is edited: every edit can be undone and redone, to the byte.
#include "risorius/view/document.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "message_of.h"
#include "risorius/core/json_text.h"

namespace risorius::view {
namespace {

Json script() {
    return Json::parse(R"({"format": "risorius-script", "version": 1, "rig": "rig.json",
        "duration_s": 2, "channels": {"AU12": {"keys": [[0, 0], [1, 0.5]]}, "AU4": {"keys": [[0, 1]]},
        "jaw_open": {"keys": [[0.5, 0.25]], "interpolation": "linear"}},
        "events": [{"expression": "joy", "start_s": 0.1}, {"blink": {}, "start_s": 1}]})");
}

Operation set(const std::string& pointer, const char* value) {
    return {pointer, std::make_shared<Json>(Json::parse(value)), {}};
}
Operation removed(const std::string& pointer) { return {pointer, nullptr, {}}; }

TEST(Document, UndoGivesBackARemovedChannelInItsPlace) {
    Document document(script());
    const std::string before = document.text();
    document.edit({removed("/channels/AU12"), removed("/events/0")});
    EXPECT_NE(document.text(), before);
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.text(), before);
    EXPECT_FALSE(document.undo());
}

TEST(Document, AGestureIsUndoneAsOne) {
    Document document(script());
    const std::string before = document.text();
    for (int i = 0; i < 60; ++i)
        document.edit({set("/channels/AU12/keys/1/1", ("0." + std::to_string(i)).c_str())}, "drag");
    document.edit({set("/channels/AU4/keys/0/1", "0.5")}, "other drag");
    EXPECT_TRUE(document.undo());
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.text(), before);
    EXPECT_TRUE(document.redo());
    EXPECT_EQ(document.json()["channels"]["AU12"]["keys"][1][1], 0.59);
}

TEST(Document, RandomEditsAreUndoneAndRedoneToTheByte) {
    // Drawn by a generator whose numbers are the same everywhere.
    std::mt19937 random(7);
    Document document(script());
    std::vector<std::string> texts{document.text()};
    const std::vector<std::string> channels{"AU12", "AU4", "jaw_open", "AU1", "head_yaw_deg"};
    for (int i = 0; i < 300; ++i) {
        const std::string channel = "/channels/" + channels[random() % channels.size()];
        const std::string value = std::to_string(random() % 1000) + "e-3";
        std::vector<Operation> operations;
        switch (random() % 5) {
            case 0:
                operations = {set(channel, ("{\"keys\": [[0, " + value + "]]}").c_str())};
                break;
            case 1:
                operations = {removed(channel)};
                break;
            case 2:
                operations = {set("/events/" + std::to_string(document.json()["events"].size()),
                                  ("{\"blink\": {}, \"start_s\": " + value + "}").c_str())};
                break;
            case 3:
                if (document.json()["events"].empty()) continue;
                operations = {removed("/events/" +
                                      std::to_string(random() % document.json()["events"].size()))};
                break;
            default:
                operations = {set("/duration_s", value.c_str()), removed("/seed"),
                              set("/seed", value.c_str())};
        }
        document.edit(operations);
        texts.push_back(document.text());
    }
    for (std::size_t i = texts.size(); i-- > 1;) {
        ASSERT_EQ(document.text(), texts[i]);
        ASSERT_TRUE(document.undo());
    }
    EXPECT_EQ(document.text(), texts[0]);
    for (std::size_t i = 1; i < texts.size(); ++i) {
        ASSERT_TRUE(document.redo());
        ASSERT_EQ(document.text(), texts[i]);
    }
    EXPECT_FALSE(document.redo());
}

TEST(Document, AnEditThatFailsChangesNothing) {
    Document document(script());
    const std::string before = document.text();
    EXPECT_EQ(message_of([&] {
                  document.edit({set("/seed", "3"), set("/channels/AU9/keys", "[[0, 1]]")});
              }),
              "edit /channels/AU9/keys: expected a place in the script, found none");
    EXPECT_EQ(document.text(), before);
    EXPECT_FALSE(document.can_undo());
    document.edit({set("/seed", "3")}, "a");
    document.edit({set("/seed", "4")}, "a");
    document.reject();
    EXPECT_EQ(document.json()["seed"], 3);
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.text(), before);
}

TEST(Document, RefusesPointersThatLeadNowhere) {
    Document document(script());
    for (const auto& [pointer, message] : std::map<std::string, std::string>{
             {"seed", "edit: expected a JSON pointer to a part of the script, found \"seed\""},
             {"", "edit: expected a JSON pointer to a part of the script, found \"\""},
             {"/events/7", "edit /events/7: expected an index in [0, 2], found \"7\""},
             {"/events/-", "edit /events/-: expected an index in [0, 2], found \"-\""},
             // The library throws here what is no Error.
             {"/events//x", "edit /events//x: expected a place in the script, found none"},
             {"/events/99999999999999999999/x",
              "edit /events/99999999999999999999/x: expected a place in the script, found none"},
             {"/rig/x",
              "edit /rig/x: expected a place in an object or a list, found a plain value"}})
        EXPECT_EQ(message_of([&] {
                      document.edit({set("/seed", "3"), set(pointer, "1")});
                  }),
                  message);
    EXPECT_EQ(document.text(), Document(script()).text());
}

TEST(Document, IsWrittenAsPeopleWriteScripts) {
    Document document(Json::parse(
        R"({"rig":"a","channels":{"AU12":{"keys":[[0,0],[0.1,0.30000000000000004]]}},"events":[]})"));
    EXPECT_EQ(document.text(),
              "{\n  \"rig\": \"a\",\n  \"channels\": {\n    \"AU12\": {\n      \"keys\": [\n"
              "        [0, 0],\n        [0.1, 0.30000000000000004]\n      ]\n    }\n  },\n"
              "  \"events\": []\n}\n");
    EXPECT_EQ(Document(Json::parse(document.text())).text(), document.text());
}

}  // namespace
}  // namespace risorius::view
