#include "risorius/face/view/detail/skull_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "risorius/geom/closest_point.h"

namespace risorius::face {

double smooth_union(double a, double b, double round) {
    const double h = std::max(round - std::abs(a - b), 0.0) / round;
    return std::min(a, b) - 0.25 * h * h * round;
}
double smooth_cut(double a, double b, double round) { return -smooth_union(-a, -b, round); }

namespace {

/// A stretch of bone that is as thick as its ends say.
struct Knot {
    double x, y, z, radius;
    Vec3 at() const { return {x, y, z}; }
};

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
    const Vec3 q = p - centre;
    const double k0 = q.cwiseQuotient(radii).norm(),
                 k1 = q.cwiseQuotient(radii.cwiseProduct(radii)).norm();
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

double rod(const Vec3& p, const Knot& a, const Knot& b) {
    const Vec3 along = b.at() - a.at(), off = p - a.at();
    const double h = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (off - h * along).norm() - (a.radius + h * (b.radius - a.radius));
}

double rods(const Vec3& p, std::span<const Knot> knots) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i)
        nearest = std::min(nearest, rod(p, knots[i], knots[i + 1]));
    return nearest;
}

double plate(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double radius) {
    return std::sqrt(geom::closest_point_on_triangle(p, a, b, c).squared_distance) - radius;
}

/// Both triangles of a, b, c, d in turn.
double plate(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
             double radius) {
    return std::min(plate(p, a, b, c, radius), plate(p, a, c, d, radius));
}

/// A wall along a path seen from above, between two heights.
double wall(const Vec3& p, std::span<const Knot> path, double low, double high) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        Knot a = path[i], b = path[i + 1];
        a.y = b.y = std::clamp(p.y(), low, high);
        nearest = std::min(nearest, rod(p, a, b));
    }
    return nearest;
}

Vec3 one_side(const Vec3& p) { return {std::abs(p.x()), p.y(), p.z()}; }

// Left side, mm, radius last. Rims of the orbit and the arch of the cheek run through the bone points of skull.json.
constexpr std::array<Knot, 6> kUpperRim{{{50, 17, 62.5, 4.5},
                                         {48, 28, 70, 5.5},
                                         {40, 37, 82, 6},
                                         {26, 39, 87, 7},
                                         {13, 36, 88, 7},
                                         {5, 30, 88, 7}}};
constexpr std::array<Knot, 5> kLowerRim{
    {{50, 17, 62.5, 4.5}, {50, 4, 64, 6}, {41, -3, 71, 6}, {29, -3, 74.5, 5.5}, {16, 4, 79, 4.5}}};
constexpr std::array<Knot, 4> kNasalProcess{
    {{17, -14, 79, 6}, {13, 2, 82, 4.5}, {9, 14, 85, 4.5}, {6, 28, 88, 5}}};
constexpr std::array<Knot, 6> kZygomaticArch{{{48, -4, 64, 8},
                                              {56, -1, 52, 5.5},
                                              {60.5, 0, 40, 4.2},
                                              {61, 1, 28, 4},
                                              {59, 3, 14, 4.5},
                                              {56, 6, 2, 5}}};
constexpr std::array<Knot, 6> kUpperArch{{{0, 0, 81.5, 6.2},
                                          {9, 0, 79.5, 6.2},
                                          {17, 0, 73.5, 6.2},
                                          {21, 0, 62, 6.5},
                                          {24, 0, 50, 7},
                                          {25, 0, 38, 6.5}}};
constexpr std::array<Knot, 6> kLowerArch{{{0, 0, 77, 4.2},
                                          {8, 0, 75, 4.2},
                                          {14.5, 0, 68.5, 4.4},
                                          {19, 0, 58, 4.6},
                                          {23.5, 0, 46, 5},
                                          {27.5, 0, 36, 5.5}}};
constexpr std::array<Knot, 5> kLowerBorder{{{0, -84, 70.5, 6.5},
                                            {13, -84, 67, 6.5},
                                            {27, -77, 55, 6},
                                            {38, -69, 37, 5.5},
                                            {44, -59, 16, 5}}};

/// The opening of the orbit is a rounded square, which runs in a cone to behind the bridge of the nose.
double orbit(const Vec3& p) {
    const Vec3 front(31.5, 17.5, 82), back(19, 18, 40);
    const double h = std::clamp((p.z() - back.z()) / (front.z() - back.z()), 0.0, 1.6);
    const Vec3 axis = back + std::min(h, 1.15) * (front - back);
    const double half_width = 1.5 + 17.4 * std::min(h, 1.1),
                 half_height = 1.5 + 15.5 * std::min(h, 1.1);
    const double u = std::abs(p.x() - axis.x()) / half_width,
                 v = std::abs(p.y() - axis.y() + 0.10 * (p.x() - axis.x())) / half_height;
    const double round = std::pow(std::pow(u, 2.6) + std::pow(v, 2.6), 1 / 2.6);
    return std::max((round - 1) * 0.5 * (half_width + half_height) * 0.9, back.z() - p.z());
}

/// A pear: the width of the opening between the wings, narrow under the nasal bones.
double nose_opening(const Vec3& p) {
    const Knot low{4.6, -18.5, 0, 7.6}, high{0, -3, 0, 4.5};
    Vec3 q = p;
    q.z() = 0;
    return std::max(rod(q, low, high), 48 - p.z());
}

}  // namespace

BoneFields skull_fields(const Vec3& p_mm) {
    const Vec3 p = one_side(p_mm);
    // The braincase, hollowed at the temples
    double braincase = ellipsoid(p, {0, 50, 0}, {78, 80, 97});

    braincase = smooth_cut(braincase, -(p.y() + 26), 24);
    const double base = ellipsoid(p, {0, -6, 22}, {26, 22, 34});
    const double mastoid = smooth_union(ellipsoid(p, {54, -12, -13}, {9, 19, 12}),
                                        ellipsoid(p, {50, 2, 0}, {14, 11, 20}), 6);
    BoneFields fields{};
    fields.vault = smooth_union(smooth_union(braincase, base, 6), mastoid, 8);
    fields.temple = ellipsoid(p, {74, 8, 44}, {29, 46, 31});

    // The middle face
    double out = std::min(rods(p, kUpperRim), rods(p, kLowerRim));
    double maxilla = ellipsoid(p, {14, -14, 56}, {22, 24, 26});
    maxilla = smooth_union(maxilla, rods(p, kNasalProcess), 6);
    maxilla = smooth_union(maxilla, ellipsoid(p, {0, -33, 62}, {23, 10, 24}), 6);
    const double cheek = smooth_union(ellipsoid(p, {44, -8, 65}, {11, 12, 11}),
                                      rod(p, {40, -12, 64, 8}, {27, -26, 60, 6}), 6);
    maxilla = smooth_union(maxilla, cheek, 6);
    out = smooth_union(out, maxilla, 6);
    out = smooth_union(out, rods(p, kZygomaticArch), 4);

    fields.outer = out;
    const double ear = rod(p, {38, 3, 4, 3.2}, {80, 3, 0, 4});
    fields.carved = std::min({orbit(p), nose_opening(p), ear});
    // Sockets of the teeth with the roof of the mouth, plates behind them, the partition of the nose and its spine
    double inner = wall(p, kUpperArch, -42, -29);
    inner = smooth_union(inner, ellipsoid(p, {0, -30, 58}, {24, 5, 24}), 4);
    inner = smooth_union(inner, plate(p, {18, -42, 32}, {14, -8, 34}, {20, -8, 22}, 2.5), 5);
    const double partition = plate(p, {0, -26, 78}, {0, 14, 76}, {0, 14, 50}, {0, -28, 50}, 1.1);
    const double spine = rod(p, {0, -27, 78, 3.5}, {0, -25.5, 87, 1.6});
    const double shell = std::min(rod(p, {8, -18, 62, 2.8}, {9, -18, 76, 2.2}),
                                  rod(p, {6.5, -7, 60, 2.4}, {7, -6, 74, 1.8}));
    fields.inner = std::min({inner, partition, smooth_union(spine, inner, 3), shell});
    return fields;
}

BoneFields mandible_fields(const Vec3& p_mm) {
    const Vec3 p = one_side(p_mm);
    double out = rods(p, kLowerBorder);
    // The body between the border and the sockets, wall by wall
    for (std::size_t i = 0; i + 1 < kLowerBorder.size(); ++i) {
        const auto top = [](std::size_t k) {
            constexpr std::array<double, 5> kHeight{-66, -66, -62, -56, -50};
            constexpr std::array<std::array<double, 2>, 5> kPlace{
                {{0, 76}, {12, 71}, {22, 56}, {29, 36}, {38, 26}}};
            return Vec3(kPlace[k][0], kHeight[k], kPlace[k][1]);
        };
        out = smooth_union(
            out, plate(p, kLowerBorder[i].at(), kLowerBorder[i + 1].at(), top(i + 1), top(i), 4.6),
            3);
    }
    out = smooth_union(out, ellipsoid(p, {0, -80, 71}, {20, 12, 11}), 5);
    // The ramus, its two processes, the condyle
    const Vec3 front_low(36, -52, 32), angle(44.5, -57, 14), neck(47, -20, 12),
        notch(46.5, -19, 23), front_high(45.5, -20, 33);
    double ramus = plate(p, front_low, angle, neck, 3.6);
    ramus = std::min(ramus, plate(p, front_low, neck, notch, front_high, 3.4));
    ramus = smooth_union(ramus, rod(p, {45.5, -20, 31, 4}, {47, -3, 34, 2}), 4);
    ramus = smooth_union(ramus, rod(p, {47, -20, 12.5, 4}, {49, -7, 12.5, 4}), 4);
    ramus = smooth_union(ramus, rod(p, {43.5, -4.5, 13.5, 4.2}, {54.5, -4.5, 12, 4.2}), 4);
    out = smooth_union(out, ramus, 8);
    return {.vault = 1e9,
            .temple = 1e9,
            .outer = out,
            .carved = 1e9,
            .inner = wall(p, kLowerArch, -67, -61.5)};
}

bool near_nasal_bone(const Vec3& p_mm) {
    return std::abs(p_mm.x()) < 20 && p_mm.y() > -16 && p_mm.y() < 38 && p_mm.z() > 74;
}

double nasal_bone_field(const Vec3& p_mm, double depth_under_tissue_mm) {
    constexpr double kThickness = 3.2;
    const Vec3 p = one_side(p_mm);
    const double slab = std::abs(depth_under_tissue_mm - 0.5 * kThickness) - 0.5 * kThickness;
    // From the forehead down to where cartilage begins, wider below; the free edge runs backwards to the side
    const double edge = -3.5 + 0.5 * p.x();
    const double bounds = std::max({edge - p.y(), p.y() - 30, p.x() - 11, 80 - p.z()});
    return smooth_cut(slab, bounds, 1.5);
}

}  // namespace risorius::face
