// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/lid_pull.h"

#include <string>

namespace risorius::face {

namespace {

int nearest_skin_vertex(const rig::Head& head, const Vec3& p) {
    int nearest = 0;
    double min = 1e300;
    for (long v = 0; v < head.vertices.rows(); ++v) {
        if (head.carrier[v] != rig::Carrier::kSkin) continue;
        const double squared = (head.vertices.row(v).transpose() - p).squaredNorm();
        if (squared < min) {
            min = squared;
            nearest = static_cast<int>(v);
        }
    }
    return nearest;
}

double rounded(double d, double start) { return d > 0 ? d * d / (d + start) : 0.0; }

double slope_of_rounded(double d, double start) {
    return d > 0 ? d * (d + 2 * start) / ((d + start) * (d + start)) : 0.0;
}

}  // namespace

LidPullMeasure::LidPullMeasure(const rig::Head& head, const rig::EyesDescription& eyes)
    : upper_per_brow_(eyes.upper_lid_per_brow),
      lower_per_cheek_(eyes.lower_lid_per_cheek),
      start_m_(head.mm(0.5)) {
    for (std::size_t side = 0; side < 2; ++side) {
        const std::string suffix = side == 0 ? "_l" : "_r";
        const auto place = [&](const char* landmark) {
            const int vertex = nearest_skin_vertex(head, head.landmark(landmark + suffix));
            return Place{vertex, head.vertices(vertex, 1)};
        };
        brow_[side] = {place("bm"), place("bc"), place("bp")};
        cheek_[side] = place("ma");
    }
}

double LidPullMeasure::brow_m(int side, const Points& skin) const {
    double sum = 0;
    for (const Place& place : brow_[side]) sum += place.rest_y_m - skin(place.vertex, 1);
    return sum / 3.0;
}

double LidPullMeasure::cheek_m(int side, const Points& skin) const {
    return skin(cheek_[side].vertex, 1) - cheek_[side].rest_y_m;
}

std::array<LidPull, 2> LidPullMeasure::of(const Points& skin) const {
    std::array<LidPull, 2> out;
    for (int side = 0; side < 2; ++side)
        out[side] = {upper_per_brow_ * rounded(brow_m(side, skin), start_m_),
                     lower_per_cheek_ * rounded(cheek_m(side, skin), start_m_)};
    return out;
}

void LidPullMeasure::add_gradient(const Points& skin, const std::array<LidPull, 2>& slope,
                                  Points& by_skin) const {
    for (int side = 0; side < 2; ++side) {
        const double upper =
            slope[side].upper_m * upper_per_brow_ * slope_of_rounded(brow_m(side, skin), start_m_);
        for (const Place& place : brow_[side]) by_skin(place.vertex, 1) -= upper / 3.0;
        by_skin(cheek_[side].vertex, 1) += slope[side].lower_m * lower_per_cheek_ *
                                           slope_of_rounded(cheek_m(side, skin), start_m_);
    }
}

}  // namespace risorius::face
