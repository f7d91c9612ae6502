// SPDX-License-Identifier: MIT
// A process that makes clip after clip uses no more memory than after the first fifty.
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/stimuli/batch.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

constexpr int kClips = 120;  // RISORIUS_SOAK_CLIPS sets another number; a full run has 1000
constexpr int kSettled = 50;
constexpr double kMegabyte_B = 1e6;

int clips_to_make() {
    const char* given = std::getenv("RISORIUS_SOAK_CLIPS");
    return given ? std::max(2 * kSettled, std::atoi(given)) : kClips;
}

/// Memory in MB: pages that the process holds, and bytes that the program has allocated and not freed.
struct Memory {
    double resident_MB, allocated_MB;
};

Memory memory() {
    long all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    const auto heap = ::mallinfo2();
    return {
        static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMegabyte_B,
        static_cast<double>(heap.uordblks + heap.hblkhd) / kMegabyte_B};
}

TEST(Soak, MemoryStaysFlatFromTheFiftiethClipOn) {
    const TemporaryFolder folder;
    const int count = clips_to_make();
    Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "Soak",
        "clips": {"quality": "preview", "ending": "mp4"},
        "sets": [{"name": "smiles", "clip": "smile_${step}",
            "parameters": {"intensity": "= step / 10000"},
            "script": {"format": "risorius-script", "version": 1, "fps": 10, "duration_s": 0.3,
                "events": [{"expression": "happiness", "intensity": "${intensity}",
                            "start_s": 0.05, "onset_s": 0.1, "hold_s": 0.1, "offset_s": 0.1}],
                "view": {"width_px": 48, "height_px": 64, "antialiasing": 1}}}]})");
    json["sets"][0]["script"]["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
    json["sets"][0]["factors"]["step"] = {{"from", 1}, {"to", count}, {"steps", count}};
    std::ofstream(folder / "design.json") << json.dump();

    std::vector<Memory> after;
    const BatchReport report =
        make_batch({.design = folder / "design.json",
                    .out = folder / "set",
                    .workers = 1,
                    .report_clip = [&](const std::string& clip, const std::string& state,
                                       const std::string& why) {
                        EXPECT_EQ(state, "made") << clip << ": " << why;
                        after.push_back(memory());
                    }});
    EXPECT_EQ(report.made, count);
    ASSERT_EQ(after.size(), static_cast<std::size_t>(count));

    // The greatest need of clips 51 on is compared in two halves, because one clip needs a little more than another.
    const auto greatest = [&](int from, int to, double Memory::*what) {
        double most = 0;
        for (int i = from; i < to; ++i)
            most = std::max(most, after[static_cast<std::size_t>(i)].*what);
        return most;
    };
    const int middle = (kSettled + count) / 2;
    for (const auto& [what, name] : {std::pair{&Memory::resident_MB, "resident"},
                                     std::pair{&Memory::allocated_MB, "allocated"}}) {
        const double early = greatest(kSettled, middle, what), late = greatest(middle, count, what);
        std::printf("%s memory, MB: clip 1 %.1f, clip 50 %.1f, clips 51 to %d %.1f, to %d %.1f\n",
                    name, after.front().*what, after[kSettled - 1].*what, middle, early, count,
                    late);
        // 0.01 MB a clip: a bitmap or a mesh that is kept would show.
        EXPECT_LE(late, early + 1 + 0.01 * (count - middle)) << name;
    }
}

}  // namespace
}  // namespace risorius::stimuli
