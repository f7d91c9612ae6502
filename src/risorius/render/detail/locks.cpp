// SPDX-License-Identifier: MIT
#include "risorius/render/detail/locks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/core/rotations.h"
#include "risorius/render/detail/lock_guides.h"
#include "risorius/render/detail/skin_box.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

// Size of the texture of strands on a head
constexpr double kStrandsAcross_m = 0.050, kStrandsAlong_m = 0.140;
/// Height of the middle of a lock over its sides, and lean of the normal at them, ratios to half its width
constexpr double kRoof = 0.35, kRound = 0.75;

double soft_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A lock is thin over so much of its length, and so thin at its tip.
constexpr double kThinEnd_m = 0.030, kThinEnd = 0.55;
/// It has its full width so far from the root.
constexpr double kFullFrom_m = 0.022;
/// Locks of layers up to this one have no gaps.
constexpr double kInner = 0.45;

/// Half the width of a lock, as a share, from the root (0) to the tip (1); it is full from `full` on.
double taper(double s, bool edge, double tip, double full) {
    const double root = edge ? 0.06 : 0.10;
    return (root + (1 - root) * soft_step(0, full, s)) * (1 - (1 - tip) * soft_step(0.5, 1.0, s));
}

/// The way of combed hair, for its light. Beside the parting it turns from one side to the other, or there would be a step of light.
Vec3 combed_along(const Vec3& along, const Vec3& out, const Vec3& at, double parting_m) {
    constexpr double kTurns_m = 0.060;
    const Vec3 down(0, -0.35, 1);
    const double aside = soft_step(0.0, kTurns_m, std::abs(at.x() - parting_m));
    return (aside * along + (1 - aside) * (down - out * out.dot(down))).normalized();
}

/// What differs from lock to lock, each 0..1.
struct LockChance {
    double tone, along, across;
};

/// The end of a lock: pointed strands side by side, each of its own length. `end`: the last vertices across the lock.
void add_ends(std::vector<HairVertex> end, double length_m, RandomSequence& random, Hair& hair) {
    constexpr int kStrands = 3;
    const HairVertex &first = end.front(), &last = end.back();
    const auto between = [&](double share) {
        HairVertex v = first;
        v.offset += share * (last.offset - first.offset);
        v.out = (first.out + share * (last.out - first.out)).normalized();
        v.strand += share * (last.strand - first.strand);
        return v;
    };
    for (int k = 0; k < kStrands; ++k) {
        const double middle = (k + 0.2 + 0.6 * random.next()) / kStrands, half = 0.7 / kStrands,
                     length = length_m * (0.25 + random.next() * random.next() * 1.5),
                     stray = 0.25 * (random.next() - 0.5);
        const auto at = static_cast<unsigned>(hair.vertices.size());
        hair.vertices.push_back(between(std::max(middle - half, 0.0)));
        hair.vertices.push_back(between(std::min(middle + half, 1.0)));
        HairVertex tip = between(middle);
        tip.offset += length * (tip.along + stray * (last.offset - first.offset).normalized());
        tip.strand.y() += length / kStrandsAlong_m;
        tip.open = 1;
        hair.vertices.push_back(tip);
        hair.triangles.insert(hair.triangles.end(), {at, at + 1, at + 2});
    }
}

/// The rows of a lock that are kept: a lock that is nearly straight needs few. Others are left out where both of its sides stay as
/// near to the line between their neighbours as `kBend_m`. `lock`: rows of `columns` vertices with one root.
std::vector<std::size_t> rows_kept(const std::vector<HairVertex>& lock, std::size_t columns) {
    constexpr double kBend_m = 0.0003;
    constexpr std::size_t kMostLeftOut = 3;
    const std::size_t rows = lock.size() / columns;
    const auto straight = [&](std::size_t from, std::size_t to) {
        for (const std::size_t column : {std::size_t{0}, columns - 1}) {
            const auto at = [&](std::size_t row) { return lock[row * columns + column].offset; };
            const Vec3 way = at(to) - at(from);
            for (std::size_t row = from + 1; row < to; ++row) {
                const Vec3 p = at(row) - at(from);
                const double along = p.dot(way) / std::max(way.squaredNorm(), 1e-12);
                if ((p - std::clamp(along, 0.0, 1.0) * way).norm() > kBend_m) return false;
            }
        }
        return true;
    };
    std::vector<std::size_t> kept{0};
    while (kept.back() + 1 < rows) {
        std::size_t to = kept.back() + 1;
        while (to + 1 < rows && to - kept.back() <= kMostLeftOut && straight(kept.back(), to + 1))
            ++to;
        kept.push_back(to);
    }
    return kept;
}

/// Combed locks are lit as the sheet that they lie in, or each would look like a ribbon.
void add_lock(const LockGuide& guide, const LockStyle& style, double parting_m, const Vec3& root,
              const LockChance& chance, RandomSequence& random, Hair& hair) {
    const std::size_t rows = guide.points.size(), columns = static_cast<std::size_t>(style.across);
    std::vector<HairVertex> lock;
    const bool tuft = style.flow == HairFlow::kRadial, combed = style.flow == HairFlow::kParting;
    const double shade = combed ? 0.06 : 0.16;  // from lock to lock
    const double half = 0.5e-3 * style.width_mm * guide.width * (0.75 + 0.5 * chance.tone);
    double along_m = kStrandsAlong_m * chance.along;
    double whole_m = 0;
    for (std::size_t i = 1; i < rows; ++i)
        whole_m += (guide.points[i] - guide.points[i - 1]).norm();
    const double full = std::min(0.22, kFullFrom_m / std::max(whole_m, 1e-6));
    const double thin_from = std::max(1 - kThinEnd_m / std::max(whole_m, 1e-6), 0.4);
    hair.roots.push_back(guide.root);
    for (std::size_t i = 0; i < rows; ++i) {
        const double s = static_cast<double>(i) / static_cast<double>(rows - 1);
        const Vec3 along =
            (guide.points[std::min(i + 1, rows - 1)] - guide.points[i > 0 ? i - 1 : 0])
                .normalized();
        const Vec3 side = along.cross(guide.out[i]).normalized(), out = side.cross(along);
        if (i > 0) along_m += (guide.points[i] - guide.points[i - 1]).norm();
        const double width = half * taper(s, guide.edge, style.tip, full);
        // Deep between the roots it is dark.
        const double root_lit = combed ? 0.95 : guide.edge ? 0.85 : 0.68;
        const double lit = (root_lit + (1 - root_lit) * soft_step(0, 0.4, s)) *
                           (tuft     ? 0.60 + 0.40 * guide.layer
                            : combed ? 0.92 + 0.08 * guide.layer
                                     : 0.76 + 0.24 * guide.layer);
        for (std::size_t column = 0; column < columns; ++column) {
            const double at =
                2.0 * static_cast<double>(column) / static_cast<double>(columns - 1) - 1;
            HairVertex v;
            v.root = hair.roots.size() - 1;
            v.offset = guide.points[i] + at * width * side +
                       kRoof * width * (1 - std::abs(at)) * out - root;
            v.along = combed && !guide.fringe
                          ? combed_along(along, guide.out[i], guide.points[i], parting_m)
                          : along;
            // Tufts are lit as the whole of them is, not strip by strip.
            v.out = tuft     ? (guide.out[i] + 0.4 * out).normalized()
                    : combed ? guide.out[i]
                             : (out + kRound * at * side).normalized();
            v.strand = {chance.across + at * width / kStrandsAcross_m, along_m / kStrandsAlong_m};
            v.lit = lit;
            v.tone =
                (1 + shade * (chance.tone - 0.5)) * (combed ? 0.92 + 0.12 * s : 0.85 + 0.25 * s);
            v.grey = guide.grey;
            // What lies deeper is seen through gaps only.
            if (!guide.single && guide.layer > kInner) {
                v.across = at;
                v.open = kThinEnd * soft_step(thin_from, 1, s);
            }
            lock.push_back(v);
        }
    }
    const std::vector<std::size_t> kept = rows_kept(lock, columns);
    HairPiece piece{hair.triangles.size(),
                    0,
                    hair.vertices.size(),
                    columns * kept.size(),
                    columns,
                    kept.size(),
                    !guide.hangs,
                    !guide.single};
    for (const std::size_t at : kept)
        hair.vertices.insert(hair.vertices.end(),
                             lock.begin() + static_cast<std::ptrdiff_t>(at * columns),
                             lock.begin() + static_cast<std::ptrdiff_t>((at + 1) * columns));
    const auto first = static_cast<unsigned>(piece.first_vertex),
               row = static_cast<unsigned>(columns);
    for (unsigned i = 0; i + 1 < kept.size(); ++i)
        for (unsigned k = 0; k + 1 < row; ++k) {
            const unsigned a = first + row * i + k, b = a + 1, c = a + row, d = c + 1;
            hair.triangles.insert(hair.triangles.end(), {a, b, d, a, d, c});
        }
    // What goes to a knot ends in it.
    const bool knotted = style.flow == HairFlow::kKnot && !guide.tail;
    if (style.fray_mm > 0 && !guide.single && !knotted) {
        add_ends({hair.vertices.end() - static_cast<std::ptrdiff_t>(columns), hair.vertices.end()},
                 1e-3 * style.fray_mm * guide.fray, random, hair);
        piece.vertices = hair.vertices.size() - piece.first_vertex;
    }
    piece.indices = hair.triangles.size() - piece.first_index;
    hair.pieces.push_back(piece);
}

/// Rows of the cap from the whorl outwards, columns around it.
constexpr int kCapRows = 16, kCapColumns = 120;
constexpr int kThinRows = 2;  ///< at the border

/// Marks the skin inside the border of the cap, which reaches so far from the whorl in each column, rad.
void cover_skin(const LockGround& ground, const Scene& scene, const Vec3& ahead, const Vec3& right,
                const std::vector<double>& reach, Hair& hair) {
    constexpr double kInside = 0.03, kDeep_m = 0.004;
    hair.covered.assign(static_cast<std::size_t>(scene.rest.rows()), 0);
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
            const int v = surface.triangles.data()[i];
            const Vec3 from = scene.rest.row(v).transpose() - ground.head().centre(),
                       d = from.normalized();
            if (from.norm() < ground.head().radius_m(d, false) - kDeep_m) continue;
            const double turn = std::atan2(d.dot(right), d.dot(ahead)) / (2 * std::numbers::pi);
            const auto column =
                static_cast<std::size_t>((turn - std::floor(turn)) * kCapColumns) % kCapColumns;
            const double angle = std::acos(std::clamp(d.dot(ground.whorl()), -1.0, 1.0));
            const double border = std::min(reach[column], reach[column + 1]);
            if (angle < border * (kCapRows - kThinRows) / kCapRows - kInside)
                hair.covered[static_cast<std::size_t>(v)] = 1;
        }
    }
}

void add_cap(const LockGround& ground, const LockStyle& style, const Scene& scene, Hair& hair) {
    if (style.ring) return;
    constexpr double kInside_m = 0.002, kTurn = 0.012;
    const Vec3 pole = ground.whorl(), centre = ground.head().centre(),
               right = pole.cross(Vec3::UnitZ()).normalized(), ahead = right.cross(pole);
    if (!ground.grows(pole, kInside_m)) return;
    HairPiece piece{hair.triangles.size(), 0, hair.vertices.size(), 0, 0, 0, false};
    std::vector<double> reaches;
    for (int column = 0; column <= kCapColumns; ++column) {
        const double turn = 2 * std::numbers::pi * column / kCapColumns;
        const Vec3 aside = std::cos(turn) * ahead + std::sin(turn) * right;
        double reach = 0;
        const auto towards = [&](double angle) {
            return Vec3(std::cos(angle) * pole + std::sin(angle) * aside);
        };
        while (reach < 2.6 && ground.grows(towards(reach + kTurn), kInside_m)) reach += kTurn;
        // The border to a sixteenth of the last turn, or it would have steps
        for (double turn_by = kTurn / 2; turn_by > kTurn / 20; turn_by /= 2)
            if (ground.grows(towards(reach + turn_by), kInside_m)) reach += turn_by;
        reaches.push_back(reach);
        for (int row = 0; row <= kCapRows; ++row) {
            const double angle = reach * row / kCapRows;
            const Vec3 d = towards(angle);
            const auto place = ground.head().skin_at(d);
            HairVertex v;
            v.root = hair.roots.size();
            hair.roots.push_back(*place);
            const double edge = soft_step(1.0, 0.8, static_cast<double>(row) / kCapRows);
            const Vec3 at = centre + (ground.head().radius_m(d, false) + 0.0004 +
                                      ground.cap_m(d) * (0.3 + 0.7 * edge)) *
                                         d;
            v.offset = at - place->on(scene.rest);
            v.along = ground.flow(at);
            if (style.flow == HairFlow::kParting)
                v.along = combed_along(v.along, d, at, ground.parting_m());
            v.out = d;
            v.strand = style.flow == HairFlow::kParting
                           ? Vec2(at.z() / kStrandsAcross_m,
                                  std::abs(at.x() - ground.parting_m()) / kStrandsAlong_m)
                           : Vec2(18.0 * column / kCapColumns, 0.1 * angle / kStrandsAlong_m);
            v.lit = style.lit_cap;
            v.open = soft_step(kCapRows - kThinRows, kCapRows, row);
            hair.vertices.push_back(v);
        }
    }
    const auto first = static_cast<unsigned>(piece.first_vertex);
    constexpr unsigned kRow = kCapRows + 1;
    for (unsigned column = 0; column < kCapColumns; ++column)
        for (unsigned row = 0; row < kCapRows; ++row) {
            const unsigned a = first + column * kRow + row, b = a + 1, c = a + kRow, d = c + 1;
            hair.triangles.insert(hair.triangles.end(), {a, b, d});
            if (row > 0) hair.triangles.insert(hair.triangles.end(), {a, d, c});
        }
    piece.indices = hair.triangles.size() - piece.first_index;
    piece.vertices = hair.vertices.size() - piece.first_vertex;
    // Of its shadow only the outline is seen.
    constexpr unsigned kStep = 2;
    for (unsigned column = 0; column < kCapColumns; column += kStep)
        for (unsigned row = 0; row < kCapRows; row += kStep) {
            const unsigned a = first + column * kRow + row, b = a + kStep, c = a + kStep * kRow,
                           d = c + kStep;
            hair.casters.insert(hair.casters.end(), {a, b, d, a, d, c});
        }
    hair.pieces.push_back(piece);
    cover_skin(ground, scene, ahead, right, reaches, hair);
}

/// Every third lock, with some six rows of it. The ends of hair that hangs throw none: a few strips of it would draw dark bars on
/// the neck.
void add_casters(Hair& hair) {
    constexpr unsigned kCasterRows = 6;
    std::size_t number = 0;
    for (const HairPiece& piece : hair.pieces) {
        if (!piece.casts || number++ % 3 != 0) continue;
        const auto first = static_cast<unsigned>(piece.first_vertex),
                   columns = static_cast<unsigned>(piece.columns),
                   all = static_cast<unsigned>(piece.rows),
                   rows = piece.turns_away ? all : (all + 1) / 2;
        const unsigned step = std::max(rows / kCasterRows, 1U);
        for (unsigned row = 0; row + step < rows; row += step) {
            const unsigned a = first + columns * row, b = a + columns - 1, c = a + step * columns,
                           d = c + columns - 1;
            hair.casters.insert(hair.casters.end(), {a, b, d, a, d, c});
        }
    }
}

}  // namespace

Hair plan_hair(const Scene& scene, const SkinPlan& plan, const Vec3& paint_centre) {
    Hair hair;
    const Appearance& person = scene.appearance;
    const LockStyle* named = lock_style(person.hair_style);
    if (!named || has_own_skin(scene) || plan.hairline[0] > 1) return hair;
    const LockStyle style =
        varied_style(*named, {person.lock_length, person.lock_wave, person.parting, person.fringe});
    const LockGround ground(scene, plan, paint_centre, style);
    RandomSequence random(scene.appearance.seed * 40503U + 11U);
    // The outermost locks come first: what they hide is then not shaded.
    std::vector<LockGuide> guides = ground.guides(scene.appearance.seed);
    std::stable_sort(guides.begin(), guides.end(),
                     [](const LockGuide& a, const LockGuide& b) { return a.layer > b.layer; });
    for (const LockGuide& guide : guides) {
        const LockChance chance{random.next(), random.next(), random.next()};
        add_lock(guide, style, ground.parting_m(), guide.root.on(scene.rest), chance, random, hair);
    }
    add_casters(hair);
    add_cap(ground, style, scene, hair);
    return hair;
}

Hair plan_hair(const Scene& scene) {
    if (scene.appearance.hair_style == "shaven") return {};
    const SkinBox box = box_of_skin(scene);
    const Vec3 centre = paint_centre(scene, box.min, box.max);
    return plan_hair(scene, plan_skin(scene, centre), centre);
}

Triangles triangles_from_outside(const Hair& hair, const Points& rest) {
    std::vector<Vec3> roots;
    for (const SkinPlace& root : hair.roots) roots.push_back(root.on(rest));
    const auto place = [&](const HairVertex& v) -> Vec3 { return roots[v.root] + v.offset; };
    Triangles out(static_cast<Eigen::Index>(hair.triangles.size()) / 3, 3);
    for (Eigen::Index f = 0; f < out.rows(); ++f) {
        const unsigned* corner = hair.triangles.data() + 3 * f;
        const HairVertex &a = hair.vertices[corner[0]], &b = hair.vertices[corner[1]],
                         &c = hair.vertices[corner[2]];
        const bool outside =
            (place(b) - place(a)).cross(place(c) - place(a)).dot(a.out + b.out + c.out) >= 0;
        out.row(f) << static_cast<int>(corner[0]), static_cast<int>(corner[outside ? 1 : 2]),
            static_cast<int>(corner[outside ? 2 : 1]);
    }
    return out;
}

PosedHair pose_hair(const Hair& hair, const Points& rest, const Points& positions) {
    // The turn of the head that fits the roots best (Kabsch 1976)
    PosedHair posed;
    constexpr std::size_t kPlaces = 40;
    const std::size_t step = std::max<std::size_t>(hair.roots.size() / kPlaces, 1);
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double count = 0;
    for (std::size_t i = 0; i < hair.roots.size(); i += step, ++count) {
        from += hair.roots[i].on(rest);
        to += hair.roots[i].on(positions);
    }
    Mat3 sum = Mat3::Zero();
    for (std::size_t i = 0; i < hair.roots.size(); i += step)
        sum += (hair.roots[i].on(positions) - to / count) *
               (hair.roots[i].on(rest) - from / count).transpose();
    posed.turned = nearest_rotation(sum).rotation;
    posed.moved = to / count - posed.turned * (from / count);
    std::vector<Vec3> roots;
    roots.reserve(hair.roots.size());
    for (const SkinPlace& root : hair.roots) roots.push_back(root.on(positions));
    posed.positions.resize(static_cast<Eigen::Index>(hair.vertices.size()), 3);
    for (std::size_t i = 0; i < hair.vertices.size(); ++i)
        posed.positions.row(static_cast<Eigen::Index>(i)) =
            (roots[hair.vertices[i].root] + posed.turned * hair.vertices[i].offset).transpose();
    return posed;
}

}  // namespace risorius::render
