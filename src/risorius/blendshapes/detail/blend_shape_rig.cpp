// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/blend_shape_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace risorius::blendshapes {

double Driver::value(const Eigen::VectorXd& shape_weights) const {
    const auto weight_of = [&](int i) { return std::clamp(shape_weights[i], 0.0, 1.0); };
    double product = 1;
    for (const int i : fades_with) product *= 1 - weight_of(i);
    if (shapes.size() > 1) {
        for (const int i : shapes) product *= weight_of(i);
        return product;
    }
    const double w = weight_of(shapes[0]);
    for (int i = 0; i < 4; ++i) product *= i < part ? w : 1 - w;
    constexpr double kInMiddle = 1 / 0.0625, kAside = 256.0 / 27.0;  // 1 over the maximum
    return (part == 2 ? kInMiddle : kAside) * product;
}

std::string Driver::target_name() const {
    std::string out;
    for (const char c : name)
        if (c == '*' || c == '~')
            out += '_';
        else
            out += c;
    if (shapes.size() == 1)  // "~1": a quarter of the way
        out.replace(out.rfind('_') + 1, 1, std::to_string(25 * part));
    return out;
}

std::optional<long> Corrective::follows() const {
    if ((of_drivers.array() != 0).count() != 1) return std::nullopt;
    Eigen::Index only;
    return of_drivers.maxCoeff(&only) == 1 ? std::optional<long>(only) : std::nullopt;
}

Eigen::VectorXd BlendShapeRig::driver_values(const Eigen::VectorXd& weights) const {
    Eigen::VectorXd out(static_cast<long>(drivers.size()));
    for (std::size_t t = 0; t < drivers.size(); ++t)
        out[static_cast<long>(t)] = drivers[t].value(weights);
    return out;
}

void BlendShapeRig::add_to(Points& vertices, const Eigen::VectorXd& weights) const {
    const Eigen::VectorXd all = all_weights(weights);
    for (std::size_t s = 0; s < shapes.size(); ++s)
        if (const double w = all[static_cast<long>(s)]; w != 0) shapes[s].add_to(vertices, w);
    for (std::size_t c = 0; c < correctives.size(); ++c)
        if (const double w = all[weights.size() + static_cast<long>(c)]; w != 0)
            correctives[c].shape.add_to(vertices, w);
}

Eigen::VectorXd BlendShapeRig::all_weights(const Eigen::VectorXd& weights) const {
    const Eigen::VectorXd values = driver_values(weights);
    Eigen::VectorXd out(weights.size() + static_cast<long>(correctives.size()));
    out.head(weights.size()) = weights;
    for (std::size_t c = 0; c < correctives.size(); ++c)
        out[weights.size() + static_cast<long>(c)] =
            std::clamp(correctives[c].of_drivers.dot(values), 0.0, 1.0);
    return out;
}

FieldError error_between(const Points& one, const Points& other, const Eigen::VectorXd& area) {
    FieldError out;
    double sum = 0, whole = 0;
    for (long v = 0; v < one.rows(); ++v) {
        if (!(area[v] > 0)) continue;
        const double distance = (one.row(v) - other.row(v)).norm();
        sum += area[v] * distance * distance;
        whole += area[v];
        if (distance > out.max_m) {
            out.max_m = distance;
            out.where = v;
        }
    }
    if (whole > 0) out.rms_m = std::sqrt(sum / whole);
    return out;
}

std::pair<Points, Points> left_and_right(const Points& rest, const Points& field,
                                         double half_width_m) {
    Points left = field, right = field;
    for (long v = 0; v < rest.rows(); ++v) {
        left.row(v) *= left_fraction(rest(v, 0), half_width_m);
        right.row(v) -= left.row(v);
    }
    return {left, right};
}

}  // namespace risorius::blendshapes
