#include "risorius/face/skin/detail/wrinkle_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "risorius/geom/polyline.h"
#include "risorius/solve/metric_builder.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::face {

namespace {

constexpr double kLeastWindow = 1e-3;
constexpr double kFadeSpacing_mm = 11.0;  // of the random depth along lines
constexpr double kFibreSpread_mm = 6.0;   // of the mean over fibres near a point
constexpr double kPathSpacing_mm = 4.0;

// A piece of a fibre: where, and which way.
struct FibrePiece {
    Vec3 at, along;
};

// One set of lines.
struct Pattern {
    int slot = 0;
    double wavelength_m = 0;
    double share =
        1;  // of the depth that would keep all length, in young skin; the rest thickens it
    std::function<double(const Vec3&)> window = {};
    std::vector<FibrePiece> fibres = {};  // pulling across the lines
    bool along_lines = false;             // the fibres run along the lines instead
    Vec3 anchor = Vec3::Zero();           // where the phase is `anchor_phase`
    double anchor_phase = 0;
    double stays = 0;               // in old skin at rest, 0..1
    double waver = 0.16;            // of the phase, wavelengths
    double waver_spacing = 3;       // of its random values, wavelengths
    std::vector<Vec3> crease = {};  // instead of fibres: the line itself
};

// Landmark terms of one side of a head.
struct Places {
    const rig::Head& head;
    Side side;

    double sign() const { return side == Side::kLeft ? 1.0 : -1.0; }
    Vec3 operator()(const std::string& id) const {
        return head.landmark(id + (side == Side::kLeft ? "_l" : "_r"));
    }
    Vec3 middle(const char* id) const { return head.landmark(id); }
};

// Height of p over a line from left to right through the points, seen from the front.
double height_over(const Vec3& p, const std::vector<Vec3>& line) {
    if (p.x() >= line.front().x()) return p.y() - line.front().y();
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (p.x() >= line[i + 1].x()) {
            const double t = (line[i].x() - p.x()) / std::max(1e-9, line[i].x() - line[i + 1].x());
            return p.y() - (1 - t) * line[i].y() - t * line[i + 1].y();
        }
    return p.y() - line.back().y();
}

std::vector<Vec3> across(const rig::Head& head, const std::vector<const char*>& left_to_middle) {
    std::vector<Vec3> out;
    for (const char* id : left_to_middle) out.push_back(head.landmark(id));
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

// The lines of expression in landmark terms; distances of lines in mm of the average head.
std::vector<Pattern> patterns_of(const rig::Head& head, const rig::Atlas& atlas, double age) {
    std::vector<Pattern> out;
    const auto mm = [&](double atlas_mm) { return head.mm(atlas_mm); };

    // Forehead: across frontalis, above the brows
    {
        const std::vector<Vec3> brows = across(head, {"bl_l", "bp_l", "bc_l", "bm_l", "g"});
        const double top = head.landmark("tr").y(), side = head.landmark("ft_l").x();
        Pattern pattern{.slot = 0, .wavelength_m = mm(8.5), .share = 0.62, .stays = 0.9};
        pattern.window = [=](const Vec3& p) {
            return geom::smoothstep(mm(1), mm(7), height_over(p, brows)) *
                   (1 - geom::smoothstep(top - mm(14), top - mm(2), p.y())) *
                   (1 - geom::smoothstep(0.78 * side, 1.02 * side, std::abs(p.x())));
        };
        for (const char* muscle : {"frontalis_medial", "frontalis_lateral"})
            for (const Side of : {Side::kLeft, Side::kRight})
                add_fibres(head, atlas, muscle, of, 1, pattern.fibres);
        out.push_back(pattern);
    }
    // Frown: across corrugator, upright on both sides of the middle
    {
        const double low = head.landmark("n").y() + mm(4), high = head.landmark("g").y() + mm(16);
        const double wide = head.landmark("bm_l").x() + mm(6);
        Pattern pattern{.slot = 1, .wavelength_m = mm(11), .share = 0.8, .stays = 0.9};
        pattern.window = [=](const Vec3& p) {
            return p.z() < 0 ? 0.0
                             : geom::smoothstep(low + mm(2), low + mm(12), p.y()) *
                                   (1 - geom::smoothstep(high - mm(10), high, p.y())) *
                                   (1 - geom::smoothstep(wide - mm(8), wide, std::abs(p.x())));
        };
        add_fibres(head, atlas, "corrugator_supercilii", Side::kLeft, 1, pattern.fibres);
        add_fibres(head, atlas, "corrugator_supercilii", Side::kRight, -1, pattern.fibres);
        pattern.anchor = head.landmark("g");
        pattern.anchor_phase = 0.5;
        out.push_back(pattern);
    }
    // Root of the nose: across procerus
    {
        const double at = head.landmark("n").y();
        const double wide = 0.62 * head.landmark("en_l").x();
        Pattern pattern{.slot = 2, .wavelength_m = mm(5), .share = 0.4, .stays = 0.7};
        pattern.window = [=](const Vec3& p) {
            return p.z() < 0
                       ? 0.0
                       : geom::smoothstep(at - mm(9), at - mm(4), p.y()) *
                             (1 - geom::smoothstep(at + mm(5), at + mm(12), p.y())) *
                             (1 - geom::smoothstep(wide - mm(4), wide + mm(2), std::abs(p.x())));
        };
        for (const Side of : {Side::kLeft, Side::kRight})
            add_fibres(head, atlas, "procerus", of, 1, pattern.fibres);
        pattern.anchor = head.landmark("n");
        out.push_back(pattern);
    }
    // Around the mouth: across orbicularis, off the red of the lips
    for (const bool upper : {true, false}) {
        const std::vector<Vec3> red = upper ? across(head, {"ch_l", "ulc_l", "cph_l", "ls"})
                                            : across(head, {"ch_l", "llc_l", "li"});
        const double corner = head.landmark("ch_l").x();
        const double end = upper ? head.landmark("sn").y() - head.landmark("ls").y()
                                 : head.landmark("li").y() - head.landmark("sl").y();
        Pattern pattern{.slot = 0, .wavelength_m = mm(4), .share = 0.3, .stays = 0.8};
        pattern.window = [=](const Vec3& p) {
            if (p.z() < 0) return 0.0;
            const double from_red = (upper ? 1 : -1) * height_over(p, red);
            return geom::smoothstep(mm(0.8), mm(3), from_red) *
                   (1 - geom::smoothstep(0.5 * std::abs(end), 1.1 * std::abs(end), from_red)) *
                   (1 - geom::smoothstep(0.75 * corner, 1.05 * corner, std::abs(p.x())));
        };
        const std::string muscle = upper ? "orbicularis_oris_upper_" : "orbicularis_oris_lower_";
        for (const char* part : {"peripheral", "marginal"})
            add_fibres(head, atlas, muscle + part, Side::kLeft, 1, pattern.fibres);
        pattern.anchor = head.landmark(upper ? "mp" : "sl");
        pattern.anchor_phase = 0.5;
        out.push_back(pattern);
    }
    // Chin: dimples, along and across mentalis
    for (const bool along : {false, true}) {
        const Vec3 middle = head.landmark("pg");
        Pattern pattern{.slot = along ? 2 : 1,
                        .wavelength_m = mm(along ? 4.4 : 5),
                        .share = 0.8,
                        .waver = 0.42,
                        .waver_spacing = 1.3};
        pattern.window = [=](const Vec3& p) {
            const double far = std::hypot(p.x() - middle.x(), 1.25 * (p.y() - middle.y()));
            return p.z() < 0 ? 0.0 : 1 - geom::smoothstep(mm(6), mm(17), far);
        };
        for (const Side of : {Side::kLeft, Side::kRight})
            add_fibres(head, atlas, "mentalis", of, 1, pattern.fibres);
        pattern.along_lines = along;
        out.push_back(pattern);
    }
    for (const Side side : {Side::kLeft, Side::kRight}) {
        const Places at{head, side};
        const double sign = at.sign();
        // Beside a crease that runs down the cheek, which begins over `begin_mm`
        const auto beside = [=](const std::vector<Vec3>& line, double from_mm, double to_mm,
                                double begin_mm) {
            const double high = line.front().y(), low = line.back().y();
            return [=](const Vec3& p) {
                if (p.z() < 0 || sign * p.x() < mm(8)) return 0.0;
                return (1 - geom::smoothstep(mm(from_mm), mm(to_mm),
                                             geom::distance_to_polyline(p, line))) *
                       geom::smoothstep(low, low + mm(9), p.y()) *
                       (1 - geom::smoothstep(high - mm(begin_mm), high + mm(1), p.y()));
            };
        };
        // Crow's feet: across the outer orbicularis oculi, fanned from the outer canthus
        {
            const Vec3 canthus = at("ex");
            Pattern pattern{.slot = 0, .wavelength_m = mm(4.2), .share = 0.5, .stays = 1};
            pattern.window = [=](const Vec3& p) {
                const double out_by = sign * (p.x() - canthus.x()), up = p.y() - canthus.y();
                const double far = (p - canthus).norm();
                if (out_by <= 0) return 0.0;
                return geom::smoothstep(mm(2.5), mm(7), out_by) *
                       (1 - geom::smoothstep(mm(13), mm(27), far)) *
                       (1 - geom::smoothstep(0.75, 1.15, std::abs(std::atan2(up, out_by + mm(3)))));
            };
            add_fibres(head, atlas, "orbicularis_oculi_orbital", side, 1, pattern.fibres);
            out.push_back(pattern);
        }
        // Side of the nose: across the levator of lip and wing
        {
            const double low = at.middle("rhi").y() - mm(3), high = at.middle("n").y() - mm(1);
            const double out_to = sign * at("al").x();
            Pattern pattern{.slot = 1, .wavelength_m = mm(3.8), .share = 0.35};
            pattern.window = [=](const Vec3& p) {
                return p.z() < 0
                           ? 0.0
                           : geom::smoothstep(low - mm(4), low + mm(3), p.y()) *
                                 (1 - geom::smoothstep(high - mm(7), high, p.y())) *
                                 geom::smoothstep(mm(2), mm(5), sign * p.x()) *
                                 (1 - geom::smoothstep(0.85 * out_to, 1.15 * out_to, sign * p.x()));
            };
            add_fibres(head, atlas, "levator_labii_superioris_alaeque_nasi", side, 1,
                       pattern.fibres);
            out.push_back(pattern);
        }
        // The nasolabial fold
        {
            Pattern pattern{.slot = 1, .wavelength_m = mm(18), .share = 0.5, .stays = 1};
            pattern.crease =
                geom::sample_curve({at("ac") + Vec3(sign * mm(2.5), mm(5), 0), at("nl1"), at("nl2"),
                                    at("nl3"), at("nl3") + Vec3(sign * mm(3), mm(-9), mm(-2))},
                                   mm(2));
            pattern.window = beside(pattern.crease, 4.5, 8.8, 5);
            out.push_back(pattern);
        }
        if (age <= 0) continue;
        // Of old skin alone: from the corner of the mouth to the jaw, and below the lower lid
        {
            Pattern pattern{.slot = 2, .wavelength_m = mm(13), .share = 0.45 * age, .stays = 1};
            const Vec3 corner = at("ch");
            pattern.crease = geom::sample_curve({corner + Vec3(sign * mm(2), mm(-3), mm(-1)),
                                                 corner + Vec3(sign * mm(5), mm(-12), mm(-2)),
                                                 corner + Vec3(sign * mm(6), mm(-22), mm(-4))},
                                                mm(2));
            pattern.window = beside(pattern.crease, 3.5, 6.4, 4);
            out.push_back(pattern);
        }
        {
            Pattern pattern{.slot = 2, .wavelength_m = mm(10), .share = 0.28 * age, .stays = 1};
            const Vec3 inner = at("en"), lid = at("pi"), outer = at("ex");
            pattern.crease = geom::sample_curve({inner + Vec3(sign * mm(1), mm(-7), mm(2)),
                                                 lid + Vec3(sign * mm(-4), mm(-9.5), mm(0)),
                                                 lid + Vec3(sign * mm(6), mm(-10), mm(-2)),
                                                 outer + Vec3(sign * mm(1), mm(-9), mm(0))},
                                                mm(2));
            const std::vector<Vec3> line = pattern.crease;
            const double from = sign * line.front().x(), to = sign * line.back().x();
            pattern.window = [=](const Vec3& p) {
                if (p.z() < 0) return 0.0;
                return (1 -
                        geom::smoothstep(mm(2.5), mm(4.9), geom::distance_to_polyline(p, line))) *
                       geom::smoothstep(from - mm(1), from + mm(5), sign * p.x()) *
                       (1 - geom::smoothstep(to - mm(6), to + mm(1), sign * p.x()));
            };
            out.push_back(pattern);
        }
    }
    return out;
}

// Smooth noise in space, about -1..1, the same on every machine.
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

// Where along the line the point of it lies that is nearest to p, m.
double place_on(const Vec3& p, const std::vector<Vec3>& line) {
    const geom::PolylinePoint nearest = geom::nearest_on_polyline(p, line);
    double place = 0;
    for (std::size_t i = 0; i < nearest.piece; ++i) place += (line[i + 1] - line[i]).norm();
    return place + nearest.share * (line[nearest.piece + 1] - line[nearest.piece]).norm();
}

// Signed distance from the crease, positive to the outside of the face.
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

// Whose phase a vertex has in each slot, -1 nobody's.
using Owners = std::vector<std::array<int, kWrinkleSlots>>;

// The phase of one pattern on the triangles that its window touches.
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
            // The far ones count for a little too, so that there always is a direction
            Vec3 pull = Vec3::Zero();
            for (const FibrePiece& fibre : pattern.fibres) {
                const double far = (fibre.at - centre).squaredNorm() / (2 * spread * spread);
                pull += (std::exp(-far) + 1e-6 / (1 + far)) * fibre.along;
            }
            pull -= normal * normal.dot(pull);
            if (pattern.along_lines) pull = normal.cross(pull);
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
        // Valleys where they are wanted
        int nearest = 0;
        for (int i = 1; i < count; ++i)
            if ((at(vertex[i]) - pattern.anchor).squaredNorm() <
                (at(vertex[nearest]) - pattern.anchor).squaredNorm())
                nearest = i;
        const double shift = pattern.anchor_phase - phase(nearest, 0);
        for (int i = 0; i < count; ++i) {
            const Vec3 place = at(vertex[i]) / (pattern.waver_spacing * pattern.wavelength_m);
            phase(i, 0) += shift + pattern.waver * noise(place);
        }
    }
    for (int i = 0; i < count; ++i) {
        const int v = vertex[i];
        if (lines.window(v, pattern.slot) > window[v]) continue;
        lines.phase(v, pattern.slot) = phase(i, 0);
        lines.window(v, pattern.slot) = window[v];
        lines.wavelength(v, pattern.slot) = pattern.wavelength_m;
        lines.at_rest(v, pattern.slot) = pattern.stays * age;
        owner[v][pattern.slot] = index;
    }
    if (pattern.crease.empty()) return;
    Crease crease{.slot = pattern.slot, .vertex = {}, .place_m = {}};
    for (const int v : vertex)
        if (window[v] > 0 && owner[v][pattern.slot] == index) {
            crease.vertex.push_back(v);
            crease.place_m.push_back(place_on(head.vertices.row(v).transpose(), pattern.crease));
        }
    lines.creases.push_back(crease);
}

}  // namespace

WrinkleLines lay_wrinkle_lines(const rig::Head& head, const rig::RigDescription& rig,
                               const Triangles& skin) {
    const long count = head.vertices.rows();
    WrinkleLines lines{Points::Zero(count, kWrinkleSlots),
                       Points::Zero(count, kWrinkleSlots),
                       Points::Zero(count, kWrinkleSlots),
                       {},
                       Points::Zero(count, kWrinkleSlots)};
    Owners owner(static_cast<std::size_t>(count), {-1, -1, -1});
    int index = 0;
    for (const Pattern& pattern : patterns_of(head, rig.atlas, rig.look.age)) {
        std::vector<double> window(static_cast<std::size_t>(count), 0.0);
        for (long i = 0; i < skin.size(); ++i) {
            const int v = skin.data()[i];
            const Vec3 at = head.vertices.row(v).transpose();
            const double here = pattern.window(at);
            window[v] = here < kLeastWindow ? 0.0 : here;
            if (window[v] > 0 && pattern.crease.empty())
                window[v] *= pattern.share * (0.8 + 0.4 * noise(at / head.mm(kFadeSpacing_mm)));
            else
                window[v] *= pattern.share;
        }
        lay(head, skin, pattern, window, index++, rig.look.age, lines, owner);
    }
    // Where two patterns of a slot meet, a triangle would run through the phases of both
    for (long f = 0; f < skin.rows(); ++f)
        for (int slot = 0; slot < kWrinkleSlots; ++slot) {
            const int a = owner[skin(f, 0)][slot], b = owner[skin(f, 1)][slot],
                      c = owner[skin(f, 2)][slot];
            if (a == b && b == c) continue;
            for (int k = 0; k < 3; ++k) lines.window(skin(f, k), slot) = 0;
        }
    return lines;
}

}  // namespace risorius::face
