// SPDX-License-Identifier: MIT
// Landmarks of face trackers: another person, whose head moves before a camera, comes to the rig as the motion of its own landmarks.
#include "risorius/inverse/detail/landmark_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <string>

#include "message_of.h"
#include "paths.h"
#include "risorius/inverse/detail/landmark_target.h"
#include "risorius/rig/head.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"
#include "temporary_folder.h"

namespace risorius::inverse {
namespace {

namespace fs = std::filesystem;

constexpr int kSeenFrames = 9;
constexpr double kSize = 1.13;  // of the sitter
constexpr int kWidth_px = 1280, kHeight_px = 720;
constexpr double kPx_per_m = 2500;

/// What a face does: both corners of the mouth go up and out, the lower lip and the chin down.
Vec3 moved(const std::string& id, double share) {
    if (id == "ch_l") return share * Vec3(5e-3, 7e-3, -3e-3);
    if (id == "ch_r") return share * Vec3(-5e-3, 7e-3, -3e-3);
    if (id == "li" || id == "stoi") return share * Vec3(0, -4e-3, 0);
    if (id.starts_with("bm_")) return share * Vec3(0, 3e-3, 0);
    return Vec3::Zero();
}
double share_of(int frame) { return std::pow(std::sin(std::numbers::pi * frame / kSeenFrames), 2); }

class LandmarkSets : public testing::Test {
  protected:
    LandmarkSets()
        : files_(scene::read_rig_files(fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json")),
          head_(rig::place_head(files_.rig, files_.mesh, files_.place())),
          points_(head_, files_.rig) {
        for (const std::string& id : points_.ids()) {
            const bool on_skull = id == "n" || id == "g" || id == "mn" || id.starts_with("en_") ||
                                  id.starts_with("fht") || id.starts_with("t_");
            max_m_.push_back(on_skull ? 0.5e-3 : 6e-3);
        }
    }

    /// Where a camera sees the sitter's landmark: x to the right, y down, z away, in pixels.
    Vec3 seen(const std::string& id, int frame) const {
        const double at = frame / static_cast<double>(kSeenFrames);
        const Mat3 turn = (Eigen::AngleAxisd(0.25 * std::sin(6 * at), Vec3::UnitY()) *
                           Eigen::AngleAxisd(0.15 * std::sin(4 * at), Vec3::UnitX()) *
                           Eigen::AngleAxisd(0.2 * at, Vec3::UnitZ()))
                              .toRotationMatrix();
        const Vec3 p =
            kSize * (turn * (points_.at(id, head_.vertices) + moved(id, share_of(frame))));
        return kPx_per_m * (1 + 0.1 * at) * Vec3(p.x(), -p.y(), -p.z()) +
               Vec3(600 + 40 * at, 350, 0);
    }
    /// The points of a set. Two points of one landmark lie on either side of it.
    std::map<int, Vec3> points_of(const LandmarkSet& set, int frame) const {
        std::map<int, Vec3> out;
        for (const SetPoint& one : set.landmarks) {
            const Vec3 at = seen(std::string(one.landmark), frame);
            const bool both = one.points[0] != one.points[1];
            if (!out.count(one.points[0]))
                out[one.points[0]] = at + (both ? Vec3(3, 1, 0) : Vec3::Zero());
            out[one.points[1]] = 2 * at - out[one.points[0]];
        }
        return out;
    }
    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / name) << text;
        return folder_.path() / name;
    }
    std::string table(const LandmarkSet& set,
                      const std::function<std::array<std::string, 3>(int)>& names,
                      const std::string& time, const std::string& more = {},
                      const std::function<std::string(int)>& cells = {}) const {
        std::ostringstream out;
        out << time << more;
        for (const auto& [number, at] : points_of(set, 0))
            for (const std::string& name : names(number))
                if (!name.empty()) out << ", " << name;
        for (int f = 0; f < kSeenFrames; ++f) {
            out << "\n" << f / 30.0 << (cells ? cells(f) : "");
            for (const auto& [number, at] : points_of(set, f)) {
                const auto columns = names(number);
                for (std::size_t k = 0; k < 3; ++k)
                    if (!columns[k].empty()) out << ", " << at[static_cast<long>(k)];
            }
        }
        out << "\n";
        return out.str();
    }
    FitTarget read(const fs::path& file, LandmarkOptions options = {}, int fps = 240) const {
        options.fps = fps;
        return given_landmarks(
            file, options, points_, [&] { return max_m_; }, head_.vertices);
    }
    /// The largest error of a displacement of the rig's landmarks, m.
    double error_m(const FitTarget& found, const LandmarkSet& set, bool flat = false) const {
        double worst = 0;
        EXPECT_EQ(found.fields.size(), static_cast<std::size_t>(kSeenFrames));
        for (int f = 0; f < kSeenFrames; ++f)
            for (const SetPoint& one : set.landmarks) {
                const std::string id(one.landmark);
                const auto frame = static_cast<std::size_t>(f);
                if (!found.sure.empty() && found.sure[frame][points_.vertex(id)] == 0) continue;
                Vec3 off =
                    found.fields[static_cast<std::size_t>(f)].row(points_.vertex(id)).transpose() -
                    moved(id, share_of(f));
                if (flat) off.z() = 0;
                worst = std::max(worst, off.norm());
            }
        return worst;
    }

    scene::RigFiles files_;
    rig::Head head_;
    scene::LandmarkPoints points_;
    std::vector<double> max_m_;
    TemporaryFolder folder_;
};

TEST_F(LandmarkSets, NamesAreLandmarksOfTheRigOnBothSides) {
    const std::vector<std::string> ids = points_.ids();
    for (const LandmarkSet* set : {&mediapipe_points(), &face68_points()}) {
        std::set<std::string> names;
        for (const SetPoint& one : set->landmarks) {
            const std::string id(one.landmark);
            EXPECT_TRUE(std::find(ids.begin(), ids.end(), id) != ids.end()) << id;
            EXPECT_TRUE(names.insert(id).second) << id;
            for (const int number : one.points) EXPECT_LT(number, set->count);
        }
        for (const std::string& id : names)
            EXPECT_TRUE(!id.ends_with("_l") || names.count(id.substr(0, id.size() - 1) + "r"));
    }
    EXPECT_GE(mediapipe_points().landmarks.size(), 80u);
    EXPECT_GE(face68_points().landmarks.size(), 40u);
}

TEST_F(LandmarkSets, ASitterBeforeACameraMovesTheRigAsItself) {
    const LandmarkSet& set = mediapipe_points();
    const auto names = [](int n) {
        const std::string id = "mediapipe_" + std::to_string(n);
        return std::array<std::string, 3>{id + ".x", id + ".y", id + ".z"};
    };
    const FitTarget found = read(write("seen.csv", table(set, names, "time_s")));
    EXPECT_EQ(found.set, "mediapipe");
    EXPECT_LT(error_m(found, set), 0.5e-3);
    EXPECT_NEAR(found.sitter_scale * kSize * kPx_per_m, 1, 1e-3);
    EXPECT_TRUE(found.sure.empty());
    // Times are rounded in a file: 0.0333333 s is a frame of 30 frames a second.
    EXPECT_EQ(read(folder_.path() / "seen.csv", {}, 30).fields.size(), 9u);
    EXPECT_EQ(read(folder_.path() / "seen.csv", {}, 15).fields.size(), 5u);
}

TEST_F(LandmarkSets, JsonOfMediaPipeHasSharesOfThePicture) {
    const LandmarkSet& set = mediapipe_points();
    std::ostringstream out;
    for (int f = 0; f < kSeenFrames; ++f) {
        const std::map<int, Vec3> points = points_of(set, f);
        out << R"({"timestampMs": )" << 1e3 * f / 30 << R"(, "faceLandmarks": [[)";
        for (int n = 0; n < set.count; ++n) {
            const Vec3 at = points.count(n) ? points.at(n) : Vec3::Zero();
            out << (n ? "," : "") << R"({"x":)" << at.x() / kWidth_px << R"(,"y":)"
                << at.y() / kHeight_px << R"(,"z":)" << at.z() / kWidth_px << R"(,"visibility":0})";
        }
        out << "]]}\n";
    }
    const fs::path file = write("seen.jsonl", out.str());
    EXPECT_LT(error_m(read(file, {.picture_px = {kWidth_px, kHeight_px}}), set), 0.5e-3);
    // What is wrong with a file comes before the size that it lacks.
    const fs::path cut = write("cut.json", "{\"frames\": [");
    EXPECT_NE(message_of([&] { read(cut); }).find("expected valid JSON"), std::string::npos);
    EXPECT_TRUE(message_of([&] { read(file); }).find("--picture") != std::string::npos ||
                message_of([&] { read(file); }).find("picture") != std::string::npos);
}

TEST_F(LandmarkSets, TheTableOfOpenFaceIsReadWithItsConfidence) {
    const LandmarkSet& set = face68_points();
    const auto in_space = [](int n) {
        const std::string digits = std::to_string(n);
        return std::array<std::string, 3>{"X_" + digits, "Y_" + digits, "Z_" + digits};
    };
    const auto cells = [](int f) {
        return f == 4 ? std::string(", 0.1, 0") : std::string(", 0.98, 1");
    };
    const FitTarget found = read(
        write("openface.csv", table(set, in_space, "timestamp", ", confidence, success", cells)));
    EXPECT_EQ(found.set, "face68");
    EXPECT_LT(error_m(found, set), 0.5e-3);
    ASSERT_EQ(found.sure.size(), static_cast<std::size_t>(kSeenFrames));
    EXPECT_EQ(found.sure[4].maxCoeff(), 0);  // no face
    EXPECT_EQ(found.sure[3].maxCoeff(), 1);
}

TEST_F(LandmarkSets, PointsWithoutDepthSayNothingOfIt) {
    const LandmarkSet& set = face68_points();
    const auto flat = [](int n) {
        const std::string digits = std::to_string(n);
        return std::array<std::string, 3>{"x_" + digits, "y_" + digits, ""};
    };
    const FitTarget found = read(write("flat.csv", table(set, flat, "timestamp")));
    EXPECT_TRUE(found.flat);
    // A head that turns is another shape in the picture: 14 degrees to the side and 9 up move it by some millimetres.
    EXPECT_LT(error_m(found, set, true), 8e-3);
    EXPECT_FALSE(found.sure.empty());
}

TEST_F(LandmarkSets, WhatIsNotSeenDoesNotCount) {
    const LandmarkSet& set = mediapipe_points();
    std::istringstream in(table(
        set,
        [](int n) {
            const std::string id = "mediapipe_" + std::to_string(n);
            return std::array<std::string, 3>{id + ".x", id + ".y", id + ".z"};
        },
        "time_s, mediapipe_61.confidence", "", [](int f) { return f >= 2 ? ", 0" : ", 1"; }));
    // The corner of the mouth is hidden and guessed wrongly, which must not turn the head.
    std::string line, text;
    std::getline(in, line);
    std::vector<std::string> names;
    std::istringstream header(line);
    for (std::string name; std::getline(header, name, ',');) names.push_back(name);
    text = line;
    for (int row = 0; std::getline(in, line); ++row) {
        std::istringstream cells(line);
        std::string out;
        std::size_t c = 0;
        for (std::string cell; std::getline(cells, cell, ','); ++c)
            out += (c ? "," : "") +
                   (row >= 2 && names[c] == " mediapipe_61.x" ? std::string("9999") : cell);
        text += "\n" + out;
    }
    const FitTarget found = read(write("hidden.csv", text + "\n"));
    ASSERT_FALSE(found.sure.empty());
    EXPECT_EQ(found.sure[5][points_.vertex("ch_r")], 0);
    EXPECT_EQ(found.sure[5][points_.vertex("ch_l")], 1);
    for (const char* id : {"ch_l", "n", "bm_l", "li"})
        EXPECT_LT(
            (Vec3(found.fields[5].row(points_.vertex(id)).transpose()) - moved(id, share_of(5)))
                .norm(),
            0.5e-3)
            << id;
}

TEST_F(LandmarkSets, TheNeutralFaceMayBeLater) {
    const LandmarkSet& set = mediapipe_points();
    const auto names = [](int n) {
        const std::string id = "mediapipe_" + std::to_string(n);
        return std::array<std::string, 3>{id + ".x", id + ".y", id + ".z"};
    };
    const fs::path file = write("seen.csv", table(set, names, "time_s"));
    const FitTarget found = read(file, {.neutral_s = {{4 / 30.0 - 0.01, 4 / 30.0 + 0.01}}});
    EXPECT_LT(found.fields[4].norm(), 1e-9);
    const Vec3 corner = found.fields[0].row(points_.vertex("ch_l")).transpose();
    EXPECT_LT((corner + moved("ch_l", share_of(4))).norm(), 1.2e-3);
    EXPECT_NE(message_of([&] {
                  read(file, {.neutral_s = {{5, 6}}});
              }).find("neutral"),
              std::string::npos);
}

TEST_F(LandmarkSets, AMirroredFaceIsRefused) {
    const LandmarkSet& set = face68_points();
    std::ostringstream out;
    out << "time_s";
    for (const auto& [n, at] : points_of(set, 0))
        for (const char axis : {'x', 'y', 'z'}) out << "\tface68_" << n << "." << axis;
    out << "\n0";
    for (const auto& [n, at] : points_of(set, 0))
        out << "\t" << at.x() << "\t" << at.y() << "\t" << -at.z();
    EXPECT_NE(message_of([&] { read(write("mirrored.tsv", out.str() + "\n")); }).find("mirrored"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::inverse
