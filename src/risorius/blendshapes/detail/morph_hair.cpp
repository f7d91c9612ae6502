// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/morph_hair.h"

#include <algorithm>
#include <numeric>

#include "risorius/core/srgb.h"
#include "risorius/media/image_file.h"
#include "risorius/render/hair_cards.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::blendshapes {

namespace {

// A shape of which no card moves farther than the first has none of the hair, and of the others what moves less is left out: m.
constexpr double kHairRests_m = 0.3e-3, kCardRests_m = 0.1e-3;

io::MorphPart part_of_hair(const char* name, const Triangles& triangles, int first,
                           double roughness, const render::HairCards& hair) {
    io::MorphPart part;
    part.name = name;
    part.triangles = triangles.array() + first;
    part.texcoords.resize(triangles.size(), 2);
    for (long c = 0; c < triangles.size(); ++c)
        part.texcoords.row(c) = hair.texcoords.row(triangles(c / 3, c % 3));
    part.roughness = roughness;
    part.normals_turn = false;
    return part;
}

/// Adds to a target how the skin below the hair moves it.
void move_hair(const render::HairCards& hair, int first, io::MorphTarget& target) {
    Points skin = Points::Zero(first, 3);
    for (std::size_t i = 0; i < target.vertex.size(); ++i)
        skin.row(target.vertex[i]) = target.delta.row(static_cast<long>(i));
    const Points moved = hair.moved(skin);
    const Eigen::VectorXd distance = moved.rowwise().norm();
    if (target.usual_weight * distance.maxCoeff() < kHairRests_m) return;
    for (long v = 0; v < moved.rows(); ++v) {
        if (distance[v] < kCardRests_m) continue;
        target.vertex.push_back(first + static_cast<int>(v));
    }
    const long before = target.delta.rows();
    target.delta.conservativeResize(static_cast<long>(target.vertex.size()), 3);
    for (long i = before; i < target.delta.rows(); ++i)
        target.delta.row(i) = moved.row(target.vertex[static_cast<std::size_t>(i)] - first);
}

}  // namespace

void add_hair(const scene::RigFiles& files, const rig::Head& head, io::MorphModel& model) {
    if (files.rig.appearance.hair_style == "shaven") return;
    const render::Scene scene = scene::scene_from_rig(head, files.rig, files.mesh);
    const render::HairCards hair = render::hair_cards(scene);
    if (hair.empty()) return;
    const auto joint = std::find_if(model.nodes.begin(), model.nodes.end(),
                                    [](const io::MorphNode& node) { return node.name == "Head"; });
    io::MorphNode node{.name = "Hair"};
    if (joint != model.nodes.end()) {
        node.parent = static_cast<int>(joint - model.nodes.begin());
        node.place = joint->place;
    }
    model.nodes.push_back(std::move(node));

    const auto first = static_cast<int>(model.vertices.rows());
    const long count = hair.vertices.rows(), all = first + count;
    model.vertices.conservativeResize(all, 3);
    model.vertices.bottomRows(count) = hair.vertices;
    model.worn_normals = hair.normals;
    if (!model.stands_for.empty()) {
        model.stands_for.resize(static_cast<std::size_t>(all));
        std::iota(model.stands_for.begin() + first, model.stands_for.end(), first);
    }
    const char* const name = "hair";
    model.pictures.push_back(
        {name, "image/png", media::png_bytes(render::hair_card_picture(scene.appearance), name)});
    // The cap is smooth, and would mirror the lamp like a ball.
    io::MorphPart cards = part_of_hair("Hair", hair.cards, first, 0.6, hair),
                  cap = part_of_hair("HairCap", hair.cap, first, 0.9, hair);
    cards.see_both_sides = cards.picture_cuts = true;
    cards.cut_at = render::kHairAlpha;
    for (io::MorphPart* part : {&cards, &cap}) {
        if (part->triangles.rows() == 0) continue;
        part->node = static_cast<int>(model.nodes.size()) - 1;
        part->picture = static_cast<int>(model.pictures.size()) - 1;
        part->tint = Points::Ones(all, 3);
        for (long v = 0; v < count; ++v)
            part->tint.row(first + v).setConstant(
                srgb_of_linear(hair.shade[static_cast<std::size_t>(v)]));
        model.parts.push_back(std::move(*part));
    }
    for (io::MorphTarget& target : model.targets) move_hair(hair, first, target);
}

}  // namespace risorius::blendshapes
