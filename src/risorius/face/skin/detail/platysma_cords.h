// SPDX-License-Identifier: MIT
/// \file
/// The cords of the neck: where platysma spans the hollow under the jaw, its borders lift from the throat as they contract.
///
///   p(s)   a border on the skin, from collar bone to jaw     n   outwards      T = a F_b   tension, a the activation
///   h(s)   height of the border over the throat: a string on an elastic bed of fat and fascia of stiffness k per length,
///
///     T h'' - k h = -T max(0, p'' . n),    h = 0 at both ends
///
/// The border rises where it spans a hollow and stays where it curves round the jaw. Across the border the height falls off as
/// 1 / cosh(y / w), the shape of a stretched sheet with bending stiffness. The part of the ridge that is finer than the mesh goes to the
/// renderer as a wrinkle line of negative depth. At a = 0 nothing moves.
///
/// The medial borders are the most prominent, posterior bands less: de Castro 1980, Plast. Reconstr. Surg. 66(6), 833-841.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// Heights h, m, of a string under `tension_n` through `stations` (two or more, `spacing_m` apart) with the outward direction of each,
/// on a bed of stiffness `bed_n_per_m2`.
std::vector<double> string_heights(const std::vector<Vec3>& stations,
                                   const std::vector<Vec3>& outward, double spacing_m,
                                   double tension_n, double bed_n_per_m2);

class PlatysmaCords {
  public:
    /// Has no cords on a rig without platysma, or when the mesh ends above the neck.
    PlatysmaCords(const rig::Head& head, const rig::RigDescription& rig);

    /// Adds a wrinkle line along each border where its slot is free. Without this call, raise() gives no depths.
    void mark(WrinkleLines& lines);

    /// Displaces `vertices` (V x 3, m) by the cords at this `activation` (one column per muscle and side). Adds what is finer than the mesh
    /// to `depth` (as WrinkleLines, or no rows).
    void raise(const Eigen::VectorXd& activation, Points& vertices, Points& depth) const;

    /// Points of the borders at rest, head frame, m. For tests and pictures.
    std::vector<std::vector<Vec3>> lines() const;

  private:
    struct Station {
        std::array<int, 3> corner;
        Vec3 barycentric;
        Vec3 rest, outward;
    };
    struct Lifted {
        int vertex;
        double station;   ///< place along the border
        double fraction;  ///< fraction of the height at that place
        double across;    ///< from the border, > 0 to the left, m
        double ridge;     ///< depth of the line / height of the cord
    };
    struct Cord {
        int column;
        double force_n;  ///< at activation 1
        double spacing_m;
        std::vector<Station> stations;
        std::vector<Lifted> lifted;
        double line_m = 0;  ///< wavelength of its line
        int slot = -1;      ///< of its line
    };
    void add(const rig::Head& head, const std::vector<Vec3>& along, int column, int slot,
             double force_n);

    std::vector<Cord> cords_;
    double bed_n_per_m2_ = 0;
    bool marked_ = false;
};

}  // namespace risorius::face
