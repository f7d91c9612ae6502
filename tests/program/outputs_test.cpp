// SPDX-License-Identifier: MIT
// What the program leaves when it is stopped, when it cannot write, and when an output is something else already.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using Clock = std::chrono::steady_clock;

const std::string kProgram = RISORIUS_BINARY_DIR "/risorius";
const std::string kHello = RISORIUS_SOURCE_DIR "/samples/hello/script.json";

void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// A script of two frames.
std::string clip_in(const Folder& folder) {
    write(folder / "clip.json", R"({"format": "risorius-script", "version": 1, "fps": 20,
        "duration_s": 0.1, "rig": ")" RISORIUS_SOURCE_DIR R"(/rigs/adult/rig.json"})");
    return "render clip.json --draft --size 64x64 ";
}

/// A tenth of a second of sound: 16 bits, 8 kHz, one channel.
void write_tone(const fs::path& file) {
    const std::string samples(1600, '\x11');
    const auto number = [](std::uint32_t value, int bytes) {
        std::string out;
        for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255);
        return out;
    };
    write(file, "RIFF" + number(36 + 1600, 4) + "WAVEfmt " + number(16, 4) + number(1, 2) +
                    number(1, 2) + number(8000, 4) + number(16000, 4) + number(2, 2) +
                    number(16, 2) + "data" + number(1600, 4) + samples);
}

/// The program, started in the background with signals as a shell in the foreground would leave them.
pid_t start(const std::vector<std::string>& arguments, const Folder& folder,
            const char* report = "/dev/null") {
    const pid_t child = ::fork();
    if (child != 0) return child;
    for (const int signal : {SIGINT, SIGHUP, SIGTERM}) ::signal(signal, SIG_DFL);
    if (::chdir(folder.path().c_str()) != 0) ::_exit(9);
    if (!std::freopen(report, "w", stdout) || !std::freopen("errors", "w", stderr)) ::_exit(9);
    std::vector<char*> words{const_cast<char*>(kProgram.c_str())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execv(kProgram.c_str(), words.data());
    ::_exit(9);
}

int wait_for(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return exit_code(status);
}

/// Processor time of a running process until now, in seconds, to a hundredth.
double processor_s(pid_t process) {
    const std::string stat = bytes_of("/proc/" + std::to_string(process) + "/stat");
    std::istringstream fields(stat.substr(stat.rfind(')') + 2));  // the name may have spaces
    std::string skipped;
    for (int i = 3; i < 14; ++i) fields >> skipped;
    double user_ticks = 0, system_ticks = 0;
    fields >> user_ticks >> system_ticks;
    return (user_ticks + system_ticks) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

/// Processor time of a process that has ended.
double processor_s(const rusage& usage) {
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Waits until the program catches SIGTERM: on a busy machine it takes a while to get to main().
void wait_until_it_listens(pid_t child) {
    constexpr unsigned long kTerm = 1UL << (SIGTERM - 1);
    const std::string key = "SigCgt:";
    for (int i = 0; i < 3000; ++i) {
        const std::string status = bytes_of("/proc/" + std::to_string(child) + "/status");
        const std::size_t at = status.find(key);
        if (at != std::string::npos &&
            (std::stoul(status.substr(at + key.size()), nullptr, 16) & kTerm) != 0)
            return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

TEST(Outputs, AreNeverInputs) {
    const Folder folder;
    const std::string render = clip_in(folder);
    ASSERT_EQ(run(render + "--still 0 -o p.png", folder.path()).code, 0);
    const std::string before = bytes_of(folder / "p.png");
    const Outcome beside =
        run("sheet clip.json --draft --times 0 --beside p.png -o p.png", folder.path());
    EXPECT_EQ(beside.code, 2) << beside.errors;
    EXPECT_NE(beside.errors.find("p.png: expected an output that is not an input"),
              std::string::npos)
        << beside.errors;
    EXPECT_TRUE(bytes_of(folder / "p.png") == before);
    write_tone(folder / "tone.wav");
    ASSERT_EQ(run(render + "-o x.mkv --audio tone.wav", folder.path()).code, 0);
    const std::string video = bytes_of(folder / "x.mkv");
    EXPECT_EQ(run(render + "--audio x.mkv -o x.mkv", folder.path()).code, 2);
    EXPECT_TRUE(bytes_of(folder / "x.mkv") == video);
    for (const char* ending : {"", ".json", ".frames.tsv"})
        fs::remove(folder / (std::string("x.mkv") + ending));
    // A script under the name of a video, by another name
    fs::create_hard_link(folder / "clip.json", folder / "clip.mp4");
    const Outcome script = run(render + "-o clip.mp4", folder.path());
    EXPECT_EQ(script.code, 2) << script.errors;
    EXPECT_EQ(folder.listing(), (Names{"clip.json", "clip.mp4", "tone.wav", "p.png",
                                       "p.png.frames.tsv", "p.png.json"}));
}

TEST(Outputs, DoNotReplaceLinksAndPipes) {
    const Folder folder;
    const std::string render = clip_in(folder);
    write(folder / "mine", "mine");
    fs::create_symlink("mine", folder / "link.mp4");
    ASSERT_EQ(::mkfifo((folder / "pipe.mp4").c_str(), 0600), 0);
    for (const char* out : {"link.mp4", "pipe.mp4"}) {
        const Outcome done = run(render + "-o " + out, folder.path());
        EXPECT_EQ(done.code, 2) << done.errors;
        EXPECT_NE(done.errors.find("expected a regular file, or nothing yet, found a "),
                  std::string::npos)
            << done.errors;
    }
    EXPECT_EQ(bytes_of(folder / "mine"), "mine");
    EXPECT_TRUE(fs::is_fifo(folder / "pipe.mp4"));
}

TEST(Outputs, OfTwoRunsBelongToOne) {
    const Folder folder;
    const pid_t first = start({"render", kHello, "--draft", "-o", "x.mp4"}, folder);
    for (int i = 0; i < 1000 && !fs::exists(folder / "x.mp4"); ++i) {
        bool begun = false;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            begun |= entry.path().filename().string().starts_with(".risorius-");
        if (begun) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Outcome second = run(clip_in(folder) + "-o x.mp4", folder.path());
    EXPECT_EQ(second.code, 2) << second.errors;
    EXPECT_NE(second.errors.find("found process " + std::to_string(first) + " on "),
              std::string::npos)
        << second.errors;
    EXPECT_EQ(run(clip_in(folder) + "-o y.mp4", folder.path()).code, 0);
    ::kill(first, SIGTERM);
    EXPECT_EQ(wait_for(first), 130);
}

// Processor time, since other work on the machine must not decide: two seconds are one of both cores.
TEST(Outputs, AreGoneWithinASecondAfterAStop) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        for (const int after_ms : {300, 1500}) {
            const Folder folder;
            const pid_t child = start({"render", kHello, "--draft", "-o", "x/y.mp4"}, folder);
            wait_until_it_listens(child);
            std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
            const double until_stop_s = processor_s(child);
            ::kill(child, signal);
            int status = 0;
            rusage usage{};
            ::wait4(child, &status, 0, &usage);
            EXPECT_EQ(exit_code(status), 130) << signal << " after " << after_ms << " ms";
            EXPECT_LT(processor_s(usage) - until_stop_s, 2);
            EXPECT_EQ(folder.listing(), Names{"errors"});
            EXPECT_EQ(bytes_of(folder / "errors"), "risorius: interrupted, nothing was written\n");
        }
}

// On a busy machine the libraries of the program take some tenths of a second until main() begins.
TEST(Outputs, AStopBeforeTheRunBeginsEndsItToo) {
    for (const int after_ms : {0, 10, 20, 40, 80}) {
        const Folder folder;
        const pid_t child =
            start({"render", kHello, "--draft", "--json", "-o", "x/y.mp4"}, folder, "report");
        wait_until_it_listens(child);
        std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
        ::kill(child, SIGINT);
        EXPECT_EQ(wait_for(child), 130) << "after " << after_ms << " ms";
        EXPECT_EQ(folder.listing(), (Names{"errors", "report"}));
        EXPECT_EQ(bytes_of(folder / "errors"), "risorius: interrupted, nothing was written\n");
        EXPECT_NE(bytes_of(folder / "report").find("\"exit_code\":130"), std::string::npos)
            << bytes_of(folder / "report");
    }
}

/// The largest nice value of the threads of a process.
int lowest_priority(pid_t process) {
    int nice = 0;
    std::error_code ended;
    const fs::path tasks = "/proc/" + std::to_string(process) + "/task";
    for (auto task = fs::directory_iterator(tasks, ended);
         !ended && task != fs::directory_iterator(); task.increment(ended))
        nice = std::max(
            nice, ::getpriority(PRIO_PROCESS,
                                static_cast<id_t>(std::stoi(task->path().filename().string()))));
    return nice;
}

// The system keeps a process until each of its threads had a turn. On a busy machine that takes seconds for one of the lowest priority.
TEST(Outputs, WaitForNoThreadOfALowPriorityAfterAStop) {
    const Folder folder;
    const int usual = lowest_priority(::getpid());
    const pid_t child = start({"render", kHello, "--draft", "--still", "0", "-o", "x.png"}, folder);
    int lowest = usual, status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        lowest = std::max(lowest, lowest_priority(child));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(exit_code(status), 0);
    EXPECT_EQ(lowest, usual);
}

// An importer that never ends stands for one that reads a large mesh.
TEST(Outputs, AStopWhileAMeshIsImportedEndsTheImporterToo) {
    const Folder folder;
    const std::string importer = (folder / "importer").string();
    write(importer, "#!/bin/sh\necho $$ > '" + (folder / "pid").string() + "'\nexec sleep 300\n");
    fs::permissions(importer, fs::perms::owner_all);
    write(folder / "head.ply", "ply\n");
    std::string rig = bytes_of(RISORIUS_SOURCE_DIR "/rigs/adult/rig.json");
    const std::string mesh = "../../models/adult/head.obj", tables = "\"../standard/";
    rig.replace(rig.find(mesh), mesh.size(), "head.ply");
    for (std::size_t at; (at = rig.find(tables)) != std::string::npos;)
        rig.replace(at, tables.size(), "\"" RISORIUS_SOURCE_DIR "/rigs/standard/");
    write(folder / "rig.json", rig);
    clip_in(folder);
    const std::string landmarks = RISORIUS_SOURCE_DIR "/models/adult/landmarks.json";
    ::setenv("RISORIUS_IMPORT_MESH", importer.c_str(), 1);
    const std::set<std::string> before = folder.listing();
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"check", "rig.json"},
             {"info", "rig.json"},
             {"render", "clip.json", "--rig", "rig.json", "-o", "x.mp4"},
             {"shapes", "rig.json", "-o", "s"},
             {"fit", "head.ply", "--landmarks", landmarks, "-o", "new.json"}}) {
        SCOPED_TRACE(command[0]);
        const pid_t child = start(command, folder);
        for (int i = 0; i < 6000 && bytes_of(folder / "pid").empty(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ASSERT_FALSE(bytes_of(folder / "pid").empty()) << bytes_of(folder / "errors");
        const pid_t second = std::stoi(bytes_of(folder / "pid"));
        fs::remove(folder / "pid");
        const Clock::time_point begin = Clock::now();
        ::kill(child, SIGINT);
        EXPECT_EQ(wait_for(child), 130) << bytes_of(folder / "errors");
        // The importer would sleep for 300 s; a busy machine may take its time.
        EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), 60);
        EXPECT_EQ(::kill(second, 0), -1) << "the importer still runs";
        fs::remove(folder / "errors");
        EXPECT_EQ(folder.listing(), before);
    }
    ::unsetenv("RISORIUS_IMPORT_MESH");
}

// llvmpipe waits without end for a thread that it was refused.
TEST(Outputs, NeedNoMoreThreadsThanThereAre) {
    const Folder folder;
    const std::string render = clip_in(folder) + "--threads 4 --still 0 -o ";
    ASSERT_EQ(run(render + "whole.png", folder.path()).code, 0);
    for (const int refused_from : {1, 2, 3, 6, 11, 12, 13, 15, 16, 18, 24}) {
        const Outcome done =
            run(render + "x.png", folder.path(),
                "FAULT_THREAD_FROM=" + std::to_string(refused_from) +
                    " LD_PRELOAD=" RISORIUS_BINARY_DIR "/tests/librisorius_fault.so timeout 60");
        SCOPED_TRACE("from " + std::to_string(refused_from) + ": " + done.errors);
        if (done.code == 1) {
            EXPECT_NE(done.errors.find("the system refuses some of the 4 threads"),
                      std::string::npos);
            EXPECT_FALSE(fs::exists(folder / "x.png"));
            continue;
        }
        EXPECT_EQ(done.code, 0);
        EXPECT_TRUE(bytes_of(folder / "x.png") == bytes_of(folder / "whole.png"));
        fs::remove(folder / "x.png");
    }
}

TEST(Outputs, WaitForNoSignalThatTheParentIgnores) {
    const Folder folder;
    const Outcome ignored =
        run(clip_in(folder) + "-o x.mp4 & p=$!; sleep 0.3; kill -INT $p; wait $p", folder.path());
    EXPECT_EQ(ignored.code, 0);  // a shell lets its background ignore INT
}

TEST(Outputs, AReportThatCannotBePrintedIsAnError) {
    const Folder folder;
    const std::string render = clip_in(folder);
    for (const char* to : {"> /dev/full", "| true"}) {
        const std::string command = "bash -c 'cd " + folder.path().string() + " && { " + kProgram +
                                    " " + render + "--json -o x.mp4 2>errors; echo $? > code; } " +
                                    to + "'";
        EXPECT_EQ(exit_code(std::system(command.c_str())), 0);
        EXPECT_EQ(bytes_of(folder / "code"), "1\n") << to;
        EXPECT_EQ(bytes_of(folder / "errors"),
                  "risorius: standard output: the report cannot be written\n");
        EXPECT_TRUE(fs::exists(folder / "x.mp4"));
    }
}

// `batch --json | head` once died in the middle of the set.
TEST(Outputs, ASetIsMadeThoughNobodyReadsItsReport) {
    const Folder folder;
    write(folder / "design.json", R"({"format": "risorius-design", "version": 1, "name": "Two",
        "clips": {"quality": "draft"}, "sets": [{"name": "a", "clip": "c${k}", "factors": {"k": [1, 2]},
        "script": {"format": "risorius-script", "version": 1, "fps": 20, "duration_s": 0.1,
            "rig": ")" RISORIUS_SOURCE_DIR R"(/rigs/adult/rig.json",
            "view": {"width_px": 64, "height_px": 64, "antialiasing": 1}}}]})");
    const std::string command = "bash -c 'cd " + folder.path().string() + " && { " + kProgram +
                                " batch design.json -o set --json --workers 1 2>errors; echo $? > "
                                "code; } | true'";
    EXPECT_EQ(exit_code(std::system(command.c_str())), 0);
    EXPECT_EQ(bytes_of(folder / "code"), "1\n");
    EXPECT_EQ(bytes_of(folder / "errors"),
              "risorius: standard output: the report cannot be written\n");
    EXPECT_TRUE(fs::exists(folder / "set/SHA256SUMS"));
}

TEST(Outputs, ALimitOfTheSizeOfFilesIsAnError) {
    const Folder folder;
    const Outcome done = run(clip_in(folder) + "-o x.mp4", folder.path(), "ulimit -f 1; ");
    EXPECT_EQ(done.code, 1);
    EXPECT_NE(done.errors.find("x.mp4"), std::string::npos) << done.errors;
    EXPECT_EQ(folder.listing(), Names{"clip.json"});
}

TEST(Outputs, OfARunWithoutMemoryAreGone) {
    const Folder folder;
    const Outcome done = run(clip_in(folder) + "-o x.mp4", folder.path(), "ulimit -v 265000; ");
    EXPECT_EQ(done.code, 1);
    EXPECT_EQ(done.errors, "risorius: not enough memory\n");
    EXPECT_EQ(folder.listing(), Names{"clip.json"});
}

// llvmpipe and its compiler crash when they get none.
TEST(Outputs, WithLittleMemoryToDrawARunEndsByItself) {
    const Folder folder;
    const std::string render = clip_in(folder);
    bool refused = false;
    for (const int megabytes : {500, 550, 600, 700, 800, 900}) {
        const Outcome done = run(render + "-o x.mp4", folder.path(),
                                 "ulimit -v " + std::to_string(megabytes) + "000; ");
        SCOPED_TRACE(std::to_string(megabytes) + " MB: " + done.errors);
        if (done.code == 0) continue;
        EXPECT_EQ(done.code, 1);
        EXPECT_NE(done.errors.find("not enough memory"), std::string::npos);
        EXPECT_EQ(folder.listing(), Names{"clip.json"});
        refused |= done.errors.find("to draw: expected 640 MB more") != std::string::npos;
    }
    EXPECT_TRUE(refused);
}

TEST(Outputs, HaveARecordWhateverTheirName) {
    const Folder folder;
    const std::string name = "caf\xe9.mp4";
    EXPECT_EQ(run(clip_in(folder) + "-o '" + name + "'", folder.path()).code, 0);
    EXPECT_EQ(folder.listing(), (Names{name, name + ".frames.tsv", name + ".json", "clip.json"}));
    EXPECT_NE(bytes_of(folder / (name + ".json")).find("caf\xef\xbf\xbd.mp4"), std::string::npos);
}

}  // namespace
}  // namespace risorius::scenario
