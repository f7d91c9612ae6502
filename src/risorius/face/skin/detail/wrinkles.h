// SPDX-License-Identifier: MIT
/// \file
/// Depth of the skin's folds along its wrinkle lines, from the skin's strain.
///
///   n   across the lines, in the rest surface        s = |F n|   stretch of the skin across them        c = 1 - s
///   l   distance of the lines at rest, (1 - c) l now               f   phase, see wrinkle_lines.h
///   A   depth          h = A d_k P(f),  P = sqrt(sin^2(pi f) + 0.2^2)   profile: narrow valleys, round ridges
///   d_k = 1 + 0.4 sin(2.4 k)   variation between lines; k = round(f), the valley, so that d_k changes on ridges
///
/// Skin hardly shortens. Beyond an onset, its compression goes into the length of the folded profile:
///   integral of sqrt(1 + h'^2) = 1 + e / (1 - c),    e = c - onset, from 0 on smoothly
/// c is averaged over about 3 mm (by a screened Poisson equation on the surface), so that it does not depend on the mesh. A crease folds
/// as a whole: its c is averaged over 9 mm along it and over the strip beside it, and its onset is lower, since the line exists at rest.
/// Where the mesh is fine enough, folds displace its vertices; the renderer shows the rest of their depth. Permanent lines of old skin are
/// as deep as under additional compression; they are shown only by the renderer and disappear when the skin is stretched.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::face {

double fold_profile(double phase);  ///< P
double fold_height(double phase);   ///< h / A over the skin without folds
double fold_excess(
    double depth_ratio);  ///< length of the profile / its span - 1, for a wave of this depth / span
double fold_depth_ratio(double excess);  ///< the inverse
/// Compression that thickens skin without a fold. Folds set in smoothly over as much to either side; at rest there is none.
struct FoldOnset {
    double at, softness;
};
inline constexpr FoldOnset kSmoothSkin{0.05, 0.04}, kCreasedSkin{0.025, 0.02};
/// e as a function of c: fraction of the rest length that folds take up
double folded_fraction(double compression, const FoldOnset& onset = kSmoothSkin);

struct WrinkleOptions {
    double strength = 1.0;      ///< fraction of what could fold that does fold; 0: none
    double mean_over_m = 3e-3;  ///< length over which the strain is averaged, m
    double mean_along_crease_m = 9e-3;
};

class Wrinkles {
  public:
    Wrinkles(const WrinkleLines& lines, const Triangles& skin, const Points& rest,
             const WrinkleOptions& options);

    /// Displaces `vertices` (V x 3, m) by the folds that the mesh resolves and adds the depth of the others to `depth` (V x 3, one column
    /// per slot, m). Not for several threads at once.
    void fold(Points& vertices, Points& depth) const;

    /// c per vertex and slot; rows in the order of vertex_indices(). For evaluation and tests.
    const Points& compression(const Points& vertices) const;
    const std::vector<int>& vertex_indices() const { return vertex_; }

  private:
    struct Gauge {  // of one triangle in one slot
        int corner[3];
        int slot;
        double weight[3];  // F n = sum weight x
        double area;
    };
    struct Strip {  // of a crease, cut into pieces along it
        int slot;
        std::vector<int> row;       // of vertex_
        std::vector<double> place;  // in pieces
        Eigen::MatrixXd mean;       // pieces x pieces
    };
    double depth_m(long row, int slot, double compression) const;
    void mean_along(const Crease& crease, const std::vector<int>& own);

    std::vector<int> vertex_;
    std::vector<Gauge> gauges_;
    std::vector<Strip> strips_;
    Points inverse_area_;  // per vertex and slot
    Eigen::VectorXd area_;
    Points phase_, window_, wavelength_, stays_, resolved_;
    Eigen::Matrix<char, Eigen::Dynamic, kWrinkleSlots> creased_;
    bool any_resolved_ = false;
    Triangles triangles_;  // over vertex_
    WrinkleOptions options_;
    std::optional<solve::SparseCholesky> mean_;
    mutable Points compression_, at_, normals_;
};

}  // namespace risorius::face
