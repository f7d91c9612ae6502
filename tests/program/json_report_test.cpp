// SPDX-License-Identifier: MIT
// What --json prints when a run does not succeed, and numbers on the command line that are none.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paths.h"
#include "risorius/core/json_text.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

class JsonReport : public testing::Test {
  protected:
    /// Standard output alone
    ShellResult run_here(const std::string& arguments) const {
        return run_shell("cd '" + folder_.path().string() + "' && '" +
                         (std::filesystem::path(RISORIUS_BINARY_DIR) / "risorius").string() + "' " +
                         arguments + " 2>said");
    }
    std::string said() const { return bytes_of(folder_ / "said"); }
    TemporaryFolder folder_;
};

const std::string kScript = std::string("'") + RISORIUS_SOURCE_DIR + "/samples/smile/script.json'";
const std::string kRig = std::string("'") + RISORIUS_SOURCE_DIR + "/rigs/adult/rig.json'";

TEST_F(JsonReport, APathThatTheSystemDoesNotTakeIsWrongInput) {
    std::filesystem::create_symlink("loop", folder_ / "loop");
    for (const std::string& name :
         {std::string(300, 'x'), std::string(5000, 'x'), std::string("loop/x")})
        for (const std::string& arguments : {"render " + kScript + " --still 0 -o " + name + ".png",
                                             "figure 8a -o f --from " + name, "check " + name}) {
            EXPECT_EQ(run_here(arguments).code, 2) << arguments << said();
            EXPECT_NE(said().find(": expected "), std::string::npos) << said();
        }
}

TEST_F(JsonReport, WrongInputIsJsonForEveryCommand) {
    for (const std::string arguments : {"render no.json -o x.mp4",
                                        "speak --labels no.ctm -o x.TextGrid",
                                        "align no.wav --text a -o x.TextGrid",
                                        "compare no.json no.json -o x.mp4",
                                        "sheet no.json --times 0 -o x.png",
                                        "fit no.obj --landmarks no.json -o x.json",
                                        "head --identity no.json -o x",
                                        "check no.json",
                                        "info no.json",
                                        "evaluate no.json --facs",
                                        "shapes no.json -o x",
                                        "solve no.json --mesh no.obj -o x",
                                        "import no.csv -o x.json",
                                        "export no.json -o x",
                                        "batch no.json -o x",
                                        "batch no.json --plan",
                                        "reverse no.tsv no.tsv -o x",
                                        "view no.json --no-browser",
                                        "bench --rig no.json",
                                        "figure no.json -o x",
                                        "render",
                                        "no_such_command",
                                        "info no.json --no-such-option"}) {
        const ShellResult result = run_here(arguments + " --json");
        EXPECT_EQ(result.code, 2) << arguments;
        const Json report = json_or_null(result.output);
        ASSERT_FALSE(report.is_null()) << arguments << "\n" << result.output;
        const bool is_check = report.is_array();
        const Json& told = is_check ? report.at(0) : report;
        EXPECT_EQ("risorius: " + told.at("error").get<std::string>() + "\n", said()) << arguments;
        if (!is_check) {
            EXPECT_EQ(told.at("format"), "risorius-error");
            EXPECT_EQ(told.at("exit_code"), 2);
        }
        EXPECT_EQ(folder_.listing(), std::set<std::string>{"said"}) << arguments;
    }
}

TEST_F(JsonReport, PlansAndListsAreJsonToo) {
    const std::string samples = std::string("'") + RISORIUS_SOURCE_DIR + "/samples/";
    for (const std::string& arguments :
         {"study " + samples + "study/study.json' --plan",
          "batch " + samples + "experiments/design.json' --plan",
          "batch " + samples + "experiments/design.json' --list", std::string("figure --list")}) {
        const ShellResult result = run_here(arguments + " --json");
        EXPECT_EQ(result.code, 0) << arguments << said();
        EXPECT_FALSE(json_or_null(result.output).is_null()) << arguments << "\n" << result.output;
    }
    const Json study =
        json_or_null(run_here("study " + samples + "study/study.json' --plan --json").output);
    EXPECT_EQ(study.value("poses", 0), 2);
    EXPECT_EQ(study.at("parameters").size(), 8u);
}

TEST_F(JsonReport, NothingIsPrintedThereWithoutTheOption) {
    EXPECT_EQ(run_here("info no.json").output, "");
}

TEST_F(JsonReport, LongMessagesAreCut) {
    std::ofstream(folder_ / "a.json") << R"({"format": ")" << std::string(200000, 'x') << "\"}";
    std::ofstream(folder_ / "b.obj")
        << "v 0 0 0\nusemtl " << std::string(200000, 'y') << "\nf 1 2 3\n";
    EXPECT_EQ(run_here("check a.json").code, 2);
    EXPECT_LT(said().size(), 8100u);
    EXPECT_EQ(run_here("info b.obj --json").code, 2);
    EXPECT_LT(said().size(), 8100u);
}

TEST_F(JsonReport, OptionsThatAreNoNumbersAreRefusedAtOnce) {
    for (const std::string number : {"nan", "inf", "-inf", "1e999", "''"})
        for (const std::string& option : std::vector<std::string>{
                 "shapes " + kRig + " -o x --corrective-megabytes ",
                 "shapes " + kRig + " -o x --corrective-tolerance-mm ",
                 "shapes " + kRig + " -o x --pairs ", "head -o x --age ", "head -o x --cast ",
                 "speak a -o x.json --gestures ", "evaluate " + kRig + " --facs --seed ",
                 "sheet s.json -o x.png --times "}) {
            const ShellResult result = run_here(option + number + " --json");
            EXPECT_EQ(result.code, 2) << option << number << said();
            EXPECT_NE(said().find(": expected a"), std::string::npos) << option << said();
            EXPECT_EQ(folder_.listing(), std::set<std::string>{"said"}) << option << number;
        }
    EXPECT_EQ(run_here("shapes " + kRig + " -o x --corrective-megabytes 1e300").code, 2);
    EXPECT_EQ(said(),
              "risorius: shapes --corrective-megabytes: expected a number in [0, 2000], found "
              "1e300\n");
    EXPECT_EQ(run_here("head --cast 0 -o x").code, 2);
    EXPECT_EQ(said(), "risorius: head --cast: expected a number in [2, 200], found 0\n");
}

}  // namespace
}  // namespace risorius
