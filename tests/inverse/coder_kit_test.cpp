// SPDX-License-Identifier: MIT
// The kit for coders: codes, order, agreement with numbers worked out by hand, and a page with what the coder needs.
#include "risorius/inverse/detail/coder_kit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "message_of.h"
#include "paths.h"
#include "rig/heads.h"
#include "risorius/inverse/code_agreement.h"
#include "risorius/inverse/read_units.h"
#include "risorius/media/video_reader.h"
#include "temporary_folder.h"

namespace risorius::inverse {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = RISORIUS_SOURCE_DIR;

fs::path written(const fs::path& file, const std::string& text) {
    std::ofstream(file) << text;
    return file;
}

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(CoderKit, ReadsCodesAsCodersWriteThem) {
    using Units = std::vector<CodedUnit>;
    EXPECT_EQ(read_codes("1C+2E", ""), (Units{{1, {}, 3}, {2, {}, 5}}));
    EXPECT_EQ(read_codes("R12B + L14", ""), (Units{{12, Side::kRight, 2}, {14, Side::kLeft, {}}}));
    EXPECT_EQ(read_codes("0", ""), Units{});
    EXPECT_EQ(read_codes("", ""), Units{});
    const auto message = [](const std::string& text) {
        return message_of([&] { read_codes(text, "sheet.tsv:7"); });
    };
    for (const char* wrong : {"AU12", "12F", "1++2", "12BB", "L", "123"})
        EXPECT_EQ(message(wrong).substr(0, 58),
                  "sheet.tsv:7: expected codes such as 1C+2C, R12B or 0, foun")
            << wrong;
    EXPECT_EQ(message("L12+R12"), "sheet.tsv:7: expected each unit once, found 12 twice");
}

TEST(CoderKit, ShowsUnitsCombinationsAndNothingInTheOrderOfTheSeed) {
    const track::FacsTable& facs = rig::adult().rig.facs;
    const std::vector<KitClip> clips = kit_clips(facs, {"AU1", "AU2", "AU12"}, 1);
    std::vector<std::string> codes;
    for (const KitClip& clip : clips) codes.push_back(clip.codes());
    std::vector<std::string> sorted = codes;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, (std::vector<std::string>{"0", "0", "0", "0", "12C", "12E", "1C", "1E",
                                                "1E+2E", "2C", "2E"}));
    std::vector<std::string> again, other;
    for (const KitClip& clip : kit_clips(facs, {"AU1", "AU2", "AU12"}, 1))
        again.push_back(clip.codes());
    for (const KitClip& clip : kit_clips(facs, {"AU1", "AU2", "AU12"}, 2))
        other.push_back(clip.codes());
    EXPECT_EQ(codes, again);
    EXPECT_NE(codes, other);
}

TEST(CoderKit, CountsAgreementUnitByUnit) {
    const TemporaryFolder temporary;
    const fs::path folder = temporary.path();
    const fs::path key =
        written(folder / "key.tsv", "clip\tcodes\nc1\t12E\nc2\t12C\nc3\t1E+2E\nc4\t0\n");
    // c1 right, c2 too strong by two levels, c3 without AU2 but with 12, c4 right
    const fs::path sheet =
        written(folder / "sheet.tsv",
                "clip\tcodes\tnote\r\nc1\t12D\t\r\nc2\tR12E\t\r\nc3\t1+12A\tx\r\nc4\t\t\r\n");
    const Agreement agreement = code_agreement(sheet, key);
    EXPECT_EQ(agreement.clips, 4);
    // Shown 4, coded 4, agreed 12, 12, 1
    EXPECT_DOUBLE_EQ(agreement.index, 2.0 * 3 / 8);
    ASSERT_EQ(agreement.units.size(), 3u);
    const UnitAgreement& twelve = agreement.units[2];
    EXPECT_EQ(twelve.unit, 12);
    EXPECT_EQ(twelve.shown, 2);
    EXPECT_EQ(twelve.seen, 2);
    EXPECT_EQ(twelve.falsely_seen, 1);
    // Agreed 3 of 4; by chance (2 x 3 + 2 x 1) / 16 = .5
    EXPECT_DOUBLE_EQ(twelve.kappa, (0.75 - 0.5) / 0.5);
    EXPECT_EQ(twelve.levels, 2);
    EXPECT_EQ(twelve.levels_within_1, 1);
    EXPECT_DOUBLE_EQ(agreement.units[0].kappa, 1);
    EXPECT_DOUBLE_EQ(agreement.units[1].kappa, 0) << "shown once, never coded";

    EXPECT_EQ(message_of([&] {
                  code_agreement(written(folder / "short.tsv", "clip\tcodes\nc1\t12\n"), key);
              }),
              (folder / "short.tsv").string() +
                  ": expected a row for each clip of the key, found none for c2");
    EXPECT_EQ(message_of([&] {
                  code_agreement(written(folder / "comma.tsv", "clip,codes\nc1,12\n"), key);
              }),
              (folder / "comma.tsv").string() +
                  ":1: expected the columns clip and codes, separated by tabs, found "
                  "\"clip,codes\"");
}

TEST(CoderKit, IsWrittenWithAPageThatShowsWhatToLookFor) {
    const TemporaryFolder temporary;
    const fs::path folder = temporary.path() / "units";
    read_units(
        {.rig = kSource / "rigs/adult/rig.json", .out = folder, .only = {"AU12"}, .kit = true});
    const std::string page = text_of(folder / "index.html");
    for (const char* part : {"The corners of the mouth go up and back", "pictures/AU12_moved.png",
                             "value=\"wrong\"", "coder.js", "data-unit=\"AU12\""})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_TRUE(fs::exists(folder / "contact_sheet.png"));
    const std::string key = text_of(folder / "key.tsv");
    EXPECT_NE(key.find("\t12E\n"), std::string::npos);
    EXPECT_EQ(text_of(folder / "kit/sheet.tsv").find("12"), std::string::npos)
        << "the sheet does not give it away";
    // The sheet as it is says that no face does anything.
    const Agreement none = code_agreement(folder / "kit/sheet.tsv", folder / "key.tsv");
    EXPECT_EQ(none.clips, 6);
    EXPECT_EQ(none.units.at(0).shown, 2);
    EXPECT_EQ(none.index, 0);
    EXPECT_EQ(media::VideoReader(folder / "kit/clips/clip_001.mp4").frames(), 60);
    // What is written again replaces what was written.
    read_units({.rig = kSource / "rigs/adult/rig.json",
                .out = folder,
                .only = {"AU12"},
                .pictures = false});
    EXPECT_FALSE(fs::exists(folder / "key.tsv"));
}

}  // namespace
}  // namespace risorius::inverse
