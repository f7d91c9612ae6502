// SPDX-License-Identifier: MIT
// The page about a machine.
#include "tools/bench/machine_page.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "temporary_folder.h"

namespace risorius::bench {
namespace {

constexpr const char* kHeader =
    "date,version,benchmark,head,case,nodes,cores,quantity,value,unit\n";

Json picture(int width_px, int height_px, bool draft, double fps) {
    return {{"width_px", width_px}, {"height_px", height_px}, {"draft", draft},
            {"fps", fps},           {"simulate_ms", 10.0},    {"draw_ms", 75.0},
            {"read_back_ms", 5.0},  {"measure_ms", 5.0},      {"encode_ms", 5.0}};
}

Json report() {
    Json rig = {{"name", "Adult"},
                {"preview", {{"step_ms", 5.84}, {"build_s", 0.61}}},
                {"video", {{"step_ms", 11.2}}},
                {"fine", {{"step_ms", 22.5}}},
                {"blend_shapes", {{"frame_ms", 0.71}}},
                {"pictures",
                 {picture(512, 512, false, 36), picture(1024, 1024, false, 19),
                  picture(1920, 1080, false, 16), picture(512, 512, true, 76),
                  picture(1024, 1024, true, 38), picture(1920, 1080, true, 27)}}};
    return {{"machine", {{"cpu", "A processor"}, {"cores", 2}}}, {"rigs", {rig}}};
}

TEST(MachinePage, ComparesAndTellsWhatToChange) {
    const KnownMachine known{"quick-one",
                             {{.label = "",
                               .head = "Adult",
                               .what = "preview",
                               .quantity = "step",
                               .unit = "ms",
                               .cores = 1,
                               .value = 2.04}}};
    EXPECT_EQ(machine_page(report(), {known, {"of-other-heads", {}}}),
              R"(A processor, 2 cores, with the head "Adult"

                                           this machine  quick-one
a step of 1/60 s, preview, one core              5.8 ms        2.0
a step of 1/60 s, video, one core                 11 ms          -
a step of 1/60 s, fine, one core                  22 ms          -
a frame of 52 blend shapes, one core             0.7 ms          -
building the face                                 0.6 s          -
a video of 512 x 512, all cores                  36 1/s          -
a video of 1024 x 1024, all cores                19 1/s          -
a video of 1920 x 1080, all cores                16 1/s          -
a video of 512 x 512 draft, all cores            76 1/s          -
a video of 1024 x 1024 draft, all cores          38 1/s          -
a video of 1920 x 1080 draft, all cores          27 1/s          -

A video of 30 frames per second, as fast as it plays:
  512 x 512   yes
  1024 x 1024 no, 19 frames per second; yes with --draft; yes with --size 512x512
  1920 x 1080 no, 16 frames per second; yes with --size 512x512
  Of a frame of 1024 x 1024, drawing takes 80 % of the processor time. A graphics processor takes it over with --gl egl.

A face that is moved live needs a step of 1/60 s in less than 16.7 ms:
  preview     yes, 5.8 ms
  video       yes, 11 ms
  fine        no, 22 ms

Sets of clips: --workers 2, one for each core. A cluster shares them out with --engine slurm.
)");
}

TEST(MachinePage, IsEmptyWhenOnlyAPartWasMeasured) {
    EXPECT_EQ(
        machine_page({{"machine", {{"cpu", "A"}, {"cores", 1}}}, {"rigs", Json::array()}}, {}), "");
    EXPECT_EQ(machine_page({{"machine", {{"cpu", "A"}, {"cores", 1}}},
                            {"rigs", {{{"name", "Adult"}, {"steps", Json::array()}}}}},
                           {}),
              "");
}

TEST(MachinePage, ReadsBackTheFileThatItWrites) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "mine.csv") << benchmark_file(report(), "2026-11");
    const std::vector<KnownMachine> known = read_known_machines(folder.path());
    ASSERT_EQ(known.size(), 1U);
    EXPECT_EQ(known[0].name, "mine");
    const std::vector<PageRow> rows = page_rows(report());
    ASSERT_EQ(known[0].rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(known[0].rows[i].what, rows[i].what);
        EXPECT_EQ(known[0].rows[i].cores, rows[i].cores);
        EXPECT_NEAR(known[0].rows[i].value, rows[i].value, 0.5);
    }
    EXPECT_TRUE(read_known_machines(folder.path() / "none").empty());
}

TEST(MachinePage, KnowsTheMachinesOfTheManual) {
    const std::vector<KnownMachine> known = read_known_machines(
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "docs/performance/benchmarks");
    ASSERT_GE(known.size(), 3U);
    std::size_t rows = 0;
    for (const KnownMachine& machine : known) rows += machine.rows.size();
    EXPECT_GE(rows, 14U);
}

TEST(MachinePage, NamesTheLineOfAWrongFile) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "mine.csv";
    const auto says = [&](const std::string& text) {
        std::ofstream(file) << text;
        return message_of([&] { read_known_machines(folder.path()); });
    };
    EXPECT_EQ(says("a,b\n"),
              file.string() +
                  ":1: expected the columns "
                  "date,version,benchmark,head,case,nodes,cores,quantity,value,unit, "
                  "found \"a,b\"");
    EXPECT_EQ(says(kHeader + std::string("2026-11,0.1.0,page,Adult\n")),
              file.string() + ":2: expected 10 columns, found 4");
    EXPECT_EQ(says(kHeader + std::string("2026-11,0.1.0,page,Adult,preview,,1,step,fast,ms\n")),
              file.string() + ":2: expected a number in the column value, found \"fast\"");
}

}  // namespace
}  // namespace risorius::bench
