// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/head_surface.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace risorius::headmodel {
namespace {

constexpr double kTop = 45.0, kBottom = -50.0, kPerRadian = 90.0;
constexpr double kPhiStep = M_PI / 120.0, kStep = 2.0, kLow = -190.0, kHigh = 190.0;

struct Sample {
    Vec3 point;
    double weight;
};

/// The measured cranium stands 7 mm above the norm for tragion to vertex (landmark v); lower it smoothly above the hairline.
double lowered(double y) {
    constexpr double kFrom = 70.0, kMeasuredTop = 137.3, kNorm = 130.2;
    const double over = std::max(0.0, y - kFrom);
    return y -
           (kMeasuredTop - kNorm) * over * over / ((kMeasuredTop - kFrom) * (kMeasuredTop - kFrom));
}

std::vector<Sample> gather(const DesignTables& tables) {
    std::vector<Sample> samples;
    const auto& depth = tables.face_depth;
    for (std::size_t r = 0; r < depth.rows.size(); ++r)
        for (std::size_t c = 0; c < depth.columns.size(); ++c) {
            const double x = depth.columns[c], y = depth.rows[r], z = depth.value[r][c];
            if (std::isnan(z)) continue;
            if (x > 3 && x < 19 && y < -13 && y > -31)
                continue;                      // wing and nostril have their own loops
            if (y == -52 && x < 20) continue;  // the slit between the lips
            if (z < -4) continue;
            samples.push_back({Vec3(x, y, z), 1.0});
        }
    const auto& radius = tables.head_radius;
    for (std::size_t r = 0; r < radius.rows.size(); ++r)
        for (std::size_t c = 0; c < radius.columns.size(); ++c) {
            const double y = radius.rows[r], azimuth = radius.columns[c],
                         value = radius.value[r][c];
            if (std::isnan(value)) continue;
            const double a = azimuth * M_PI / 180.0;
            const Vec3 p(value * std::sin(a), lowered(y), 20.0 + value * std::cos(a));
            if (y < 92 && y > -97 && azimuth < 35) continue;  // the depth table is finer
            if (y < 35 && y > -36 && azimuth > 96 && azimuth < 121) continue;  // ear
            if (y < -95 && azimuth > 105) continue;                            // shoulder
            if (y < -88 && azimuth > 145) continue;
            samples.push_back({p, 0.7});
        }
    for (const auto& landmark : tables.landmarks) {
        const std::string& id = landmark.first;
        const Vec3& p = landmark.second;
        if (p.x() < 0) continue;
        // Free margins and wing points lie off the bare head; the ear has its own frame.
        static const char* const kElsewhere[] = {"stos", "sto",    "stoi", "uli_l", "lli_l", "al_l",
                                                 "ac_l", "sbal_l", "sa_l", "sba_l", "v",     "c"};
        if (std::any_of(std::begin(kElsewhere), std::end(kElsewhere),
                        [&](const char* e) { return id == e; }))
            continue;
        samples.push_back({p, 2.0});
    }
    // Under the tip and where columella and lip meet the skin turns within a row of the table: a plate would cut the one and swing
    // past the other.
    for (const Vec3& p : {Vec3(0, -26, 113.3), Vec3(0, -34, 99.4), Vec3(4, -34, 99.2),
                          Vec3(8, -34, 97.9), Vec3(12, -34, 95.1)})
        samples.push_back({p, 4.0});
    // Throat and side of the neck below the measured part, own design.
    for (const Vec3& p : {Vec3(0, -125, 23), Vec3(0, -145, 20), Vec3(22, -125, 14),
                          Vec3(47, -118, -14), Vec3(38, -118, 2)})
        samples.push_back({p, 2.0});
    return samples;
}

}  // namespace

CapsulePoint capsule_coordinates(const Vec3& p) {
    const double across = std::hypot(p.x(), p.z());
    const double phi = std::atan2(std::abs(p.x()), p.z());
    if (p.y() > kTop)
        return {phi, kTop + kPerRadian * std::atan2(p.y() - kTop, across),
                std::hypot(across, p.y() - kTop)};
    if (p.y() < kBottom)
        return {phi, kBottom - kPerRadian * std::atan2(kBottom - p.y(), across),
                std::hypot(across, p.y() - kBottom)};
    return {phi, p.y(), across};
}

Vec3 point_at(double phi, double s, double rho) {
    double y = s, across = rho;
    if (s > kTop) {
        const double e = (s - kTop) / kPerRadian;
        y = kTop + rho * std::sin(e);
        across = rho * std::cos(e);
    } else if (s < kBottom) {
        const double e = (kBottom - s) / kPerRadian;
        y = kBottom - rho * std::sin(e);
        across = rho * std::cos(e);
    }
    return Vec3(across * std::sin(phi), y, across * std::cos(phi));
}

HeadSurface::HeadSurface(const DesignTables& tables)
    : columns_(121), rows_(static_cast<int>((kHigh - kLow) / kStep) + 1) {
    const int n = columns_ * rows_;
    const auto id = [&](int c, int r) {
        // The surface continues as its own mirror image across the midline, front and back.
        if (c < 0) c = -c;
        if (c >= columns_) c = 2 * (columns_ - 1) - c;
        return r * columns_ + c;
    };
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    const auto add_row = [&](const std::vector<std::pair<int, double>>& row, double target,
                             double weight) {
        for (const auto& [i, a] : row) {
            right[i] += weight * a * target;
            for (const auto& [j, b] : row) entries.emplace_back(i, j, weight * a * b);
        }
    };
    // Thin-plate energy; stiffer on cranium and neck, where the tables are coarse and the head is plain.
    for (int r = 0; r < rows_; ++r)
        for (int c = 0; c < columns_; ++c) {
            const double s = kLow + r * kStep;
            const double face = std::clamp((90.0 - c * 1.5) / 30.0, 0.0, 1.0) *
                                std::clamp((105.0 - std::abs(s + 5.0)) / 20.0, 0.0, 1.0);
            // Below the chin the tables meet at grazing rays, so their rounding would show as bumps on the jaw.
            const double jaw = std::clamp((-58.0 - s) / 15.0, 0.0, 1.0) *
                               std::clamp((c * 1.5 - 22.0) / 15.0, 0.0, 1.0);
            const double stiffness = std::max(0.12 * face + 12.0 * (1.0 - face), 8.0 * jaw);
            add_row({{id(c - 1, r), 1}, {id(c, r), -2}, {id(c + 1, r), 1}}, 0, stiffness);
            if (r > 0 && r + 1 < rows_) {
                add_row({{id(c, r - 1), 1}, {id(c, r), -2}, {id(c, r + 1), 1}}, 0, stiffness);
                if (c + 1 < columns_)
                    add_row({{id(c, r), 1},
                             {id(c + 1, r), -1},
                             {id(c, r + 1), -1},
                             {id(c + 1, r + 1), 1}},
                            0, 2 * stiffness);
            }
        }
    for (const Sample& sample : gather(tables)) {
        const CapsulePoint q = capsule_coordinates(sample.point);
        const double u = q.phi / kPhiStep, v = (q.s - kLow) / kStep;
        const int c = std::clamp(static_cast<int>(u), 0, columns_ - 2);
        const int r = std::clamp(static_cast<int>(v), 0, rows_ - 2);
        const double fu = u - c, fv = v - r;
        add_row({{id(c, r), (1 - fu) * (1 - fv)},
                 {id(c + 1, r), fu * (1 - fv)},
                 {id(c, r + 1), (1 - fu) * fv},
                 {id(c + 1, r + 1), fu * fv}},
                q.rho, sample.weight);
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    const Eigen::VectorXd solution = factor.solve(right);
    value_.assign(solution.data(), solution.data() + n);
}

double HeadSurface::rho(double phi, double s) const {
    // Uniform cubic B-spline weights would smooth; Catmull-Rom passes through the fitted values.
    const double u = std::clamp(phi / kPhiStep, 0.0, columns_ - 1.0);
    const double v = std::clamp((s - kLow) / kStep, 1.0, rows_ - 2.001);
    const int c = std::min(static_cast<int>(u), columns_ - 2), r = static_cast<int>(v);
    const auto weights = [](double t) {
        return std::array<double, 4>{((-0.5 * t + 1.0) * t - 0.5) * t,
                                     (1.5 * t - 2.5) * t * t + 1.0,
                                     ((-1.5 * t + 2.0) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
    };
    const auto wu = weights(u - c), wv = weights(v - r);
    double sum = 0;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            int cc = c + i - 1;
            if (cc < 0) cc = -cc;
            if (cc >= columns_) cc = 2 * (columns_ - 1) - cc;
            const int rr = std::clamp(r + j - 1, 0, rows_ - 1);
            sum += wu[i] * wv[j] * value_[static_cast<std::size_t>(rr * columns_ + cc)];
        }
    return sum;
}

Vec3 HeadSurface::project(const Vec3& point) const {
    const CapsulePoint q = capsule_coordinates(point);
    Vec3 p = at(q.phi, q.s);
    if (point.x() < 0) p.x() = -p.x();
    return p;
}

}  // namespace risorius::headmodel
