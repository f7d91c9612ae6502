// SPDX-License-Identifier: MIT
// A render job is complete: its script and rig are read when it is planned, once.
#include "risorius/animate/render_job.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "message_of.h"
#include "paths.h"
#include "risorius/animate/animate.h"
#include "risorius/animate/run_render_job.h"
#include "temporary_folder.h"

namespace risorius::animate {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RISORIUS_SOURCE_DIR;

Json short_script(const fs::path& rig) {
    return {{"format", "risorius-script"},
            {"version", 1},
            {"rig", rig.string()},
            {"fps", 10},
            {"duration_s", 0.2},
            {"view", {{"width_px", 32}, {"height_px", 32}, {"antialiasing", 1}}},
            {"events", Json::array({{{"expression", "happiness"},
                                     {"start_s", 0},
                                     {"onset_s", 0.1},
                                     {"hold_s", 0.1},
                                     {"offset_s", 0.1}}})}};
}

/// A named pipe that gives its text to the first reader, and to every later one something that is no script.
class OncePipe {
  public:
    OncePipe(const fs::path& file, std::string text) : file_(file), text_(std::move(text)) {
        EXPECT_EQ(::mkfifo(file.c_str(), 0600), 0);
        writer_ = std::thread([this] { write(); });
    }
    ~OncePipe() {
        stop_ = true;
        writer_.join();
    }
    int readers() const { return readers_; }

  private:
    void write() {
        while (!stop_) {
            // Opens only while somebody reads
            const int pipe = ::open(file_.c_str(), O_WRONLY | O_NONBLOCK);
            if (pipe >= 0) {
                const std::string& text = readers_++ == 0 ? text_ : nothing_;
                EXPECT_EQ(::write(pipe, text.data(), text.size()),
                          static_cast<ssize_t>(text.size()));
                ::close(pipe);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    fs::path file_;
    std::string text_, nothing_ = "read twice";
    std::atomic<int> readers_{0};
    std::atomic<bool> stop_{false};
    std::thread writer_;
};

/// Counts how often a file is opened.
class OpenCounter {
  public:
    explicit OpenCounter(const fs::path& file) : events_(::inotify_init1(IN_NONBLOCK)) {
        // With the closing events, as equal events in a row would be counted as one
        EXPECT_GE(::inotify_add_watch(events_, file.c_str(), IN_OPEN | IN_CLOSE), 0);
    }
    ~OpenCounter() { ::close(events_); }
    int count() {
        std::array<char, 4096> buffer{};
        for (ssize_t size; (size = ::read(events_, buffer.data(), buffer.size())) > 0;)
            for (ssize_t at = 0; at < size;) {
                inotify_event event{};
                std::memcpy(&event, buffer.data() + at, sizeof event);
                if (event.mask & IN_OPEN) ++count_;
                at += static_cast<ssize_t>(sizeof event + event.len);
            }
        return count_;
    }

  private:
    int events_, count_ = 0;
};

/// The adult rig with a file and tables of its own, which no other test reads: everything else is linked.
fs::path own_rig(const fs::path& folder) {
    fs::create_directories(folder / "rigs/adult");
    fs::create_directory_symlink(kRoot / "models", folder / "models");
    for (const auto& entry : fs::directory_iterator(kRoot / "rigs"))
        if (entry.path().filename() != "adult" && entry.path().filename() != "standard")
            fs::create_symlink(entry.path(), folder / "rigs" / entry.path().filename());
    fs::copy(kRoot / "rigs/standard", folder / "rigs/standard", fs::copy_options::recursive);
    for (const auto& entry : fs::directory_iterator(kRoot / "rigs/adult"))
        if (entry.path().filename() != "rig.json")
            fs::create_symlink(entry.path(), folder / "rigs/adult" / entry.path().filename());
    fs::copy_file(kRoot / "rigs/adult/rig.json", folder / "rigs/adult/rig.json");
    return folder / "rigs/adult/rig.json";
}

TEST(RenderJob, ReadsAScriptOnceSoThatItMayComeThroughAPipe) {
    const TemporaryFolder folder;
    RenderRequest request;
    request.script = folder.path() / "script.json";
    request.out = folder.path() / "smile.mkv";
    request.quality = "preview";
    OncePipe pipe(request.script, short_script(kRoot / "rigs/adult/rig.json").dump());
    const RunRecord record = animate(request);
    EXPECT_EQ(record.frames, 2);
    EXPECT_NEAR(record.json().at("step_s").get<double>(), 1 / 60.0, 1e-12);
    EXPECT_EQ(record.script.sha256,
              sha256_of_text(short_script(kRoot / "rigs/adult/rig.json").dump()));
    EXPECT_EQ(pipe.readers(), 1);
}

TEST(RenderJob, ReadsScriptAndRigOnceForAllJobsAndNeverInTheRun) {
    const TemporaryFolder folder;
    const fs::path rig = own_rig(folder.path());
    RenderRequest request;
    request.script = folder.path() / "script.json";
    std::ofstream(request.script) << short_script(rig).dump();
    request.out = folder.path() / "smile.mkv";
    request.quality = "preview";
    OpenCounter scripts(request.script), rigs(rig),
        tables(folder.path() / "rigs/standard/muscle_bands.json");
    RenderInputs inputs;
    const RenderJob job = plan_render_job(request, inputs);
    request.fps = 5;
    const RenderJob second = plan_render_job(request, inputs);
    EXPECT_EQ(scripts.count(), 1);
    EXPECT_EQ(rigs.count(), 1);
    EXPECT_EQ(tables.count(), 1);
    EXPECT_EQ(job.rig, second.rig);

    // The job is complete: its run needs neither the request nor the files
    fs::remove(request.script);
    fs::remove(rig);
    RenderSession session;
    int frames = 0;
    const RenderResult result = run_render_job(job, session, [&](const Image&) { ++frames; }, {});
    EXPECT_EQ(frames, 2);
    run_render_job(second, session, [&](const Image&) { ++frames; }, {});
    EXPECT_EQ(frames, 3);
}

// A file that is read twice can change in between. Then the record would have the checksum of something else.
TEST(RenderJob, HasTheChecksumsOfTheBytesThatItReads) {
    const TemporaryFolder folder;
    const fs::path rig = own_rig(folder.path()), emg = folder / "emg.tsv";
    const std::string of_rig = bytes_of(rig);
    std::string of_emg = "level\n";
    for (int i = 0; i < 2000; ++i) of_emg += std::to_string(i % 7) + "\n";
    fs::remove(rig);
    OncePipe rigs(rig, of_rig), recordings(emg, of_emg);
    RenderRequest request;
    request.script = folder / "script.json";
    Json script = short_script(rig);
    script["emg"] = {
        {"file", "emg.tsv"}, {"rate_hz", 1000}, {"channels", {{"zygomaticus_major", "level"}}}};
    std::ofstream(request.script) << script.dump();
    request.out = folder / "smile.mkv";
    const RenderJob job = plan_render_job(request);
    EXPECT_EQ(job.rig->rig.sha256, sha256_of_text(of_rig));
    EXPECT_EQ(rigs.readers(), 1);
    ASSERT_EQ(job.recordings.size(), 1U);
    EXPECT_EQ(job.recordings[0].sha256, sha256_of_text(of_emg));
    EXPECT_EQ(recordings.readers(), 1);
}

TEST(RenderJob, TakesAScriptFromMemoryAndNamesItInMessages) {
    RenderRequest request;
    request.script = "a design, clip one";
    Json script = short_script(kRoot / "rigs/adult/rig.json");
    request.script_in_memory = JsonCursor::from_json(script, request.script.string());
    request.out = "smile.mkv";
    const RenderJob job = plan_render_job(request);
    EXPECT_EQ(job.frames, 2);
    EXPECT_EQ(job.script.expressions.size(), 1u);
    script["events"][0]["expression"] = "hapiness";
    request.script_in_memory = JsonCursor::from_json(script, request.script.string());
    EXPECT_EQ(
        message_of([&] { plan_render_job(request); }).rfind("a design, clip one:/events/0", 0), 0u);
}

// A draft takes steps that are twice as long.
/// Frames hold no sound. A script that speaks gives them all the same, and the record says where the sound is.
TEST(RenderJob, OfAScriptThatSpeaksMayBeAFolderOfFrames) {
    RenderRequest request;
    request.script = kRoot / "samples/talk/english.json";
    request.out = "frames/";
    const RenderJob job = plan_render_job(request);
    EXPECT_EQ(job.video.sound, nullptr);
    ASSERT_EQ(job.warnings.size(), 1u);
    EXPECT_EQ(job.warnings[0].substr(0, job.warnings[0].find(" is in ")),
              "a folder of frames has no sound; what is said");
    EXPECT_EQ(fs::path(job.warnings[0]).filename(), "english.wav");
    request.out = "talk.mp4";
    const RenderJob video = plan_render_job(request);
    EXPECT_NE(video.video.sound, nullptr);
    EXPECT_TRUE(video.warnings.empty());
}

TEST(RenderJob, SetsTheLightForTheSkinOrForACard) {
    const auto meter_of = [](const Json& light) {
        RenderRequest request;
        request.script = "a design, clip one";
        Json script = short_script(kRoot / "rigs/adult/rig.json");
        script["view"]["light"] = light;
        request.script_in_memory = JsonCursor::from_json(script, request.script.string());
        request.out = "smile.mkv";
        return plan_render_job(request).view.light.meter;
    };
    EXPECT_EQ(meter_of("portrait"), render::Meter::kSkin);
    EXPECT_EQ(meter_of({{"turn_deg", 10}}), render::Meter::kSkin);
    EXPECT_EQ(meter_of({{"meter", "card"}}), render::Meter::kCard);
    EXPECT_EQ(message_of([&] {
                  meter_of({{"meter", "face"}});
              }),
              "a design, clip one:/view/light/meter: expected one of \"skin\" \"card\", found "
              "\"face\"");
}

TEST(RenderJob, LeavesTheHairOutWhereItIsAskedTo) {
    const TemporaryFolder folder;
    const fs::path rig = own_rig(folder.path());
    const auto frames_of = [&](const char* style, const Json& view_hair,
                               const std::optional<std::string>& asked) {
        Json json = Json::parse(std::ifstream(rig));
        json["appearance"]["hair_style"] = style;
        std::ofstream(rig) << json.dump();
        Json script = short_script(rig);
        if (!view_hair.is_null()) script["view"]["hair"] = view_hair;
        RenderRequest request;
        request.script = folder.path() / "script.json";
        std::ofstream(request.script) << script.dump();
        request.out = folder.path() / "smile.mkv";
        request.quality = "draft";
        request.hair = asked;
        const RunRecord record = animate(request);
        EXPECT_NEAR(record.json().at("step_s").get<double>(), 1 / 30.0, 1e-12);  // of a draft
        return record.frames_sha256;
    };
    const std::string bare = frames_of("shaven", nullptr, {});
    const std::string bob = frames_of("bob", nullptr, {});
    EXPECT_NE(bob, bare);
    EXPECT_EQ(frames_of("bob", "none", {}), bare);
    EXPECT_EQ(frames_of("bob", nullptr, "none"), bare);
    EXPECT_EQ(frames_of("bob", "none", "own"), bob);
    EXPECT_EQ(message_of([&] { frames_of("bob", nullptr, "wig"); }),
              "hair: expected one of \"none\", \"own\", found \"wig\"");
}

}  // namespace
}  // namespace risorius::animate
