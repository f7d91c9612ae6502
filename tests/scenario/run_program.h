// Runs the real program and catches what it says.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace risorius::scenario {

/// A folder of its own for one test.
class Folder {
  public:
    Folder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("risorius-scenario-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    std::set<std::string> listing() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
            names.insert(entry.path().lexically_relative(path_).string());
        return names;
    }

  private:
    std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Outcome {
    int code = -1;
    std::string out;
    std::string errors;
};

/// `before` stands before the program's name, as in "timeout 1"; the program is started in `folder`.
inline Outcome run(const std::string& arguments, const std::filesystem::path& folder,
                   const std::string& before = "") {
    const Folder scratch;
    const std::string command = "cd '" + folder.string() + "' && " + before + " '" +
                                RISORIUS_BINARY_DIR "/risorius' " + arguments + " >'" +
                                (scratch / "out").string() + "' 2>'" +
                                (scratch / "errors").string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch / "out"),
            text_of(scratch / "errors")};
}

}  // namespace risorius::scenario
