// SPDX-License-Identifier: MIT
// A table of meshes as users bring them, and of meshes made to break readers: what `check` and `fit` answer, within some seconds
// of processor time and 500 MB, and that they leave nothing behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "paths.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;
const fs::path kProgram = fs::path(RISORIUS_BINARY_DIR) / "risorius";
const fs::path kTree = RISORIUS_SOURCE_DIR;

struct Ran {
    int code = -1;  ///< minus the number of a signal that ended it
    std::string output;
    double seconds = 0;    ///< of processors, for it and its children
    double megabytes = 0;  ///< at most, of one of them
};

/// Runs the program in a folder.
Ran run_program(const std::vector<std::string>& arguments, const fs::path& folder,
                const fs::path& log) {
    std::vector<std::string> words{kProgram.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(out, STDOUT_FILENO);
        ::dup2(out, STDERR_FILENO);
        if (::chdir(folder.c_str()) != 0) ::_exit(126);
        ::execv(pointers[0], pointers.data());
        ::_exit(127);
    }
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    Ran ran;
    ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    for (const timeval& part : {used.ru_utime, used.ru_stime})
        ran.seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    ran.megabytes = static_cast<double>(used.ru_maxrss) / 1000;
    ran.output = bytes_of(log);
    return ran;
}

struct Case {
    const char* file;
    int code;
    const char* says;  ///< a part of what is printed
};

void expect_cases(const fs::path& folder, const std::vector<Case>& cases) {
    const TemporaryFolder logs, work;
    for (const Case& one : cases) {
        const Ran ran =
            run_program({"check", (folder / one.file).string()}, work.path(), logs / "log");
        EXPECT_EQ(ran.code, one.code) << one.file << "\n" << ran.output;
        EXPECT_NE(ran.output.find(one.says), std::string::npos) << one.file << "\n" << ran.output;
        EXPECT_LE(ran.seconds, 15) << one.file;
        EXPECT_LE(ran.megabytes, 500) << one.file;
        EXPECT_TRUE(work.listing().empty()) << one.file;
    }
}

TEST(MeshTable, FilesAsUsersBringThem) {
    expect_cases(kTree / "tests/inputs/public_cases",
                 {{"obj_plain.obj", 0, "fine"},
                  {"obj_comment_ends_in_backslash.obj", 0, "fine"},
                  {"obj_comment_ends_in_backslash_silent.obj", 0, "(999, 999, 999)"},
                  {"obj_comment_after_face.obj", 0, "fine"},
                  {"obj_cr_only.obj", 0, "fine"},
                  {"obj_edge_among_faces.obj", 0, "a face of two corners is an edge, left out"},
                  {"obj_face_twice.obj", 2, "fit --repair"},
                  {"obj_face_without_area.obj", 2, "fit --repair"},
                  {"mtl_identity_scale.obj", 0, "fine"},
                  {"gltf_quantized.glb", 0, "fine"},
                  {"gltf_quantized_14_bits.glb", 0, "fine"},
                  {"gltf_meshopt.glb", 0, "fine"},
                  {"gltf_named_vrm.vrm", 0, "fine"},
                  {"gltf_requires_unknown.glb", 2, "EXT_unheard_of_geometry"}});
}

TEST(MeshTable, FilesMadeToBreakReaders) {
    expect_cases(kTree / "tests/inputs/hostile", {{"assimp_oob.glb", 2, "expected a glTF file"},
                                                  {"bad_utf8_group.obj", 2, "\\xff"},
                                                  {"escape_in_group.obj", 2, "\\x1b"},
                                                  {"hang.ply", 2, "it took more than 3 s"},
                                                  {"oom.dae", 2, "it took more than 480 MB"},
                                                  {"weld_min.obj", 2, "coordinates of at most 1e9"},
                                                  {"targets_nonstring.glb", 0, "fine"},
                                                  {"vertex_nan2.glb", 0, "fine"}});
}

TEST(MeshTable, LargeFilesMadeToBreakReaders) {
    const TemporaryFolder made;
    const std::string script = (kTree / "tests/inputs/hostile/make_large.py").string();
    if (run_shell("python3 '" + script + "' '" + made.path().string() + "'").code != 0)
        GTEST_SKIP() << "python3 is not installed";
    expect_cases(made.path(), {{"deepnodes.glb", 0, "fine"},
                               {"dag.glb", 2, "a node with one parent"},
                               {"deep.fbx", 2, "could not read: it"},
                               {"mtlloop.obj", 0, "fine"}});
}

TEST(MeshTable, HeadsAsUsersBringThem) {
    const TemporaryFolder made, out, logs;
    if (run_shell("python3 '" + (kTree / "tests/inputs/public_cases/make_heads.py").string() +
                  "' '" + (kTree / "models/adult/head.obj").string() + "' '" +
                  (kTree / "models/adult/landmarks.json").string() + "' '" + made.path().string() +
                  "'")
            .code != 0)
        GTEST_SKIP() << "python3 is not installed";
    struct Head {
        const char *mesh, *landmarks;
        int code;
        const char* says;
    };
    for (const Head& head : std::vector<Head>{
             {"both_eyes.obj", "landmarks_by_number.json", 0, "eye_l       Eyes_l"},
             {"one_object.obj", "landmarks_by_number.json", 0, "eye_l       Character.Std_eye_l"},
             {"says_its_unit.fbx", "landmarks_as_in_file.json", 0, "eye_l       eye_l"},
             {"says_its_unit.fbx", "landmarks_by_number.json", 2,
              ".fbx file are not read in the order"},
             {"skinned.glb", "landmarks_m.json", 0, "eye_l       eye_l"},
             {"picture_of_windows.obj", "landmarks_by_number.json", 0, "skin        skin"},
             {"picture_tga.obj", "landmarks_by_number.json", 0, "skin        skin"}}) {
        const Ran ran = run_program(
            {"fit", (made / head.mesh).string(), "--landmarks", (made / head.landmarks).string(),
             "--no-calibrate", "-o", (out / (std::string(head.mesh) + ".json")).string()},
            out.path(), logs / "log");
        EXPECT_EQ(ran.code, head.code) << head.mesh << "\n" << ran.output;
        EXPECT_NE(ran.output.find(head.says), std::string::npos) << head.mesh << "\n" << ran.output;
        EXPECT_EQ(ran.output.find("cannot"), std::string::npos) << ran.output;
        EXPECT_LE(ran.seconds, 15) << head.mesh;
        EXPECT_LE(ran.megabytes, 500) << head.mesh;
    }
    // The rig names materials as parts, and is read with them.
    EXPECT_EQ(
        run_program({"check", (out / "one_object.obj.json").string()}, out.path(), logs / "log")
            .code,
        0);
}

}  // namespace
}  // namespace risorius
