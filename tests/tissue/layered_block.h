// SPDX-License-Identifier: MIT
/// \file
/// A small layered block of tissue and its top sheet, and checks that every energy term must pass.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// Nodes on a wavy nx x ny x nz grid. Each cell is cut into six tets around its main diagonal.
struct LayeredBlock {
    Points rest;
    Tets tets;
    Triangles top;

    LayeredBlock(int nx, int ny, int nz, double spacing_m = 4e-3) {
        const auto at = [&](int i, int j, int k) { return (k * ny + j) * nx + i; };
        rest.resize(nx * ny * nz, 3);
        for (int k = 0; k < nz; ++k)
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i)
                    rest.row(at(i, j, k)) << i * spacing_m, j * spacing_m,
                        k * spacing_m + 0.3 * spacing_m * std::sin(1.3 * i + 0.7 * j);
        static constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                             {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
        tets.resize(6 * (nx - 1) * (ny - 1) * (nz - 1), 4);
        int t = 0;
        for (int k = 0; k + 1 < nz; ++k)
            for (int j = 0; j + 1 < ny; ++j)
                for (int i = 0; i + 1 < nx; ++i)
                    for (int path = 0; path < 6; ++path) {
                        int p[3] = {i, j, k};
                        int corner[4] = {at(i, j, k), 0, 0, 0};
                        for (int step = 0; step < 3; ++step) {
                            ++p[kPaths[path][step]];
                            corner[step + 1] = at(p[0], p[1], p[2]);
                        }
                        if (path >= 3) std::swap(corner[1], corner[2]);
                        tets.row(t++) << corner[0], corner[1], corner[2], corner[3];
                    }
        top.resize(2 * (nx - 1) * (ny - 1), 3);
        t = 0;
        for (int j = 0; j + 1 < ny; ++j)
            for (int i = 0; i + 1 < nx; ++i) {
                const int a = at(i, j, nz - 1), b = at(i + 1, j, nz - 1);
                const int c = at(i + 1, j + 1, nz - 1), d = at(i, j + 1, nz - 1);
                top.row(t++) << a, b, c;
                top.row(t++) << a, c, d;
            }
    }
    int nodes() const { return static_cast<int>(rest.rows()); }
};

inline Points shaken(const Points& x, double amplitude_m, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-amplitude_m, amplitude_m);
    Points y = x;
    for (Eigen::Index i = 0; i < y.size(); ++i) y.data()[i] += uniform(random);
    return y;
}

inline Points moved(const Points& x, const Rigid& motion) {
    Points y(x.rows(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        y.row(i) = (motion * Vec3(x.row(i).transpose())).transpose();
    return y;
}

inline Rigid some_motion() {
    Rigid motion = Rigid::Identity();
    motion.rotate(Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()));
    motion.pretranslate(Vec3(0.02, -0.05, 0.03));
    return motion;
}

template <class Term>
Points gradient_of(const Term& term, const Points& x) {
    Points gradient = Points::Zero(x.rows(), 3);
    term.add_energy(x, gradient);
    return gradient;
}

/// Compares the gradient with central differences in every coordinate. With a step of 1e-8 m on elements of millimetres,
/// rounding and truncation are both near 1e-8 of the maximum force.
template <class Term>
void expect_gradient_is_exact(const Term& term, const Points& x, double tolerance = 1e-6) {
    const Points gradient = gradient_of(term, x);
    const double largest = gradient.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    const double h = 1e-8;
    Points y = x, ignored = Points::Zero(x.rows(), 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        y.data()[i] = x.data()[i] + h;
        const double above = term.add_energy(y, ignored);
        y.data()[i] = x.data()[i] - h;
        const double below = term.add_energy(y, ignored);
        y.data()[i] = x.data()[i];
        ASSERT_NEAR((above - below) / (2 * h), gradient.data()[i], tolerance * largest)
            << "coordinate " << i;
    }
}

/// Internal forces neither translate nor rotate the body as a whole.
inline void expect_no_net_force_or_torque(const Points& x, const Points& gradient) {
    const double largest = gradient.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double longest = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const Vec3 f = gradient.row(i).transpose(), p = x.row(i).transpose();
        force += f;
        torque += p.cross(f);
        longest = std::max(longest, p.norm());
    }
    EXPECT_LT(force.norm(), 1e-11 * largest);
    EXPECT_LT(torque.norm(), 1e-11 * largest * longest);
}

}  // namespace risorius::tissue
