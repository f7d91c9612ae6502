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
// Along the skin, a node is drawn to skin that is as near and has as similar a normal, beyond what it sees of its own head. On flat skin
// this says nothing; at a nose, a lid or a lip, what the network sees is off by more.
constexpr double kOfNormals_m = 10e-3;  // what a difference of normals of 1 rad is worth
constexpr double kSimilarWidth_m = 4e-3, kAlongSkin = 1.3;
constexpr double kFaceSpacing_m = 9e-3, kAboveNasion_m = 0.03, kAroundFace_m = 0.01;
// Where the network misses the mouth: what it says of lips and chin is left out, and the lips are where they were found.
constexpr double kAroundMouth_m = 35e-3, kLipDeviation_m = 0.5e-3;
constexpr double kLessTrust = 1.5;  // factor of the deviation of what is seen, once there are nodes

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

/// The vertices of a skin in cells, to find those around a point.
class SkinCells {
  public:
    explicit SkinCells(const ShownHead& head) : head_(head) {
        area_.assign(static_cast<std::size_t>(head.positions.rows()), 0);
        for (Eigen::Index f = 0; f < head.skin.rows(); ++f) {
            const auto corner = [&](int k) -> Vec3 {
                return head.positions.row(head.skin(f, k)).transpose();
            };
            const double area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 6;
            for (int k = 0; k < 3; ++k) area_[static_cast<std::size_t>(head.skin(f, k))] += area;
        }
        for (std::size_t v = 0; v < area_.size(); ++v)
            if (area_[v] > 0)
                cells_[cell_of(head.positions.row(static_cast<Eigen::Index>(v)).transpose())]
                    .push_back(static_cast<int>(v));
    }

    /// The mean of the skin around p, weighted by how near it is and how similar its normal; nothing when there is none.
    std::optional<Vec3> similar(const Vec3& p, const Vec3& normal, double width) const {
        const std::array<int, 3> middle = cell_of(p);
        Vec3 sum = Vec3::Zero();
        double weights = 0;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    const auto cell = cells_.find({middle[0] + x, middle[1] + y, middle[2] + z});
                    if (cell == cells_.end()) continue;
                    for (const int v : cell->second) {
                        const Vec3 at = head_.positions.row(v).transpose(),
                                   there = head_.normals.row(v).transpose();
                        const double cosine = there.dot(normal);
                        if (!(cosine > kSimilar)) continue;
                        const double price =
                            (at - p).squaredNorm() + kOfNormals_m * kOfNormals_m * 2 * (1 - cosine);
                        const double weight = area_[static_cast<std::size_t>(v)] *
                                              std::exp(-price / (2 * width * width));
                        sum += weight * (at - p);
                        weights += weight;
                    }
                }
        if (!(weights > 1e-12 * width * width)) return std::nullopt;
        return sum / weights;
    }

  private:
    static constexpr double kCell_m = 12e-3;
    static std::array<int, 3> cell_of(const Vec3& p) {
        return {static_cast<int>(std::floor(p.x() / kCell_m)),
                static_cast<int>(std::floor(p.y() / kCell_m)),
                static_cast<int>(std::floor(p.z() / kCell_m))};
    }

    const ShownHead& head_;
    std::vector<double> area_;
    std::map<std::array<int, 3>, std::vector<int>> cells_;
};

/// The template after the similarity, and what is known of its displacements.
struct Moving {
    Points nodes, normals;  // of the skin
    Points own;             // SkinCells::similar() of each node on its own head
    std::vector<bool> in_face;
    Points anchors, seen;  // points of the network, and their displacements
    std::vector<double> anchor_deviation;
};

/// The vertices of the face from the forehead to the chin, ascending.
std::vector<int> front_of(const TemplateHead& known, const std::vector<int>& skin) {
    const auto at = [&](const char* id) { return known.landmarks.at(id); };
    std::vector<int> out;
    for (const int v : skin) {
        const Vec3 p = known.head.positions.row(v).transpose();
        if (p.z() > at("ex_l").z() - kAroundFace_m && p.y() > at("me").y() - kAroundFace_m &&
            p.y() < at("n").y() + kAboveNasion_m)
            out.push_back(v);
    }
    return out;
}

/// Spreads nodes over the template's skin, more densely over its ears and its face.
void add_nodes(const TemplateHead& known, const Similarity& to_new, Moving& out) {
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
    const std::vector<int> front = front_of(known, skin);
    std::vector<int> nodes = spread_out(known.head.positions, ears, kEarSpacing_m);
    spread_out_more(known.head.positions, front, kFaceSpacing_m, nodes);
    spread_out_more(known.head.positions, skin, kNodeSpacing_m, nodes);
    out.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
    out.normals.resize(out.nodes.rows(), 3);
    out.own.resize(out.nodes.rows(), 3);
    const SkinCells cells(known.head);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Eigen::Index row = static_cast<Eigen::Index>(i);
        const Vec3 own = cells
                             .similar(known.head.positions.row(nodes[i]).transpose(),
                                      known.head.normals.row(nodes[i]).transpose(),
                                      kSimilarWidth_m / to_new.scale)
                             .value_or(Vec3::Zero());
        out.in_face.push_back(std::find(front.begin(), front.end(), nodes[i]) != front.end());
        out.own.row(row) = (to_new.scale * (to_new.rotation * own)).transpose();
        out.nodes.row(row) = to_new(known.head.positions.row(nodes[i]).transpose()).transpose();
        out.normals.row(row) =
            (to_new.rotation * known.head.normals.row(nodes[i]).transpose()).transpose();
    }
}

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

    add_nodes(known, to_new, out);
    return out;
}

/// How the template's ear has to be moved after the similarity: shifted, made larger, and tilted about the axis through both ears.
struct EarMotion {
    Vec3 shift = Vec3::Zero();
    double larger = 1, tilt = 0;  // tilt: rad

    /// `ear`: its middle, and `p`: a point on it, both after the similarity.
    Vec3 displacement(const Vec3& ear, const Vec3& p) const {
        return shift + larger * (Eigen::AngleAxisd(tilt, Vec3::UnitX()) * (p - ear)) - (p - ear);
    }

    /// The same for the ear of the other side.
    EarMotion mirrored() const { return {Vec3(-shift.x(), shift.y(), shift.z()), larger, tilt}; }
};

/// The skin around an ear, after the similarity.
struct EarPatch {
    Vec3 middle;
    std::vector<Vec3> points, normals;
};

EarPatch ear_patch(const TemplateHead& known, const Similarity& to_new, const Vec3& ear) {
    std::vector<int> patch;
    for (Eigen::Index f = 0; f < known.head.skin.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = known.head.skin(f, k);
            if ((known.head.positions.row(v).transpose() - ear).norm() < kEarRadius_m)
                patch.push_back(v);
        }
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
    EarPatch out{to_new(ear), {}, {}};
    for (const int v : spread_out(known.head.positions, patch, 4e-3)) {
        out.points.push_back(to_new(known.head.positions.row(v).transpose()));
        out.normals.push_back(to_new.rotation * known.head.normals.row(v).transpose());
    }
    return out;
}

/// Mean squared distance of an ear from the skin, and a price.
double misfit_of(const EarPatch& ear, const EarMotion& motion, const ShownHead& head) {
    constexpr double kReach_m = 12e-3, kPriceOfShift = 0.1, kPriceOfTurn_m2 = 1e-5;
    // Without a price, the ear of a head that ends behind it would fit a smooth cheek better.
    const double size = std::log(motion.larger);
    const double price = kPriceOfShift * motion.shift.squaredNorm() +
                         kPriceOfTurn_m2 * (size * size + motion.tilt * motion.tilt);
    const Eigen::AngleAxisd turn(motion.tilt, Vec3::UnitX());
    double sum = 0;
    for (std::size_t i = 0; i < ear.points.size(); ++i) {
        const Vec3& p = ear.points[i];
        const auto found =
            match(head, p + motion.displacement(ear.middle, p), turn * ear.normals[i], kReach_m);
        const double d = found ? found->distance : kReach_m;
        sum += d * d;
    }
    return price + sum / static_cast<double>(ear.points.size());
}

/// The motions of the left and of the right ear: shifts over a grid of 48 x 64 mm, then with sizes and tilts, finer around the best. Both
/// ears move alike at first, as one alone may fit a wrong place.
std::array<EarMotion, 2> ear_motions(const std::array<EarPatch, 2>& ears, const ShownHead& head) {
    const auto search = [](const EarMotion& from, double step_m, const std::array<int, 3>& reach,
                           const std::vector<double>& sizes, const std::vector<double>& tilts,
                           const auto& misfit) {
        EarMotion best = from;
        double least = std::numeric_limits<double>::infinity();
        for (const double size : sizes)
            for (const double tilt : tilts)
                for (int x = -reach[0]; x <= reach[0]; ++x)
                    for (int y = -reach[1]; y <= reach[1]; ++y)
                        for (int z = -reach[2]; z <= reach[2]; ++z) {
                            const EarMotion motion{from.shift + step_m * Vec3(x, y, z),
                                                   from.larger * size, from.tilt + tilt};
                            const double now = misfit(motion);
                            if (now < least) {
                                least = now;
                                best = motion;
                            }
                        }
        return best;
    };
    const auto both = [&](const EarMotion& motion) {
        return misfit_of(ears[0], motion, head) + misfit_of(ears[1], motion.mirrored(), head);
    };
    EarMotion left = search({}, 8e-3, {1, 4, 3}, {1}, {0}, both);
    left = search(left, 4e-3, {1, 1, 1}, {0.9, 1, 1.12, 1.25}, {-0.15, 0, 0.15}, both);
    std::array<EarMotion, 2> out{left, left.mirrored()};
    for (std::size_t side = 0; side < 2; ++side)
        out[side] =
            search(out[side], 2e-3, {1, 1, 1}, {0.95, 1, 1.05}, {-0.07, 0, 0.07},
                   [&](const EarMotion& motion) { return misfit_of(ears[side], motion, head); });
    return out;
}

/// Adds the ears to what is known: their nodes move with their ear.
void add_ears(const TemplateHead& known, const Similarity& to_new, const ShownHead& head,
              Moving& moving) {
    const std::array<EarPatch, 2> ears{ear_patch(known, to_new, ear_of(known, "t_l")),
                                       ear_patch(known, to_new, ear_of(known, "t_r"))};
    const std::array<EarMotion, 2> motions = ear_motions(ears, head);
    for (std::size_t side = 0; side < 2; ++side)
        for (Eigen::Index i = 0; i < moving.nodes.rows(); ++i) {
            const Vec3 node = moving.nodes.row(i).transpose();
            if ((node - ears[side].middle).norm() > to_new.scale * kEarRadius_m) continue;
            const Eigen::Index row = moving.anchors.rows();
            moving.anchors.conservativeResize(row + 1, 3);
            moving.seen.conservativeResize(row + 1, 3);
            moving.anchors.row(row) = node.transpose();
            moving.seen.row(row) = motions[side].displacement(ears[side].middle, node).transpose();
            moving.anchor_deviation.push_back(kEarDeviation_m);
        }
}

/// Takes what the network sees of the mouth and of the chin out, and adds where the lips are.
void hold_lips(const TemplateHead& known, const Similarity& to_new,
               const std::map<std::string, Vec3>& lips, Moving& moving) {
    const Vec3 middle = to_new(known.landmarks.at("sto"));
    const double highest = to_new(known.landmarks.at("sn")).y();
    std::vector<Vec3> anchors, seen;
    std::vector<double> deviation;
    for (Eigen::Index i = 0; i < moving.anchors.rows(); ++i) {
        const Vec3 at = moving.anchors.row(i).transpose();
        if (at.y() < highest && (at - middle).norm() < to_new.scale * kAroundMouth_m) continue;
        anchors.push_back(at);
        seen.push_back(moving.seen.row(i).transpose());
        deviation.push_back(moving.anchor_deviation[static_cast<std::size_t>(i)]);
    }
    for (const auto& [id, place] : lips) {
        const auto from = known.landmarks.find(id);
        if (from == known.landmarks.end()) continue;
        anchors.push_back(to_new(from->second));
        seen.push_back(place - anchors.back());
        deviation.push_back(kLipDeviation_m);
    }
    moving.anchors.resize(static_cast<Eigen::Index>(anchors.size()), 3);
    moving.seen.resize(moving.anchors.rows(), 3);
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        moving.anchors.row(static_cast<Eigen::Index>(i)) = anchors[i].transpose();
        moving.seen.row(static_cast<Eigen::Index>(i)) = seen[i].transpose();
    }
    moving.anchor_deviation = deviation;
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
    const SkinCells cells(head);
    for (const Scale& scale : kScales) {
        std::vector<double> deviation = moving.anchor_deviation;
        for (double& d : deviation) d *= kLessTrust;
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
                if (found) {
                    to += found->normal * found->normal.dot(found->at - here - moved);
                    const auto similar = cells.similar(found->at, moving.normals.row(i).transpose(),
                                                       kSimilarWidth_m);
                    if (similar && moving.in_face[static_cast<std::size_t>(i)]) {
                        const Vec3 beyond = *similar - moving.own.row(i).transpose();
                        to += kAlongSkin * (beyond - found->normal * found->normal.dot(beyond));
                    }
                }
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
                                                       const std::vector<SeenPoint>& face,
                                                       const std::map<std::string, Vec3>& lips) {
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
    if (!lips.empty()) hold_lips(known, to_new, lips, parts);
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
