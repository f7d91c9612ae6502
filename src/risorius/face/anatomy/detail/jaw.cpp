// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/jaw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "risorius/face/anatomy/shell.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

Jaw::Jaw(const rig::Head& head, const rig::JawDescription& d) : size_(head.size) {
    hinge_ = head.mm(1.0) * d.hinge_mm;
    slide_ = head.mm(1.0) * d.open_slide_mm;
    forward_ = head.mm(1.0) * d.forward_mm;
    open_rad_ = d.open_deg * 3.14159265358979323846 / 180.0;
    side_m_ = head.mm(d.side_mm);
    chin_ahead_m_ = std::max(head.mm(30), head.landmark("pg").z() - hinge_.z());
    stomion_ = head.landmark("sto");
    corner_l_ = head.landmark("ch_l");
    corner_r_ = head.landmark("ch_r");
    for (const char* id :
         {"me", "gn", "pjm_l", "pjm_r", "mmb_l", "mmb_r", "ant_l", "ant_r", "go_l", "go_r"})
        border_.push_back(head.landmark(id));
}

Rigid Jaw::motion(double open, double forward, double side) const {
    // Condyles slide forward and down as the jaw opens; a sideways jaw also turns about the working condyle.
    Rigid motion = Rigid::Identity();
    const double yaw = side * side_m_ / chin_ahead_m_;
    motion.translate(
        Vec3(hinge_ + open * slide_ + forward * forward_ + Vec3(0.15 * side * side_m_, 0, 0)));
    motion.rotate(Eigen::AngleAxisd(0.85 * yaw, Vec3::UnitY()));
    motion.rotate(Eigen::AngleAxisd(open * open_rad_, Vec3::UnitX()));
    motion.translate(-hinge_);
    return motion;
}

double Jaw::height_over_bite(const Vec3& p) const {
    const double mm = 1e-3 * size_;
    // In front the lip line, from corner to corner through stomion.
    const Vec3& corner = p.x() >= 0 ? corner_l_ : corner_r_;
    const double across = std::clamp(std::abs(p.x()) / std::abs(corner.x()), 0.0, 1.0);
    double bite = stomion_.y() + (corner.y() - stomion_.y()) * across * across;
    // Behind the corners the occlusal plane rises, gently to the last molar and steeply to the condyle.
    const double lip_z = std::min(stomion_.z() - 6 * mm, corner.z() + 4 * mm);
    const double molar_z = 45 * mm;
    const double behind = std::max(0.0, lip_z - p.z());
    const double to_molar = std::max(1e-6, lip_z - molar_z);
    if (behind <= to_molar) {
        bite += 0.30 * behind;
    } else {
        const double at_molar = bite + 0.30 * to_molar;
        const double to_hinge = std::max(1e-6, molar_z - hinge_.z());
        bite = at_molar + (hinge_.y() - at_molar) * std::min(1.5, (behind - to_molar) / to_hinge);
    }
    return p.y() - bite;
}

double Jaw::border_height(const Vec3& p) const {
    double sum = 0, weights = 0;
    for (const Vec3& b : border_) {
        const double dx = p.x() - b.x(), dz = p.z() - b.z();
        const double w = 1.0 / (std::pow(dx * dx + dz * dz, 1.5) + 1e-9);
        sum += w * b.y();
        weights += w;
    }
    return sum / weights;
}

double Jaw::weight(const Vec3& p, double height_over_bite_m) const {
    const double mm = 1e-3 * size_;
    const double lateral = std::abs(p.x());
    const double corner = 0.5 * (corner_l_.x() - corner_r_.x());
    // The change from skull to mandible is sharp between the lips and wide over cheek and ramus.
    double half = (1.5 + 10.5 * geom::smoothstep(0.6 * corner, corner + 12 * mm, lateral)) * mm;
    half += 2.0 * mm * geom::smoothstep(50 * mm, 62 * mm, lateral);
    double w = 1.0 - geom::smoothstep(-half, half, height_over_bite_m);
    // Below the border of the mandible, tissue follows it less the nearer it is to the hyoid
    const double below = std::max(0.0, border_height(p) - p.y()) / (9 * mm);
    w /= 1.0 + below * below;
    w *= geom::smoothstep(2 * mm, 25 * mm, p.z());
    return w;
}

Vec3 Jaw::floor_bulge(const Vec3& p) const {
    const double mm = 1e-3 * size_;
    const double below = border_height(p) - p.y();
    const double aside = p.x() / (30 * mm);
    const double fraction = geom::smoothstep(-4 * mm, 14 * mm, below) *
                            (1.0 - geom::smoothstep(14 * mm, 60 * mm, below)) *
                            std::exp(-aside * aside) * geom::smoothstep(0.0, 15 * mm, p.z());
    return 0.4 * fraction * Vec3(0.7 * aside, -1, -0.55);
}

double Jaw::in_floor(const Vec3& p) const {
    const double mm = 1e-3 * size_;
    return geom::smoothstep(-11 * mm, 5 * mm, border_height(p) - p.y()) *
           geom::smoothstep(0.0, 15 * mm, p.z());
}

namespace {

// Returns the shortest distance along the edges of the fine shell from the vertex nearest to `from`, m; infinite if there is no path.
std::vector<double> ways_from(const Vec3& from, const rig::Head& head, const Shell& shell) {
    const std::size_t count = static_cast<std::size_t>(head.vertices.rows());
    std::vector<std::vector<int>> neighbours(count);
    int start = shell.fine(0, 0);
    for (long f = 0; f < shell.fine.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = shell.fine(f, k), b = shell.fine(f, (k + 1) % 3);
            neighbours[a].push_back(b);
            neighbours[b].push_back(a);
            if ((head.vertices.row(a).transpose() - from).squaredNorm() <
                (head.vertices.row(start).transpose() - from).squaredNorm())
                start = a;
        }
    std::vector<double> way(count, std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    way[start] = 0;
    open.push({0.0, start});
    while (!open.empty()) {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > way[v]) continue;
        for (int w : neighbours[v]) {
            const double longer = distance + (head.vertices.row(v) - head.vertices.row(w)).norm();
            if (longer < way[w]) {
                way[w] = longer;
                open.push({longer, w});
            }
        }
    }
    return way;
}

}  // namespace

std::vector<double> bite_heights(const rig::Head& head, const Jaw& jaw, const Shell& shell) {
    // Three points on each border, so that every point of the lips is near one of them.
    std::vector<double> to_upper, to_lower;
    const auto nearest_of = [&](const std::vector<const char*>& ids) {
        std::vector<double> min = ways_from(head.landmark(ids[0]), head, shell);
        for (std::size_t i = 1; i < ids.size(); ++i) {
            const std::vector<double> way = ways_from(head.landmark(ids[i]), head, shell);
            for (std::size_t v = 0; v < min.size(); ++v) min[v] = std::min(min[v], way[v]);
        }
        return min;
    };
    to_upper = nearest_of({"ls", "ulc_l", "ulc_r"});
    to_lower = nearest_of({"li", "llc_l", "llc_r"});
    const std::vector<Vec3> lips = lip_line(head);
    std::vector<double> out;
    for (int vertex : shell.vertex) {
        const Vec3 p = head.vertices.row(vertex).transpose();
        const double height = jaw.height_over_bite(p);
        const double near =
            1.0 - geom::smoothstep(head.mm(7), head.mm(12), geom::distance_to_polyline(p, lips));
        const double up = to_upper[vertex], down = to_lower[vertex];
        if (near <= 0 || !std::isfinite(up + down)) {
            out.push_back(height);
            continue;
        }
        // +1 on the upper border, -1 on the lower one, 0 at the corners where both are equally far
        const double side = (down - up) / (down + up + 1e-9);
        const double sided = head.mm(8) * side;
        out.push_back((1 - near) * height + near * sided);
    }
    return out;
}

}  // namespace risorius::face
