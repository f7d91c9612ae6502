// SPDX-License-Identifier: MIT
// tools/setup.sh on machines made up of stand-ins: which packages it asks for, and what it says when they cannot be had.
#include <gtest/gtest.h>
#include <unistd.h>

#include "shell.h"
#include "structure/source_tree.h"

namespace risorius::structure {
namespace {

namespace fs = std::filesystem;

/// A search path with stand-ins for apt and friends, and the few real programs that the script uses.
class Machine {
  public:
    Machine() {
        static int count = 0;
        folder_ = fs::temp_directory_path() /
                  ("risorius setup " + std::to_string(::getpid()) + "-" + std::to_string(count++));
        fs::create_directories(folder_ / "bin");
        for (const char* name : {"bash", "dirname", "env", "mktemp", "rm", "tail", "cat", "grep"})
            for (const char* place : {"/usr/bin/", "/bin/"})
                if (fs::exists(std::string(place) + name) && !fs::exists(folder_ / "bin" / name))
                    fs::create_symlink(std::string(place) + name, folder_ / "bin" / name);
        std::ofstream(folder_ / "installed");
        std::ofstream(folder_ / "offered");
        std::ofstream(folder_ / "calls");
    }
    ~Machine() { fs::remove_all(folder_); }

    /// A program of the made-up machine; $state is its folder of notes.
    void has(const std::string& program, const std::string& script) const {
        const fs::path file = folder_ / "bin" / program;
        std::ofstream(file) << "#!/usr/bin/env bash\nstate='" << folder_.string() << "'\n"
                            << script << "\n";
        fs::permissions(file, fs::perms::owner_all);
    }

    /// apt that offers some packages, and others only after an update; installing notes them as installed.
    void has_apt() const {
        has("dpkg-query",
            "shift 2; code=0; for p in \"$@\"; do if grep -qx \"$p\" \"$state/installed\"; then "
            "echo \"$p installed\"; else code=1; fi; done; exit $code");
        has("apt-cache", "grep -qx \"$2\" \"$state/offered\"");
        has("apt-get",
            "echo \"apt-get $*\" >>\"$state/calls\"\n"
            "[[ ${DEBIAN_FRONTEND:-} == noninteractive ]] || exit 9\n"
            "case \"$*\" in\n"
            "*' update') if [[ -f $state/mirror ]]; then cat \"$state/mirror\" "
            ">>\"$state/offered\"; else "
            "echo 'E: no route to the mirror'; exit 100; fi ;;\n"
            "*' install '*) if [[ -f $state/broken ]]; then echo 'E: dpkg was interrupted'; exit "
            "100; fi\n"
            "for p in \"$@\"; do echo \"$p\" >>\"$state/installed\"; done ;;\n"
            "esac");
        has("id", "echo 0");
    }

    void note(const std::string& name, const std::vector<std::string>& lines) const {
        std::ofstream file(folder_ / name, std::ios::app);
        for (const std::string& line : lines) file << line << "\n";
    }

    std::string calls() const { return text_of(folder_ / "calls"); }

    /// What setup.sh says, and its exit code, from a folder that is not the project's.
    std::pair<std::string, int> setup(const std::string& arguments = "",
                                      const std::string& settings = "") const {
        const std::string bin = (folder_ / "bin").string();
        const std::string command =
            "cd / && RISORIUS_SKIP_SETUP=0 PATH='" + bin + "' " + settings + " '" + bin +
            "/bash' '" + (source_dir() / "tools/setup.sh").string() + "' " + arguments + " 2>&1";
        const ShellResult result = run_shell(command);
        return {result.output, result.code};
    }

  private:
    fs::path folder_;
};

/// The list as this test reads it, independent of the shell script.
std::vector<std::string> packages(bool test) {
    std::vector<std::string> names;
    bool wanted = true;
    for (std::string line : lines_of(text_of(source_dir() / "tools/packages.txt"))) {
        line = line.substr(0, line.find('#'));
        line = line.substr(0, line.find(' '));
        if (line.starts_with("["))
            wanted = line == "[build]" || (test && line == "[test]");
        else if (!line.empty() && wanted)
            names.push_back(line);
    }
    return names;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
    return text;
}

TEST(SetupScript, SaysNothingWhenNothingIsMissing) {
    const Machine machine;
    machine.has_apt();
    machine.note("installed", packages(true));
    for (const char* purpose : {"", "build", "test"}) {
        const auto [said, code] = machine.setup(purpose);
        EXPECT_EQ(said, "");
        EXPECT_EQ(code, 0);
    }
    EXPECT_EQ(machine.calls(), "");
}

TEST(SetupScript, InstallsOnlyWhatIsMissingWithoutFetchingTheListAgain) {
    const Machine machine;
    machine.has_apt();
    std::vector<std::string> installed = packages(false);
    std::erase(installed, "libassimp-dev");
    std::erase(installed, "cmake");
    machine.note("installed", installed);
    machine.note("offered", packages(true));
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 0);
    EXPECT_EQ(said,
              "setup: installing 2 Debian packages (a few minutes at most): cmake libassimp-dev\n");
    EXPECT_EQ(machine.calls().find("update"), std::string::npos);
    EXPECT_NE(machine.calls().find(" install --no-install-recommends cmake libassimp-dev\n"),
              std::string::npos)
        << machine.calls();
    EXPECT_EQ(machine.setup().first, "");
}

TEST(SetupScript, TestingNeedsMoreThanBuilding) {
    const Machine machine;
    machine.has_apt();
    machine.note("installed", packages(false));
    machine.note("offered", packages(true));
    EXPECT_EQ(machine.setup("build").first, "");
    const auto [said, code] = machine.setup("test");
    EXPECT_EQ(code, 0);
    EXPECT_NE(said.find("libgtest-dev"), std::string::npos);
    EXPECT_EQ(machine.setup("test").first, "");
}

TEST(SetupScript, TheManualNeedsNothingOfWhatBuildingNeeds) {
    const Machine machine;
    machine.has_apt();
    machine.note("offered", {"mkdocs", "mkdocs-material", "libjs-katex", "doxygen"});
    const auto [said, code] = machine.setup("docs");
    EXPECT_EQ(code, 0) << said;
    EXPECT_EQ(said,
              "setup: installing 4 Debian packages (a few minutes at most): mkdocs "
              "mkdocs-material libjs-katex doxygen\n");
}

TEST(SetupScript, FetchesTheListOfPackagesWhenTheMachineHasNone) {
    const Machine machine;
    machine.has_apt();
    machine.note("mirror", packages(true));
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 0) << said;
    EXPECT_EQ(said, "setup: installing " + std::to_string(packages(false).size()) +
                        " Debian packages (a few minutes at most): " + joined(packages(false)) +
                        "\nsetup: fetching the list of packages\n");
}

TEST(SetupScript, NamesAPackageThatTheMirrorDoesNotHave) {
    const Machine machine;
    machine.has_apt();
    std::vector<std::string> offered = packages(false);
    std::erase(offered, "libosmesa6-dev");
    machine.note("mirror", offered);
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 1);
    EXPECT_TRUE(said.ends_with(
        "setup: no such package in this machine's apt sources: libosmesa6-dev (Debian 12, "
        "section main, has them)\n"))
        << said;
}

TEST(SetupScript, NamesWhatCouldNotBeInstalledAndWhyAfterOneMoreTry) {
    const Machine machine;
    machine.has_apt();
    std::vector<std::string> installed = packages(false);
    std::erase(installed, "cmake");
    machine.note("installed", installed);
    machine.note("offered", packages(true));
    machine.note("mirror", {});
    machine.note("broken", {});
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 1);
    EXPECT_TRUE(said.ends_with("E: dpkg was interrupted\nsetup: could not be installed: cmake\n"))
        << said;
    const std::string calls = machine.calls();
    EXPECT_LT(calls.find("install"), calls.find("update"));
    EXPECT_LT(calls.find("update"), calls.rfind("install"));
}

TEST(SetupScript, SaysThatTheMirrorCannotBeReached) {
    const Machine machine;
    machine.has_apt();
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 1);
    EXPECT_NE(said.find("setup: apt-get update failed: E: no route to the mirror\n"),
              std::string::npos)
        << said;
}

TEST(SetupScript, UsesSudoWhenNotRoot) {
    const Machine machine;
    machine.has_apt();
    machine.has("id", "echo 1000");
    machine.has("sudo", "echo sudo >>\"$state/calls\"; exec \"$@\"");
    machine.note("offered", packages(true));
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 0) << said;
    EXPECT_TRUE(machine.calls().starts_with("sudo\napt-get ")) << machine.calls();
}

TEST(SetupScript, WithoutSudoSaysWhatToRunAsRoot) {
    const Machine machine;
    machine.has_apt();
    machine.has("id", "echo 1000");
    machine.note("offered", packages(true));
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 1);
    EXPECT_EQ(said, "setup: " + std::to_string(packages(false).size()) +
                        " Debian packages are missing, and installing them needs root, but there "
                        "is no sudo. As root, "
                        "run:\nsetup: apt-get install --no-install-recommends " +
                        joined(packages(false)) + "\n");
    EXPECT_EQ(machine.calls(), "");
}

TEST(SetupScript, WithoutAptListsWhatIsNeeded) {
    const Machine machine;
    const auto [said, code] = machine.setup();
    EXPECT_EQ(code, 1);
    EXPECT_EQ(said,
              "setup: this system has no apt, so nothing can be installed here. Needed, by their "
              "names in Debian 12:\n"
              "setup: " +
                  joined(packages(false)) +
                  "\nsetup: install the like of them, then run again with RISORIUS_SKIP_SETUP=1\n");
    const auto [skipped, skipped_code] = machine.setup("", "RISORIUS_SKIP_SETUP=1");
    EXPECT_EQ(skipped, "");
    EXPECT_EQ(skipped_code, 0);
}

TEST(SetupScript, RefusesAnUnknownPurpose) {
    const auto [said, code] = Machine().setup("bild");
    EXPECT_EQ(said, "setup: expected build, test, speech, docs, studio or web, found \"bild\"\n");
    EXPECT_EQ(code, 1);
}

TEST(PackageList, NamesEveryPackageOnceWithItsUse) {
    std::set<std::string> seen;
    for (const std::string& line : lines_of(text_of(source_dir() / "tools/packages.txt"))) {
        if (line.empty() || line[0] == '#' || line[0] == '[') continue;
        EXPECT_NE(line.find("  # "), std::string::npos) << line;
        EXPECT_TRUE(seen.insert(line.substr(0, line.find(' '))).second) << line << " twice";
    }
    EXPECT_TRUE(seen.contains("cmake"));
}

}  // namespace
}  // namespace risorius::structure
