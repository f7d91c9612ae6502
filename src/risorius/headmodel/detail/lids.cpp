// SPDX-License-Identifier: MIT
// Lids: loops from the orbit to the margin, the margin's own thickness, and the inner face lying on the globe.
#include <algorithm>
#include <cmath>

#include "risorius/headmodel/detail/skin.h"

namespace risorius::headmodel {
namespace {

constexpr int kLoop = 44, kInner = 5, kOuter = 27;  ///< places of the canthi in the loop
constexpr double kGap = 0.3;

std::vector<Vec3> margin_curve(const DesignTables& tables) {
    // Each lid evenly by length, through the measured margin points.
    std::vector<Vec3> points(kLoop);
    const auto lid = [&](std::vector<const char*> ids, int from, int to) {
        std::vector<std::pair<double, Vec3>> through;
        double length = 0;
        for (std::size_t k = 0; k < ids.size(); ++k) {
            const Vec3 p = tables.landmarks.at(ids[k]);
            if (k > 0) length += (p - through.back().second).norm();
            through.emplace_back(length, p);
        }
        for (auto& t : through) t.first *= (to - from) / length;
        const auto curve = curve_points(through, to - from, false);
        for (int k = from; k <= to; ++k)
            points[static_cast<std::size_t>(k % kLoop)] = curve[static_cast<std::size_t>(k - from)];
    };
    lid({"en_l", "llm_l", "pi_l", "lll_l", "ex_l"}, kInner, kOuter);
    lid({"ex_l", "ull_l", "ps_l", "ulm_l", "en_l"}, kOuter, kLoop + kInner);
    return points;
}

// Each landmark of the margin is the vertex nearest to its place in the tables.
void name_margin_landmarks(Skin& skin, const DesignTables& tables) {
    const HalfMesh& mesh = skin.mesh;
    for (const char* id : {"en_l", "llm_l", "pi_l", "lll_l", "ex_l", "ull_l", "ps_l", "ulm_l"}) {
        int best = skin.lid_margin[0];
        for (const int v : skin.lid_margin)
            if ((mesh.point[static_cast<std::size_t>(v)] - tables.landmarks.at(id)).squaredNorm() <
                (mesh.point[static_cast<std::size_t>(best)] - tables.landmarks.at(id))
                    .squaredNorm())
                best = v;
        skin.landmark[id] = best;
    }
}

}  // namespace

void add_lids(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
              const HeadSurface& head, const Globe& globe) {
    HalfMesh& mesh = skin.mesh;
    const std::vector<Vec3> margin = margin_curve(tables);
    const Vec3 middle(31.2, 17.6, 0);
    const auto outwards = [&](int k) {
        Vec3 away = margin[k] - middle;
        away.z() = 0;
        away.x() *= 0.55;  // mostly up or down except at the canthi
        return away.normalized();
    };
    std::vector<int> previous = block;
    const auto ring = [&](const std::function<Vec3(int)>& place, Hold hold) {
        std::vector<int> ids;
        for (int k = 0; k < kLoop; ++k) ids.push_back(mesh.add(place(k), hold));
        mesh.bridge(previous, ids, true);
        previous = ids;
        return ids;
    };
    const auto before_margin = [&](int k) {
        return clear_of_globe(head.project(margin[k] + 1.5 * outwards(k)), globe, 1.3);
    };
    // The upper lid folds in along a crease some millimetres above its margin, and hangs over it a little.
    const double peak = (tables.landmarks.at("ucr_l") - tables.landmarks.at("ps_l")).norm();
    const auto lid_height = [&](int k, double fraction) {
        const int along = k >= kOuter ? k - kOuter : k < kInner ? k + kLoop - kOuter : -1;
        if (along < 0) return 0.0;
        const double u = static_cast<double>(along) / (kLoop + kInner - kOuter);
        return fraction * peak * std::pow(std::sin(M_PI * u), 0.7);
    };
    const auto on_lid = [&](int k, double height, double raise) {
        Vec3 p = head.project(margin[k] + height * outwards(k));
        p += raise * Vec3(0.25, -0.1, 1).normalized();
        return clear_of_globe(p, globe, 1.2);
    };
    constexpr int kSkinRings = 5;
    for (int r = 1; r <= kSkinRings; ++r) {
        const double t = static_cast<double>(r) / (kSkinRings + 1);
        const std::vector<int> ids = ring(
            [&](int k) {
                const Vec3 p =
                    (1 - t) * mesh.point[static_cast<std::size_t>(block[k])] + t * before_margin(k);
                return clear_of_globe(head.project(p), globe, 1.3);
            },
            Hold::kOnHead);
        // Relaxing would draw the innermost loops across the canthus, so they keep their distance there.
        if (r >= kSkinRings - 1)
            for (int k = 0; k < kLoop; ++k) {
                if (std::min({std::abs(k - kInner), std::abs(k - kOuter),
                              std::abs(k - kLoop - kInner)}) > (r == kSkinRings ? 1 : 0))
                    continue;
                const auto v = static_cast<std::size_t>(ids[static_cast<std::size_t>(k)]);
                mesh.point[v] = clear_of_globe(
                    head.project(margin[k] + (r == kSkinRings ? 2.3 : 3.2) * outwards(k)), globe,
                    1.3);
                mesh.hold[v] = Hold::kPinned;
            }
        constexpr double kFraction[] = {0, 0, 0, 1.35, 0.98, 0.62},
                         kRaise[] = {0, 0, 0, 0.5, -0.9, 0.0};
        if (kFraction[r] == 0) continue;
        for (int k = 0; k < kLoop; ++k) {
            const double height = lid_height(k, kFraction[r]);
            if (height < 2.6 ||
                mesh.hold[static_cast<std::size_t>(ids[static_cast<std::size_t>(k)])] ==
                    Hold::kPinned)
                continue;  // near the canthi the fold runs out
            const auto v = static_cast<std::size_t>(ids[static_cast<std::size_t>(k)]);
            const double fade = std::min(1.0, (height - 2.0) / 2.5);
            mesh.point[v] = on_lid(k, height, kRaise[r] * fade);
            mesh.hold[v] = Hold::kPinned;
        }
    }
    const std::size_t first_fixed = mesh.point.size();
    mesh.adding = Region::kLid;
    ring(before_margin, Hold::kPinned);
    skin.lid_margin =
        ring([&](int k) { return clear_of_globe(margin[k], globe, 0.9); }, Hold::kPinned);
    name_margin_landmarks(skin, tables);
    const auto on_globe = [&](int k, double beyond) {
        Vec3 d = (margin[k] - globe.centre).normalized();
        d = (d * 12.0 + beyond * outwards(k)).normalized();
        return Vec3(globe.centre + d * (globe.radius_at(d.z()) + kGap));
    };
    // The margin is a narrow face from its outer edge to the globe; at the inner canthus it widens to the caruncle.
    ring(
        [&](int k) {
            const Vec3 outer = mesh.point[static_cast<std::size_t>(skin.lid_margin[k])],
                       inner = on_globe(k, 0.1);
            const double depth = (inner - outer).norm();
            return Vec3(0.5 * (outer + inner) +
                        std::min(0.8, 0.15 * std::max(0.0, depth - 1.5)) * Vec3::UnitZ());
        },
        Hold::kPinned);
    ring([&](int k) { return on_globe(k, 0.1); }, Hold::kPinned);
    ring([&](int k) { return on_globe(k, 1.6); }, Hold::kPinned);
    ring([&](int k) { return on_globe(k, 3.4); }, Hold::kPinned);
    for (std::size_t v = first_fixed; v < mesh.point.size(); ++v)
        skin.fixed.push_back(static_cast<int>(v));
}

}  // namespace risorius::headmodel
