// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/tongue_body.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

// Places along the tongue, 0 at the root and 1 at the tip. The top of the arch lies below the border of hard and soft palate in k (0.3),
// below the hard palate in i (0.57), and at the soft palate in u (0.18). Estimates, after midsagittal pictures of the vowels (Fant
// 1960, Acoustic Theory of Speech Production)
constexpr double kTop = 0.45, kTopPerBack = -0.27;
constexpr double kBehind = 0.42;  // from the top to the hind end of the arch
constexpr double kBefore = 0.12, kBeforePerTip = 0.45, kFrontMost = 0.95;  // to its front end
constexpr double kRound = 2.6;                      // power of its top: 2 is a parabola
constexpr double kTipFrom = 0.85, kTipTo = 0.97;    // from here on, the tip does not follow
constexpr double kRootFrom = -0.15, kRootTo = 0.1;  // the root follows half
// A tongue that is pushed against the palate flattens: 1 on the channel would take a point through it by this part of the way.
constexpr double kPress = 0.2;
// Where another point touches first, the top of the arch is still below the palate: near 1, the tongue is pressed harder.
constexpr double kPressMore = 0.22, kPressFrom = 0.7, kPressTo = 1;
constexpr double kSoftStart = 0.1;      // of the channel, in which the arch begins to rise
constexpr double kLower_mm = 7;         // the body at -1, which stays above the floor of the mouth
constexpr double kHump_mm = 4;          // of a tongue at rest, which moves with the channel back
constexpr double kHighestArch_mm = 60;  // no arch is higher; more than in a wide open mouth
// Rise of the underside / rise of the back, of a body that rises and of one that sinks
constexpr double kUnderside = 0.5, kUndersideSinks = 0.8;
constexpr double kEdge = 0.6;        // rise of the edges / rise of the middle
constexpr double kEdgeFrom = 0.45;   // from here on to the edge, as a fraction of the half width
constexpr double kThinBody_mm = 16;  // of what stretches; the underside may belong to another part
constexpr double kNarrow = 0.85;     // power of the stretch by which it becomes narrower
constexpr int kBehindRoot = 6;       // sections by which the palate is known behind the root
constexpr double kFilm_mm = 0.15;    // between tongue and palate in contact
constexpr double kTouches = 0.3;     // points that rise less do not touch the palate first

// 1 at the top of the arch, 0 outside of it.
double arch_at(double along, double back) {
    const double top = kTop + kTopPerBack * back;
    const double t = std::abs(along - top) /
                     (along < top ? kBehind : kBefore + kBeforePerTip * (kFrontMost - top));
    if (t >= 1) return 0;
    const double s = 1 - std::pow(t, kRound);
    return s * s * (1 - geom::smoothstep(kTipFrom, kTipTo, along)) *
           geom::smoothstep(kRootFrom, kRootTo, along);
}

// 0 to 1, without a corner at 0.
double softly(double x) { return x <= 0 ? 0 : (1 + kSoftStart) * x * x / (x + kSoftStart); }

// A rise, held back softly where there is no more room. No rise is none for any room.
double held_back(double rise, double room) {
    if (rise <= 0) return rise;
    if (room <= 0) return 0;
    const double s = rise / room;
    if (s <= 1 - kPress) return rise;
    if (s >= 1 + kPress) return room;
    return room * (s - (s - 1 + kPress) * (s - 1 + kPress) / (4 * kPress));
}

}  // namespace

TongueBody::TongueBody(const rig::Head& head, double from_z, double to_z,
                       std::vector<TongueSection> sections, const std::vector<double>& middle_y)
    : millimetre_(head.mm(1)), sections_(std::move(sections)) {
    // An open jaw takes the root backwards, below what lies behind it
    std::vector<double> back(kBehindRoot, middle_y.front() + sections_.front().top);
    for (std::size_t k = 0; k < sections_.size(); ++k)
        back.push_back(middle_y[k] + sections_[k].top);
    const double step = (to_z - from_z) / static_cast<double>(sections_.size() - 1);
    palate_ = Palate(head, from_z - kBehindRoot * step, to_z, back);
}

TongueSection TongueBody::section_at(double along) const {
    const double place = std::clamp(along, 0.0, 1.0) * static_cast<double>(sections_.size() - 1);
    const auto k = std::min(sections_.size() - 2, static_cast<std::size_t>(place));
    const double t = place - static_cast<double>(k);
    const TongueSection &a = sections_[k], &b = sections_[k + 1];
    return {(1 - t) * a.top + t * b.top, (1 - t) * a.bottom + t * b.bottom,
            (1 - t) * a.half_width + t * b.half_width};
}

double TongueBody::share(const TonguePoint& point, const TongueSection& section,
                         double underside) const {
    const double half = point.height > 0 ? section.top : section.bottom;
    const double above = half > 0 ? std::clamp(point.height / half, -1.0, 1.0) : 0.0;
    const double aside =
        section.half_width > 0 ? std::min(1.0, std::abs(point.side) / section.half_width) : 0.0;
    return (1 - (1 - kEdge) * geom::smoothstep(kEdgeFrom, 1.0, aside)) *
           (1 - (1 - underside) * 0.5 * (1 - above));
}

void TongueBody::raise(double up, double back, const Points& vertices,
                       std::vector<TonguePoint>& points) const {
    const PalateHeights palate = palate_.heights(vertices);
    const double film = kFilm_mm * millimetre_, hump = kHump_mm * millimetre_;
    const auto room = [&](const TonguePoint& point) {
        return palate.at(point.p.x(), point.p.z()) - film - point.p.y();
    };
    // How high the top of the arch is when the first point touches the palate, without what the moved hump adds
    double way = kHighestArch_mm * millimetre_;
    for (const TonguePoint& point : points) {
        const double part = share(point, section_at(point.along), kUnderside),
                     here = arch_at(point.along, back);
        if (part * here <= kTouches) continue;
        const double moved = hump * part * (here - arch_at(point.along, 0));
        way = std::min(way, std::max(0.0, room(point) - moved) / (part * here));
    }
    const double press = 1 + kPress + kPressMore * geom::smoothstep(kPressFrom, kPressTo, up);
    const double above = press * way * softly(up), below = kLower_mm * millimetre_ * softly(-up);
    for (TonguePoint& point : points) {
        const TongueSection section = section_at(point.along);
        const double here = arch_at(point.along, back), rest = arch_at(point.along, 0);
        const double rise = above * here + hump * (here - rest);
        const double thickness = std::max(section.top + section.bottom, kThinBody_mm * millimetre_);
        // One that becomes lower would go through the teeth if it became wider
        const double stretch =
            1 + (1 - kUnderside) * std::clamp(rise, 0.0, std::max(way, 0.0)) / thickness;
        point.p.x() *= std::pow(stretch, -kNarrow);
        point.p.y() += held_back(share(point, section, kUnderside) * rise, room(point)) -
                       share(point, section, kUndersideSinks) * below * rest;
    }
}

}  // namespace risorius::face
