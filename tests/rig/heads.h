// SPDX-License-Identifier: MIT
/// \file
/// The heads of the tests: the adult that comes with the project, and two measured ones that may lie beside it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "paths.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/io/read_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::rig {

struct TestHead {
    RigDescription rig;
    geom::PolygonMesh mesh;
    int vertex(const std::string& landmark) const { return rig.landmarks.at(landmark).vertex; }
};

inline std::filesystem::path source_folder() { return RISORIUS_SOURCE_DIR; }
inline std::filesystem::path adult_rig_file() {
    return source_folder() / "rigs" / "adult" / "rig.json";
}

inline const TestHead& adult() {
    static const TestHead head = [] {
        TestHead out;
        out.rig = read_rig(adult_rig_file());
        out.mesh = io::read_mesh(out.rig.mesh_file);
        return out;
    }();
    return head;
}

inline const Head& adult_placed() {
    static const Head head = place_head(adult().rig, adult().mesh, "adult");
    return head;
}

/// A measured head in the shared folder, with the adult's anatomy and its own landmarks; none when it is not there.
inline std::optional<TestHead> measured_head(
    const std::string& mesh, const std::string& landmarks,
    const std::map<std::string, std::vector<std::string>>& parts) {
    const std::filesystem::path file =
        std::filesystem::path(RISORIUS_SHARED_DIR) / "data" / "heads" / mesh;
    if (!std::filesystem::exists(file)) return std::nullopt;
    TestHead out;
    out.rig = adult().rig;
    out.rig.mesh_file = file;
    out.rig.metres_per_unit = 0.01;
    out.rig.landmarks = read_landmarks(source_folder() / "tests" / "data" / "heads" / landmarks);
    out.rig.parts = parts;
    out.mesh = io::read_mesh(file);
    return out;
}

inline std::optional<TestHead> ict_head() {
    return measured_head("ict/ict_neutral.obj", "ict_landmarks.json",
                         {{"skin", {"face", "head_neck"}},
                          {"mouth", {"mouth_socket"}},
                          {"eye_socket", {"eye_socket_l", "eye_socket_r"}},
                          {"gums_tongue", {"gums_tongue"}},
                          {"teeth", {"teeth"}},
                          {"eye_l", {"eyeball_l"}},
                          {"eye_r", {"eyeball_r"}},
                          {"lashes_l", {"lashes_l"}},
                          {"lashes_r", {"lashes_r"}}});
}

inline std::optional<TestHead> makehuman_head() {
    return measured_head("makehuman/mh_head.obj", "makehuman_landmarks.json",
                         {{"skin", {"skin"}},
                          {"tongue", {"tongue"}},
                          {"teeth_upper", {"teeth_upper"}},
                          {"teeth_lower", {"teeth_lower"}},
                          {"eye_l", {"eye_l"}},
                          {"eye_r", {"eye_r"}},
                          {"cornea_l", {"cornea_l"}},
                          {"cornea_r", {"cornea_r"}},
                          {"lashes_l", {"lashes_l"}},
                          {"lashes_r", {"lashes_r"}}});
}

}  // namespace risorius::rig
