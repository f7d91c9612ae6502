// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "risorius/landmarks/detail/smooth_field.h"
#include "risorius/landmarks/similarity.h"

namespace risorius::landmarks {

namespace {

constexpr double kSeenDeviation_m = 1.2e-3;  // of a point on which all views agree
constexpr double kWidelySeen_m = 5e-3;       // spread of views above which a point says nothing
constexpr double kAnchorSpacing_m = 7e-3, kNodeSpacing_m = 16e-3, kEarSpacing_m = 6e-3;
constexpr double kBelowChin_m = 0.045, kEarRadius_m = 0.034;
constexpr double kSimilar = 0.6;  // cosine between normals that may belong together
constexpr double kEarDeviation_m = 3e-3;

struct Scale {
    double deviation_m;  // of a node from the skin it is drawn to
    double reach_m;
    int rounds;
};
constexpr std::array<Scale, 3> kScales{{{6e-3, 20e-3, 8}, {2.5e-3, 12e-3, 6}, {1.2e-3, 8e-3, 6}}};

/// Adds points of a set that are at least `spacing` from all before, lowest first.
void spread_out_more(const Points& points, const std::vector<int>& among, double spacing,
                     std::vector<int>& out) {
    for (const int v : among) {
        const bool far = std::all_of(out.begin(), out.end(), [&](int w) {
            return (points.row(v) - points.row(w)).squaredNorm() > spacing * spacing;
        });
        if (far) out.push_back(v);
    }
}

std::vector<int> spread_out(const Points& points, const std::vector<int>& among, double spacing) {
    std::vector<int> out;
    spread_out_more(points, among, spacing, out);
    return out;
}

/// The middle of an ear, from its tragion.
Vec3 ear_of(const TemplateHead& known, const char* tragion) {
    return known.landmarks.at(tragion) + Vec3(0, 0.005, -0.012);
}

Vec3 normal_at(const ShownHead& head, const geom::SurfacePoint& p) {
    Vec3 out = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
        out += p.barycentric[k] * head.normals.row(head.skin(p.triangle, k)).transpose();
    return out.normalized();
}

/// The nearest skin with a similar normal; nothing when it is farther than `reach`.
struct Match {
    Vec3 at, normal;
    double distance;
};
std::optional<Match> match(const ShownHead& head, const Vec3& p, const Vec3& normal, double reach) {
    const auto found = head.skin_tree.closest(p, reach);
    if (!found) return std::nullopt;
    const Vec3 there = normal_at(head, *found);
    if (!(there.dot(normal) > kSimilar)) return std::nullopt;
    return Match{found->point, there, std::sqrt(found->squared_distance)};
}

/// The template after the similarity, and what is known of its displacements.
struct Moving {
    Points nodes, normals;  // of the skin
    Points anchors, seen;   // points of the network, and their displacements
    std::vector<double> anchor_deviation;
};

Moving moving(const TemplateHead& known, const Similarity& to_new,
              const std::vector<SeenPoint>& face) {
    Moving out;
    std::vector<int> order;
    Points at(kFacePoints, 3), displaced(kFacePoints, 3);
    std::vector<double> spread(kFacePoints, 0);
    for (int k = 0; k < kFacePoints; ++k) {
        const SeenPoint &here = known.face[static_cast<std::size_t>(k)],
                        &there = face[static_cast<std::size_t>(k)];
        at.row(k) = to_new(here.at).transpose();
        displaced.row(k) = there.at.transpose() - at.row(k);
        spread[static_cast<std::size_t>(k)] =
            here.weight > 0 && there.weight > 0 ? std::max(to_new.scale * here.spread, there.spread)
                                                : std::numeric_limits<double>::infinity();
        if (spread[static_cast<std::size_t>(k)] < kWidelySeen_m) order.push_back(k);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return spread[static_cast<std::size_t>(a)] < spread[static_cast<std::size_t>(b)];
    });
    const std::vector<int> anchors = spread_out(at, order, kAnchorSpacing_m);
    out.anchors.resize(static_cast<Eigen::Index>(anchors.size()), 3);
    out.seen.resize(out.anchors.rows(), 3);
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        out.anchors.row(static_cast<Eigen::Index>(i)) = at.row(anchors[i]);
        out.seen.row(static_cast<Eigen::Index>(i)) = displaced.row(anchors[i]);
        const double views = spread[static_cast<std::size_t>(anchors[i])];
        out.anchor_deviation.push_back(std::hypot(kSeenDeviation_m, views));
    }

    std::vector<int> skin;
    std::vector<bool> used(static_cast<std::size_t>(known.head.positions.rows()), false);
    const double lowest = known.landmarks.at("me").y() - kBelowChin_m;
    for (Eigen::Index f = 0; f < known.head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = known.head.skin(f, k);
            if (used[static_cast<std::size_t>(v)] || known.head.positions(v, 1) < lowest) continue;
            used[static_cast<std::size_t>(v)] = true;
            skin.push_back(v);
        }
    // Ears vary on a small scale.
    std::vector<int> ears;
    for (const int v : skin) {
        const Vec3 p = known.head.positions.row(v).transpose();
        for (const char* id : {"t_l", "t_r"})
            if ((p - ear_of(known, id)).norm() < kEarRadius_m) ears.push_back(v);
    }
    std::vector<int> nodes = spread_out(known.head.positions, ears, kEarSpacing_m);
    spread_out_more(known.head.positions, skin, kNodeSpacing_m, nodes);
    out.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
    out.normals.resize(out.nodes.rows(), 3);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Eigen::Index row = static_cast<Eigen::Index>(i);
        out.nodes.row(row) = to_new(known.head.positions.row(nodes[i]).transpose()).transpose();
        out.normals.row(row) =
            (to_new.rotation * known.head.normals.row(nodes[i]).transpose()).transpose();
    }
    return out;
}

/// Where the template's ear has to be shifted: over a grid of 48 x 64 mm, then finer around the best.
Vec3 ear_shift(const TemplateHead& known, const Similarity& to_new, const Vec3& ear,
               const ShownHead& head) {
    std::vector<int> patch;
    for (Eigen::Index f = 0; f < known.head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = known.head.skin(f, k);
            if ((known.head.positions.row(v).transpose() - ear).norm() < kEarRadius_m)
                patch.push_back(v);
        }
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
    patch = spread_out(known.head.positions, patch, 4e-3);
    constexpr double kReach_m = 12e-3, kPriceOfShift = 0.1;
    const auto misfit = [&](const Vec3& shift) {
        // Without a price, the ear of a head that ends behind it would fit a smooth cheek better.
        double sum = kPriceOfShift * shift.squaredNorm() * static_cast<double>(patch.size());
        for (const int v : patch) {
            const Vec3 p = to_new(known.head.positions.row(v).transpose()) + shift;
            const Vec3 normal = to_new.rotation * known.head.normals.row(v).transpose();
            const auto found = match(head, p, normal, kReach_m);
            const double d = found ? found->distance : kReach_m;
            sum += d * d;
        }
        return sum;
    };
    Vec3 best = Vec3::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (const double step : {8e-3, 4e-3, 2e-3}) {
        const Vec3 middle = best;
        const int reach_y = step == 8e-3 ? 4 : 1, reach_z = step == 8e-3 ? 3 : 1,
                  reach_x = step == 8e-3 ? 1 : 1;
        for (int x = -reach_x; x <= reach_x; ++x)
            for (int y = -reach_y; y <= reach_y; ++y)
                for (int z = -reach_z; z <= reach_z; ++z) {
                    const Vec3 shift = middle + step * Vec3(x, y, z);
                    const double now = misfit(shift);
                    if (now < least) {
                        least = now;
                        best = shift;
                    }
                }
    }
    return best;
}

/// Adds the ears to what is known: their nodes move with the shift of their ear.
void add_ears(const TemplateHead& known, const Similarity& to_new, const ShownHead& head,
              Moving& moving) {
    for (const char* id : {"t_l", "t_r"}) {
        const Vec3 ear = ear_of(known, id), shift = ear_shift(known, to_new, ear, head);
        for (Eigen::Index i = 0; i < moving.nodes.rows(); ++i) {
            if ((moving.nodes.row(i).transpose() - to_new(ear)).norm() >
                to_new.scale * kEarRadius_m)
                continue;
            const Eigen::Index row = moving.anchors.rows();
            moving.anchors.conservativeResize(row + 1, 3);
            moving.seen.conservativeResize(row + 1, 3);
            moving.anchors.row(row) = moving.nodes.row(i);
            moving.seen.row(row) = shift.transpose();
            moving.anchor_deviation.push_back(kEarDeviation_m);
        }
    }
}

Points stacked(const Points& a, const Points& b) {
    Points out(a.rows() + b.rows(), 3);
    out << a, b;
    return out;
}

/// Draws the nodes to the skin in three scales. Returns the field of the last.
SmoothField registered(const Moving& moving, const ShownHead& head) {
    const Points x = stacked(moving.anchors, moving.nodes);
    SmoothField field(moving.anchors, moving.anchor_deviation);
    field.set(moving.seen);
    for (const Scale& scale : kScales) {
        std::vector<double> deviation = moving.anchor_deviation;
        deviation.resize(static_cast<std::size_t>(x.rows()), scale.deviation_m);
        SmoothField next(x, deviation);
        for (int round = 0; round < scale.rounds; ++round) {
            Points drawn(moving.nodes.rows(), 3);
            for (Eigen::Index i = 0; i < drawn.rows(); ++i) {
                const Vec3 here = moving.nodes.row(i).transpose(),
                           moved = round == 0 ? field.at(here)
                                              : next.at_point(moving.anchors.rows() + i);
                const auto found =
                    match(head, here + moved, moving.normals.row(i).transpose(), scale.reach_m);
                Vec3 to = moved;
                if (found) to += found->normal * found->normal.dot(found->at - here - moved);
                drawn.row(i) = to.transpose();
            }
            next.set(stacked(moving.seen, drawn));
        }
        field = std::move(next);
    }
    return field;
}

}  // namespace

std::map<std::string, PlacedLandmark> placed_landmarks(const TemplateHead& known,
                                                       const ShownHead& head,
                                                       const std::vector<SeenPoint>& face) {
    std::vector<Vec3> from, to;
    std::vector<double> weights;
    for (std::size_t k = 0; k < face.size(); ++k) {
        if (!(known.face[k].weight > 0) || !(face[k].weight > 0)) continue;
        from.push_back(known.face[k].at);
        to.push_back(face[k].at);
        const double spread = std::max({known.face[k].spread, face[k].spread, kSeenDeviation_m});
        weights.push_back(1 / (spread * spread));
    }
    const Similarity to_new = nearest_similarity(from, to, weights);
    Moving parts = moving(known, to_new, face);
    add_ears(known, to_new, head, parts);
    const SmoothField seen(parts.anchors, parts.anchor_deviation), field = registered(parts, head);
    std::map<std::string, PlacedLandmark> out;
    for (const auto& [id, p] : known.landmarks) {
        const Vec3 aligned = to_new(p), moved = aligned + field.at(aligned);
        const auto skin = head.skin_tree.closest(moved);
        out[id] = {skin->point, std::sqrt(skin->squared_distance), seen.deviation_at(aligned)};
    }
    return out;
}

}  // namespace risorius::landmarks
