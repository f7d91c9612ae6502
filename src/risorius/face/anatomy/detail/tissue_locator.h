// SPDX-License-Identifier: MIT
/// \file
/// Locates points in the tissue: the skin above a point, and the tetrahedron that contains it.
#pragma once

#include <string>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/geom/closest_point.h"
#include "risorius/muscle/fibre_set.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// A lip, as one that owns a fibre.
enum class Lip { kNone, kUpper, kLower };

/// Returns the lip that a landmark lies on, at the red border or beside it; none for the corners of the mouth and everything else.
Lip lip_of(const std::string& landmark);

/// Queries on the tissue mesh at rest. Positions are in the head frame, m.
class TissueLocator {
  public:
    /// Keeps references to its arguments.
    TissueLocator(const rig::Head& head, const Shell& shell, const TissueMesh& mesh);

    /// The column of tissue between skin and bone: its skin point, outward direction (unit) and thickness, m.
    struct Column {
        Vec3 skin, outward;
        double thickness;
    };
    /// Returns the column at the point of the skin that is nearest to p. In the middle half of the mouth, the lips may overlap: there the
    /// other lip than `lip` is left out.
    Column column_at(const Vec3& p, Lip lip = Lip::kNone) const;

    /// Returns the four nodes and the barycentric weights of p in the tetrahedron that contains it. If p lies outside the tissue, it takes
    /// a near tetrahedron, with the weights limited to 0..1. `lip` as in column_at().
    muscle::FibrePoint embed(const Vec3& p, Lip lip = Lip::kNone) const;

  private:
    bool owned(const Vec3& p, Lip lip) const;
    bool on_other_lip(long tet, Lip lip) const;
    Eigen::Vector4d weights(long t, const Vec3& p) const;

    const Shell& shell_;
    const TissueMesh& mesh_;
    double middle_x_, quarter_m_;  ///< of the mouth, m: its middle, and a quarter of its width
    struct Skin {
        Triangles triangles;  ///< of the shell
        geom::SurfaceTree tree;
    };
    Skin skin_, upper_skin_,
        lower_skin_;  ///< the latter without the other lip, and all that is on its side of the bite
    Points centres_;
};

}  // namespace risorius::face
