// SPDX-License-Identifier: MIT
/// \file
/// The head without ears as a smooth function: distance from a vertical axis segment, over azimuth and height.
///
/// Every point belongs to the nearest point O of the segment (0, 45, 0)-(0, -50, 0). Its coordinates are
///   phi   azimuth about the segment, 0 forward, pi backward, rad
///   s     height on the segment, continued beyond its ends by 90 mm per radian of elevation, mm
///   rho   distance from O, mm
/// rho(phi, s) is the thin-plate fit on a regular grid to the measured depths, radii and landmarks. The head without ears
/// and nasal wings is star-shaped in this sense, so one smooth function carries forehead, face, chin, throat and nape.
#pragma once

#include <vector>

#include "risorius/headmodel/detail/tables.h"

namespace risorius::headmodel {

struct CapsulePoint {
    double phi, s, rho;
};

CapsulePoint capsule_coordinates(const Vec3& point);
Vec3 point_at(double phi, double s, double rho);

class HeadSurface {
  public:
    explicit HeadSurface(const DesignTables& tables);

    double rho(double phi, double s) const;
    Vec3 at(double phi, double s) const { return point_at(phi, s, rho(phi, s)); }
    /// Projects a point onto the surface along the ray from the axis segment. The sign of x does not change.
    Vec3 project(const Vec3& point) const;

  private:
    int columns_, rows_;
    std::vector<double> value_;
};

}  // namespace risorius::headmodel
