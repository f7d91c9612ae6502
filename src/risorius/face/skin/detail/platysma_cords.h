// SPDX-License-Identifier: MIT
/// \file
/// The cords of the neck: where platysma spans the hollow under the jaw, its borders lift from the throat as they contract.
///
///   p(s)   a border on the skin, from collar bone to jaw; s is the length along it, m       n   outward normal
///   T = a F_b   tension, N; a is the activation, F_b the force of the border at a = 1
///   h(s)   height of the border over the throat, m, as that of a string on an elastic bed of fat and fascia with stiffness k, N/m^2:
///
///     T h'' - k h = -T max(0, p'' . n),    h = 0 at both ends
///
/// The border rises where it spans a hollow and stays where it curves round the jaw. At the distance y from the
/// border the height is h / cosh(y / w) with the width w, the shape of a stretched sheet with bending stiffness. The part of the
/// ridge that is finer than the mesh goes to the renderer as a wrinkle line of negative depth. At a = 0 nothing moves.
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

/// Returns the height h at each of `stations`, m: two or more points of the string, `spacing_m` apart. `outward` has the outward direction
/// (unit) of each. `bed_n_per_m2` is k.
std::vector<double> string_heights(const std::vector<Vec3>& stations,
                                   const std::vector<Vec3>& outward, double spacing_m,
                                   double tension_n, double bed_n_per_m2);

/// The cords of one head.
class PlatysmaCords {
  public:
    /// There are no cords on a rig without platysma, or when the mesh ends above the neck.
    PlatysmaCords(const rig::Head& head, const rig::RigDescription& rig);

    /// Adds a wrinkle line along each border, at vertices where the slot of the line is free. Without this call, raise() gives no depths.
    void mark(WrinkleLines& lines);

    /// Displaces `vertices` (V x 3, m) by the cords at this `activation` (per column of the rig, 0..1). Adds the part of the ridges that is
    /// finer than the mesh to `depth` (V x 3, m, one column per slot, or no rows).
    void raise(const Eigen::VectorXd& activation, Points& vertices, Points& depth) const;

    /// Returns the points of each border at rest, head frame, m. For tests and pictures.
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
        double across;    ///< distance from the border, m, > 0 to the left
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
