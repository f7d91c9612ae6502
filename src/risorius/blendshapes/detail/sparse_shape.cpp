// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/sparse_shape.h"

#include <algorithm>

namespace risorius::blendshapes {

namespace {

double smooth_rise(double x, double from, double to) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace

void SparseShape::add_to(Points& vertices, double weight) const {
    for (std::size_t i = 0; i < vertex.size(); ++i)
        vertices.row(vertex[i]) += weight * delta.row(static_cast<long>(i));
}

Points SparseShape::dense(long vertices) const {
    Points out = Points::Zero(vertices, 3);
    add_to(out, 1.0);
    return out;
}

SparseShape sparse(const Points& field) {
    SparseShape out;
    for (long v = 0; v < field.rows(); ++v)
        if (!field.row(v).isZero(0.0)) out.vertex.push_back(static_cast<int>(v));
    out.delta.resize(static_cast<long>(out.vertex.size()), 3);
    for (std::size_t i = 0; i < out.vertex.size(); ++i)
        out.delta.row(static_cast<long>(i)) = field.row(out.vertex[i]);
    return out;
}

void fade_out(Points& field, const Fade& fade) {
    for (long v = 0; v < field.rows(); ++v) {
        const double size = field.row(v).norm(),
                     fraction = smooth_rise(size, fade.none_m, fade.all_m);
        field.row(v) *= fraction * size < 0.2 * fade.none_m ? 0.0 : fraction;
    }
}

double left_fraction(double x_m, double half_width_m) {
    return smooth_rise(x_m, -half_width_m, half_width_m);
}

void share_the_rest(const Points& rest, const Points& whole, double half_width_m, Points& left,
                    Points& right) {
    for (long v = 0; v < rest.rows(); ++v) {
        const Vec3 left_over = (whole.row(v) - left.row(v) - right.row(v)).transpose();
        const double fraction = left_fraction(rest(v, 0), half_width_m);
        left.row(v) += fraction * left_over.transpose();
        right.row(v) += (1 - fraction) * left_over.transpose();
    }
}

}  // namespace risorius::blendshapes
