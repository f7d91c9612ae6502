// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/oral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "risorius/headmodel/detail/part_layout.h"

namespace risorius::headmodel {
namespace {

/// Crowns from the midline backwards. Widths and heights: crown table of the skull data; premolars, laterals and
/// second molars from the same norms (estimates).
struct Crown {
    double width, height, thickness;  ///< along the arch, along the tooth, across the arch
    bool molar;
};
constexpr Crown kUpperCrowns[7] = {{8.6, 10.5, 6.6, false}, {6.6, 9.0, 5.8, false},
                                   {7.6, 10.0, 7.4, false}, {7.0, 8.5, 8.4, true},
                                   {6.8, 8.0, 8.4, true},   {10.4, 7.5, 10.2, true},
                                   {9.6, 7.0, 10.0, true}};
constexpr Crown kLowerCrowns[7] = {
    {5.3, 8.8, 5.6, false}, {5.8, 9.0, 5.9, false}, {6.8, 10.3, 7.0, false}, {7.0, 8.6, 7.4, true},
    {7.1, 8.2, 7.8, true},  {10.8, 7.5, 9.6, true}, {10.4, 7.0, 9.4, true}};

/// The incisal and occlusal line of one side as a polyline dense in length. Incisors and molars as measured (skull data); the canines at
/// the norm between them (34 mm above, 29 below), some millimetres behind the lips and not where the narrow measured arch has them.
class ArchLine {
  public:
    explicit ArchLine(Arch arch) {
        std::vector<Vec3> knots;
        if (arch == Arch::kUpper)
            knots = {Vec3(0, -53.7, 88.3),  Vec3(8.2, -53.3, 86.9),  Vec3(13.5, -52.6, 83),
                     Vec3(17, -51.7, 76.4), Vec3(19.8, -50.5, 69.8), Vec3(22.6, -48.4, 60.5),
                     Vec3(24.6, -46, 51),   Vec3(25.2, -44.6, 45.5)};
        else
            knots = {Vec3(0, -52.0, 86.3),    Vec3(6.5, -51.7, 85.1),  Vec3(11.3, -51, 81.2),
                     Vec3(15, -50.2, 75.3),   Vec3(18.1, -49.6, 67.9), Vec3(20.9, -48.4, 57.5),
                     Vec3(22.7, -46.2, 48.5), Vec3(23.2, -45, 43)};
        // Mirrored start, so that the arch crosses the midline at a right angle.
        std::vector<Vec3> all{Vec3(-knots[1].x(), knots[1].y(), knots[1].z())};
        all.insert(all.end(), knots.begin(), knots.end());
        all.push_back(2 * all.back() - all[all.size() - 2]);
        for (std::size_t k = 1; k + 2 < all.size(); ++k)
            for (int i = 0; i < 40; ++i) {
                const double t = i / 40.0;
                const Vec3 &a = all[k - 1], &b = all[k], &c = all[k + 1], &d = all[k + 2];
                line_.push_back(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t +
                                       (3 * b - a - 3 * c + d) * t * t * t));
            }
        length_.push_back(0);
        for (std::size_t k = 1; k < line_.size(); ++k)
            length_.push_back(length_.back() + (line_[k] - line_[k - 1]).norm());
    }
    double length() const { return length_.back(); }
    Vec3 at(double s) const {
        std::size_t k = 0;
        while (k + 2 < length_.size() && length_[k + 1] < s) ++k;
        return line_[k] +
               (line_[k + 1] - line_[k]) * ((s - length_[k]) / (length_[k + 1] - length_[k]));
    }
    /// Towards lips and cheek, level.
    Vec3 outward(double s) const {
        Vec3 along = at(s + 0.5) - at(std::max(0.0, s - 0.5));
        if (s < 0.5) along = Vec3(1, 0, 0);
        return Vec3(-along.z(), 0, along.x()).normalized();
    }

  private:
    std::vector<Vec3> line_;
    std::vector<double> length_;
};

/// Where each crown's middle stands along the arch, and the factor that fits the row into the measured arch.
double crown_places(Arch arch, const ArchLine& line, std::array<double, 7>& place) {
    const Crown* crowns = arch == Arch::kUpper ? kUpperCrowns : kLowerCrowns;
    double total = 0;
    for (int k = 0; k < 7; ++k) total += crowns[k].width;
    const double scale = std::min(1.0, (line.length() - 0.3) / total);
    double s = 0;
    for (int k = 0; k < 7; ++k) {
        place[k] = s + 0.5 * scale * crowns[k].width;
        s += scale * crowns[k].width;
    }
    return scale;
}

class Builder {
  public:
    explicit Builder(const std::string& group) { mesh_.group_names = {group}; }
    int add(const Vec3& p) {
        points_.push_back(p);
        return static_cast<int>(points_.size()) - 1;
    }
    struct Corner {
        int vertex;
        Vec2 place;
    };
    void face(const std::vector<Corner>& corners) {
        for (const Corner& corner : corners) {
            mesh_.corner_vertex.push_back(corner.vertex);
            places_.push_back(corner.place);
        }
        mesh_.face_begin.push_back(static_cast<int>(mesh_.corner_vertex.size()));
        mesh_.face_group.push_back(0);
    }
    /// Where a tube is laid out: `ring` -1 is the apex before the first, `around` 0..1 from the vertex `begin` of a ring.
    struct Layout {
        std::size_t begin = 0;
        std::function<Vec2(int ring, double around)> at;
    };
    /// Quads along a tube of rings of equal size; normals are set right by the sign of its volume.
    void tube(const std::vector<std::vector<int>>& rings, const Layout& layout) {
        Vec3 middle = Vec3::Zero();
        int count = 0;
        for (const auto& ring : rings)
            for (const int v : ring) {
                middle += points_[static_cast<std::size_t>(v)];
                ++count;
            }
        middle /= count;
        double volume = 0;
        const auto each = [&](const auto& use) {
            for (std::size_t r = 0; r + 1 < rings.size(); ++r)
                for (std::size_t k = 0; k < rings[r].size(); ++k) {
                    const std::size_t n = (k + 1) % rings[r].size();
                    use(r, k, rings[r][k], rings[r][n], rings[r + 1][n], rings[r + 1][k]);
                }
        };
        each([&](std::size_t, std::size_t, int a, int b, int c, int d) {
            const auto at = [&](int v) {
                return Vec3(points_[static_cast<std::size_t>(v)] - middle);
            };
            volume += (at(c) - at(a)).cross(at(d) - at(b)).dot(at(a) + at(b) + at(c) + at(d));
        });
        inside_out_ = volume < 0;
        rings_ = rings;
        layout_ = layout;
        each([&](std::size_t ring, std::size_t k, int a, int b, int c, int d) {
            const int r = static_cast<int>(ring);
            const Corner p{a, place(r, k, 0)}, q{b, place(r, k, 1)}, s{c, place(r + 1, k, 1)},
                t{d, place(r + 1, k, 0)};
            if (inside_out_)
                face({p, t, s, q});
            else
                face({p, q, s, t});
        });
    }
    /// A fan over the last ring of the latest tube, or over its first.
    void close(const Vec3& apex, bool first) {
        const std::vector<int>& ring = first ? rings_.front() : rings_.back();
        const int r = first ? 0 : static_cast<int>(rings_.size()) - 1;
        const int top = add(apex);
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Corner a{ring[k], place(r, k, 0)}, b{ring[(k + 1) % ring.size()], place(r, k, 1)},
                tip{top, place(first ? -1 : r + 1, k, 0.5)};
            if (inside_out_ != first)
                face({b, a, tip});
            else
                face({a, b, tip});
        }
    }
    geom::PolygonMesh finish() {
        mesh_.positions.resize(static_cast<long>(points_.size()), 3);
        for (std::size_t v = 0; v < points_.size(); ++v)
            mesh_.positions.row(static_cast<long>(v)) = points_[v].transpose();
        mesh_.corner_texcoord.resize(static_cast<long>(places_.size()), 2);
        for (std::size_t c = 0; c < places_.size(); ++c)
            mesh_.corner_texcoord.row(static_cast<long>(c)) = places_[c].transpose();
        return mesh_;
    }
    std::vector<Vec3>& points() { return points_; }

  private:
    /// Of the cell between the vertices k and k + 1 of a ring, `step` of the way from one to the other.
    Vec2 place(int ring, std::size_t k, double step) const {
        const std::size_t count = rings_.front().size();
        const double from = static_cast<double>((k + count - layout_.begin) % count);
        return layout_.at(ring, (from + step) / static_cast<double>(count));
    }

    geom::PolygonMesh mesh_;
    std::vector<Vec3> points_;
    std::vector<Vec2> places_;             ///< of the corners
    std::vector<std::vector<int>> rings_;  ///< of the latest tube
    Layout layout_;
    bool inside_out_ = false;
};

constexpr int kCrownAround = 20, kCrownRings = 9;

/// 0 at the buried neck, 1 at the edge; close rings where the edge is rounded.
double crown_height(int ring) {
    return ring < 6 ? ring / 6.0 * 0.86 : 0.86 + (ring - 5) * 0.14 / (kCrownRings - 5);
}

void add_crown(Builder& builder, const Crown& crown, double scale, Arch arch, const ArchLine& line,
               double place, double side, const Disc& disc) {
    constexpr int kAround = kCrownAround, kRings = kCrownRings;
    const double to_edge = arch == Arch::kUpper ? -1 : 1;  // of y
    const Vec3 edge = line.at(place);
    const Vec3 out = line.outward(place), along = Vec3(out.z(), 0, -out.x());
    const bool front = !crown.molar;
    std::vector<std::vector<int>> rings;
    const double buried = 1.5;  // of the crown's neck in the gum
    for (int r = 0; r <= kRings; ++r) {
        const double h = crown_height(r);
        const double rounding =
            h < 0.86 ? 1.0 : std::sqrt(std::max(0.0, 1 - std::pow((h - 0.86) / 0.155, 2.0)));
        const double half_width = 0.5 * scale * crown.width * 0.985 *
                                  (0.74 + 0.26 * std::sin(std::min(1.0, h / 0.72) * M_PI / 2)) *
                                  (front ? 0.90 + 0.10 * rounding : 0.62 + 0.38 * rounding);
        const double taper =
            front ? 1.0 - 0.70 * std::pow(h, 1.2) : 0.92 + 0.08 * std::sin(h * M_PI);
        const double half_depth = 0.5 * crown.thickness * taper *
                                  (front ? 0.55 + 0.45 * rounding : 0.62 + 0.38 * rounding);
        rings.emplace_back();
        for (int k = 0; k < kAround; ++k) {
            const double a = 2 * M_PI * k / kAround, power = front ? 0.75 : 0.7;
            const double u = std::copysign(std::pow(std::abs(std::cos(a)), power), std::cos(a));
            const double v = std::copysign(std::pow(std::abs(std::sin(a)), power), std::sin(a));
            // The labial face of a front tooth stays in one gentle curve; thickness goes to the tongue side.
            const double lean =
                front ? -(1 - h) * 0.7 - half_depth + 0.6 - 1.2 * h * h * 0.3 : -half_depth * 0.2;
            const double cusp = crown.molar ? 0.5 * (1 - rounding) * std::abs(u * v) * 2.0 : 0.0;
            double y = edge.y() - to_edge * (1 - h) * (crown.height + buried) + to_edge * cusp;
            if (front)
                y -= to_edge * 0.5 * std::pow(std::abs(u), 4.0) * (h > 0.8 ? 1.0 : 0.0) *
                     (1 - rounding);
            Vec3 p = edge + along * (half_width * u) + out * (lean + half_depth * v);
            p.y() = y;
            p.x() *= side;
            rings.back().push_back(builder.add(p));
        }
    }
    // From the rounded edge to its middle it is a quarter as far as from the neck to the edge.
    constexpr double kRim = 0.2;
    builder.tube(rings, {0, [&disc](int ring, double around) {
                             const double fraction =
                                 ring > kRings ? 0 : 1 - (1 - kRim) * crown_height(ring);
                             return disc.at(fraction, 2 * M_PI * around);
                         }});
    Vec3 apex = Vec3::Zero();
    for (const int v : rings.back())
        apex += builder.points()[static_cast<std::size_t>(v)] / kAround;
    if (crown.molar) apex.y() -= to_edge * 0.7;  // the central fossa
    builder.close(apex, false);
}

}  // namespace

geom::PolygonMesh teeth(Arch arch, const std::string& group) {
    Builder builder(group);
    const ArchLine line(arch);
    std::array<double, 7> place;
    const double scale = crown_places(arch, line, place);
    const bool upper = arch == Arch::kUpper;
    for (const double side : {1.0, -1.0})
        for (int k = 0; k < 7; ++k)
            add_crown(builder, (upper ? kUpperCrowns : kLowerCrowns)[k], scale, arch, line,
                      place[k], side, crown_disc(upper, side > 0 ? k : k + 7));
    return builder.finish();
}

std::vector<double> crown_heights() {
    std::vector<double> heights;
    for (int tooth = 0; tooth < 14; ++tooth) {
        const double max = kUpperCrowns[tooth % 7].molar ? 0.8 : 1.0;
        for (int r = 0; r <= kCrownRings; ++r)
            heights.insert(heights.end(), kCrownAround, std::min(crown_height(r), max));
        heights.push_back(max);  // the middle of the edge
    }
    return heights;
}

geom::PolygonMesh gums(Arch arch, const std::string& group) {
    constexpr int kAround = 16, kSteps = 72;
    Builder builder(group);
    const ArchLine line(arch);
    std::array<double, 7> place;
    const double scale = crown_places(arch, line, place);
    const Crown* crowns = arch == Arch::kUpper ? kUpperCrowns : kLowerCrowns;
    const double to_edge = arch == Arch::kUpper ? -1 : 1;
    std::vector<std::vector<int>> rings;
    for (int step = -kSteps; step <= kSteps; ++step) {
        const double s = std::abs(step) * line.length() / kSteps, side = step < 0 ? -1 : 1;
        int tooth = 0;
        while (tooth < 6 && s > 0.5 * (place[tooth] + place[tooth + 1])) ++tooth;
        const Crown& crown = crowns[tooth];
        const double within =
            std::min(1.0, std::abs(s - place[tooth]) / (0.5 * scale * crown.width));
        // Smoothed height and thickness, so that the gum does not step from tooth to tooth.
        double height = 0, thickness = 0, weight = 0;
        for (int k = 0; k < 7; ++k) {
            const double w = std::exp(-std::pow((s - place[k]) / 6.0, 2));
            height += w * crowns[k].height;
            thickness += w * crowns[k].thickness;
            weight += w;
        }
        height /= weight;
        thickness /= weight;
        const Vec3 edge = line.at(s), out = line.outward(s);
        const double papilla = 2.2 * std::pow(within, 2.0);
        const double rim = edge.y() - to_edge * (height - papilla);
        const double root = edge.y() - to_edge * (height + 4.5);
        const double depth = 0.5 * thickness + 1.1;
        const double back = std::clamp((s - place[1]) / (place[3] - place[1]), 0.0, 1.0);
        const double middle = (1 - back) * (-0.5 * thickness + 0.2) - back * 0.8;
        const double end = std::min(1.0, 0.45 + 2.2 * (1 - s / line.length()));
        rings.emplace_back();
        for (int k = 0; k < kAround; ++k) {
            const double a = 2 * M_PI * k / kAround;
            const double across = std::copysign(std::pow(std::abs(std::cos(a)), 0.7), std::cos(a));
            const double lift = std::copysign(std::pow(std::abs(std::sin(a)), 0.8), std::sin(a));
            Vec3 p =
                edge + out * (middle + across * depth * (1 - 0.18 * std::max(0.0, lift)) * end);
            p.y() = 0.5 * (rim + root) + 0.5 * (rim - root) * lift * end;
            p.x() *= side;
            rings.back().push_back(builder.add(p));
        }
    }
    const double count = static_cast<double>(rings.size());
    builder.tube(rings, {kAround * 3 / 4, [&](int ring, double around) {
                             return gum_place(arch == Arch::kUpper, (ring + 1) / (count + 1),
                                              around);
                         }});
    for (const bool last : {false, true}) {
        const auto& ring = last ? rings.back() : rings.front();
        Vec3 apex = Vec3::Zero();
        for (const int v : ring) apex += builder.points()[static_cast<std::size_t>(v)] / kAround;
        builder.close(apex, !last);
    }
    return builder.finish();
}

geom::PolygonMesh tongue(const std::string& group) {
    // Sections from the tip to the root: middle height and depth along the tongue, half width, half thickness.
    struct Section {
        double y, z, half_width, half_thickness;
    };
    constexpr Section kSections[] = {
        {-56.6, 79.0, 4.5, 1.8}, {-56.4, 77.5, 8.2, 3.0}, {-56.2, 74, 11.0, 4.0},
        {-55.7, 69, 13.0, 5.6},  {-55.2, 63, 14.6, 7.6},  {-55, 57, 15.8, 9.8},
        {-56.2, 51, 16.6, 11.6}, {-59.2, 45, 17.0, 12.2}, {-62.5, 40.5, 16.4, 12},
        {-66.5, 37.5, 15, 11},   {-70, 36, 12.5, 9}};
    constexpr int kAround = 28;
    Builder builder(group);
    std::vector<std::vector<int>> rings;
    const int count = static_cast<int>(std::size(kSections));
    for (int r = 0; r < count; ++r) {
        const Section& s = kSections[r];
        // Sections stand square to the line through their middles.
        const Section &a = kSections[std::max(0, r - 1)],
                      &b = kSections[std::min(count - 1, r + 1)];
        const Vec3 along = Vec3(0, b.y - a.y, b.z - a.z).normalized();
        const Vec3 up = Vec3(1, 0, 0).cross(along).y() > 0 ? Vec3(1, 0, 0).cross(along)
                                                           : Vec3(-Vec3(1, 0, 0).cross(along));
        rings.emplace_back();
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2 * M_PI * k / kAround;
            const double x = std::cos(angle), v = std::sin(angle);
            // A shallow groove along the middle of the back.
            const double groove = v > 0 ? 0.10 * std::exp(-std::pow(x / 0.18, 2)) : 0.0;
            rings.back().push_back(
                builder.add(Vec3(s.half_width * x, s.y, s.z) +
                            up * (s.half_thickness *
                                  (std::copysign(std::pow(std::abs(v), 0.85), v) - groove))));
        }
    }
    const Disc disc = tongue_disc();
    builder.tube(rings, {0, [&](int ring, double around) {
                             return disc.at((ring + 1.0) / (count + 1), 2 * M_PI * around);
                         }});
    builder.close(Vec3(0, -56.7, 80.0), true);
    builder.close(Vec3(0, -71.5, 35.5), false);
    return builder.finish();
}

}  // namespace risorius::headmodel
