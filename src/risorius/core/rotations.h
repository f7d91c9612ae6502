// SPDX-License-Identifier: MIT
/// \file
/// Rotations that fit something: two directions, a matrix, or points. They are compiled only once, because each file that uses Eigen's
/// singular value decomposition takes seconds longer to compile.
#pragma once

#include "risorius/core/types.h"

namespace risorius {

/// The shortest rotation that turns the direction `from` into the direction `to`. Their lengths do not matter, but are not 0. Between
/// opposite directions it is a half turn about any axis across them.
Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to);

/// The rotation R that is nearest to a matrix A: it minimises |R - A| over all rotations (Kabsch 1976).
struct NearestRotation {
    Mat3 rotation = Mat3::Identity();
    /// Singular values of A, descending. The last one has a minus sign if A mirrors. Their sum is the trace of R^T A.
    Vec3 stretch = Vec3::Ones();
};
NearestRotation nearest_rotation(const Mat3& matrix);

/// The rigid motion that brings the rows of `from` nearest to those of `to`, in the least squares sense (Kabsch 1976).
Rigid nearest_motion(const Points& from, const Points& to);

}  // namespace risorius
