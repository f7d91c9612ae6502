// SPDX-License-Identifier: MIT
#include "risorius/render/detail/lock_guides.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr double kHairMapPerMetre = 2.5;  ///< of the paint map, for a head of 0.1 m radius
constexpr double kStep_m = 0.004;         ///< along a guide before it is resampled
constexpr double kAboveSkin_m = 0.0008;
constexpr double kTurnedIn_m = 0.045;  ///< above the tips of hanging hair
constexpr double kAtNeck = -0.5;       ///< height of directions from the centre that meet the neck
constexpr double kNape_m = -0.055;     ///< the lowest hair, from the height of the tragia

double ramp(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Vec3 across_plane(const Vec3& v, const Vec3& normal) { return v - normal * normal.dot(v); }

Vec3 landmark_or(const Scene& scene, const char* id, const Vec3& otherwise) {
    const auto found = scene.landmarks.find(id);
    return found == scene.landmarks.end() ? otherwise : found->second;
}

}  // namespace

LockGround::LockGround(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
                       const LockStyle& style)
    : style_(style), plan_(plan), head_(scene, plan, centre) {
    const Vec3 crown = landmark_or(scene, "v", centre + Vec3(0, 0.13, 0)),
               back = landmark_or(scene, "op", centre + Vec3(0, 0.02, -0.09)),
               jaw = landmark_or(scene, "go_l", centre + Vec3(0.05, -0.06, 0));
    whorl_ = (crown + 0.45 * (back - crown) + Vec3(0.008, 0.012, -0.012) - centre).normalized();
    knot_ = back + Vec3(0, 0.008, -0.014);
    parting_m_ = 1e-3 * style.parting_mm;
    const Vec3 top = landmark_or(scene, "tr", centre + Vec3(0, 0.09, 0.08)),
               brow = landmark_or(scene, "bm_l", centre + Vec3(0.02, 0.03, 0.09));
    fringe_m_ = top.y() + style.fringe * (brow.y() + 0.002 - top.y());
    tips_m_ = jaw.y() - 0.010 + 1e-3 * style.cut_mm;
}

bool LockGround::grows(const Vec3& direction, double inside_m) const {
    if (!head_.skin_at(direction) || head_.is_ear(direction)) return false;
    const Vec3 at = head_.centre() + head_.radius_m(direction, false) * direction;
    if (at.y() + SkinPlan::kRingSlope * at.z() > plan_.ring_m - inside_m) return false;
    if (at.y() < head_.centre().y() + kNape_m + inside_m) return false;
    const Vec2 place = paint_place(at, head_.centre());
    return (place - Vec2(0.5, 0.5)).norm() >
           hairline_radius(plan_, place) + kHairMapPerMetre * inside_m;
}

double LockGround::cap_m(const Vec3& direction) const {
    const Vec3 at = head_.centre() + head_.radius_m(direction, false) * direction;
    const Vec2 place = paint_place(at, head_.centre());
    const double inside =
        ((place - Vec2(0.5, 0.5)).norm() - hairline_radius(plan_, place)) / kHairMapPerMetre;
    const double thick = 1e-3 * style_.cap_mm;
    return thick * ramp(-0.002, 0.010 + 0.8 * thick, inside);
}

double LockGround::skin_m(const Vec3& d) const {
    // Below the head the outermost skin is that of the shoulders, which hair of these styles does not touch.
    constexpr double kBelow = -0.25, kNeck_m = 0.115;
    double radius = head_.radius_m(d, false);
    if (style_.over_ears) {
        // It comes off the head above an ear, and does not fall in at once below it. The ear is pressed to the head.
        constexpr double kPressed = 0.45;
        double ear = head_.radius_m(d, true);
        for (const double up : {-0.45, -0.30, -0.15, 0.15, 0.30, 0.45})
            ear = std::max(ear, head_.radius_m(Vec3(d + up * Vec3::UnitY()).normalized(), true) -
                                    0.018 * std::abs(up));
        radius += (1 - kPressed) * std::max(0.0, ear - radius);
    }
    return d.y() < kBelow && radius > kNeck_m ? 0 : radius;
}

double LockGround::length_m(const Vec3& d) const {
    const double top = ramp(0.50, 0.78, d.y() - 0.1 * d.z()),
                 side = d.x() * d.x() / std::max(d.x() * d.x() + d.z() * d.z(), 1e-9);
    return 1e-3 * (top * style_.top_mm +
                   (1 - top) * (side * style_.side_mm + (1 - side) * style_.back_mm));
}

double LockGround::wave_phase(const Vec3& d) const {
    // Locks that lie side by side wave together: by their way from the parting, and a little by chance.
    const double from_m =
        0.1 * std::abs(std::asin(std::clamp(d.x(), -1.0, 1.0)) - parting_m_ / 0.1);
    return from_m / (1e-3 * style_.pitch_mm) + 0.35 * std::sin(7 * d.z() + 3 * d.y());
}

bool LockGround::in_fringe(const Vec3& d) const {
    constexpr double kDeep_m = 0.038;
    return style_.fringe > 0 && d.z() > 0.1 && std::abs(d.x()) < 0.55 && !grows(d, kDeep_m);
}

bool LockGround::before_ear(const Vec3& d) const {
    constexpr double kAbove_m = 0.026;
    const EarRegion& ear = plan_.ears[0];
    if (!style_.hangs || !ear.known) return false;
    const Vec3 at = head_.centre() + head_.radius_m(d, false) * d;
    return at.z() > ear.high.z() - 0.008 && at.y() < ear.high.y() + kAbove_m;
}

Vec3 LockGround::flow(const Vec3& at) const {
    const Vec3 from = at - head_.centre(), out = from.normalized();
    Vec3 way = Vec3::Zero();
    switch (style_.flow) {
        case HairFlow::kWhorl:
            way = across_plane(out - whorl_, out) + Vec3(0, -0.10, 0);
            break;
        case HairFlow::kParting: {
            const double side = from.x() < parting_m_ ? -1 : 1;
            const double behind = ramp(-0.01, -0.07, from.z());
            // Hanging hair comes forward as far as the temples, and frames the face.
            way =
                Vec3(side * (1 - 0.75 * behind), -0.25 - 0.9 * behind, style_.hangs ? 0.34 : 0.25);
            break;
        }
        case HairFlow::kRadial:
            way = Vec3(0, -1, 0) + 0.3 * out;
            break;
        case HairFlow::kKnot:
            way = knot_ - at;
            break;
        case HairFlow::kDown:
            way = Vec3(0, -1, -0.35);
            break;
    }
    return across_plane(way, out).normalized();
}

void LockGround::finish(std::vector<Vec3> way, const Vec3& across, double phase,
                        LockGuide& guide) const {
    // Resampled, with curl or wave added. Steps are even, or grow where hair hangs straight in the end.
    const double evenness = style_.hangs ? 1.35 : 1;
    double whole = 0;
    for (std::size_t i = 1; i < way.size(); ++i) whole += (way[i] - way[i - 1]).norm();
    const double curl = 1e-3 * style_.curl_mm, pitch = 1e-3 * style_.pitch_mm;
    double passed = 0;
    std::size_t i = 1;
    for (int k = 0; k <= guide.segments; ++k) {
        const double want = whole * std::pow(static_cast<double>(k) / guide.segments, evenness);
        while (i + 1 < way.size() && passed + (way[i] - way[i - 1]).norm() < want) {
            passed += (way[i] - way[i - 1]).norm();
            ++i;
        }
        const Vec3 span = way[i] - way[i - 1];
        Vec3 p =
            way[i - 1] + std::clamp((want - passed) / std::max(span.norm(), 1e-9), 0.0, 1.0) * span;
        const Vec3 out = (p - head_.centre()).normalized();
        const double grown = ramp(0, 0.3, want / std::max(whole, 1e-9));
        const double turn = phase + 2 * std::numbers::pi * want / pitch;
        p += curl * grown * (std::cos(turn) * across + 0.7 * (1 + std::sin(turn)) * out);
        guide.points.push_back(p);
        guide.out.push_back(out);
    }
}

LockGuide LockGround::guide(const Vec3& d, RandomSequence& random, double longest_m) const {
    LockGuide guide;
    guide.segments = longest_m < 0.1 ? 2 : style_.segments;
    guide.root = *head_.skin_at(d);
    guide.layer = random.next();
    guide.edge = !grows(d, 0.010);
    const Vec3 centre = head_.centre();
    double length = length_m(d) * (0.85 + 0.3 * random.next());
    if (guide.edge && style_.flow == HairFlow::kRadial) length *= 0.6;
    // Short hair is cut shorter towards the nape: longer locks would stand beside the neck.
    if (style_.flow == HairFlow::kParting && !style_.hangs)
        length *= 0.3 + 0.7 * ramp(kNape_m, 0.0, head_.radius_m(d, false) * d.y());
    length = std::min(length, longest_m);
    const double phase = random.next(),
                 turn = 2 * std::numbers::pi *
                        (style_.flow == HairFlow::kParting ? wave_phase(d) + 0.12 * phase : phase),
                 stray = random.next() - 0.5, cut = tips_m_ + 0.016 * (random.next() - 0.5);
    const double cap = cap_m(d), layer = 1e-3 * style_.layers_mm * guide.layer,
                 loft = 1e-3 * style_.loft_mm;
    const bool tuft = style_.flow == HairFlow::kRadial, fringe = in_fringe(d);
    const double fringe_cut = fringe ? fringe_m_ + 0.005 * (random.next() - 0.5) : 0;
    const auto way_at = [&](const Vec3& at) -> Vec3 {
        if (!fringe) return flow(at);
        const Vec3 out = (at - head_.centre()).normalized();
        return across_plane(Vec3(0.5 * stray + 0.25 * out.x(), -1, 0.35), out).normalized();
    };
    if (fringe) {
        guide.width = 0.75;
        guide.fringe = true;
        guide.fray = 0.4;
        guide.segments = std::min(style_.segments, 10);
    }
    Vec3 p = centre + (skin_m(d) + (tuft ? 0.95 : 0.75) * cap + 0.0003) * d;
    // Tufts lie in any direction; other locks follow the flow, and stray a little.
    Vec3 along = way_at(p);
    const Vec3 aside = along.cross(d);
    if (tuft && guide.edge)
        along = across_plane(whorl_ - d, d).normalized() + 0.9 * stray * aside;
    else if (tuft)
        along = std::cos(turn) * along + std::sin(turn) * aside;
    else
        along += 0.35 * stray * aside;
    Vec3 v = (along + style_.lift * d).normalized();
    // Hair that hangs is free from the top of the ears downwards.
    const double loose_m = centre.y() + (style_.hangs ? 0.045 : 0.0);
    std::vector<Vec3> way{p};
    for (double passed = 0; passed < length; passed += kStep_m) {
        const Vec3 out = (p - centre).normalized();
        if (style_.flow == HairFlow::kKnot && (knot_ - p).norm() < 0.012) break;
        if (style_.hangs && p.y() < cut) break;
        if (fringe && p.y() < fringe_cut) break;
        if (!style_.over_ears && head_.is_ear(out) && passed > 0.006) {
            guide.fray = 0.2;
            break;
        }
        if (!tuft) {
            const bool free = p.y() < loose_m && style_.hangs;
            // Hanging hair turns in towards the neck above its tips.
            const double in = 0.7 * ramp(cut + kTurnedIn_m, cut, p.y());
            const Vec3 onward = free ? Vec3((0.12 - in) * v.x() - in * out.x(), -1,
                                            (0.12 - in) * v.z() - in * out.z())
                                     : way_at(p);
            v = (0.80 * v + 0.20 * onward + style_.fall * kStep_m / 0.03 * Vec3(0, -0.22, 0))
                    .normalized();
        }
        p += kStep_m * v;
        // Off the head, and not far from the hull
        const Vec3 now = (p - centre).normalized();
        const double rise = tuft ? 1 : ramp(0, 0.022, passed + kStep_m);
        // On top of the head the locks lie close, or single ones would stand out against the background.
        const double lies = tuft ? 1 : 1 - 0.7 * ramp(0.5, 0.85, now.y());
        const double skin = skin_m(now),
                     least =
                         skin + kAboveSkin_m +
                         (std::max(cap_m(now) - 1e-3 * style_.sunk_mm, 0.0) + lies * layer) * rise,
                     most = least + loft + (p.y() < loose_m ? 0.05 : 0.0);
        const double r = (p - centre).norm();
        // Hair that meets the neck is hidden behind it.
        if (style_.hangs && skin > 0 && now.y() < kAtNeck && r < least - 0.001) break;
        const double kept = skin > 0 ? std::clamp(r, least, most) : r;
        p = centre + kept * now;
        if (kept != r) v = across_plane(v, now).normalized();
        guide.hangs = guide.hangs || kept > skin + 0.02;
        way.push_back(p);
    }
    if (way.size() < 2) return guide;
    finish(std::move(way), aside, turn, guide);
    return guide;
}

void LockGround::add_hairline(RandomSequence& random, std::vector<LockGuide>& guides) const {
    constexpr int kDirections = 6000;
    constexpr double kLongest_m = 0.006;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kDirections; ++i) {
        const double y = 1 - 2 * (i + 0.5) / kDirections, ring = std::sqrt(1 - y * y);
        Vec3 d(ring * std::cos(golden * i), y, ring * std::sin(golden * i));
        const double ragged = 0.0005 + 0.003 * random.next();
        if (!grows(d, ragged) || grows(d, 0.006)) continue;
        LockGuide one = guide(d, random, kLongest_m);
        if (one.points.empty()) continue;
        one.width = 0.6 / style_.width_mm;
        one.layer = 0.5;
        one.single = true;
        guides.push_back(std::move(one));
    }
}

void LockGround::add_fringe(RandomSequence& random, std::vector<LockGuide>& guides) const {
    constexpr int kDirections = 3000;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kDirections; ++i) {
        const double y = 1 - 2 * (i + 0.5) / kDirections, ring = std::sqrt(1 - y * y);
        const Vec3 d(ring * std::cos(golden * i), y, ring * std::sin(golden * i));
        const double ragged = 0.006 * random.next();
        if (!in_fringe(d) || !grows(d, ragged)) continue;
        LockGuide one = guide(d, random, 1);
        if (!one.points.empty()) guides.push_back(std::move(one));
    }
}

void LockGround::add_tail(RandomSequence& random, std::vector<LockGuide>& guides) const {
    constexpr int kLocks = 44;
    constexpr double kLength_m = 0.19;
    const Vec3 out = (knot_ - head_.centre()).normalized();
    const auto root = head_.skin_at(out);
    if (!root) return;
    for (int i = 0; i < kLocks; ++i) {
        LockGuide guide;
        guide.segments = style_.segments;
        guide.root = *root;
        guide.hangs = guide.tail = true;
        const double turn = 2 * std::numbers::pi * (i + 0.5 * random.next()) / kLocks,
                     inner = std::sqrt(random.next()),
                     length = kLength_m * (0.8 + 0.3 * random.next());
        guide.layer = inner;
        guide.width = 0.8;
        const Vec3 aside = 0.009 * inner * Vec3(std::cos(turn), std::sin(turn), 0);
        Vec3 p = knot_ - 0.010 * out + aside, v = (out + Vec3(0, -0.9, 0) + 8 * aside).normalized();
        std::vector<Vec3> way{p};
        for (double passed = 0; passed < length; passed += kStep_m) {
            v = (v + Vec3(0, -0.28, 0) - 4 * Vec3(p.x() - 1.6 * aside.x(), 0, 0)).normalized();
            p += kStep_m * v;
            const Vec3 now = (p - head_.centre()).normalized();
            const double skin = skin_m(now), least = skin + 0.008 + 0.010 * inner;
            const double r = (p - head_.centre()).norm();
            if (skin > 0 && r < least && passed > 0.02) {
                p = head_.centre() + least * now;
                v = across_plane(v, now).normalized();
            }
            way.push_back(p);
        }
        finish(std::move(way), Vec3::UnitX(), turn, guide);
        for (std::size_t k = 0; k < guide.out.size(); ++k)
            guide.out[k] = (Vec3(std::cos(turn), 0.2, std::sin(turn) - 0.4)).normalized();
        guides.push_back(guide);
    }
}

std::vector<LockGuide> LockGround::guides(unsigned seed) const {
    // Even directions over the sphere (Fibonacci), shaken by the seed; as many as give the number of locks on a scalp that covers
    // a fixed share of the sphere, so that a high hairline has fewer locks, not closer ones.
    constexpr double kScalpShare = 0.42;
    RandomSequence random(seed * 2654435761U + 97U);
    const int count = static_cast<int>(style_.locks / kScalpShare);
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<LockGuide> guides;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - 2 * (i + 0.5) / count, ring = std::sqrt(1 - y * y);
        const double reach = 1.2 / std::sqrt(static_cast<double>(count));
        Vec3 d(ring * std::cos(golden * i), y, ring * std::sin(golden * i));
        for (int k = 0; k < 3; ++k) d[k] += reach * (random.next() - 0.5);
        d.normalize();
        const double ragged = 0.004 * random.next();
        if (!grows(d, ragged) || before_ear(d)) continue;
        LockGuide one = guide(d, random, 1);
        if (one.points.empty()) continue;
        // The border of cropped hair is made of single hairs alone.
        if (one.edge && style_.flow == HairFlow::kWhorl) continue;
        // The temples turn grey first.
        one.grey = 0.2 * ramp(0.55, 0.85, std::abs(d.x()));
        guides.push_back(std::move(one));
    }
    add_hairline(random, guides);
    if (style_.fringe > 0) add_fringe(random, guides);
    if (style_.tail) add_tail(random, guides);
    return guides;
}

}  // namespace risorius::render
