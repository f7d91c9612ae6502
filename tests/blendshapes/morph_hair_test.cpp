// SPDX-License-Identifier: MIT
// The hair that other programs get: which cards each style has, and that they stay on the head.
#include "risorius/blendshapes/detail/morph_hair.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "blendshapes/adult_suite.h"
#include "risorius/blendshapes/detail/morph_head.h"
#include "risorius/face/surfaces.h"
#include "risorius/io/coarser_model.h"
#include "risorius/render/hair_styles.h"
#include "temporary_folder.h"

namespace risorius::blendshapes {
namespace {

/// The adult without hair, built once; each test adds hair to a copy.
class MorphHair : public AdultSuite {
  protected:
    static void SetUpTestSuite() {
        AdultSuite::SetUpTestSuite();
        bald_ = std::make_unique<io::MorphModel>(morph_head(*files_, *face_, 0, EyesBy::kBoth));
    }
    static void TearDownTestSuite() {
        bald_.reset();
        AdultSuite::TearDownTestSuite();
    }
    static io::MorphModel with_hair(const std::string& style, io::MorphModel model) {
        scene::RigFiles files = *files_;
        files.rig.appearance.hair_style = style;
        add_hair(files, face_->head(), model);
        return model;
    }
    static io::MorphModel with_hair(const std::string& style) { return with_hair(style, *bald_); }
    static Json json_of(const std::string& glb) {
        std::uint32_t length = 0;
        std::memcpy(&length, glb.data() + 12, sizeof length);
        return Json::parse(glb.substr(20, length));
    }
    static std::unique_ptr<io::MorphModel> bald_;
};
std::unique_ptr<io::MorphModel> MorphHair::bald_;

TEST_F(MorphHair, EveryStyleIsANodeBelowTheHeadWithItsCards) {
    // Triangles of the cards and of the cap on the adult
    const std::map<std::string, std::pair<long, long>> kTriangles{
        {"crop", {7000, 3720}},     {"short_parted", {5582, 3720}}, {"curly_short", {18786, 3720}},
        {"afro", {20868, 3720}},    {"bob", {7192, 3720}},          {"long_tied", {18288, 3720}},
        {"bald_fringe", {2900, 0}},
    };
    for (const std::string& style : render::hair_style_names()) {
        const io::MorphModel model = with_hair(style);
        const int hair = node_of(model, "Hair");
        if (style == "shaven") {
            EXPECT_EQ(hair, -1);
            EXPECT_EQ(io::glb_bytes(model), io::glb_bytes(*bald_));
            continue;
        }
        ASSERT_GE(hair, 0) << style;
        const io::MorphNode& shown = model.nodes[static_cast<std::size_t>(hair)];
        EXPECT_EQ(shown.parent, node_of(model, "Head")) << style;
        std::map<std::string, long> triangles;
        for (const io::MorphPart& part : model.parts)
            if (part.node == hair) triangles[part.name] = part.triangles.rows();
        EXPECT_EQ(triangles["Hair"], kTriangles.at(style).first) << style;
        EXPECT_EQ(triangles["HairCap"], kTriangles.at(style).second) << style;
        EXPECT_EQ(model.pictures.size(), bald_->pictures.size() + 1) << style;
    }
}

TEST_F(MorphHair, TheFileHasAMaskedMaterialNormalsAndTextureCoordinatesAndIsTheSameTwice) {
    for (const bool compact : {false, true}) {
        io::MorphModel bald = *bald_;
        bald.targets.push_back({"jawOpen", {0}, Points::Constant(1, 3, 0.001)});
        bald.whole_numbers = compact;
        const io::MorphModel model = with_hair("bob", bald);
        const std::string bytes = io::glb_bytes(model);
        EXPECT_EQ(bytes, io::glb_bytes(model));
        const std::string without = io::glb_bytes(bald);
        EXPECT_LT(bytes.size() - without.size(), 700'000u);
        RecordProperty(compact ? "compact_bytes" : "bytes",
                       std::to_string(bytes.size() - without.size()));
        const Json json = json_of(bytes);
        const Json& mesh = json["meshes"].back();
        EXPECT_EQ(mesh["name"], "Hair");
        std::map<std::string, std::string> modes;
        for (const Json& primitive : mesh["primitives"]) {
            for (const char* attribute : {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"})
                EXPECT_TRUE(primitive["attributes"].contains(attribute)) << attribute;
            EXPECT_FALSE(primitive["attributes"].contains("_VERTEX"));
            const Json& material = json["materials"][primitive["material"].get<std::size_t>()];
            modes[material["name"]] = material.value("alphaMode", "OPAQUE");
            EXPECT_EQ(material.value("doubleSided", false), material["name"] == "Hair");
            EXPECT_TRUE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
        }
        EXPECT_EQ(modes,
                  (std::map<std::string, std::string>{{"Hair", "MASK"}, {"HairCap", "OPAQUE"}}));
        const TemporaryFolder folder;
        std::ofstream(folder.path() / "hair.glb", std::ios::binary) << bytes;
        std::ofstream(folder.path() / "bald.glb", std::ios::binary) << without;
        const io::MorphModel read = io::read_glb(folder.path() / "hair.glb"),
                             read_bald = io::read_glb(folder.path() / "bald.glb");
        EXPECT_EQ(read.vertices.rows(), read_bald.vertices.rows());
        EXPECT_EQ(read.parts.size(), read_bald.parts.size());
    }
}

TEST_F(MorphHair, CardsMoveWithTheSkinBelowThemAndRestWhereItRests) {
    // A shape lifts all of the skin above the brows by 3 mm, another one lifts the chin.
    io::MorphModel model = *bald_;
    const Vec3 brow = face_->head().landmark("bm_l"), chin = face_->head().landmark("me");
    for (const char* name : {"browInnerUp", "mouthShrugLower"}) {
        const bool up = std::string(name) == "browInnerUp";
        io::MorphTarget target{name, {}, {}};
        for (long v = 0; v < model.vertices.rows(); ++v)
            if (up ? model.vertices(v, 1) > brow.y() : model.vertices(v, 1) < chin.y())
                target.vertex.push_back(static_cast<int>(v));
        target.delta = Points::Zero(static_cast<long>(target.vertex.size()), 3);
        target.delta.col(1).setConstant(0.003);
        model.targets.push_back(std::move(target));
    }
    const io::MorphModel hairy = with_hair("short_parted", model);
    const long first = hairy.first_worn();
    ASSERT_EQ(first, bald_->vertices.rows());
    const io::MorphTarget& up = hairy.targets[0];
    long cards = 0;
    for (std::size_t i = 0; i < up.vertex.size(); ++i) {
        if (i > 0) {
            ASSERT_LT(up.vertex[i - 1], up.vertex[i]);
        }
        if (up.vertex[i] < first) continue;
        ++cards;
        // A card on the rim of what moves has a part of it.
        EXPECT_LE((up.delta.row(static_cast<long>(i)) - Eigen::RowVector3d(0, 0.003, 0)).norm(),
                  0.003);
    }
    EXPECT_GT(cards, (hairy.vertices.rows() - first) / 2);
    EXPECT_EQ(hairy.targets[1].vertex, model.targets[1].vertex);
    const Json json = json_of(io::glb_bytes(hairy));
    EXPECT_EQ(json["meshes"].back()["extras"]["targetNames"], Json({"browInnerUp"}));
}

TEST_F(MorphHair, TheJointTurnsItWithTheScalp) {
    track::Drive rest, turned;
    rest.excitation = turned.excitation = Eigen::VectorXd::Zero(face_->activation().size());
    turned.kinematic[static_cast<std::size_t>(track::Kinematic::kHeadYaw)] = 30;
    turned.kinematic[static_cast<std::size_t>(track::Kinematic::kHeadForward)] = 5;
    const io::MorphModel model = with_hair("afro");
    Rigid head = Rigid::Identity();
    for (const io::NodeMotion& motion : node_motions(model, *face_, {rest, turned}))
        if (motion.node == node_of(model, "Head")) {
            const Vec3 pivot = model.nodes[static_cast<std::size_t>(motion.node)].place;
            head = Eigen::Translation3d(pivot + motion.shift[1]) * motion.turn[1] *
                   Eigen::Translation3d(-pivot);
        }
    const Points posed = face_->surfaces().posed(bald_->vertices, turned).vertices;
    // The distance of each card from the nearest vertex of the scalp is what it is at rest.
    std::vector<long> scalp;
    for (long v = 0; v < bald_->vertices.rows(); v += 7)
        if (bald_->vertices(v, 1) > face_->head().landmark("tr").y()) scalp.push_back(v);
    ASSERT_GT(scalp.size(), 50u);
    double worst = 0;
    for (long v = model.first_worn(); v < model.vertices.rows(); v += 29) {
        const Vec3 at = model.vertices.row(v).transpose();
        long nearest = scalp[0];
        for (const long s : scalp)
            if ((bald_->vertices.row(s).transpose() - at).norm() <
                (bald_->vertices.row(nearest).transpose() - at).norm())
                nearest = s;
        const Vec3 before = at - bald_->vertices.row(nearest).transpose(),
                   after = head * at - posed.row(nearest).transpose();
        worst = std::max(worst, (after - head.linear() * before).norm());
    }
    EXPECT_LT(worst, 0.5e-3);
}

TEST_F(MorphHair, CoarserLevelsKeepAllOfIt) {
    const io::MorphModel model = with_hair("crop"), coarse = io::coarser_model(model, 0.5);
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
        const io::MorphPart &fine = model.parts[p], &few = coarse.parts[p];
        if (fine.name.starts_with("Hair")) {
            EXPECT_EQ(few.triangles, fine.triangles);
        } else if (fine.name == "Skin") {
            EXPECT_LT(few.triangles.rows(), fine.triangles.rows());
        }
    }
}

}  // namespace
}  // namespace risorius::blendshapes
