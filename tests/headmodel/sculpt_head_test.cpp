// SPDX-License-Identifier: MIT
// A head of the family from the command's side: who is asked for, what is written, what is refused.
#include "risorius/headmodel/sculpt_head.h"

#include <gtest/gtest.h>

#include <fstream>

#include "message_of.h"
#include "risorius/scene/rig_files.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

using Files = std::set<std::string>;

TEST(SculptHead, SameSeedGivesTheSameFiles) {
    const TemporaryFolder folder;
    for (const char* name : {"a", "b"})
        sculpt_head(
            {.out = folder / name, .identity = chosen_identity({.seed = 7}), .mesh_only = true});
    EXPECT_EQ(bytes_of(folder / "a/head.obj"), bytes_of(folder / "b/head.obj"));
    EXPECT_EQ(bytes_of(folder / "a/identity.json"), bytes_of(folder / "b/identity.json"));
    EXPECT_NE(bytes_of(folder / "a/head.obj"), "");
    // Who was drawn can be asked for again by the file.
    sculpt_head({.out = folder / "c",
                 .identity = chosen_identity({.identity = folder / "a/identity.json"}),
                 .mesh_only = true});
    EXPECT_EQ(bytes_of(folder / "a/head.obj"), bytes_of(folder / "c/head.obj"));
}

TEST(SculptHead, AMeshAloneDoesNotTakeARigAway) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "anna");
    std::ofstream(folder / "anna/rig.json") << "{}";
    EXPECT_EQ(message_of([&] {
                  sculpt_head({.out = folder / "anna",
                               .identity = chosen_identity({.seed = 7}),
                               .mesh_only = true});
              }),
              "mesh_only: expected a folder without a rig, which it would take away, found \"" +
                  (folder / "anna/rig.json").generic_string() + "\"");
    EXPECT_EQ(bytes_of(folder / "anna/rig.json"), "{}");
}

TEST(SculptHead, NobodyBeyondTheSpreadIsWritten) {
    const TemporaryFolder folder;
    const headmodel::Identity wide =
        chosen_identity({.age = 80, .shape = {"nose_width=2", "fat=2", "face_width=2"}});
    const std::string message =
        message_of([&] { sculpt_head({.out = folder / "out", .identity = wide}); });
    EXPECT_TRUE(message.starts_with(
        "head: expected measures within 2.5 standard deviations of the mean, found nose width"))
        << message;
    EXPECT_EQ(folder.listing(), Files{});
}

TEST(SculptHead, WhatIsSetGoesBeforeTheNamedIdentity) {
    const headmodel::Identity ada = chosen_identity({.identity = "ada"}),
                              older = chosen_identity({.identity = "ada",
                                                       .age = 60,
                                                       .shape = {"lips=-1"},
                                                       .iris = "brown"});
    EXPECT_EQ(older.age, 60);
    EXPECT_EQ(older.shape.at("lips"), -1);
    EXPECT_EQ(older.iris, "brown");
    EXPECT_EQ(older.sex, ada.sex);
    EXPECT_EQ(older.shape.at("eyes"), ada.shape.at("eyes"));
}

TEST(SculptHead, ErrorsNameTheOption) {
    const auto message = [](const IdentityChoice& choice) {
        return message_of([&] { chosen_identity(choice); });
    };
    EXPECT_EQ(message({.age = 12}), "age: expected [20, 80], found 12");
    EXPECT_EQ(message({.shape = {"lips"}}), "shape: expected PARAMETER=NUMBER, found \"lips\"");
    EXPECT_EQ(message({.shape = {"lips=3"}}), "shape/lips: expected [-2, 2], found 3");
    EXPECT_EQ(message({.identity = "ada", .seed = 3}),
              "seed: expected a seed or identity, found both");
    EXPECT_NE(message({.identity = "adda"}).find("(did you mean \"ada\"?)"), std::string::npos);
}

}  // namespace
}  // namespace risorius::headmodel
