// SPDX-License-Identifier: MIT
/// \file
/// Types of vectors, matrices and arrays. An array has one row per element: V points, C texture coordinates, F triangles or T
/// tetrahedra. The entries of triangles and tetrahedra are the indices of their corners. Units are SI units unless a name
/// contains another unit.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "risorius/core/detail/installed_data.h"

#ifndef RISORIUS_EIGEN_ALIGN_BYTES
#error \
    "Compile with the flags of the library: target risorius::core in CMake, or pkg-config --cflags risorius"
#endif
static_assert(EIGEN_MAX_ALIGN_BYTES == RISORIUS_EIGEN_ALIGN_BYTES,
              "Eigen aligns otherwise than in the library: leave EIGEN_MAX_ALIGN_BYTES to the "
              "flags of risorius");

namespace risorius {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Rigid = Eigen::Isometry3d;

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;     ///< V x 3
using TexCoords = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  ///< C x 2
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;     ///< F x 3
using Tets = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;          ///< T x 4

/// The side of the face or body, as the subject sees it: left is +x in the head frame.
enum class Side { kLeft = 0, kRight = 1 };

}  // namespace risorius
