// SPDX-License-Identifier: MIT
// The head that other programs get: names, pictures, joints that turn it as Risorius does, and a dark mouth.
#include "risorius/blendshapes/detail/morph_head.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "blendshapes/adult_suite.h"
#include "message_of.h"
#include "risorius/blendshapes/detail/mouth_shade.h"
#include "risorius/face/surfaces.h"

namespace risorius::blendshapes {
namespace {

/// The adult, built once for all tests of the suite.
class MorphHead : public AdultSuite {
  protected:
    static void SetUpTestSuite() {
        AdultSuite::SetUpTestSuite();
        model_ = std::make_unique<io::MorphModel>(morph_head(*files_, *face_, 256, EyesBy::kBoth));
    }
    static void TearDownTestSuite() {
        model_.reset();
        AdultSuite::TearDownTestSuite();
    }
    static int node(const std::string& name) { return node_of(*model_, name); }
    static track::Drive drive() {
        track::Drive out;
        out.excitation = Eigen::VectorXd::Zero(face_->activation().size());
        return out;
    }
    static std::unique_ptr<io::MorphModel> model_;
};
std::unique_ptr<io::MorphModel> MorphHead::model_;

double& at(track::Drive& drive, track::Kinematic channel) {
    return drive.kinematic[static_cast<std::size_t>(channel)];
}

TEST_F(MorphHead, HasTheNamesThatOtherProgramsKnowAndAPictureForEachSubstance) {
    std::set<std::string> shown, substances;
    long triangles = 0;
    for (const io::MorphPart& part : model_->parts) {
        shown.insert(model_->nodes[static_cast<std::size_t>(part.node)].name);
        substances.insert(part.name);
        EXPECT_GE(part.picture, 0) << part.name;
        EXPECT_EQ(part.texcoords.rows(), 3 * part.triangles.rows());
        triangles += part.triangles.rows();
    }
    EXPECT_EQ(shown, (std::set<std::string>{"EyeLeft", "EyeRight", "Face", "Lashes", "TeethLower",
                                            "TeethUpper", "Tongue"}));
    EXPECT_EQ(substances, (std::set<std::string>{"Eyes", "Gums", "Lashes", "Mouth", "Skin", "Teeth",
                                                 "Tongue"}));
    EXPECT_LE(model_->parts.size(), 13u);  // draw calls
    EXPECT_EQ(model_->pictures.size(), 6u);
    EXPECT_EQ(triangles, geom::triangulate(files_->mesh).rows());
    // Without pictures of the look, parts have colours, and each eye its iris.
    const io::MorphModel plain = morph_head(*files_, *face_, 0, EyesBy::kBone);
    EXPECT_EQ(plain.pictures.size(), 1u);  // of the lashes, which are solid ribbons without it
    int eyes = 0;
    for (const io::MorphPart& part : plain.parts) eyes += part.tint.rows() > 0;
    EXPECT_EQ(eyes, 2);
}

TEST_F(MorphHead, JointsTurnItAsTheSimulationDoes) {
    track::Drive turned = drive();
    at(turned, track::Kinematic::kHeadYaw) = 30;
    at(turned, track::Kinematic::kHeadForward) = 5;
    const std::vector<io::NodeMotion> motions = node_motions(*model_, *face_, {drive(), turned});
    ASSERT_EQ(motions.size(), 2u);  // Neck and Head; the eyes rest in their sockets
    std::map<int, Rigid> place;
    for (const int joint : model_->skin.joints) place[joint] = Rigid::Identity();
    for (const io::NodeMotion& motion : motions) {
        const Vec3 pivot = model_->nodes[static_cast<std::size_t>(motion.node)].place;
        Rigid& rigid = place[motion.node];
        rigid.translate(pivot + motion.shift[1]);
        rigid.rotate(motion.turn[1]);
        rigid.translate(-pivot);
    }
    const Points& rest = face_->head().vertices;
    const Points posed = face_->surfaces().posed(rest, turned).vertices;
    double worst = 0, shoulders = 0;
    for (const io::MorphPart& part : model_->parts) {
        const bool skinned = part.node == model_->skin.node;
        for (const int v : part.triangles.reshaped()) {
            const Vec3 from = rest.row(v);
            Vec3 to = Vec3::Zero();
            for (std::size_t j = 0; j < model_->skin.joints.size(); ++j)
                to += (skinned ? model_->skin.weights(v, static_cast<long>(j)) : j == 2) *
                      (place[model_->skin.joints[j]] * from);
            worst = std::max(worst, (to - posed.row(v).transpose()).norm());
            if (skinned && model_->skin.weights(v, 0) == 1)
                shoulders = std::max(shoulders, (to - from).norm());
        }
    }
    EXPECT_LT(worst, 1.5e-3);
    EXPECT_LT(shoulders, 1e-5);
    RecordProperty("neck_um", std::to_string(1e6 * worst));
}

TEST_F(MorphHead, EyesTurnAboutTheirCentres) {
    track::Drive glance = drive();
    at(glance, track::Kinematic::kGazeYawLeft) = 17.8;
    const std::vector<io::NodeMotion> motions = node_motions(*model_, *face_, {drive(), glance});
    ASSERT_EQ(motions.size(), 1u);
    EXPECT_EQ(motions[0].node, node("LeftEye"));
    EXPECT_TRUE(motions[0].shift.empty());
    const Vec3 centre = model_->nodes[static_cast<std::size_t>(node("LeftEye"))].place;
    EXPECT_LT((centre - face_->head().eyes[0].centre).norm(), 1e-12);
    EXPECT_FALSE(model_->nodes[static_cast<std::size_t>(node("EyeLeft"))].animate_shapes);
    const Points posed = face_->surfaces().posed(face_->head().vertices, glance).vertices;
    double
        front = 0,
        pupil =
            0;  // the farthest vertex forward at rest, and how far it is from the pivot when turned
    for (const io::MorphPart& part : model_->parts)
        if (part.node == node("EyeLeft"))
            for (const int v : part.triangles.reshaped()) {
                const Vec3 from = face_->head().vertices.row(v).transpose() - centre,
                           to = motions[0].turn[1] * from;
                EXPECT_LT((centre + to - posed.row(v).transpose()).norm(), 1e-9);
                if (const double along = from.dot(face_->head().eyes[0].forward); along > front) {
                    front = along;
                    pupil = to.norm();
                }
            }
    // As at rest: shapes alone, which are straight, would leave 11.87 mm of it.
    EXPECT_NEAR(pupil, 12.44e-3, 0.01e-3);
}

TEST_F(MorphHead, EyesTurnByShapesOrByNodesAsAsked) {
    track::Drive glance = drive();
    at(glance, track::Kinematic::kGazeYawLeft) = 17.8;
    const auto eye = [&](const io::MorphModel& model) {
        return model.nodes[static_cast<std::size_t>(node("EyeLeft"))];
    };
    EXPECT_TRUE(eye(*model_).has_shapes);
    const io::MorphModel morph = morph_head(*files_, *face_, 0, EyesBy::kMorph);
    EXPECT_TRUE(eye(morph).animate_shapes);
    EXPECT_TRUE(node_motions(morph, *face_, {drive(), glance}).empty());
    io::MorphModel bone = morph_head(*files_, *face_, 0, EyesBy::kBone);
    EXPECT_EQ(node_motions(bone, *face_, {drive(), glance}).size(), 1u);
    // The file of "bone" has no target on the eyeballs, though a shape moves their vertices.
    io::MorphTarget& look = bone.targets.emplace_back();
    look.name = "eyeLookOutLeft";
    for (long v = 0; v < bone.vertices.rows(); ++v) look.vertex.push_back(static_cast<int>(v));
    look.delta = Points::Constant(bone.vertices.rows(), 3, 1e-3);
    const auto targets_of_eyes = [&] {
        const std::string bytes = io::glb_bytes(bone);
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, sizeof length);
        const Json parsed = Json::parse(bytes.substr(20, length));
        std::map<std::string, bool> has;
        for (const Json& mesh : parsed["meshes"])
            has[mesh["name"]] = mesh["primitives"][0].contains("targets");
        return has;
    };
    EXPECT_FALSE(targets_of_eyes().at("EyeLeft"));
    EXPECT_TRUE(targets_of_eyes().at("Lashes"));
    EXPECT_EQ(message_of([] { eyes_named("bones"); }),
              "eyes: expected one of \"morph\", \"bone\", \"both\" (did you mean \"bone\"?), found "
              "\"bones\"");
}

TEST_F(MorphHead, TheLowerTeethTellTheAxisOfTheJaw) {
    io::MorphModel model = *model_;
    const auto extras = [&] {
        return model.nodes[static_cast<std::size_t>(node("TeethLower"))].extras;
    };
    describe_jaw(model);
    EXPECT_TRUE(extras().is_null());  // no shape opens it
    // A turn of 0.3 rad about an axis that leans a little, with a slide of 2 mm along it
    const Vec3 pivot(0.001, -0.0137, 0.0038), axis = Vec3(1, 0.1, 0).normalized();
    const Rigid turn = Eigen::Translation3d(pivot + 0.002 * axis) * Eigen::AngleAxisd(0.3, axis) *
                       Eigen::Translation3d(-pivot);
    io::MorphTarget& open = model.targets.emplace_back();
    open.name = "jawOpen";
    open.delta.resize(model.vertices.rows(), 3);
    for (long v = 0; v < model.vertices.rows(); ++v) {
        const Vec3 at = model.vertices.row(v);
        open.vertex.push_back(static_cast<int>(v));
        open.delta.row(v) = (turn * at - at).transpose();
    }
    describe_jaw(model);
    const Json jaw = extras().at("jaw");
    const auto vector = [&](const char* key) {
        return Vec3(jaw.at(key).at(0).get<double>(), jaw.at(key).at(1).get<double>(),
                    jaw.at(key).at(2).get<double>());
    };
    EXPECT_LT((vector("axis") - axis).norm(), 1e-9);
    EXPECT_LT((vector("pivot_m") - pivot).cross(axis).norm(), 1e-9);  // a point of the axis
    EXPECT_NEAR(jaw.at("angle_deg").get<double>(), 0.3 * 180 / 3.14159265358979, 1e-9);
    EXPECT_NEAR(jaw.at("slide_m").get<double>(), 0.002, 1e-9);
}

TEST_F(MorphHead, TheMouthIsDarkInsideAndBrightAtTheLips) {
    io::MorphModel model = *model_;
    shade_mouth(face_->head(), model);
    // The wall of the mouth: the farther behind the lips, the darker
    const double lips = face_->head().landmark("sto").z();
    double near = 0, deep = 0;
    int at_lips = 0, inside = 0;
    for (const io::MorphPart& part : model.parts) {
        EXPECT_EQ(part.tint.rows() > 0,
                  part.name != "Skin" && part.name != "Eyes" && part.name != "Lashes")
            << part.name;
        if (part.name != "Tongue") continue;
        for (const int v : part.triangles.reshaped()) {
            const double behind = lips - model.vertices(v, 2);
            (behind < 0.02 ? near : deep) += part.tint(v, 0);
            ++(behind < 0.02 ? at_lips : inside);
        }
    }
    ASSERT_GT(at_lips, 0);
    ASSERT_GT(inside, 0);
    EXPECT_LT(deep / inside, near / at_lips + 1e-9);
    EXPECT_LT(deep / inside, 0.4);
}

// Teeth that the lips cover while the jaw is open are seen in a smile, and must not be black in it.
TEST_F(MorphHead, TeethAreAsBrightAsLipsThatBareThemLetThemBe) {
    const auto brightest = [&](const io::MorphModel& model) {
        double most = 0;
        for (const io::MorphPart& part : model.parts)
            if (part.name == "Teeth")
                for (const int v : part.triangles.reshaped())
                    most = std::max(most, part.tint(v, 0));
        return most;
    };
    io::MorphModel shut = *model_;
    shade_mouth(face_->head(), shut);
    // The upper lip goes up by 8 mm, without the jaw.
    io::MorphModel bared = *model_;
    io::MorphTarget& up = bared.targets.emplace_back();
    up.name = "lip up";
    const Vec3 lip = face_->head().landmark("ls");
    std::set<int> skin;
    for (const io::MorphPart& part : bared.parts)
        if (part.name == "Skin")
            skin.insert(part.triangles.reshaped().begin(), part.triangles.reshaped().end());
    for (const int v : skin)
        if ((bared.vertices.row(v).transpose() - lip).norm() < 0.03 &&
            bared.vertices(v, 1) > face_->head().landmark("sto").y())
            up.vertex.push_back(v);
    up.delta = Points::Zero(static_cast<long>(up.vertex.size()), 3);
    up.delta.col(1).setConstant(0.008);
    shade_mouth(face_->head(), bared);
    EXPECT_GT(brightest(bared), brightest(shut) + 0.2);
}

}  // namespace
}  // namespace risorius::blendshapes
