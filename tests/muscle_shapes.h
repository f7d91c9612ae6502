// SPDX-License-Identifier: MIT
/// \file
/// Muscles of every shape for tests: sizes as in a face, and a closed surface to fill.
#pragma once

#include <cmath>
#include <numbers>

#include "risorius/muscle/muscle_shape.h"

namespace risorius::testing_of {

inline muscle::MuscleShape block_shape() {
    return {.place = "block", .length_m = 0.04, .width_m = 0.02, .thickness_m = 0.01};
}

inline muscle::MuscleShape fusiform_shape() {
    return {.place = "round",
            .form = muscle::MuscleShape::Form::kRound,
            .length_m = 0.04,
            .width_m = 0.02,
            .thickness_m = 0.016,
            .end_ratio = 0.5};
}

inline muscle::MuscleShape sheet_shape() {
    return {.place = "sheet",
            .form = muscle::MuscleShape::Form::kSheet,
            .length_m = 0.05,
            .width_m = 0.05,
            .thickness_m = 0.004,
            .insertion_width_m = 0.025};
}

/// A quarter of a circle of 40 mm, bent about y.
inline muscle::MuscleShape bent_shape() {
    muscle::MuscleShape shape{.place = "path", .form = muscle::MuscleShape::Form::kPath};
    constexpr int kPoints = 5;
    shape.path_m.resize(kPoints, 3);
    shape.outward.resize(kPoints, 3);
    for (int i = 0; i < kPoints; ++i) {
        const double angle = std::numbers::pi / 2 * i / (kPoints - 1);
        shape.outward.row(i) << std::sin(angle), 0, std::cos(angle);
        shape.path_m.row(i) = 0.04 * shape.outward.row(i);
    }
    shape.widths_m = {0.010, 0.014, 0.016, 0.014, 0.010};
    shape.thicknesses_m = {0.006};
    return shape;
}

/// An oval of 60 by 44 mm in the plane z = 0, as around a mouth.
inline muscle::MuscleShape ring_shape() {
    muscle::MuscleShape shape{.place = "ring", .form = muscle::MuscleShape::Form::kRing};
    constexpr int kPoints = 8;
    shape.path_m.resize(kPoints, 3);
    for (int i = 0; i < kPoints; ++i) {
        const double angle = 2 * std::numbers::pi * i / kPoints;
        shape.path_m.row(i) << 0.03 * std::cos(angle), 0.022 * std::sin(angle), 0;
    }
    shape.widths_m = {0.008};
    shape.thicknesses_m = {0.005};
    return shape;
}

/// Spindle about an arc in the x-z plane that turns by `bend` rad over 60 mm; elliptic sections 20 by 14 mm in the middle.
inline muscle::MuscleShape spindle_shape(double bend) {
    muscle::MuscleShape shape{.place = "surface", .form = muscle::MuscleShape::Form::kSurface};
    constexpr int kRings = 24, kSides = 24;
    constexpr double kLength = 0.06, kWidth = 0.02, kThickness = 0.014;
    shape.surface_m.resize(kRings * kSides + 2, 3);
    const auto place = [&](double s, double y, double z) -> Vec3 {
        const double angle = bend * (s - 0.5);
        if (bend == 0) return {kLength * (s - 0.5), y, z};
        const double radius = kLength / bend;
        return {(radius + z) * std::sin(angle), y, (radius + z) * std::cos(angle) - radius};
    };
    for (int i = 0; i < kRings; ++i) {
        // Close together at the tips
        const double turn = std::numbers::pi * (i + 0.5) / kRings;
        const double s = 0.5 - 0.5 * std::cos(turn), r = std::sqrt(std::sin(turn));
        for (int k = 0; k < kSides; ++k) {
            const double angle = 2 * std::numbers::pi * k / kSides;
            shape.surface_m.row(i * kSides + k) =
                place(s, r * kWidth / 2 * std::cos(angle), r * kThickness / 2 * std::sin(angle))
                    .transpose();
        }
    }
    const int first = kRings * kSides, last = first + 1;
    shape.surface_m.row(first) = place(0, 0, 0).transpose();
    shape.surface_m.row(last) = place(1, 0, 0).transpose();
    shape.triangles.resize(2 * kSides * kRings, 3);
    int t = 0;
    for (int k = 0; k < kSides; ++k) {
        const int next = (k + 1) % kSides;
        shape.triangles.row(t++) << first, next, k;
        for (int i = 0; i + 1 < kRings; ++i) {
            const int a = i * kSides + k, b = i * kSides + next;
            shape.triangles.row(t++) << a, b, b + kSides;
            shape.triangles.row(t++) << a, b + kSides, a + kSides;
        }
        shape.triangles.row(t++) << last, (kRings - 1) * kSides + k, (kRings - 1) * kSides + next;
    }
    shape.equal_volume = true;
    return shape;
}

inline double surface_volume(const muscle::MuscleShape& shape) {
    double six = 0;
    for (Eigen::Index t = 0; t < shape.triangles.rows(); ++t) {
        const Vec3 a = shape.surface_m.row(shape.triangles(t, 0)),
                   b = shape.surface_m.row(shape.triangles(t, 1)),
                   c = shape.surface_m.row(shape.triangles(t, 2));
        six += a.dot(b.cross(c));
    }
    return six / 6;
}

}  // namespace risorius::testing_of
