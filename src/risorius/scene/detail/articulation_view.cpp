// SPDX-License-Identifier: MIT
#include "risorius/scene/detail/articulation_view.h"

#include <algorithm>

#include "risorius/geom/plane_section.h"
#include "risorius/render/section_picture.h"

namespace risorius::scene {

namespace {

constexpr double kShown_mm = 100;  // height of the picture
constexpr double kBefore_mm = 20;  // of the lips, in front of them: a nose
constexpr double kBesideTeeth_mm = 4;

}  // namespace

ArticulationView::ArticulationView(const render::Scene& scene, const rig::Head& head)
    : rest_(scene.rest),
      middle_x_(head.landmark("ls").x()),
      mouth_y_(head.landmark("sto").y()),
      lips_z_(head.landmark("ls").z()),
      millimetre_(head.mm(1)) {
    using render::Material;
    struct Look {
        Material material;
        Vec3 ink;
        double fill, line, beside_mm;
    };
    // From back to front
    const Look looks[] = {{Material::kMouth, {0.72, 0.42, 0.40}, 0, 0.004, 0},
                          {Material::kTongue, {0.82, 0.40, 0.42}, 0.8, 0.005, 0},
                          {Material::kGums, {0.86, 0.60, 0.58}, 0.6, 0.002, kBesideTeeth_mm},
                          {Material::kTeeth, {0.35, 0.42, 0.50}, 0.45, 0.004, kBesideTeeth_mm},
                          {Material::kSkin, {0.25, 0.16, 0.13}, 0, 0.008, 0}};
    for (const Look& look : looks)
        for (const render::Surface& surface : scene.surfaces)
            if (surface.material == look.material)
                parts_.push_back(
                    {surface.triangles, look.ink, look.fill, look.line, look.beside_mm});
    // The leftmost, the rightmost and the foremost vertex of the upper teeth
    for (long v = 0; v < rest_.rows(); ++v) {
        if (head.carrier[static_cast<std::size_t>(v)] != rig::Carrier::kSkull) continue;
        const int one = static_cast<int>(v);
        if (rigid_[0] < 0) rigid_ = {one, one, one};
        if (rest_(one, 0) > rest_(rigid_[0], 0)) rigid_[0] = one;
        if (rest_(one, 0) < rest_(rigid_[1], 0)) rigid_[1] = one;
        if (rest_(one, 2) > rest_(rigid_[2], 2)) rigid_[2] = one;
    }
}

Rigid ArticulationView::skull_of(const Points& positions) const {
    const auto at = [&](int k) {
        return Vec3(positions.row(rigid_[static_cast<std::size_t>(k)]).transpose());
    };
    Rigid out = Rigid::Identity();
    const Vec3 x = (at(0) - at(1)).normalized();
    const Vec3 y = (at(2) - at(1)).cross(x).normalized();
    out.linear().col(0) = x;
    out.linear().col(1) = y;
    out.linear().col(2) = x.cross(y);
    out.translation() = at(2);
    return out;
}

void ArticulationView::draw(const Points& positions, Image& image) const {
    Points in_head = positions;
    if (rigid_[0] >= 0) {
        const Rigid back = skull_of(rest_) * skull_of(positions).inverse();
        in_head =
            ((positions * back.linear().transpose()).rowwise() + back.translation().transpose())
                .eval();
    }
    const double scale = image.height_px / (kShown_mm * millimetre_);
    const double left_px =
        std::max(0.0, (image.width_px - image.height_px) / 2.0);  // of a square in the middle
    const auto in_picture = [&](const Vec2& yz) {
        return Vec2(left_px + (lips_z_ + kBefore_mm * millimetre_ - yz.y()) * scale,
                    image.height_px / 2.0 - (yz.x() - mouth_y_) * scale);
    };
    std::vector<render::SectionPart> sections;
    for (const Part& part : parts_) {
        render::SectionPart section{.segments = {},
                                    .ink = part.ink,
                                    .fill = part.fill,
                                    .line_px = std::max(1.0, part.line * image.height_px)};
        for (const auto& [a, b] :
             geom::plane_section(part.triangles, in_head, middle_x_ + part.beside_mm * millimetre_))
            section.segments.emplace_back(in_picture(a), in_picture(b));
        sections.push_back(std::move(section));
    }
    render::draw_sections(sections, image);
}

}  // namespace risorius::scene
