// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/wrinkle_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "risorius/geom/polyline.h"
#include "risorius/rig/wrinkle_table.h"
#include "risorius/solve/metric_builder.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::face {

namespace {

constexpr double kMinWindow = 1e-3;
constexpr double kFadeSpacing_mm = 11.0;  // spacing of the random depth along lines
constexpr double kFibreSpread_mm = 6.0;   // radius of the mean over fibres near a point
constexpr double kPathSpacing_mm = 4.0;
constexpr double kPartingFade_mm = 6.0;  // lines fade over this where two patterns meet

// A segment of a fibre: position and direction.
struct FibrePiece {
    Vec3 at, along;
};

// One set of lines on a head. `table` is its row in the table of the rig.
struct Pattern {
    const rig::WrinklePattern* table = nullptr;
    Side side = Side::kLeft;  // if the pattern exists on each side
    double wavelength_m = 0;
    double fraction = 1;                  // fraction of the depth at the age of the skin
    std::vector<FibrePiece> fibres = {};  // they pull across the lines
    Vec3 anchor = Vec3::Zero();           // the phase here is table->anchor_phase
    std::vector<Vec3> crease = {};        // the line itself, instead of fibres

    double sign() const { return side == Side::kLeft ? 1.0 : -1.0; }
    const Vec3& at(const rig::Head& head, const std::string& id) const {
        return head.landmarks.at(side == Side::kLeft ? id : rig::mirrored_landmark(id));
    }
};

// Returns the height of p over the polyline through the points, seen from the front, m.
double height_over(const Vec3& p, const std::vector<Vec3>& line) {
    if (p.x() >= line.front().x()) return p.y() - line.front().y();
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (p.x() >= line[i + 1].x()) {
            const double t = (line[i].x() - p.x()) / std::max(1e-9, line[i].x() - line[i + 1].x());
            return p.y() - (1 - t) * line[i].y() - t * line[i + 1].y();
        }
    return p.y() - line.back().y();
}

std::vector<Vec3> across(const rig::Head& head, const std::vector<std::string>& left_to_middle) {
    std::vector<Vec3> out;
    for (const std::string& id : left_to_middle) out.push_back(head.landmark(id));
    const std::size_t half = left_to_middle.size() - 1;
    for (std::size_t i = half; i-- > 0;)
        out.push_back(head.landmark(rig::mirrored_landmark(left_to_middle[i])));
    return out;
}

void add_fibres(const rig::Head& head, const rig::Atlas& atlas, const std::string& muscle,
                Side side, double sign, std::vector<FibrePiece>& out) {
    for (const rig::MuscleBand& of_left : atlas.bands) {
        if (of_left.muscle != muscle || (side == Side::kRight && of_left.crosses_midline()))
            continue;
        const rig::MuscleBand band = side == Side::kLeft ? of_left : mirrored(of_left);
        std::vector<Vec3> through;
        for (const rig::BandPoint& point : band.points)
            through.push_back(head.landmark(point.landmark) + head.size * point.offset);
        const std::vector<Vec3> path = geom::sample_curve(through, head.mm(kPathSpacing_mm));
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
            out.push_back(
                {0.5 * (path[i] + path[i + 1]), sign * (path[i + 1] - path[i]).normalized()});
    }
}

// Returns the value of one end of a smooth step, m.
double bound_of(const rig::Head& head, const Pattern& pattern, const rig::WrinkleBound& bound) {
    const double sign = bound.axis == 0 ? pattern.sign() : 1.0;
    double value = 0;
    if (!bound.landmark.empty()) {
        value = sign * pattern.at(head, bound.landmark)[bound.axis];
        if (!bound.less.empty())
            value = std::abs(value - sign * pattern.at(head, bound.less)[bound.axis]);
        value = bound.fraction * value;
    } else if (bound.crease_end >= 0) {
        const Vec3& end = bound.crease_end == 0 ? pattern.crease.front() : pattern.crease.back();
        value = bound.fraction * (sign * end[bound.axis]);
    }
    for (const double plus_mm : bound.plus_mm) value += head.mm(plus_mm);
    return value;
}

// A factor of a window, with all that does not depend on the point of the skin.
struct PlacedFactor {
    const rig::WrinkleFactor* table;
    double from, to;         // m, or rad
    std::vector<Vec3> line;  // or empty
    Vec3 point;              // or 0
    double behind_m;
};

PlacedFactor place_factor(const rig::Head& head, const Pattern& pattern,
                          const rig::WrinkleFactor& factor) {
    const bool angle = factor.of == rig::WrinkleFactor::Of::kTurnAbout;
    PlacedFactor out{&factor, 0, 0, {}, Vec3::Zero(), head.mm(factor.behind_mm)};
    out.from = angle ? factor.from.plus_mm.at(0) : bound_of(head, pattern, factor.from);
    out.to = angle ? factor.to.plus_mm.at(0) : bound_of(head, pattern, factor.to);
    if (!factor.line.empty()) out.line = across(head, factor.line);
    if (!factor.point.empty()) out.point = pattern.at(head, factor.point);
    return out;
}

// Returns the quantity of a point of the skin that the smooth step of a factor depends on, m or rad.
double quantity_at(const Vec3& p, const PlacedFactor& factor, const Pattern& pattern) {
    using Of = rig::WrinkleFactor::Of;
    const Vec3& point = factor.point;
    switch (factor.table->of) {
        case Of::kHeight:
            return p.y();
        case Of::kOutward:
            return pattern.sign() * p.x();
        case Of::kFromMiddle:
            return std::abs(p.x());
        case Of::kOverLine:
            return height_over(p, factor.line);
        case Of::kUnderLine:
            return -height_over(p, factor.line);
        case Of::kFromCrease:
            return geom::distance_to_polyline(p, pattern.crease);
        case Of::kFromPoint:
            return (p - point).norm();
        case Of::kBeyondPoint:
            return pattern.sign() * (p.x() - point.x());
        case Of::kAroundPoint:
            return std::hypot(p.x() - point.x(), factor.table->stretch * (p.y() - point.y()));
        case Of::kTurnAbout:
            return std::abs(std::atan2(p.y() - point.y(),
                                       pattern.sign() * (p.x() - point.x()) + factor.behind_m));
    }
    return 0;
}

// Returns the window of a pattern at every vertex of the skin, 0..1.
std::vector<double> window_of(const rig::Head& head, const Triangles& skin,
                              const Pattern& pattern) {
    std::vector<PlacedFactor> factors;
    for (const rig::WrinkleFactor& factor : pattern.table->window)
        factors.push_back(place_factor(head, pattern, factor));
    const auto window_at = [&](const Vec3& p) {
        if (pattern.table->front_only && p.z() < 0) return 0.0;
        if (pattern.sign() * p.x() < head.mm(pattern.table->min_outward_mm)) return 0.0;
        double product = 1;
        for (const PlacedFactor& factor : factors) {
            const double step =
                geom::smoothstep(factor.from, factor.to, quantity_at(p, factor, pattern));
            product *= factor.table->falls ? 1 - step : step;
            if (product == 0) return 0.0;
        }
        return product;
    };
    std::vector<double> out(static_cast<std::size_t>(head.vertices.rows()), 0.0);
    for (long i = 0; i < skin.size(); ++i) {
        const int v = skin.data()[i];
        out[v] = window_at(head.vertices.row(v).transpose());
    }
    return out;
}

Pattern place_pattern(const rig::Head& head, const rig::Atlas& atlas, double age,
                      const rig::WrinklePattern& table, Side side) {
    constexpr double kCreaseSpacing_mm = 2.0;
    Pattern out{.table = &table, .side = side, .wavelength_m = head.mm(table.wavelength_mm)};
    out.fraction = table.aged ? table.fraction * age : table.fraction;
    if (!table.anchor.empty()) out.anchor = out.at(head, table.anchor);
    for (const rig::WrinkleFibres& fibres : table.fibres)
        for (const Side of : {Side::kLeft, Side::kRight}) {
            if (table.each_side && of != side) continue;
            const double sign = of == Side::kLeft ? fibres.left : fibres.right;
            if (sign != 0) add_fibres(head, atlas, fibres.muscle, of, sign, out.fibres);
        }
    std::vector<Vec3> through;
    for (const rig::CreasePoint& point : table.crease)
        through.push_back(out.at(head, point.landmark) +
                          Vec3(out.sign() * head.mm(point.offset_mm.x()),
                               head.mm(point.offset_mm.y()), head.mm(point.offset_mm.z())));
    if (!through.empty()) out.crease = geom::sample_curve(through, head.mm(kCreaseSpacing_mm));
    return out;
}

// Returns the patterns of a head of this age: patterns across the midline, then those of the left, then those of the right side.
std::vector<Pattern> patterns_of(const rig::Head& head, const rig::Atlas& atlas, double age) {
    std::vector<Pattern> out;
    const auto add = [&](bool each_side, Side side) {
        for (const rig::WrinklePattern& table : atlas.wrinkles)
            if (table.each_side == each_side && (!table.aged || age > 0))
                out.push_back(place_pattern(head, atlas, age, table, side));
    };
    add(false, Side::kLeft);
    add(true, Side::kLeft);
    add(true, Side::kRight);
    return out;
}

// Returns smooth noise at a point, about -1..1. It is the same on every machine.
double noise(const Vec3& p) {
    const auto value = [](long x, long y, long z) {
        auto seed = static_cast<std::uint32_t>(x * 73856093L ^ y * 19349663L ^ z * 83492791L);
        std::minstd_rand random(seed % 2147483646U + 1U);
        random.discard(3);
        return 2.0 * static_cast<double>(random()) / 2147483647.0 - 1.0;
    };
    const Vec3 cell(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        long at[3];
        for (int k = 0; k < 3; ++k) {
            const int up = (corner >> k) & 1;
            const double t = geom::smoothstep(0, 1, p[k] - cell[k]);
            weight *= up ? t : 1 - t;
            at[k] = static_cast<long>(cell[k]) + up;
        }
        sum += weight * value(at[0], at[1], at[2]);
    }
    return sum;
}

// Returns the arc length of the point of the line that is nearest to p, m.
double place_on(const Vec3& p, const std::vector<Vec3>& line) {
    const geom::PolylinePoint nearest = geom::nearest_on_polyline(p, line);
    double place = 0;
    for (std::size_t i = 0; i < nearest.piece; ++i) place += (line[i + 1] - line[i]).norm();
    return place + nearest.fraction * (line[nearest.piece + 1] - line[nearest.piece]).norm();
}

// Returns the signed distance from the crease, m, positive towards the outside of the face.
double across_crease(const Vec3& p, const std::vector<Vec3>& line) {
    double best = 1e300, side = 1;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 along = line[i + 1] - line[i];
        const double t = std::clamp((p - line[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const Vec3 off = p - line[i] - t * along;
        if (off.squaredNorm() >= best) continue;
        best = off.squaredNorm();
        side = along.x() * off.y() - along.y() * off.x() > 0 ? 1 : -1;
    }
    return side * std::sqrt(best);
}

// Per vertex and slot, the pattern that its phase belongs to, or -1.
using Owners = std::vector<std::array<int, kWrinkleSlots>>;

// Computes the phase of one pattern on the triangles that its window touches.
void lay(const rig::Head& head, const Triangles& skin, const Pattern& pattern,
         const std::vector<double>& window, int index, double age, WrinkleLines& lines,
         Owners& owner) {
    const auto at = [&](int v) { return Vec3(head.vertices.row(v).transpose()); };
    std::vector<int> own(window.size(), -1), vertex;
    std::vector<long> faces;
    for (long f = 0; f < skin.rows(); ++f) {
        bool touched = false;
        for (int k = 0; k < 3; ++k) touched = touched || window[skin(f, k)] > 0;
        if (!touched) continue;
        faces.push_back(f);
        for (int k = 0; k < 3; ++k)
            if (own[skin(f, k)] < 0) {
                own[skin(f, k)] = static_cast<int>(vertex.size());
                vertex.push_back(skin(f, k));
            }
    }
    if (vertex.empty()) return;
    const auto count = static_cast<int>(vertex.size());
    Points phase = Points::Zero(count, 3);  // first column

    if (!pattern.crease.empty()) {
        for (int i = 0; i < count; ++i)
            phase(i, 0) = across_crease(at(vertex[i]), pattern.crease) / pattern.wavelength_m;
    } else {
        solve::MetricBuilder laplacian(count);
        Points right = Points::Zero(count, 3);
        const double spread = head.mm(kFibreSpread_mm);
        for (const long f : faces) {
            const Vec3 a = at(skin(f, 0)), b = at(skin(f, 1)), c = at(skin(f, 2));
            const Vec3 twice = (b - a).cross(c - a);
            const double area = 0.5 * twice.norm();
            if (area < 1e-12) continue;
            const Vec3 normal = twice / (2 * area), centre = (a + b + c) / 3;
            // Far fibres have a small weight too, so that there is always a direction
            Vec3 pull = Vec3::Zero();
            for (const FibrePiece& fibre : pattern.fibres) {
                const double far = (fibre.at - centre).squaredNorm() / (2 * spread * spread);
                pull += (std::exp(-far) + 1e-6 / (1 + far)) * fibre.along;
            }
            pull -= normal * normal.dot(pull);
            if (pattern.table->along_fibres) pull = normal.cross(pull);
            if (pull.squaredNorm() > 0) pull.normalize();
            const Vec3 gradient[3] = {normal.cross(c - b) / (2 * area),
                                      normal.cross(a - c) / (2 * area),
                                      normal.cross(b - a) / (2 * area)};
            int nodes[3];
            double block[9];
            for (int i = 0; i < 3; ++i) {
                nodes[i] = own[skin(f, i)];
                right(nodes[i], 0) += area * gradient[i].dot(pull) / pattern.wavelength_m;
                for (int j = 0; j < 3; ++j) block[3 * i + j] = area * gradient[i].dot(gradient[j]);
            }
            laplacian.add_block(nodes, block, 3);
        }
        for (int i = 0; i < count; ++i) laplacian.add_diagonal(i, 1e-8);
        solve::SparseCholesky(laplacian.build({})).solve(right, phase);
        // Shifts the phase so that valleys lie where the table wants them
        int nearest = 0;
        for (int i = 1; i < count; ++i)
            if ((at(vertex[i]) - pattern.anchor).squaredNorm() <
                (at(vertex[nearest]) - pattern.anchor).squaredNorm())
                nearest = i;
        const double shift = pattern.table->anchor_phase - phase(nearest, 0);
        for (int i = 0; i < count; ++i) {
            const Vec3 place =
                at(vertex[i]) / (pattern.table->jitter_spacing * pattern.wavelength_m);
            phase(i, 0) += shift + pattern.table->jitter * noise(place);
        }
    }
    for (int i = 0; i < count; ++i) {
        const int v = vertex[i];
        if (lines.window(v, pattern.table->slot) > window[v]) continue;
        lines.phase(v, pattern.table->slot) = phase(i, 0);
        lines.window(v, pattern.table->slot) = window[v];
        lines.wavelength(v, pattern.table->slot) = pattern.wavelength_m;
        lines.at_rest(v, pattern.table->slot) = pattern.table->permanence * age;
        lines.later(v, pattern.table->slot) = pattern.table->onset - rig::kWrinkleOnset;
        owner[v][pattern.table->slot] = index;
    }
    if (pattern.crease.empty()) return;
    Crease crease{.slot = pattern.table->slot, .vertex = {}, .place_m = {}};
    for (const int v : vertex)
        if (window[v] > 0 && owner[v][pattern.table->slot] == index) {
            crease.vertex.push_back(v);
            crease.place_m.push_back(place_on(head.vertices.row(v).transpose(), pattern.crease));
        }
    lines.creases.push_back(crease);
}

// Where two patterns of a slot meet, the phase within a triangle would run from one to the other: there are no lines there, and
// those beside it fade towards it.
void part_patterns(const rig::Head& head, const Triangles& skin, const Owners& owner,
                   WrinkleLines& lines) {
    const double fade = head.mm(kPartingFade_mm);
    for (int slot = 0; slot < kWrinkleSlots; ++slot) {
        std::vector<char> cut(owner.size(), 0);
        std::vector<Vec3> meeting;
        for (long f = 0; f < skin.rows(); ++f) {
            const auto own = [&](int k) { return owner[skin(f, k)][slot]; };
            if (own(0) == own(1) && own(1) == own(2)) continue;
            bool seen = false;
            for (int k = 0; k < 3; ++k) seen = seen || lines.window(skin(f, k), slot) > 0;
            if (!seen) continue;
            for (int k = 0; k < 3; ++k) {
                if (cut[skin(f, k)]) continue;
                cut[skin(f, k)] = 1;
                meeting.push_back(head.vertices.row(skin(f, k)).transpose());
            }
        }
        if (meeting.empty()) continue;
        for (long v = 0; v < lines.window.rows(); ++v) {
            if (lines.window(v, slot) == 0) continue;
            const Vec3 at = head.vertices.row(v).transpose();
            double nearest = fade;
            for (const Vec3& place : meeting) nearest = std::min(nearest, (place - at).norm());
            lines.window(v, slot) *= geom::smoothstep(0, fade, nearest);
        }
    }
}

// Claims the phases of all triangles that show a line, and marks the vertices around them.
void claim_phases(const Triangles& skin, WrinkleLines& lines) {
    lines.claim.setConstant(lines.window.rows(), kWrinkleSlots, WrinkleLines::kFree);
    const auto spread = [&](WrinkleLines::Claim to, auto&& reaches) {
        for (long f = 0; f < skin.rows(); ++f)
            for (int slot = 0; slot < kWrinkleSlots; ++slot) {
                if (!reaches(skin(f, 0), slot) && !reaches(skin(f, 1), slot) &&
                    !reaches(skin(f, 2), slot))
                    continue;
                for (int k = 0; k < 3; ++k) {
                    signed char& claim = lines.claim(skin(f, k), slot);
                    claim = std::max<signed char>(claim, to);
                }
            }
    };
    spread(WrinkleLines::kOfLine, [&](int v, int slot) { return lines.window(v, slot) > 0; });
    spread(WrinkleLines::kBesideLine,
           [&](int v, int slot) { return lines.claim(v, slot) == WrinkleLines::kOfLine; });
}

}  // namespace

WrinkleLines lay_wrinkle_lines(const rig::Head& head, const rig::RigDescription& rig,
                               const Triangles& skin) {
    const long count = head.vertices.rows();
    WrinkleLines lines{Points::Zero(count, kWrinkleSlots), Points::Zero(count, kWrinkleSlots),
                       Points::Zero(count, kWrinkleSlots), {},
                       Points::Zero(count, kWrinkleSlots), Points::Zero(count, kWrinkleSlots)};
    Owners owner(static_cast<std::size_t>(count), {-1, -1, -1});
    int index = 0;
    for (const Pattern& pattern : patterns_of(head, rig.atlas, rig.appearance.age)) {
        std::vector<double> window = window_of(head, skin, pattern);
        for (long v = 0; v < count; ++v) {
            double& here = window[static_cast<std::size_t>(v)];
            if (here < kMinWindow) here = 0.0;
            if (here == 0) continue;
            const Vec3 at = head.vertices.row(v).transpose();
            here *= pattern.crease.empty()
                        ? pattern.fraction * (0.8 + 0.4 * noise(at / head.mm(kFadeSpacing_mm)))
                        : pattern.fraction;
        }
        lay(head, skin, pattern, window, index++, rig.appearance.age, lines, owner);
    }
    part_patterns(head, skin, owner, lines);
    claim_phases(skin, lines);
    return lines;
}

}  // namespace risorius::face
