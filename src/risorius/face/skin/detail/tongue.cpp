// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/tongue.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr int kPieces = 24;           // segments of the middle line; it has one sample more
constexpr double kTipUp_rad = 1.1;    // maximum curl of the blade
constexpr double kOverLip_rad = 0.6;  // angle over the lower lip at full protrusion
constexpr double kFlattest = 0.35;    // minimum thickness between teeth / thickness at rest
constexpr double kEngaged = 0.2;      // protrusion above which teeth and lips guide it fully
// At rest the tongue fills the mouth up to the palate. When the jaw opens it lies down on the floor of the mouth. Estimates, by eye
constexpr double kWideOpen_rad = 0.44;  // rotation of the jaw at which it lies flat
constexpr double kLiesDown = 0.3;       // fraction of its height that it has lost then
constexpr double kRootSinks_mm = 9;     // with the hyoid bone, average adult

// Returns how far the jaw is open, 0..1.
double opening(const Rigid& mandible) {
    return std::clamp(std::acos(std::clamp(mandible.linear()(1, 1), -1.0, 1.0)) / kWideOpen_rad,
                      0.0, 1.0);
}

double forward_angle(const Vec3& tangent) { return std::atan2(tangent.y(), tangent.z()); }

}  // namespace

Vec3 Tongue::Line::at(double along) const {
    const double place = std::clamp(along, 0.0, 1.0) * kPieces;
    const int k = std::min(kPieces - 1, static_cast<int>(place));
    const double t = place - k;
    return (1 - t) * point[static_cast<std::size_t>(k)] +
           t * point[static_cast<std::size_t>(k + 1)];
}

Vec3 Tongue::Line::tangent(double along) const {
    // Smoothed over a tenth of the line, so that neighbours rotate alike
    Vec3 t = at(along + 0.1) - at(along - 0.1);
    t.x() = 0;
    return t.normalized();
}

Tongue::Tongue(const rig::Head& head, double range_m) : head_(head), range_m_(range_m) {
    std::vector<int> vertices;
    double back = 1e300, front = -1e300, low = 1e300, high = -1e300;
    for (long v = 0; v < head.vertices.rows(); ++v)
        if (head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kTongue) {
            vertices.push_back(static_cast<int>(v));
            back = std::min(back, head.vertices(v, 2));
            front = std::max(front, head.vertices(v, 2));
        }
    if (vertices.empty()) return;
    length_m_ = std::max(1e-6, front - back);

    // Middle line: smoothed heights of slices, and their smoothed fractions of the motion of the jaw
    std::vector<double> height(kPieces + 1), weight(kPieces + 1);
    over_jaw_.assign(kPieces + 1, 0);
    for (int k = 0; k <= kPieces; ++k)
        for (int v : vertices) {
            const double off =
                (head.vertices(v, 2) - back) / length_m_ * kPieces - static_cast<double>(k);
            const double w = std::exp(-0.5 * off * off / 4) + 1e-12;
            weight[static_cast<std::size_t>(k)] += w;
            height[static_cast<std::size_t>(k)] += w * head.vertices(v, 1);
            over_jaw_[static_cast<std::size_t>(k)] +=
                w * head.jaw_fraction[static_cast<std::size_t>(v)];
        }
    for (int k = 0; k <= kPieces; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double along = static_cast<double>(k) / kPieces;
        rest_.point.push_back({0, height[i] / weight[i], back + along * length_m_});
        over_jaw_[i] *= (0.55 + 0.45 * geom::smoothstep(0.0, 0.5, along)) / weight[i];
    }
    for (int v : vertices) {
        const Vec3 p = head.vertices.row(v).transpose();
        const double along = (p.z() - back) / length_m_;
        const Vec3 ahead = rest_.tangent(along), off = p - rest_.at(along);
        const Vec3 up(0, ahead.z(), -ahead.y());
        members_.push_back({v, along, off.x(), off.dot(up), off.dot(ahead)});
        if (along > 0.6) {
            low = std::min(low, off.dot(up));
            high = std::max(high, off.dot(up));
        }
    }
    thickness_m_ = std::max(1e-4, high - low);
    std::vector<double> middle_y;
    for (const Vec3& p : rest_.point) middle_y.push_back(p.y());
    body_ = TongueBody(head, back, front, sections(), middle_y);

    // Edges of the incisors: the foremost points on bone at the midline. Without teeth they lie behind the lips
    const Vec3 lips = 0.5 * (head.landmark("stos") + head.landmark("stoi"));
    const auto edge = [&](bool lower) {
        Vec3 best = lips - Vec3(0, 0, head.mm(8));
        double foremost = -1e300;
        const auto carried = [&](long v) {
            const auto i = static_cast<std::size_t>(v);
            const bool on_jaw = head.jaw_fraction[i] > 0.5;
            return (head.carrier[i] == rig::Carrier::kMandible ||
                    head.carrier[i] == rig::Carrier::kSkull) &&
                   on_jaw == lower && std::abs(head.vertices(v, 0)) < head.mm(5) &&
                   (Vec3(head.vertices.row(v).transpose()) - lips).norm() < head.mm(22);
        };
        for (long v = 0; v < head.vertices.rows(); ++v)
            if (carried(v)) foremost = std::max(foremost, head.vertices(v, 2));
        for (long v = 0; v < head.vertices.rows(); ++v) {
            if (!carried(v) || head.vertices(v, 2) < foremost - head.mm(5)) continue;
            const double y = head.vertices(v, 1);
            if (foremost > -1e299 &&
                (best.z() != foremost || (lower ? y > best.y() : y < best.y())))
                best = {0, y, foremost};
        }
        return best;
    };
    lower_edge_ = edge(true);
    upper_edge_ = edge(false);
    tip_ = TongueTip(head, upper_edge_, length_m_);
    const auto skin_at = [&](const char* landmark) {
        std::vector<int> nearest;
        const Vec3 p = head.landmark(landmark);
        double min = 1e300;
        for (long v = 0; v < head.vertices.rows(); ++v) {
            if (head.carrier[static_cast<std::size_t>(v)] != rig::Carrier::kSkin) continue;
            const double d = (Vec3(head.vertices.row(v).transpose()) - p).norm();
            if (d >= min) continue;
            min = d;
            nearest = {static_cast<int>(v)};
        }
        return nearest;
    };
    lower_lip_ = skin_at("stoi");
    upper_lip_ = skin_at("stos");
}

// An ellipse for each sample of the middle line: means of the vertices about it.
std::vector<TongueSection> Tongue::sections() const {
    std::vector<TongueSection> out(kPieces + 1);
    for (int k = 0; k <= kPieces; ++k) {
        TongueSection& section = out[static_cast<std::size_t>(k)];
        const auto mean = [&](const auto& value, const auto& counts) {
            double sum = 0, weight = 1e-12;
            for (const Member& m : members_) {
                const double off = m.along * kPieces - k, w = std::exp(-0.5 * off * off / 2);
                if (!counts(m)) continue;
                sum += w * value(m);
                weight += w;
            }
            return sum / weight;
        };
        section.half_width = std::sqrt(2 * mean([](const Member& m) { return m.side * m.side; },
                                                [](const Member&) { return true; }));
        for (const double sign : {1.0, -1.0})
            (sign > 0 ? section.top : section.bottom) =
                mean([&](const Member& m) { return sign * m.up; },
                     [&](const Member& m) {
                         return sign * m.up > 0 && std::abs(m.side) < 0.5 * section.half_width;
                     });
    }
    return out;
}

Tongue::Gate Tongue::teeth(const Rigid& mandible) const {
    const Vec3 lower = mandible * lower_edge_;
    // Closed incisors overlap and leave no room
    return {lower.y(), std::max(upper_edge_.y(), lower.y()), 0.5 * (lower.z() + upper_edge_.z())};
}

double Tongue::room(const TongueDrive& drive) const {
    const Gate gate = teeth(drive.mandible);
    return std::clamp((gate.upper_y - gate.lower_y) / (kFlattest * thickness_m_), 0.0, 1.0);
}

Tongue::Line Tongue::bent(const TongueDrive& drive, double out) const {
    Line line;
    line.point.push_back(rest_.point.front());
    for (int k = 0; k < kPieces; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const Vec3 piece = rest_.point[i + 1] - rest_.point[i];
        const double along = (k + 0.5) / kPieces;
        const double stretch = 1 + out * range_m_ / length_m_ * 3 * along * along;
        const double bend = kTipUp_rad * drive.up * geom::smoothstep(0.45, 1.0, along) -
                            kOverLip_rad * out * geom::smoothstep(0.6, 1.0, along);
        const double angle = forward_angle(piece) + bend;
        line.point.push_back(line.point.back() +
                             stretch * piece.norm() * Vec3(0, std::sin(angle), std::cos(angle)));
    }
    for (std::size_t i = 0; i < line.point.size(); ++i)
        line.point[i] += over_jaw_[i] * (drive.mandible * line.point[i] - line.point[i]);
    return line;
}

void Tongue::place(const TongueDrive& drive, Points& vertices) const {
    if (empty()) return;
    const double out = drive.out * (drive.out > 0 ? room(drive) : 1.0);
    Line line = bent(drive, out);
    const double open = opening(drive.mandible), lies = 1 - kLiesDown * open;
    std::vector<double> flat(kPieces + 1, lies);
    const Vec3 down = drive.mandible.linear() * Vec3(0, -0.5 * (1 - lies) * thickness_m_, 0);
    for (std::size_t i = 0; i < line.point.size(); ++i) {
        const double behind = 1 - static_cast<double>(i) / kPieces;
        line.point[i] += over_jaw_[i] * down;
        line.point[i].y() -= open * behind * head_.mm(kRootSinks_mm);
    }
    if (out > 0) {
        // At the teeth and then at the lips, the tongue is shifted into the gap and flattened to its height
        const double engaged = geom::smoothstep(0, kEngaged, out);
        Gate lips{-1e300, 1e300, 0};
        if (!lower_lip_.empty() && !upper_lip_.empty())
            lips = {vertices(lower_lip_.front(), 1), vertices(upper_lip_.front(), 1),
                    0.5 * (vertices(lower_lip_.front(), 2) + vertices(upper_lip_.front(), 2))};
        double from_y = 0, from = 0;
        std::vector<double> shift(kPieces + 1, 0.0);
        double flattest = 1;
        for (const Gate& gate : {teeth(drive.mandible), lips}) {
            int k = 0;
            while (k <= kPieces && line.point[static_cast<std::size_t>(k)].z() < gate.z) ++k;
            if (k > kPieces) break;  // the tip has not reached this gap
            const double gap = std::max(0.0, gate.upper_y - gate.lower_y);
            flattest = std::min(flattest, std::clamp(0.9 * gap / thickness_m_, kFlattest, 1.0));
            const double half = std::min(0.5 * gap, 0.5 * flattest * thickness_m_);
            const double y = line.point[static_cast<std::size_t>(k)].y();
            // Closed lips or teeth: the tongue lies on the lower ones
            const double by = std::max(gate.lower_y + half, std::min(gate.upper_y - half, y)) - y;
            for (int i = 0; i <= kPieces; ++i) {
                const auto j = static_cast<std::size_t>(i);
                const double fraction = geom::smoothstep(from, std::max(from + 1, 1.0 * k), i);
                if (i > from) shift[j] = from_y + fraction * (by - from_y);
                flat[j] = std::min(flat[j], 1 - (1 - flattest) * geom::smoothstep(k - 8.0, k, i));
            }
            from_y = by;
            from = k;
        }
        for (std::size_t i = 0; i < line.point.size(); ++i) {
            line.point[i].y() += engaged * shift[i];
            flat[i] = lies - engaged * (lies - flat[i]);
        }
    }
    std::vector<TonguePoint> points;
    for (const Member& m : members_) {
        const double place = m.along * kPieces;
        const auto k = static_cast<std::size_t>(std::clamp(place, 0.0, kPieces - 1.0));
        const double t = place - static_cast<double>(k);
        const double thin = (1 - t) * flat[k] + t * flat[k + 1];
        const Vec3 ahead = line.tangent(m.along), up(0, ahead.z(), -ahead.y());
        points.push_back({m.along, m.side, m.up,
                          line.at(m.along) + m.side / std::sqrt(thin) * Vec3::UnitX() +
                              m.up * thin * up + m.ahead * ahead});
    }
    tip_.raise(drive.up, 1 - geom::smoothstep(0, kEngaged, out), points);
    if (drive.body_up != 0 || drive.body_back != 0)
        body_.raise(drive.body_up, drive.body_back, vertices, points);
    for (std::size_t i = 0; i < members_.size(); ++i)
        vertices.row(members_[i].vertex) = points[i].p.transpose();
}

}  // namespace risorius::face
