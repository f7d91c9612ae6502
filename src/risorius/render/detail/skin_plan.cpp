// SPDX-License-Identifier: MIT
#include "risorius/render/detail/skin_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "risorius/render/detail/beard_form.h"
#include "risorius/render/detail/complexion.h"
#include "risorius/render/detail/lock_style.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

struct ZoneRecipe {
    const char* landmark;  ///< without the suffix of its side
    bool paired;
    double spread_m;
    Vec3 log_tint;
    double oil;
    Vec3 offset{0, 0, 0};               ///< m, of the left side
    double Complexion::*own = nullptr;  ///< what a person has more or less of
};

// Where blood is close under the skin, where the lids let it shine through, and where the face is oily.
const ZoneRecipe kRecipes[] = {
    {"ma", true, 0.017, {-0.02, -0.15, -0.13}, 0.10, {-0.004, -0.004, 0}, &Complexion::cheeks},
    {"mc", true, 0.018, {-0.02, -0.11, -0.09}, 0.0, {0, 0, 0}, &Complexion::cheeks},
    {"prn", false, 0.011, {0.0, -0.17, -0.15}, 0.30, {0, 0, 0}, &Complexion::nose},
    {"prn", false, 0.008, {0.02, -0.18, -0.15}, 0.05, {0, -0.009, -0.006}, &Complexion::nose},
    {"al", true, 0.009, {-0.02, -0.25, -0.21}, 0.20, {0, 0, 0}, &Complexion::nose},
    {"sn", false, 0.007, {0.0, -0.08, -0.06}, -0.12, {0, 0.004, 0.005}},
    {"rhi", false, 0.010, {0, -0.04, -0.03}, 0.25},
    {"mef", false, 0.026, {0.0, 0.02, -0.02}, 0.22},
    {"g", false, 0.014, {0, -0.03, -0.02}, 0.18},
    {"pg", false, 0.012, {-0.02, -0.10, -0.08}, 0.12, {0, 0, 0}, &Complexion::cheeks},
    {"sa", true, 0.016, {-0.04, -0.22, -0.18}, 0.0},
    {"sba", true, 0.013, {-0.03, -0.20, -0.17}, 0.0},
    {"ps", true, 0.0075, {-0.10, -0.17, -0.13}, 0.05, {0, 0, 0}, &Complexion::eyes},
    {"ucr", true, 0.008, {-0.07, -0.12, -0.09}, 0.05, {0, 0, 0}, &Complexion::eyes},
    {"pi", true, 0.006, {-0.09, -0.17, -0.11}, 0.0, {0, 0, 0}, &Complexion::eyes},
    {"or", true, 0.010, {-0.07, -0.07, 0.0}, -0.10, {-0.005, 0.006, 0}, &Complexion::eyes},
    {"en", true, 0.0045, {-0.04, -0.26, -0.22}, 0.10},
    {"en", true, 0.0017, {0.16, -0.62, -0.46}, 0.90, {0.0036, 0.0003, -0.003}},  // caruncle
    {"ex", true, 0.0045, {-0.05, -0.16, -0.12}, 0.0},
    {"sbal", true, 0.006, {-0.08, -0.20, -0.17}, 0.0},
    {"ch", true, 0.0026, {-0.16, -0.22, -0.20}, -0.14, {0.0006, -0.0002, 0}},  // lips tuck in
    {"ch", true, 0.0016, {-0.16, -0.26, -0.24}, -0.10, {-0.0008, 0, 0}},
    {"sto", false, 0.020, {-0.01, -0.06, -0.05}, 0.0},
    // Where the lips meet they turn inwards, redder and darker.
    {"sto", false, 0.0022, {-0.16, -0.30, -0.28}, 0.0, {0, -0.0003, 0}},
    {"lli", true, 0.0026, {-0.16, -0.30, -0.28}, 0.0, {-0.004, 0, 0.001}},
    {"lli", true, 0.0022, {-0.20, -0.34, -0.32}, 0.0, {0.003, 0, -0.001}},
    {"ch", true, 0.0022, {-0.22, -0.36, -0.34}, 0.0, {-0.0072, 0.0006, 0.005}},
};

class Marks {
  public:
    explicit Marks(const Scene& scene) : marks_(scene.landmarks) {}
    const Vec3* find(const std::string& id) const {
        const auto it = marks_.find(id);
        return it == marks_.end() ? nullptr : &it->second;
    }
    /// All of the landmarks, or an empty list if one is missing.
    std::vector<Vec3> all(const std::vector<std::string>& ids) const {
        std::vector<Vec3> points;
        for (const std::string& id : ids) {
            const Vec3* p = find(id);
            if (!p) return {};
            points.push_back(*p);
        }
        return points;
    }

  private:
    const std::map<std::string, Vec3>& marks_;
};

std::vector<SkinZone> plan_zones(const Marks& marks, const Complexion& complexion) {
    std::vector<SkinZone> zones;
    for (const ZoneRecipe& recipe : kRecipes)
        for (const int side : {0, 1}) {
            if (!recipe.paired && side == 1) continue;
            const std::string id =
                std::string(recipe.landmark) + (recipe.paired ? (side == 0 ? "_l" : "_r") : "");
            const Vec3* p = marks.find(id);
            if (!p) continue;
            const Vec3 offset(side == 0 ? recipe.offset.x() : -recipe.offset.x(), recipe.offset.y(),
                              recipe.offset.z());
            const double factor = recipe.own ? complexion.*recipe.own : 1.0;
            zones.push_back({*p + offset, recipe.spread_m, factor * recipe.log_tint, recipe.oil});
        }
    return zones;
}

void plan_lips(const Marks& marks, SkinPlan& plan) {
    std::vector<Vec3> upper = marks.all({"ch_r", "ulc_r", "cph_r", "ls", "cph_l", "ulc_l", "ch_l"});
    const std::vector<Vec3> lower = marks.all({"ch_l", "llc_l", "li", "llc_r", "ch_r"});
    if (upper.empty() || lower.empty()) return;
    // The upper border rises to the crests of the philtrum and dips between them (Cupid's bow).
    constexpr double kBow_m = 0.0004;
    upper[2].y() += 0.7 * kBow_m;
    upper[3].y() -= kBow_m;
    upper[4].y() += 0.7 * kBow_m;
    for (const std::vector<Vec3>& border : {upper, lower}) {
        const std::vector<Vec3> curve = smooth_curve(border, border.size() == 7 ? 5 : 7);
        for (std::size_t i = 0; i + 1 < curve.size(); ++i) plan.lip_outline.push_back(curve[i]);
    }
    plan.lip_back_m = std::min(upper.front().z(), upper.back().z()) - 0.035;
}

/// Along the jaw, on the chin, between nose and lip and under the jaw. Sideburns join it to the hair of the head, and the last
/// spots join moustache and chin.
void plan_beard(const Marks& marks, const Appearance& appearance, SkinPlan& plan) {
    const BeardForm& form = beard_form(appearance.beard_form);
    plan.trimmed = form.trimmed;
    struct Spot {
        const char *from, *to;
        bool paired;
        double fraction;  ///< along the way, 0..1
        double spread_m;
        Vec3 offset{0, 0, 0};
    };
    static const Spot kSpots[] = {{"pg", "me", false, 0.5, 0.015},
                                  {"me", "me", false, 0, 0.014, {0, -0.008, -0.012}},
                                  {"sn", "ls", false, 0.55, 0.0065},
                                  {"cph", "ch", true, 0.55, 0.0070, {0, 0.004, 0}},
                                  {"ch", "go", true, 0.22, 0.012, {0, -0.016, 0}},
                                  {"ch", "go", true, 0.60, 0.016, {0, -0.006, 0}},
                                  {"go", "t", true, 0.10, 0.015},
                                  {"go", "t", true, 0.55, 0.010, {0, 0, 0.010}},
                                  {"ch", "go", true, 0.02, 0.0085, {0, -0.011, 0}}};
    for (std::size_t k = 0; k < std::size(kSpots); ++k)
        for (const int side : {0, 1}) {
            const Spot& spot = kSpots[k];
            if (!form.spots[k] || (!spot.paired && side == 1)) continue;
            const std::string s = spot.paired ? (side == 0 ? "_l" : "_r") : "";
            const Vec3 *from = marks.find(spot.from + s), *to = marks.find(spot.to + s);
            if (!from || !to) continue;
            plan.beard.push_back({*from + spot.fraction * (*to - *from) + spot.offset,
                                  form.spread * spot.spread_m, Vec3::Zero(), 0.0});
        }
}

/// Takes the corners out of the front of a hairline, which would show as a notch in the middle. Sideburns and nape stay as they are.
void round_front(std::array<double, SkinPlan::kHairlineSteps>& hairline) {
    constexpr int kPasses = 2, kFront = 6;  // steps to each side of the middle
    for (int pass = 0; pass < kPasses; ++pass) {
        const auto before = hairline;
        const auto at = [&](int i) {
            return before[static_cast<std::size_t>((i + SkinPlan::kHairlineSteps) %
                                                   SkinPlan::kHairlineSteps)];
        };
        for (int i = -kFront; i <= kFront; ++i)
            hairline[static_cast<std::size_t>((i + SkinPlan::kHairlineSteps) %
                                              SkinPlan::kHairlineSteps)] =
                0.25 * at(i - 1) + 0.5 * at(i) + 0.25 * at(i + 1);
    }
}

/// Hair grows outside a closed curve on the map: over the forehead through the landmarks, in front of the ears, to the nape.
void plan_hairline(const Marks& marks, const Vec3& centre, const Appearance& appearance,
                   SkinPlan& plan) {
    plan.hairline.fill(2.0);
    const std::vector<Vec3> front = marks.all({"tr", "fht_l", "fht_r", "t_l", "t_r"});
    if (front.empty()) return;
    struct Knot {
        double angle, radius;
    };
    std::vector<Knot> knots;
    const auto add = [&](const Vec3& p) {
        const Vec2 d = paint_place(p, centre) - Vec2(0.5, 0.5);
        knots.push_back({std::atan2(d.x(), d.y()), d.norm()});
    };
    // Higher on the forehead is also farther back; the map only knows the direction from the middle of the head.
    const HairlineForm& form = hairline_form(appearance.hairline_form);
    const double temples_mm = appearance.temples_mm + form.temples_mm;
    // Locks leave the outermost millimetres of their ground bare, so that their ground begins lower on the forehead.
    constexpr double kBare_mm = 6;
    const LockStyle* style = lock_style(appearance.hair_style);
    const double lower_mm = style && !style->ring ? kBare_mm : 0;
    const Vec3 up(0, 0.75, -0.65),
        higher = 1e-3 * (appearance.hairline_mm + form.higher_mm - lower_mm) * up,
        bay = higher + 1e-3 * temples_mm * Vec3(0, 0.7, -0.7) + 1e-3 * form.bay_mm * up,
        side_bay = 0.4 * higher + 1e-3 * temples_mm * Vec3(0, 0.3, -0.6);
    const Vec3 crown = front[0] + higher + 1e-3 * form.middle_mm * up, &temple_l = front[1],
               &temple_r = front[2];
    for (const int side : {0, 1}) {
        const double s = side == 0 ? 1 : -1;
        const Vec3& temple = side == 0 ? temple_l : temple_r;
        const Vec3& tragion = side == 0 ? front[3] : front[4];
        // Bay of the temple, its point, front edge and foot of the sideburn, behind the ear, nape
        add(front[0] + 0.55 * (temple - front[0]) + Vec3(0, 0.012, -0.004) + bay);
        add(temple + Vec3(0, 0, -0.004) + side_bay);
        add(tragion + Vec3(0, 0.034, 0.026));
        add(tragion + Vec3(0, 0.004, 0.014));
        add(tragion + Vec3(-s * 0.008, -0.030, -0.034));
        add(tragion + Vec3(-s * 0.030, -0.055, -0.062));
    }
    add(crown);
    add(centre + Vec3(0.010, -0.062, -0.085));
    add(centre + Vec3(-0.010, -0.062, -0.085));
    std::sort(knots.begin(), knots.end(),
              [](const Knot& a, const Knot& b) { return a.angle < b.angle; });
    for (int i = 0; i < SkinPlan::kHairlineSteps; ++i) {
        double angle = 2 * std::numbers::pi * i / SkinPlan::kHairlineSteps;
        if (angle > std::numbers::pi) angle -= 2 * std::numbers::pi;
        std::size_t next = 0;
        while (next < knots.size() && knots[next].angle < angle) ++next;
        Knot b = knots[next % knots.size()], a = knots[(next + knots.size() - 1) % knots.size()];
        if (next == knots.size()) b.angle += 2 * std::numbers::pi;
        if (next == 0) a.angle -= 2 * std::numbers::pi;
        const double t = b.angle > a.angle ? (angle - a.angle) / (b.angle - a.angle) : 0.0;
        plan.hairline[static_cast<std::size_t>(i)] = a.radius + t * (b.radius - a.radius);
    }
    if (style) round_front(plan.hairline);
}

}  // namespace

std::vector<Vec3> smooth_curve(const std::vector<Vec3>& knots, int steps) {
    std::vector<Vec3> points;
    const auto count = static_cast<int>(knots.size());
    const auto knot = [&](int i) -> Vec3 {
        // Reflected end points make the end spans as round as their neighbours.
        if (i < 0) return 2 * knots.front() - knots[1];
        if (i >= count) return 2 * knots.back() - knots[static_cast<std::size_t>(count) - 2];
        return knots[static_cast<std::size_t>(i)];
    };
    for (int i = 0; i + 1 < count; ++i)
        for (int j = 0; j < steps; ++j) {
            const double t = static_cast<double>(j) / steps, t2 = t * t, t3 = t2 * t;
            points.push_back(0.5 *
                             (2 * knot(i) + (knot(i + 1) - knot(i - 1)) * t +
                              (2 * knot(i - 1) - 5 * knot(i) + 4 * knot(i + 1) - knot(i + 2)) * t2 +
                              (3 * knot(i) - knot(i - 1) - 3 * knot(i + 1) + knot(i + 2)) * t3));
        }
    points.push_back(knots.back());
    return points;
}

bool EarRegion::contains(const Vec3& p) const {
    if (!known || (p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
    const bool bowl = p.z() > high.z() - 0.030 && p.y() < high.y() - 0.016;
    return bowl ||
           std::abs(p.x()) > out_m + lean * (high.z() - p.z()) + lean * std::max(0.0, p.y());
}

bool EarRegion::has_beside(const Vec3& p) const {
    constexpr double kBehindFront_m = 0.002;
    return known && (p.array() >= low.array()).all() && (p.array() <= high.array()).all() &&
           p.z() < high.z() - kBehindFront_m;
}

double beard_density(const SkinPlan& plan, const Vec3& rest) {
    double sum = 0;
    for (const SkinZone& zone : plan.beard)
        sum +=
            std::exp(-0.5 * (rest - zone.centre).squaredNorm() / (zone.spread_m * zone.spread_m));
    const double t = std::clamp((sum - 0.2) / 0.65, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

bool is_white_hair(double draw, double whites) {
    return 37 * draw - std::floor(37 * draw) < whites;
}

double white_share(const Appearance& appearance) {
    return appearance.grey_hair.value_or(0.85 * std::clamp(1.6 * appearance.age - 0.5, 0.0, 1.0));
}

Vec3 dark_hair_tone(const Appearance& appearance) {
    // Brows and beards of blond people are darker and less yellow than their hair.
    const Vec3& long_hair = appearance.hair_tone;
    const double light = std::clamp((long_hair.x() - 0.40) / 0.15, 0.0, 1.0),
                 yellow = std::clamp((long_hair.x() - long_hair.z()) / 0.30, 0.0, 1.0);
    const Vec3 darker = long_hair + 0.8 * light * yellow * (Vec3(0.38, 0.28, 0.20) - long_hair);
    return (complexion_of(appearance).brows * darker).cwiseMin(1.0);
}

Vec3 hair_tone_at(const Appearance& appearance) {
    const Vec3 tone = dark_hair_tone(appearance);
    return tone + white_share(appearance) * (Vec3(0.60, 0.555, 0.50) - tone);
}

Vec3 lip_tone_at(const Appearance& appearance) {
    return linear_from_srgb(appearance.lip_tone)
        .cwiseProduct(complexion_of(appearance).lips)
        .cwiseMin(1.0);
}

bool has_cap(const Appearance& appearance, const SkinPlan& plan) {
    const LockStyle* style = lock_style(appearance.hair_style);
    return style && !style->ring && plan.hairline[0] <= 1;
}

double scalp_paint(const Appearance& appearance) {
    constexpr double kBetweenLocks = 0.97;
    return lock_style(appearance.hair_style) ? std::max(appearance.scalp_hair, kBetweenLocks)
                                             : appearance.scalp_hair;
}

double hairline_radius(const SkinPlan& plan, const Vec2& place) {
    const Vec2 d = place - Vec2(0.5, 0.5);
    const double turn = std::atan2(d.x(), d.y()) / (2 * std::numbers::pi);
    const double at = (turn - std::floor(turn)) * SkinPlan::kHairlineSteps;
    const auto i = static_cast<std::size_t>(at) % SkinPlan::kHairlineSteps;
    const double t = at - std::floor(at);
    return (1 - t) * plan.hairline[i] + t * plan.hairline[(i + 1) % SkinPlan::kHairlineSteps];
}

SkinPlan plan_skin(const Scene& scene, const Vec3& paint_centre) {
    const Marks marks(scene);
    SkinPlan plan;
    plan.zones = plan_zones(marks, complexion_of(scene.appearance));
    plan_lips(marks, plan);
    plan_beard(marks, scene.appearance, plan);
    plan_hairline(marks, paint_centre, scene.appearance, plan);
    for (const std::size_t side : {0U, 1U}) {
        const std::string s = side == 0 ? "_l" : "_r";
        const std::vector<Vec3> ear = marks.all({"sa" + s, "sba" + s, "t" + s});
        if (!ear.empty()) {
            EarRegion& region = plan.ears[side];
            region.known = true;
            const double x = ear[2].x(), out = 0.06 * (x > 0 ? 1 : -1);
            region.low = {std::min(x, x + out) - 0.01, ear[1].y() - 0.006, ear[2].z() - 0.050};
            region.high = {std::max(x, x + out) + 0.01, ear[0].y() + 0.008, ear[2].z() + 0.006};
            region.out_m = std::abs(x) + 0.002;
            region.lean = 0.13;
        }
        const std::vector<Vec3> brow = marks.all({"bm" + s, "bc" + s, "bp" + s, "bl" + s});
        if (!brow.empty()) plan.brows[side] = smooth_curve(brow, 12);
    }
    const LockStyle* style = lock_style(scene.appearance.hair_style);
    if (style && style->ring) {
        constexpr double kAboveEars_m = 0.020;
        const double ears_m = plan.ears[0].known ? plan.ears[0].high.y() : paint_centre.y() + 0.03;
        plan.ring_m = std::max(ears_m, paint_centre.y() + 0.02) + kAboveEars_m;
    }
    return plan;
}

}  // namespace risorius::render
