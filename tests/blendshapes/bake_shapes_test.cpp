// SPDX-License-Identifier: MIT
// Blend shapes of the adult: halves make wholes, what does not move stays put to the bit, and files hold what was made.
#include "risorius/blendshapes/bake_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/animate/render_job.h"
#include "risorius/blendshapes/detail/point_cache.h"
#include "risorius/blendshapes/detail/shape_animation.h"
#include "risorius/blendshapes/detail/shape_weights.h"
#include "risorius/blendshapes/shape_player.h"
#include "risorius/core/error.h"
#include "risorius/core/read_file.h"
#include "risorius/core/sha256.h"
#include "risorius/face/surfaces.h"
#include "risorius/inverse/evaluate.h"
#include "risorius/inverse/solve_activations.h"
#include "risorius/io/morph_model.h"
#include "risorius/io/read_mesh.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/track/arkit_names.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "temporary_folder.h"

namespace risorius::blendshapes {
namespace {

namespace fs = std::filesystem;

const fs::path kAdult = fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json";

ShapeSet set_of(const std::string& name, const std::vector<std::string>& only = {}) {
    return shape_set(rig::read_rig(kAdult), name, only, "rig.json");
}

const ShapeGoal& goal(const ShapeSet& set, const std::string& name) {
    return set.goals[static_cast<std::size_t>(set.index(name).value())];
}

TEST(ShapeGoals, EveryNameOfArkitIsThereInItsOrder) {
    const ShapeSet set = set_of("arkit52");
    ASSERT_EQ(set.goals.size(), 52u);
    for (std::size_t i = 0; i < 52; ++i) EXPECT_EQ(set.goals[i].name, track::arkit_names()[i]);
    EXPECT_EQ(goal(set, "mouthSmileLeft").sides, Sides::kHalves);
    EXPECT_EQ(goal(set, "mouthSmileLeft").partner, *set.index("mouthSmileRight"));
    EXPECT_TRUE(goal(set, "mouthSmileLeft").left);
    EXPECT_EQ(goal(set, "mouthSmileLeft").whole, "mouthSmile");
    // A jaw cannot be left and right at once
    EXPECT_EQ(goal(set, "jawLeft").sides, Sides::kOpposed);
    EXPECT_EQ(goal(set, "mouthLeft").sides, Sides::kOpposed);
    EXPECT_EQ(goal(set, "jawOpen").sides, Sides::kNone);
    EXPECT_EQ(goal(set, "mouthClose").on_top_of, *set.index("jawOpen"));
}

TEST(ShapeGoals, OtherSetsHaveWhatMovesTheFace) {
    const ShapeSet facs = set_of("facs");
    EXPECT_EQ(goal(facs, "AU12.l").sides, Sides::kHalves);
    EXPECT_EQ(goal(facs, "AU30.l").sides, Sides::kOpposed);
    EXPECT_TRUE(facs.index("AU26"));
    EXPECT_FALSE(facs.index("AU51.l") || facs.index("AU51"));  // turns the head
    EXPECT_GT(facs.left_out.size(), 5u);
    const ShapeSet muscles = set_of("muscles");
    EXPECT_EQ(goal(muscles, "zygomaticus_major.r").partner, *muscles.index("zygomaticus_major.l"));
    EXPECT_TRUE(muscles.index("levator_palpebrae_superioris_relaxed.l"));
    EXPECT_FALSE(muscles.index("digastric_anterior.l"));
    for (const char* tongue : {"tongue_up", "tongue_body_up", "tongue_body_back"})
        EXPECT_TRUE(muscles.index(tongue)) << tongue;
    EXPECT_EQ(set_of("visemes").goals.size(), 15u);
    // A half comes with the other one, a corrective with what it corrects
    EXPECT_EQ(set_of("arkit52", {"mouthSmileLeft"}).goals.size(), 2u);
    EXPECT_EQ(set_of("arkit52", {"mouthClose"}).goals.size(), 2u);
    EXPECT_THROW(set_of("arkit"), Error);
    try {
        set_of("arkit52", {"mouthSmlie"});
        ADD_FAILURE() << "took an unknown name";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "only: expected shapes of the set \"arkit52\" (did you mean "
                     "\"mouthSmile\"?), found \"mouthSmlie\"");
    }
}

// Lips that are shut over an open jaw are no shape of their own: without a jaw that is open there is none of it, whatever the lips do.
TEST(ShapeWeights, WhatLiesOnAnotherShapeGoesNoFartherThanThat) {
    const scene::RigFiles files = scene::read_rig_files(kAdult);
    const track::ChannelTable channels = files.rig.channels();
    const ShapeSet set = set_of("arkit52", {"mouthClose", "mouthPucker"});
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    const ShapeWeights weights(face, channels, set.goals);
    const long shut = *set.index("mouthClose"), open = *set.index("jawOpen");
    track::Drive drive = set.goals[static_cast<std::size_t>(shut)].drive;
    const Eigen::VectorXd lips_alone = weights.of(drive);
    EXPECT_LE(lips_alone[shut], lips_alone[open]);
    EXPECT_LT(lips_alone[shut], 0.05);
    // With the jaw of the other one the drive is what the shape was solved with
    drive.kinematic = set.goals[static_cast<std::size_t>(open)].drive.kinematic;
    const Eigen::VectorXd both = weights.of(drive);
    EXPECT_NEAR(both[shut], 1, 0.1);
    EXPECT_NEAR(both[open], 1, 0.1);
}

TEST(LiveLinkTable, IsWholeWhateverShapesThereAre) {
    ShapeAnimation animation;
    animation.fps = 30;
    animation.shapes = {"jawOpen"};
    animation.weights = Eigen::MatrixXd::Constant(2, 1, 0.25);
    animation.drives.resize(2);
    const std::string table = live_link_table(animation);
    EXPECT_EQ(table.rfind("Timecode,BlendShapeCount,EyeBlinkLeft,", 0), 0u);
    const std::string second = table.substr(table.rfind("00:00:00:01.000,61,"));
    EXPECT_EQ(std::count(second.begin(), second.end(), ','), 62);
    EXPECT_EQ(second.find("0.25"), std::string("00:00:00:01.000,61,").size() + 17 * 9);
}

TEST(PointCaches, HaveTheirHeadersAndByteOrders) {
    const PointCache cache{2, 2, 50, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -0.5f}};
    const std::string pc2 = pc2_bytes(cache), mdd = mdd_bytes(cache);
    EXPECT_EQ(pc2.size(), 32u + 48u);
    EXPECT_EQ(pc2.substr(0, 12), std::string("POINTCACHE2\0", 12));
    EXPECT_EQ(pc2.substr(12, 8), std::string("\1\0\0\0\2\0\0\0", 8));
    EXPECT_EQ(pc2.substr(20, 12), std::string("\0\0\0\0\0\0\x80\x3f\2\0\0\0", 12));
    EXPECT_EQ(pc2.substr(76), std::string("\0\0\0\xbf", 4));
    EXPECT_EQ(mdd.size(), 8u + 8u + 48u);
    EXPECT_EQ(mdd.substr(0, 8), std::string("\0\0\0\2\0\0\0\2", 8));
    EXPECT_EQ(mdd.substr(8, 8), std::string("\0\0\0\0\x3c\xa3\xd7\x0a", 8));  // 0 and 0.02 s
    EXPECT_EQ(mdd.substr(60), std::string("\xbf\0\0\0", 4));
}

class BakedShapes : public testing::Test {
  protected:
    static ShapesOptions options(const std::vector<std::string>& only, int threads) {
        return {.rig = kAdult,
                .out = folder().path() / "shapes",
                .only = only,
                .pictures = false,
                .correctives = threads > 1,
                .pairs = 1,
                .test_frames = threads > 1 ? 2 : 0,
                .threads = threads};
    }
    static const TemporaryFolder& folder() {
        static const TemporaryFolder one;
        return one;
    }
    static const ShapesReport& report() {
        static const ShapesReport one = bake_shapes(options({"mouthSmile", "eyeBlink"}, 2));
        return one;
    }
    static const MadeShape& shape(const std::string& name) {
        for (const MadeShape& made : report().shapes.list)
            if (made.goal.name == name) return made;
        throw std::out_of_range(name);
    }
};

TEST_F(BakedShapes, KeepTheirCertificate) {
    ASSERT_EQ(report().shapes.list.size(), 4u);
    EXPECT_TRUE(report().shapes.mirrored);
    for (const MadeShape& made : report().shapes.list) {
        std::string said;
        for (const std::string& one : made.certificate.complaints()) said += one + "; ";
        EXPECT_EQ(said, "") << made.goal.name;
        EXPECT_GT(made.certificate.peak_m, 2e-3) << made.goal.name;
        EXPECT_GT(made.certificate.stretch.max, 1.0) << made.goal.name;
    }
    EXPECT_TRUE(shape("eyeBlinkLeft").certificate.lid_gap_m);
    EXPECT_FALSE(shape("mouthSmileLeft").certificate.lid_gap_m);
    EXPECT_LT(report().shapes.halves_error_m, 0.2e-3);
}

TEST_F(BakedShapes, MoveTheirOwnSideAndNothingFarAway) {
    const geom::PolygonMesh& mesh = io::read_mesh(rig::read_rig(kAdult).mesh_file);
    const blendshapes::SparseShape& smile = shape("mouthSmileLeft").shape;
    EXPECT_LT(smile.vertex.size(), static_cast<std::size_t>(mesh.vertex_count()) / 2);
    const Points field = smile.dense(mesh.vertex_count());
    double left = 0, right = 0;
    for (long v = 0; v < field.rows(); ++v) {
        (mesh.positions(v, 0) > 0 ? left : right) += field.row(v).squaredNorm();
        if (mesh.positions(v, 0) < -35) {
            EXPECT_LT(field.row(v).norm(), 1e-3) << v;
        }
    }
    EXPECT_GT(left, 10 * right);
    // The OBJ has the import's own numbers where nothing moves, and its faces
    const geom::PolygonMesh moved =
        io::read_mesh(folder().path() / "shapes/obj/mouthSmileLeft.obj");
    ASSERT_EQ(moved.vertex_count(), mesh.vertex_count());
    EXPECT_EQ(moved.corner_vertex, mesh.corner_vertex);
    for (long v = 0; v < field.rows(); ++v) {
        if (field.row(v).isZero(0.0)) {
            EXPECT_EQ(moved.positions.row(v), mesh.positions.row(v)) << v;
        } else {
            EXPECT_LT(
                (moved.positions.row(v) - mesh.positions.row(v)).norm() - 1e3 * field.row(v).norm(),
                1e-6);
        }
    }
}

TEST_F(BakedShapes, AreTheSameForAnyNumberOfThreads) {
    const TemporaryFolder other;
    ShapesOptions alone = options({"mouthSmile"}, 1);
    alone.out = other.path() / "alone";
    alone.formats = {"glb"};
    const ShapesReport again = bake_shapes(alone);
    ASSERT_EQ(again.shapes.list.size(), 2u);
    for (const MadeShape& made : again.shapes.list) {
        const MadeShape& first = shape(made.goal.name);
        EXPECT_EQ(made.shape.vertex, first.shape.vertex) << made.goal.name;
        EXPECT_EQ(made.shape.delta, first.shape.delta) << made.goal.name;
    }
    EXPECT_TRUE(fs::exists(alone.out / "shapes.glb"));
    EXPECT_FALSE(fs::exists(alone.out / "obj"));
    EXPECT_FALSE(fs::exists(alone.out / "shapes.f32"));
    // It has no correctives, and is read without them.
    const scene::RigFiles files = scene::read_rig_files(kAdult);
    const ShapesOfFile read = read_shapes_of_file(
        alone.out / "shapes.glb", files, rig::place_head(files.rig, files.mesh, files.place()));
    EXPECT_EQ(read.goals.size(), 2u);
    EXPECT_TRUE(read.rig.correctives.empty());
}

TEST_F(BakedShapes, AreWhatTheFilesHold) {
    const io::MorphModel model = io::read_glb(folder().path() / "shapes/shapes.glb");
    ASSERT_EQ(model.targets.size(),
              report().shapes.list.size() + report().correctives.rig.correctives.size());
    for (std::size_t i = 0; i < report().shapes.list.size(); ++i) {
        const MadeShape& made = report().shapes.list[i];
        EXPECT_EQ(model.targets[i].name, made.goal.name);
        ASSERT_EQ(model.targets[i].vertex, made.shape.vertex);
        // Whole numbers of 16 bits, of which the largest delta has 32,767
        EXPECT_LT((model.targets[i].delta - made.shape.delta).cwiseAbs().maxCoeff(), 1e-6);
    }
    // The table is one that `evaluate` reads, and by it the rig makes these very shapes
    const inverse::Evaluation evaluation = inverse::evaluate(
        {.rig = kAdult, .shapes = folder().path() / "shapes/shapes.json", .only = {"mouthSmile"}});
    ASSERT_EQ(evaluation.expressions.size(), 1u);
    EXPECT_GT(evaluation.expressions[0].table.score.cosine, 0.999);
    EXPECT_LT(evaluation.expressions[0].table.score.rms_m, 0.05e-3);
    const JsonCursor json = JsonCursor::read_file(folder().path() / "shapes/results.json");
    EXPECT_EQ(json.at("beyond_limits").integer(0, 100), report().complaints());
    EXPECT_TRUE(fs::exists(folder().path() / "shapes/index.html"));
}

TEST_F(BakedShapes, PlayWhatDrivesThem) {
    const scene::RigFiles files = scene::read_rig_files(kAdult);
    const track::ChannelTable channels = files.rig.channels();
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    ASSERT_FALSE(report().shapes.list.empty());  // made by now
    const fs::path file = folder().path() / "shapes/shapes.glb";
    ShapesOfFile shapes = read_shapes_of_file(file, files, face.head());
    ASSERT_EQ(shapes.goals.size(), 4u);
    EXPECT_EQ(shapes.set, "arkit52");
    EXPECT_EQ(shapes.rig.correctives.size(), report().correctives.rig.correctives.size());
    const ShapePlayer player(std::move(shapes), face, channels);
    const Points& rest = face.head().vertices;
    for (const MadeShape& made : report().shapes.list) {
        const face::FacePose pose = player.pose(made.goal.drive);
        const Points off = pose.vertices - rest - made.shape.dense(rest.rows());
        EXPECT_LT(off.rowwise().norm().maxCoeff(), 0.02 * made.certificate.peak_m)
            << made.goal.name;
    }
    // Its skin folds by its own strain, and not at rest
    track::Drive smile = shape("mouthSmileLeft").goal.drive;
    face::FacePose folded = player.pose(smile);
    face.surfaces().fold(folded, smile);
    ASSERT_EQ(folded.fold_depth.rows(), rest.rows());
    EXPECT_GT(folded.fold_depth.maxCoeff(), 0.02e-3);
    smile.excitation.setZero();
    face::FacePose still = player.pose(smile);
    face.surfaces().fold(still, smile);
    EXPECT_LT(still.fold_depth.cwiseAbs().maxCoeff(), 1e-9);
    // The head's own turn and the eyes' are no part of the shapes
    track::Drive turned = shape("mouthSmileLeft").goal.drive;
    turned.excitation.setZero();
    turned.kinematic[static_cast<std::size_t>(track::Kinematic::kHeadYaw)] = 20;
    turned.kinematic[static_cast<std::size_t>(track::Kinematic::kGazeYawLeft)] = 10;
    const face::FacePose pose = player.pose(turned);
    face.start([&](double) { return turned; });
    face.solve_equilibrium(turned.excitation, turned);
    const face::FacePose simulated = face.pose();
    EXPECT_EQ(pose.eye_rotation[0], simulated.eye_rotation[0]);
    EXPECT_TRUE(pose.head.isApprox(simulated.head, 0.0));
    // Lids and the corners between them go with the gaze, which these shapes do not
    double worst = 0;
    for (long v = 0; v < rest.rows(); ++v) {
        const auto from_eye = [&](int side) {
            return (Vec3(rest.row(v).transpose()) - face.head().eyes[side].centre).norm();
        };
        if (std::min(from_eye(0), from_eye(1)) > 25e-3)
            worst = std::max(worst, (pose.vertices - simulated.vertices).row(v).norm());
    }
    EXPECT_LT(worst, 0.5e-3);
    EXPECT_GT((pose.vertices - rest).rowwise().norm().maxCoeff(), 20e-3);
    // Another head's
    scene::RigFiles other = files;
    other.rig.facs.arkit.clear();
    EXPECT_THROW(read_shapes_of_file(file, other, face.head()), Error);
    rig::Head moved = face.head();
    moved.vertices.col(1).array() += 1e-3;
    EXPECT_THROW(read_shapes_of_file(file, files, moved), Error);
    // What no blend shape can show is refused before anything is built
    animate::RenderRequest options;
    options.script = fs::path(RISORIUS_SOURCE_DIR) / "samples/hello/script.json";
    options.out = folder().path() / "linear.mp4";
    options.shapes = file;
    const animate::RenderJob planned = animate::plan_render_job(options);
    ASSERT_TRUE(planned.shapes.has_value());
    EXPECT_EQ(planned.shapes->content->goals.size(), 4u);  // read once, for the run too
    EXPECT_EQ(planned.shapes->file.sha256, sha256_of_file(file));
    options.show = "muscles";
    EXPECT_THROW(animate::plan_render_job(options), Error);
    options.show.reset();
    options.shapes = files.rig.mesh_file;
    EXPECT_THROW(animate::plan_render_job(options), Error);
}

TEST_F(BakedShapes, AreSolvedBackToWhatMadeThem) {
    ASSERT_FALSE(report().shapes.list.empty());  // made by now
    const TemporaryFolder other;
    const inverse::SolveReport solved =
        inverse::solve_activations({.rig = kAdult,
                                    .out = other.path() / "solved",
                                    .shapes = folder().path() / "shapes/shapes.glb",
                                    .only = {"mouthSmileLeft"}});
    ASSERT_EQ(solved.solved.size(), 1u);
    const inverse::SolvedDrive& one = solved.solved[0];
    EXPECT_LT(one.rms_m, 0.3e-3);
    const Eigen::VectorXd truth = shape("mouthSmileLeft").goal.drive.excitation;
    double error = 0;
    int used = 0;
    for (long c = 0; c < truth.size(); ++c)
        if (truth[c] != 0 || one.drive.excitation[c] != 0) {
            error += std::abs(truth[c] - one.drive.excitation[c]);
            ++used;
        }
    ASSERT_GT(used, 0);
    EXPECT_LT(error / used, 0.1);
    // Its script is one that can be played
    const rig::RigDescription rig = rig::read_rig(kAdult);
    const track::ChannelTable channels = rig.channels();
    const track::ScriptDescription script = track::read_script(other.path() / "solved/script.json",
                                                               channels, rig.facs, rig.expressions);
    const track::Drive shown = track::Timeline(script, channels).at(0.5);
    for (long c = 0; c < truth.size(); ++c)
        EXPECT_NEAR(std::isnan(shown.activation[c]) ? 0.0 : shown.activation[c],
                    one.drive.excitation[c], 1e-6);
    EXPECT_THROW(inverse::solve_activations({.rig = kAdult, .out = other.path() / "none"}), Error);
}

// Landmarks of a smile on a head that turns and goes away meanwhile, as a camera sees them
TEST_F(BakedShapes, AreFoundInLandmarksOverTime) {
    const scene::RigFiles files = scene::read_rig_files(kAdult);
    const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
    const scene::LandmarkPoints points(head, files.rig);
    const Points smiling =
        head.vertices + shape("mouthSmileLeft").shape.dense(head.vertices.rows());
    const Rigid turn = Eigen::Translation3d(0.02, -0.01, 0.05) *
                       Eigen::AngleAxisd(0.2, Vec3(0.3, 1, 0.1).normalized());
    const TemporaryFolder other;
    {
        std::ofstream table(other.path() / "seen.tsv");
        table << "time_s";
        for (const std::string& id : points.ids())
            for (const char axis : {'x', 'y', 'z'}) table << "\t" << id << "." << axis << "_mm";
        for (const bool smiles : {false, true}) {
            table << "\n" << (smiles ? 0.1 : 0.0);
            for (const std::string& id : points.ids()) {
                const Vec3 p = points.at(id, smiles ? smiling : head.vertices);
                for (const double mm : Vec3(1e3 * (smiles ? turn * p : p))) table << "\t" << mm;
            }
        }
        table << "\n";
    }
    const inverse::SolveReport solved =
        inverse::solve_activations({.rig = kAdult,
                                    .out = other.path() / "solved",
                                    .landmarks = other.path() / "seen.tsv",
                                    .as = "muscles"});
    ASSERT_EQ(solved.solved.size(), 2u);
    EXPECT_TRUE(solved.sequence);
    EXPECT_EQ(solved.solved[0].highest, 0);
    const inverse::SolvedDrive& smile = solved.solved[1];
    EXPECT_GT(smile.given_rms_m, 1e-3);
    EXPECT_LT(smile.given_rms_m, 4e-3);  // the turn is not the face's
    EXPECT_LT(smile.rms_m, 0.3 * smile.given_rms_m);
    const track::ChannelTable channels = files.rig.channels();
    const auto pull = [&](Side side) {
        return smile.drive.excitation[channels.column("zygomaticus_major", side)];
    };
    EXPECT_GT(pull(Side::kLeft), 0.1);
    EXPECT_LT(pull(Side::kRight), 0.05);
    EXPECT_TRUE(fs::exists(other.path() / "solved/script.json"));
}

// The whole set: without correctives it takes half a minute.
TEST(BakedWholeSet, EveryPartHasTheShapesThatMoveIt) {
    const TemporaryFolder folder;
    ShapesOptions all{.rig = kAdult, .out = folder.path() / "whole", .formats = {"glb"}};
    all.texture_px = 0;
    all.pictures = all.correctives = false;
    all.test_frames = 0;
    const ShapesReport report = bake_shapes(all);
    EXPECT_EQ(report.shapes.list.size(), 52u);
    const std::string bytes = read_file(all.out / "shapes.glb", {"a face", 20 * kMegabyte});
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    const Json gltf = Json::parse(bytes.substr(20, length));
    std::map<std::string, std::size_t> keys;
    for (const Json& mesh : gltf["meshes"])
        for (const Json& primitive : mesh["primitives"]) {
            const std::size_t count = primitive.value("targets", Json::array()).size();
            EXPECT_EQ(keys.emplace(mesh["name"], count).first->second, count) << mesh["name"];
        }
    const std::map<std::string, std::size_t> wanted{
        {"Face", 52},      {"EyeLeft", 4},    {"EyeRight", 4}, {"Lashes", 34},
        {"TeethUpper", 0}, {"TeethLower", 5}, {"Tongue", 5}};
    EXPECT_EQ(keys, wanted);
}

TEST(BakedShapesOfNothing, LeaveNothingBehind) {
    const TemporaryFolder folder;
    EXPECT_THROW(bake_shapes({.rig = folder.path() / "none.json", .out = folder.path() / "out"}),
                 Error);
    EXPECT_THROW(bake_shapes({.rig = kAdult, .out = folder.path() / "out", .set = "arkit"}), Error);
    EXPECT_THROW(bake_shapes({.rig = kAdult, .out = folder.path() / "out", .formats = {"fbx"}}),
                 Error);
    EXPECT_THROW(bake_shapes({.rig = kAdult, .out = folder.path() / "out"},
                             {.progress = {}, .stopped = [] { return true; }}),
                 Interrupted);
    EXPECT_TRUE(folder.listing().empty());
}

}  // namespace
}  // namespace risorius::blendshapes
