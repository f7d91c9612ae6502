// SPDX-License-Identifier: MIT
// Lips and the cavity behind them: skin loops, vermilion, the line of contact, the inner lip and a bag round the teeth.
#include <cmath>

#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {
namespace {

constexpr int kHalfLoop = 30, kCorner = 15;
constexpr double kLipLine_mm =
    -52.6;  ///< height of the line of the lips, where `up` and `down` of a section begin
constexpr double kSquareness = 0.6;  ///< of the sections of the cavity: 1 an ellipse, 0 a box

/// As even by length as lets every point be a vertex, `count` steps.
std::vector<Vec3> even_curve(const std::vector<Vec3>& points, int count) {
    std::vector<std::pair<double, Vec3>> through;
    double length = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (k > 0) length += (points[k] - points[k - 1]).norm();
        through.emplace_back(length, points[k]);
    }
    for (auto& t : through) t.first = std::round(t.first * count / length);
    return curve_points(through, count, false);
}

Vec3 mirror(Vec3 p) {
    p.x() = -p.x();
    return p;
}

// A curve of one lip from the midline to the corner.
std::vector<Vec3> border_lip(const std::vector<Vec3>& right) {
    // The curve is made over both sides so that it crosses the midline level.
    std::vector<Vec3> both;
    for (auto p = right.rbegin(); p != right.rend(); ++p)
        if (p->x() > 0) both.push_back(mirror(*p));
    for (const Vec3& p : right) both.push_back(p);
    const auto curve = even_curve(both, 2 * kCorner);
    return std::vector<Vec3>(curve.begin() + kCorner, curve.end());
}

// Landmarks of the border of the red and of the free margins are the vertices nearest to their places in the tables.
void name_lip_landmarks(Skin& skin, const std::vector<int>& red, const DesignTables& tables) {
    const HalfMesh& mesh = skin.mesh;
    const auto name = [&](const char* id, const std::vector<int>& along) {
        int best = along[0];
        for (const int v : along)
            if ((mesh.point[static_cast<std::size_t>(v)] - tables.landmarks.at(id)).squaredNorm() <
                (mesh.point[static_cast<std::size_t>(best)] - tables.landmarks.at(id))
                    .squaredNorm())
                best = v;
        skin.landmark[id] = best;
    };
    const std::vector<int> upper_red(red.begin() + kCorner, red.end()),
        lower_red(red.begin(), red.begin() + kCorner);
    for (const char* id : {"ls", "cph_l", "ulc_l", "ch_l"}) name(id, upper_red);
    for (const char* id : {"li", "llc_l"}) name(id, lower_red);
    skin.landmark["stos"] = skin.landmark["sto"] = skin.upper_margin[0];
    skin.landmark["stoi"] = skin.lower_margin[0];
    name("uli_l", {skin.upper_margin.begin() + 1, skin.upper_margin.end() - 1});
    name("lli_l", {skin.lower_margin.begin() + 1, skin.lower_margin.end() - 1});
}

Vec3 on_section(const MouthSection& section, int k) {
    const double angle = M_PI * k / kHalfLoop;  // 0 below, pi above
    const double c = -std::cos(angle), s = std::sin(angle);
    const double x = section.half_width * std::pow(std::abs(s), kSquareness);
    const double y = kLipLine_mm + (c > 0 ? section.up : section.down) *
                                       std::copysign(std::pow(std::abs(c), kSquareness), c);
    const double w = x / section.half_width;
    return Vec3(
        k == 0 || k == kHalfLoop ? 0 : x, y,
        0.5 * (1 + c) * section.front + 0.5 * (1 - c) * section.front_below - section.bend * w * w);
}

// The throat closes with two rows of quads, from a vertex on the midline to the corners.
void close_throat(HalfMesh& mesh, const std::vector<int>& previous) {
    constexpr int kRows = 2;
    std::vector<int> throat{previous[kHalfLoop]};
    const Vec3 floor = mesh.point[static_cast<std::size_t>(previous[0])],
               roof = mesh.point[static_cast<std::size_t>(previous[kHalfLoop])];
    for (int r = 1; r < kRows; ++r)
        throat.push_back(mesh.add(roof + (floor - roof) * r / kRows, Hold::kPinned, true));
    throat.insert(throat.end(), previous.begin(), previous.end() - 1);
    mesh.fill(throat, kRows, (kHalfLoop - kRows) / 2, Hold::kPinned, 1);
}

}  // namespace

void add_mouth(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
               const HeadSurface& head) {
    HalfMesh& mesh = skin.mesh;
    const auto at = [&](const char* id) { return tables.landmarks.at(id); };

    // Vermilion border and free margins, from the midline of the lower lip over the corner to that of the upper lip.
    const std::vector<Vec3> upper = border_lip({at("ls"), at("cph_l"), at("ulc_l"), at("ch_l")});
    const std::vector<Vec3> lower = border_lip({at("li"), at("llc_l"), at("ch_l")});
    const std::vector<Vec3> meet = border_lip(tables.lip_contact);
    constexpr double kHalfGap = 0.06;
    const auto is_upper = [](int k) { return k > kCorner; };
    const auto border = [&](int k) { return k <= kCorner ? lower[k] : upper[kHalfLoop - k]; };
    const auto contact = [&](int k) {
        Vec3 p = meet[k <= kCorner ? k : kHalfLoop - k];
        if (k != kCorner) p.y() += is_upper(k) ? kHalfGap : -kHalfGap;
        return p;
    };

    std::vector<int> previous = block;
    const auto ring = [&](const std::function<Vec3(int)>& place, Hold hold, int group) {
        std::vector<int> ids;
        for (int k = 0; k <= kHalfLoop; ++k)
            ids.push_back(mesh.add(place(k), hold, k == 0 || k == kHalfLoop));
        mesh.bridge(previous, ids, false, group);
        previous = ids;
        return ids;
    };
    constexpr int kSkinRings = 4;
    for (int r = 1; r <= kSkinRings; ++r) {
        const double t = static_cast<double>(r) / (kSkinRings + 1);
        ring(
            [&](int k) {
                return head.project((1 - t) * mesh.point[static_cast<std::size_t>(block[k])] +
                                    t * border(k));
            },
            Hold::kOnHead, 0);
    }
    const std::size_t first_fixed = mesh.point.size();
    const std::vector<int> red = ring(border, Hold::kPinned, 0);
    mesh.adding = Region::kLips;
    // Across the red of the lip: full at first, then turning in to the line of contact.
    const auto across = [&](int k, double t) {
        const Vec3 b = border(k), m = contact(k);
        const double side = std::abs(k - kCorner) / static_cast<double>(kCorner);
        Vec3 full = b;
        const double fullness = std::min(1.0, 1.6 * side);
        full.y() = m.y() + (is_upper(k) ? 0.3 : -0.8) * fullness;
        full.z() = b.z() + (is_upper(k) ? -0.9 : 3.0) * fullness;
        full.x() = 0.5 * (b.x() + m.x());
        return Vec3((1 - t) * (1 - t) * b + 2 * t * (1 - t) * full + t * t * m);
    };
    for (const double t : {0.22, 0.44, 0.66, 0.84})
        ring([&](int k) { return across(k, t); }, Hold::kPinned, 0);
    const std::vector<int> margin = ring(contact, Hold::kPinned, 0);
    mesh.adding = Region::kLining;
    for (int k = 0; k <= kCorner; ++k) {
        skin.lower_margin.push_back(margin[k]);
        skin.upper_margin.push_back(margin[kHalfLoop - k]);
    }
    name_lip_landmarks(skin, red, tables);
    // The lips touch over some millimetres before they part behind the teeth line.
    for (const double depth : {1.2, 2.6})
        ring(
            [&](int k) {
                Vec3 p = contact(k);
                p.x() *= 1 - 0.016 * depth;
                p.z() -= depth;
                return p;
            },
            Hold::kPinned, 0);
    for (const MouthSection& section : tables.mouth_sections)
        ring([&](int k) { return on_section(section, k); }, Hold::kPinned, 1);
    close_throat(mesh, previous);
    for (std::size_t v = first_fixed; v < mesh.point.size(); ++v)
        skin.fixed.push_back(static_cast<int>(v));
}

}  // namespace risorius::headmodel
