// SPDX-License-Identifier: MIT
#include "risorius/face/view/detail/skull_shapes.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/data_folder.h"
#include "risorius/core/json_cursor.h"
#include "risorius/geom/closest_point.h"

namespace risorius::face {

double smooth_union(double a, double b, double round) {
    const double h = std::max(round - std::abs(a - b), 0.0) / round;
    return std::min(a, b) - 0.25 * h * h * round;
}
double smooth_cut(double a, double b, double round) { return -smooth_union(-a, -b, round); }

namespace {

using Knot = SkullShapes::Knot;

double ellipsoid(const Vec3& p, const SkullShapes::Ellipsoid& shape) {
    const Vec3& radii = shape.radii;
    const Vec3 q = p - shape.centre;
    const double k0 = q.cwiseQuotient(radii).norm(),
                 k1 = q.cwiseQuotient(radii.cwiseProduct(radii)).norm();
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

double rod(const Vec3& p, const Knot& a, const Knot& b) {
    const Vec3 along = b.at - a.at, off = p - a.at;
    const double h = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (off - h * along).norm() - (a.radius + h * (b.radius - a.radius));
}

double rod(const Vec3& p, const SkullShapes::Rod& shape) { return rod(p, shape.from, shape.to); }

double rods(const Vec3& p, const std::vector<Knot>& knots) {
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

double plate(const Vec3& p, const SkullShapes::Plate& shape) {
    const std::vector<Vec3>& c = shape.corners;
    return c.size() == 3 ? plate(p, c[0], c[1], c[2], shape.radius)
                         : plate(p, c[0], c[1], c[2], c[3], shape.radius);
}

/// A wall along a path seen from above, between two heights.
double wall(const Vec3& p, const std::vector<Knot>& path, double low, double high) {
    double nearest = 1e9;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        Knot a = path[i], b = path[i + 1];
        a.at.y() = b.at.y() = std::clamp(p.y(), low, high);
        nearest = std::min(nearest, rod(p, a, b));
    }
    return nearest;
}

Vec3 one_side(const Vec3& p) { return {std::abs(p.x()), p.y(), p.z()}; }

/// The cone goes on a little beyond the front of the orbit, so that its rim is open.
double orbit(const Vec3& p, const SkullShapes::Orbit& shape) {
    constexpr double kBeyond = 1.6, kAxisBeyond = 1.15, kRimBeyond = 1.1, kFlat = 0.9;
    const double h =
        std::clamp((p.z() - shape.back.z()) / (shape.front.z() - shape.back.z()), 0.0, kBeyond);
    const Vec3 axis = shape.back + std::min(h, kAxisBeyond) * (shape.front - shape.back);
    const double half_width = shape.apex + shape.half_width * std::min(h, kRimBeyond),
                 half_height = shape.apex + shape.half_height * std::min(h, kRimBeyond);
    const double u = std::abs(p.x() - axis.x()) / half_width,
                 v = std::abs(p.y() - axis.y() + shape.tilt * (p.x() - axis.x())) / half_height;
    const double round = std::pow(std::pow(u, shape.squareness) + std::pow(v, shape.squareness),
                                  1 / shape.squareness);
    return std::max((round - 1) * 0.5 * (half_width + half_height) * kFlat, shape.back.z() - p.z());
}

double nose_opening(const Vec3& p, const SkullShapes& shapes) {
    Vec3 q = p;
    q.z() = 0;
    return std::max(rod(q, shapes.nose_opening), shapes.nose_opening_back - p.z());
}

constexpr Range kPlace_mm{-300, 300}, kRadius_mm{0.1, 300};

Vec3 place_of(const JsonCursor& json) {
    const Vec3 out = json.vec3();
    if (out.cwiseAbs().maxCoeff() > kPlace_mm.max) json.fail("a place within 300 mm of the origin");
    return out;
}

Knot knot_of(const JsonCursor& json) {
    const std::vector<JsonCursor> items = json.items();
    if (items.size() != 4) json.fail("[x, y, z, radius]");
    return {
        Vec3(items[0].number(kPlace_mm), items[1].number(kPlace_mm), items[2].number(kPlace_mm)),
        items[3].number(kRadius_mm)};
}

void read(const JsonCursor& json, std::vector<Knot>& out) {
    for (const JsonCursor& item : json.items()) out.push_back(knot_of(item));
    if (out.size() < 2) json.fail("two points or more");
}
void read(const JsonCursor& json, SkullShapes::Rod& out) {
    const std::vector<JsonCursor> ends = json.items();
    if (ends.size() != 2) json.fail("two points");
    out = {knot_of(ends[0]), knot_of(ends[1])};
}
void read(const JsonCursor& json, SkullShapes::Ellipsoid& out) {
    json.allow_keys({"centre", "radii"});
    out = {place_of(json.at("centre")), place_of(json.at("radii"))};
    if (out.radii.minCoeff() <= 0) json.at("radii").fail("three lengths above 0");
}
void read(const JsonCursor& json, SkullShapes::Plate& out) {
    json.allow_keys({"corners", "radius"});
    for (const JsonCursor& corner : json.at("corners").items())
        out.corners.push_back(place_of(corner));
    if (out.corners.size() != 3 && out.corners.size() != 4)
        json.at("corners").fail("three or four corners");
    out.radius = json.at("radius").number(kRadius_mm);
}
void read(const JsonCursor& json, double& out) { out = json.number(kPlace_mm); }
void read(const JsonCursor& json, SkullShapes::Heights& out) {
    const std::vector<JsonCursor> ends = json.items();
    if (ends.size() != 2) json.fail("two heights");
    out = {ends[0].number(kPlace_mm), ends[1].number(kPlace_mm)};
    if (!(out.low < out.high)) json.fail("the lower height first");
}
void read(const JsonCursor& json, SkullShapes::Orbit& out) {
    json.allow_keys({"front", "back", "apex", "half_width", "half_height", "squareness", "tilt"});
    out = {place_of(json.at("front")),
           place_of(json.at("back")),
           json.at("apex").number(kRadius_mm),
           json.at("half_width").number(kRadius_mm),
           json.at("half_height").number(kRadius_mm),
           json.at("squareness").number({1, 20}),
           json.at("tilt").number({-1, 1})};
    if (!(out.back.z() < out.front.z())) json.at("back").fail("a place behind \"front\"");
}
void read(const JsonCursor& json, SkullShapes::NasalBone& out) {
    json.allow_keys({"thickness", "lower_edge", "edge_slope", "top", "half_width", "back"});
    out = {json.at("thickness").number(kRadius_mm),  json.at("lower_edge").number(kPlace_mm),
           json.at("edge_slope").number({-10, 10}),  json.at("top").number(kPlace_mm),
           json.at("half_width").number(kRadius_mm), json.at("back").number(kPlace_mm)};
}
template <typename Visit>
void visit_rounding(SkullShapes::Rounding& rounding, Visit visit) {
    visit("braincase_floor", rounding.braincase_floor);
    visit("skull_base", rounding.skull_base);
    visit("mastoid_root", rounding.mastoid_root);
    visit("mastoid", rounding.mastoid);
    visit("nasal_process", rounding.nasal_process);
    visit("alveolar_process", rounding.alveolar_process);
    visit("cheek_buttress", rounding.cheek_buttress);
    visit("cheekbone", rounding.cheekbone);
    visit("maxilla", rounding.maxilla);
    visit("zygomatic_arch", rounding.zygomatic_arch);
    visit("hard_palate", rounding.hard_palate);
    visit("pterygoid_plate", rounding.pterygoid_plate);
    visit("nasal_spine", rounding.nasal_spine);
    visit("nasal_bone", rounding.nasal_bone);
    visit("body", rounding.body);
    visit("chin", rounding.chin);
    visit("coronoid_process", rounding.coronoid_process);
    visit("condyle_neck", rounding.condyle_neck);
    visit("condyle", rounding.condyle);
    visit("ramus", rounding.ramus);
}
void read(const JsonCursor& json, SkullShapes::Rounding& out) {
    std::vector<std::string_view> keys;
    visit_rounding(out, [&](const char* key, double&) { keys.push_back(key); });
    json.allow_keys(keys);
    visit_rounding(
        out, [&](const char* key, double& value) { value = json.at(key).number(kRadius_mm); });
}
void read(const JsonCursor& json, std::vector<Vec3>& out) {
    for (const JsonCursor& item : json.items()) out.push_back(place_of(item));
}

template <typename Visit>
void visit_shapes(SkullShapes& shapes, Visit visit) {
    visit("upper_rim", shapes.upper_rim);
    visit("lower_rim", shapes.lower_rim);
    visit("nasal_process", shapes.nasal_process);
    visit("zygomatic_arch", shapes.zygomatic_arch);
    visit("upper_arch", shapes.upper_arch);
    visit("lower_arch", shapes.lower_arch);
    visit("lower_border", shapes.lower_border);
    visit("braincase", shapes.braincase);
    visit("skull_base", shapes.skull_base);
    visit("mastoid", shapes.mastoid);
    visit("mastoid_root", shapes.mastoid_root);
    visit("temple", shapes.temple);
    visit("maxilla", shapes.maxilla);
    visit("alveolar_process", shapes.alveolar_process);
    visit("cheekbone", shapes.cheekbone);
    visit("hard_palate", shapes.hard_palate);
    visit("chin", shapes.chin);
    visit("cheek_buttress", shapes.cheek_buttress);
    visit("ear_canal", shapes.ear_canal);
    visit("nasal_spine", shapes.nasal_spine);
    visit("lower_concha", shapes.lower_concha);
    visit("middle_concha", shapes.middle_concha);
    visit("coronoid_process", shapes.coronoid_process);
    visit("condyle_neck", shapes.condyle_neck);
    visit("condyle", shapes.condyle);
    visit("pterygoid_plate", shapes.pterygoid_plate);
    visit("nasal_septum", shapes.nasal_septum);
    visit("ramus_lower", shapes.ramus_lower);
    visit("ramus_upper", shapes.ramus_upper);
    visit("body_top", shapes.body_top);
    visit("body_radius", shapes.body_radius);
    visit("orbit", shapes.orbit);
    visit("nose_opening", shapes.nose_opening);
    visit("nose_opening_back", shapes.nose_opening_back);
    visit("nasal_bone", shapes.nasal_bone);
    visit("upper_sockets", shapes.upper_sockets);
    visit("lower_sockets", shapes.lower_sockets);
    visit("braincase_floor", shapes.braincase_floor);
    visit("rounding", shapes.rounding);
}

}  // namespace

SkullShapes read_skull_shapes(const JsonCursor& json) {
    json.at("format").one_of({"risorius-skull-shapes"});
    SkullShapes out{};
    std::vector<std::string_view> keys{"format", "version", "source"};
    visit_shapes(out, [&](const char* key, auto&) { keys.push_back(key); });
    json.allow_keys(keys);
    json.at("version").integer(1, 1);
    visit_shapes(out, [&](const char* key, auto& shape) { read(json.at(key), shape); });
    if (out.body_top.size() != out.lower_border.size())
        json.at("body_top").fail("as many places as \"lower_border\" has");
    return out;
}

const SkullShapes& standard_skull_shapes() {
    static const SkullShapes kShapes = read_skull_shapes(
        JsonCursor::read_file(data_folder() / "rigs" / "standard" / "skull_shapes.json"));
    return kShapes;
}

BoneFields skull_fields(const SkullShapes& shapes, const Vec3& p_mm) {
    const Vec3 p = one_side(p_mm);
    const SkullShapes::Rounding& rounding = shapes.rounding;
    // The braincase with the hollows of the temples
    double braincase = ellipsoid(p, shapes.braincase);
    braincase = smooth_cut(braincase, -(p.y() - shapes.braincase_floor), rounding.braincase_floor);
    const double base = ellipsoid(p, shapes.skull_base);
    const double mastoid = smooth_union(ellipsoid(p, shapes.mastoid),
                                        ellipsoid(p, shapes.mastoid_root), rounding.mastoid_root);
    BoneFields fields{};
    fields.vault =
        smooth_union(smooth_union(braincase, base, rounding.skull_base), mastoid, rounding.mastoid);
    fields.temple = ellipsoid(p, shapes.temple);

    // The middle face
    double out = std::min(rods(p, shapes.upper_rim), rods(p, shapes.lower_rim));
    double maxilla = ellipsoid(p, shapes.maxilla);
    maxilla = smooth_union(maxilla, rods(p, shapes.nasal_process), rounding.nasal_process);
    maxilla =
        smooth_union(maxilla, ellipsoid(p, shapes.alveolar_process), rounding.alveolar_process);
    const double cheek = smooth_union(ellipsoid(p, shapes.cheekbone), rod(p, shapes.cheek_buttress),
                                      rounding.cheek_buttress);
    maxilla = smooth_union(maxilla, cheek, rounding.cheekbone);
    out = smooth_union(out, maxilla, rounding.maxilla);
    out = smooth_union(out, rods(p, shapes.zygomatic_arch), rounding.zygomatic_arch);

    fields.outer = out;
    const double ear = rod(p, shapes.ear_canal);
    fields.carved = std::min({orbit(p, shapes.orbit), nose_opening(p, shapes), ear});
    // Sockets of the teeth with the roof of the mouth, plates behind them, the partition of the nose and its spine
    double inner = wall(p, shapes.upper_arch, shapes.upper_sockets.low, shapes.upper_sockets.high);
    inner = smooth_union(inner, ellipsoid(p, shapes.hard_palate), rounding.hard_palate);
    inner = smooth_union(inner, plate(p, shapes.pterygoid_plate), rounding.pterygoid_plate);
    const double partition = plate(p, shapes.nasal_septum);
    const double spine = rod(p, shapes.nasal_spine);
    const double shell = std::min(rod(p, shapes.lower_concha), rod(p, shapes.middle_concha));
    fields.inner =
        std::min({inner, partition, smooth_union(spine, inner, rounding.nasal_spine), shell});
    return fields;
}

BoneFields mandible_fields(const SkullShapes& shapes, const Vec3& p_mm) {
    const Vec3 p = one_side(p_mm);
    const SkullShapes::Rounding& rounding = shapes.rounding;
    double out = rods(p, shapes.lower_border);
    // The body between the border and the sockets, wall by wall
    for (std::size_t i = 0; i + 1 < shapes.lower_border.size(); ++i) {
        out = smooth_union(out,
                           plate(p, shapes.lower_border[i].at, shapes.lower_border[i + 1].at,
                                 shapes.body_top[i + 1], shapes.body_top[i], shapes.body_radius),
                           rounding.body);
    }
    out = smooth_union(out, ellipsoid(p, shapes.chin), rounding.chin);
    // The ramus, its two processes, the condyle
    double ramus = plate(p, shapes.ramus_lower);
    ramus = std::min(ramus, plate(p, shapes.ramus_upper));
    ramus = smooth_union(ramus, rod(p, shapes.coronoid_process), rounding.coronoid_process);
    ramus = smooth_union(ramus, rod(p, shapes.condyle_neck), rounding.condyle_neck);
    ramus = smooth_union(ramus, rod(p, shapes.condyle), rounding.condyle);
    out = smooth_union(out, ramus, rounding.ramus);
    return {
        .vault = 1e9,
        .temple = 1e9,
        .outer = out,
        .carved = 1e9,
        .inner = wall(p, shapes.lower_arch, shapes.lower_sockets.low, shapes.lower_sockets.high)};
}

bool near_nasal_bone(const Vec3& p_mm) {
    return std::abs(p_mm.x()) < 20 && p_mm.y() > -16 && p_mm.y() < 38 && p_mm.z() > 74;
}

double nasal_bone_field(const SkullShapes& shapes, const Vec3& p_mm, double depth_under_tissue_mm) {
    const SkullShapes::NasalBone& bone = shapes.nasal_bone;
    const Vec3 p = one_side(p_mm);
    const double slab =
        std::abs(depth_under_tissue_mm - 0.5 * bone.thickness) - 0.5 * bone.thickness;
    // From the forehead down to where cartilage begins, wider below; the free edge runs backwards to the side
    const double edge = bone.lower_edge + bone.edge_slope * p.x();
    const double bounds =
        std::max({edge - p.y(), p.y() - bone.top, p.x() - bone.half_width, bone.back - p.z()});
    return smooth_cut(slab, bounds, shapes.rounding.nasal_bone);
}

}  // namespace risorius::face
