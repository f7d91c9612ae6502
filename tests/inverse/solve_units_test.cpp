// SPDX-License-Identifier: MIT
// A recorded smile comes back under the names of its action units, in few curves with few keys.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "paths.h"
#include "risorius/core/counter_rng.h"
#include "risorius/core/error.h"
#include "risorius/core/read_file.h"
#include "risorius/face/face.h"
#include "risorius/inverse/detail/landmark_sets.h"
#include "risorius/inverse/solve_activations.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "temporary_folder.h"

namespace risorius::inverse {
namespace {

namespace fs = std::filesystem;

const fs::path kSmiling = fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json";

/// A smile of two action units at a share of its height.
track::Drive smile_at(const scene::RigFiles& files, double share) {
    track::Expansion sum = track::Expansion::none(files.rig.channels());
    for (const auto& [unit, height] : {std::pair{"AU6", 0.54}, {"AU12", 0.72}})
        sum.add(rig::expansion_at(files.rig, unit, 1).value(), files.rig.facs.find(unit)->curve,
                height * share);
    return rig::clamped_drive(sum, files.rig.channels());
}

/// A face at rest that is to be recorded, and where its landmarks are.
struct Sitter {
    scene::RigFiles files = scene::read_rig_files(kSmiling);
    face::Face face{files.rig, files.mesh, face::quality_named("preview"), files.place()};
    scene::LandmarkPoints points{face.head(), files.rig};

    Sitter() {
        track::Drive rest;
        rest.excitation = Eigen::VectorXd::Zero(files.rig.channels().column_count());
        face.start([&](double) { return rest; });
    }
};

/// A table that cannot be read is told before the minute of simulation that finds out what the units do.
TEST(SolveUnits, AWrongTableIsToldBeforeAnythingIsSimulated) {
    const TemporaryFolder folder;
    const fs::path table = folder.path() / "seen.tsv";
    std::ofstream(table) << "time_s\tch_l.x_mm\tch_l.y_mm\tch_l.z_mm\n0\t1\t2\n";
    std::vector<std::string> work;
    ProgressMonitor monitor;
    monitor.progress = [&](double, const std::string& what) { work.push_back(what); };
    EXPECT_THROW(solve_activations({.rig = kSmiling,
                                    .out = folder.path() / "out",
                                    .landmarks = table,
                                    .with = {"pressure"}},
                                   monitor),
                 Error);
    for (const std::string& what : work) EXPECT_EQ(what, "building the face");
}

TEST(SolveUnits, ASmileIsNamedAndHasFewKeys) {
    Sitter sitter;
    auto& [files, face, points] = sitter;
    const TemporaryFolder folder;
    const fs::path table = folder.path() / "seen.tsv";
    constexpr int kFrames = 13;
    {
        std::ofstream out(table);
        out << "time_s";
        for (const std::string& id : points.ids())
            for (const char axis : {'x', 'y', 'z'}) out << "\t" << id << "." << axis << "_mm";
        for (int f = 0; f < kFrames; ++f) {
            const track::Drive drive =
                smile_at(files, std::pow(std::sin(3.14159265 * f / (kFrames - 1)), 2));
            face.solve_equilibrium(drive.excitation, drive, {.iterations = face::kRestIterations});
            const Points vertices = face.pose().vertices;
            out << "\n" << f / 15.0;
            for (const std::string& id : points.ids())
                for (long k = 0; k < 3; ++k) out << "\t" << 1e3 * points.at(id, vertices)[k];
        }
        out << "\n";
    }
    const SolveReport found = solve_activations(
        {.rig = kSmiling, .out = folder.path() / "solved", .landmarks = table, .fps = 30});
    ASSERT_EQ(found.solved.size(), static_cast<std::size_t>(kFrames));
    EXPECT_LE(found.curves.size(), 8u);
    std::map<std::string, double> highest;
    std::size_t keys = 0;
    std::string listed;
    for (const UnitCurve& curve : found.curves) {
        listed += curve.channel + " ";
        keys += curve.keys.size();
        for (const track::Key& key : curve.keys)
            highest[curve.channel] = std::max(highest[curve.channel], key.value);
    }
    SCOPED_TRACE(listed);
    EXPECT_LE(keys, 30u);
    EXPECT_NEAR(highest["AU12"], 0.72, 0.1);
    EXPECT_NEAR(highest["AU6"], 0.54, 0.15);
    EXPECT_LT(found.rms_m(), 0.1e-3);
    EXPECT_TRUE(found.solved[6].simulated);
    // What it says of a simulated frame is what the script does.
    face.solve_equilibrium(found.solved[6].drive.excitation, found.solved[6].drive,
                           {.iterations = face::kRestIterations});
    const Points played = face.pose().vertices;
    const track::Drive truth = smile_at(files, 1);
    face.solve_equilibrium(truth.excitation, truth, {.iterations = face::kRestIterations});
    const Points wanted = face.pose().vertices;
    double squares = 0;
    for (const std::string& id : points.ids())
        squares += (points.at(id, played) - points.at(id, wanted)).squaredNorm();
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(points.ids().size())),
                found.solved[6].rms_m, 0.03e-3);
    // The script sets activations, so that it does not lag behind the recording.
    const track::ChannelTable channels = files.rig.channels();
    const track::ScriptDescription script = track::read_script(
        folder.path() / "solved/script.json", channels, files.rig.facs, files.rig.expressions);
    const track::Drive top = track::Timeline(script, channels).at(0.4);
    const int pull = channels.column("zygomaticus_major", Side::kLeft);
    EXPECT_NEAR(top.activation[pull], found.solved[6].drive.excitation[pull], 0.02);
    // One thread finds the same.
    solve_activations({.rig = kSmiling,
                       .out = folder.path() / "alone",
                       .landmarks = table,
                       .fps = 30,
                       .threads = 1});
    for (const char* name : {"script.json", "results.json"}) {
        const auto text = [&](const char* of) {
            return read_file(folder.path() / of / name, {"a result", kMegabyte});
        };
        EXPECT_EQ(text("solved"), text("alone")) << name;
    }
    // What moves no face is refused, and so are words that mean nothing.
    EXPECT_THROW(
        solve_activations(
            {.rig = kSmiling, .out = folder.path() / "none", .landmarks = table, .as = "bones"}),
        Error);
    EXPECT_THROW(
        solve_activations(
            {.rig = kSmiling, .out = folder.path() / "none", .meshes = {table}, .as = "units"}),
        Error);
    EXPECT_THROW(solve_activations({.rig = kSmiling,
                                    .out = folder.path() / "none",
                                    .landmarks = table,
                                    .as = "muscles",
                                    .with = {"tongue"}}),
                 Error);
}

TEST(SolveUnits, ASmileOfAnotherPersonBeforeACameraIsNamed) {
    Sitter sitter;
    auto& [files, face, points] = sitter;
    const TemporaryFolder folder;
    const fs::path table = folder.path() / "camera.csv";
    constexpr int kFrames = 13, kHidden = 4;
    {
        // A larger face that turns and comes nearer, in pixels, with noise of a third of a pixel. At times a hand hides the left corner.
        std::ofstream out(table);
        RandomSequence noise(7);
        out << "time_s,mediapipe_291.confidence";
        for (const SetPoint& one : mediapipe_points().landmarks)
            for (const char axis : {'x', 'y', 'z'})
                out << ",mediapipe_" << one.points[0] << "." << axis;
        for (const SetPoint& one : mediapipe_points().landmarks)
            if (one.points[1] != one.points[0])
                for (const char axis : {'x', 'y', 'z'})
                    out << ",mediapipe_" << one.points[1] << "." << axis;
        for (int f = 0; f < kFrames; ++f) {
            const double at = f / (kFrames - 1.0);
            const track::Drive drive = smile_at(files, std::pow(std::sin(3.14159265 * at), 2));
            face.solve_equilibrium(drive.excitation, drive, {.iterations = face::kRestIterations});
            const Points vertices = face.pose().vertices;
            const Mat3 turn = (Eigen::AngleAxisd(0.2 * at, Vec3::UnitY()) *
                               Eigen::AngleAxisd(-0.1 * at, Vec3::UnitX()))
                                  .toRotationMatrix();
            out << "\n" << f / 15.0 << (f == kHidden ? ",0" : ",1");
            const auto write = [&](const SetPoint& one) {
                const Vec3 p = 1.1 * (turn * points.at(std::string(one.landmark), vertices));
                Vec3 px = 2000 * (1 + 0.1 * at) * Vec3(p.x(), -p.y(), -p.z());
                for (long k = 0; k < 3; ++k) px[k] += 0.33 * std::sqrt(12) * (noise.next() - 0.5);
                if (f == kHidden && one.landmark == "ch_l") px.x() += 80;
                out << "," << px.x() << "," << px.y() << "," << px.z();
            };
            for (const SetPoint& one : mediapipe_points().landmarks) write(one);
            for (const SetPoint& one : mediapipe_points().landmarks)
                if (one.points[1] != one.points[0]) write(one);
        }
        out << "\n";
    }
    const SolveReport found = solve_activations(
        {.rig = kSmiling, .out = folder.path() / "solved", .landmarks = table, .fps = 30});
    EXPECT_EQ(found.set, "mediapipe");
    ASSERT_TRUE(found.sitter_scale.has_value());
    EXPECT_NEAR(*found.sitter_scale * 1.1 * 2000, 1, 0.01);
    std::map<std::string, double> highest;
    std::string listed;
    for (const UnitCurve& curve : found.curves) {
        listed += curve.channel + " " + std::to_string(curve.keys.size()) + " ";
        for (const track::Key& key : curve.keys)
            highest[curve.channel] = std::max(highest[curve.channel], key.value);
    }
    SCOPED_TRACE(listed);
    // The noise, 0.15 mm in each axis of each frame and of the neutral face (0.37 mm of a landmark), is left.
    EXPECT_LE(found.curves.size(), 8u);
    EXPECT_NEAR(highest["AU12"], 0.72, 0.1);
    EXPECT_NEAR(highest["AU6"], 0.54, 0.3);
    EXPECT_LT(found.rms_m(), 0.55e-3);
}

}  // namespace
}  // namespace risorius::inverse
