// SPDX-License-Identifier: MIT
// A stimulus set made by a job array of a real Slurm that the test starts on the loopback, and runs without Slurm.
#include "risorius/stimuli/slurm.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/report/run_program.h"
#include "temporary_folder.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;
using report::run_program;

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A design of two clips, in a file whose name a shell would not take for one word.
fs::path design_in(const fs::path& folder) {
    Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "Two",
        "clips": {"quality": "preview", "ending": "mkv"},
        "match": {"luminance": {"mean": 0.28}},
        "sets": [{"name": "two", "clip": "${expression}",
            "factors": {"expression": ["happiness", "fear"]},
            "script": {"format": "risorius-script", "version": 1, "fps": 10, "duration_s": 0.3,
                "events": [{"expression": "${expression}", "start_s": 0.0, "onset_s": 0.2}],
                "view": {"width_px": 48, "height_px": 64, "antialiasing": 1}}}]})");
    json["sets"][0]["script"]["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
    const fs::path file = folder / "it's a design.json";
    std::ofstream(file) << json.dump();
    return file;
}

class Slurm : public testing::Test {
  protected:
    void SetUp() override {
        if (run_program({"slurmctld", "-V"}).exit_code == 127 ||
            run_program({"munged", "--version"}).exit_code == 127)
            GTEST_SKIP() << "no slurm-wlm and munge here";
        if (geteuid() != 0) GTEST_SKIP() << "starting a Slurm takes root";
        const std::string port = std::to_string(20000 + 2 * (getpid() % 10000));
        const report::ProgramResult up = run_program({cluster(), "start", folder().string(), port});
        ASSERT_EQ(up.exit_code, 0) << up.output;
        setenv("SLURM_CONF", (folder() / "slurm.conf").c_str(), 1);
    }
    void TearDown() override { run_program({cluster(), "stop", folder().string()}); }

    static std::string cluster() { return RISORIUS_SOURCE_DIR "/tests/data/slurm/cluster.sh"; }
    const fs::path& folder() const { return folder_.path(); }
    fs::path design() const { return design_in(folder()); }

  private:
    TemporaryFolder folder_;
};

TEST_F(Slurm, MakesTheSameBytesAsThisMachineAndTriesAgain) {
    stimuli::BatchOptions here;
    here.design = design();
    here.out = folder() / "here";
    here.workers = 1;
    stimuli::BatchOptions there = here;
    there.out = folder() / "there";
    ASSERT_TRUE(stimuli::make_batch(here).complete);

    // A program that fails the first time, whichever task comes first: a folder is made by one only
    const fs::path program = folder() / "risorius once";
    std::ofstream(program) << "#!/bin/sh\nif mkdir '" << (folder() / "failed").string()
                           << "' 2>/dev/null; then exit 1; fi\n"
                           << "exec '" RISORIUS_BINARY_DIR "/risorius' \"$@\"\n";
    fs::permissions(program, fs::perms::owner_all);
    stimuli::SlurmOptions slurm;
    slurm.part_command = [&](const fs::path& design, const fs::path& out, int workers,
                             const std::string& part) {
        return std::vector<std::string>{
            program,  "batch", design,  "--out", out, "--workers", std::to_string(workers),
            "--part", part,    "--json"};
    };
    slurm.tasks = 2;
    slurm.retries = 0;
    stimuli::BatchReport report = stimuli::make_batch_on_slurm(there, slurm);
    EXPECT_FALSE(report.complete);
    EXPECT_EQ(report.made, 0) << "pictures are matched when all conditions are rendered";
    EXPECT_EQ(report.unmeasured, 1);
    ASSERT_EQ(report.failed.size(), 1u);
    EXPECT_FALSE(fs::exists(there.out / "SHA256SUMS"));
    fs::remove(folder() / "failed");
    slurm.retries = 1;
    report = stimuli::make_batch_on_slurm(there, slurm);
    EXPECT_TRUE(report.complete);
    EXPECT_EQ(report.kept + report.made, 2);
    EXPECT_EQ(text_of(there.out / "SHA256SUMS"), text_of(here.out / "SHA256SUMS"));
    EXPECT_FALSE(fs::exists(there.out / "code/slurm.sh"));
}

/// Programs are looked for in one folder alone.
class WithoutSlurm : public testing::Test {
  protected:
    void SetUp() override {
        before_ = std::getenv("PATH");
        fs::create_directory(folder_ / "programs");
        setenv("PATH", (folder_ / "programs").c_str(), 1);
        batch_.design = design_in(folder_.path());
        batch_.out = folder_ / "results/there";
        slurm_.part_command = [](const auto&...) { return std::vector<std::string>{"true"}; };
    }
    void TearDown() override { setenv("PATH", before_.c_str(), 1); }
    void make_program(const std::string& name, const std::string& does) const {
        const fs::path program = folder_ / "programs" / name;
        std::ofstream(program) << "#!/bin/sh\n" << does << "\n";
        fs::permissions(program, fs::perms::owner_all);
    }

    TemporaryFolder folder_;
    stimuli::BatchOptions batch_;
    stimuli::SlurmOptions slurm_;

  private:
    std::string before_;
};

TEST_F(WithoutSlurm, ProgramsThatAreMissingAreAnErrorBeforeAnythingIsWritten) {
    try {
        stimuli::make_batch_on_slurm(batch_, slurm_);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(
            error.what(),
            "engine: expected the programs of Slurm with \"slurm\", found no program \"sbatch\"");
    }
    EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(WithoutSlurm, AJobThatIsRejectedLeavesNothing) {
    for (const char* name : {"squeue", "scancel"}) make_program(name, "exit 0");
    make_program("sbatch", "case \"$1\" in --version) exit 0;; esac\necho sbatch: no; exit 1");
    EXPECT_THROW(stimuli::make_batch_on_slurm(batch_, slurm_), RunError);
    EXPECT_FALSE(fs::exists(folder_ / "results"));
}

}  // namespace
}  // namespace risorius::scenario
