// SPDX-License-Identifier: MIT
/// \file
/// Computes the depth of folds along the wrinkle lines of the skin from the strain of the skin.
///
///   n   direction across the lines, in the rest surface       F   deformation gradient of the skin
///   s = |F n|   stretch across the lines                      c = 1 - s   compression
///   l   distance between lines at rest, m; now it is (1 - c) l                 f   phase, see wrinkle_lines.h
///   A   depth, m       h = A d_k P(f)   height of the fold, m
///   P = sqrt(sin^2(pi f) + 0.2^2)   profile: narrow valleys, round ridges
///   d_k = 1 + 0.4 sin(2.4 k)   variation between lines; k = round(f) is the number of the valley, so d_k changes on the ridges
///
/// Skin hardly shortens. Beyond an onset, compression makes it fold, and the length along the folded profile is preserved:
///   integral of sqrt(1 + h'^2) = 1 + e / (1 - c),    e = c - onset, with a smooth start at 0; each pattern has its onset
///
/// c is averaged over about 3 mm (by a screened Poisson equation on the surface), so that it does not depend on the mesh. A crease folds
/// as a whole: its c is averaged over 9 mm along it and across the strip beside it. Its onset is lower, since the line exists at rest.
/// Where the mesh is fine enough, folds displace its vertices; the renderer shows the rest of their depth. Permanent lines of old skin are
/// as deep as an additional compression would make them. Only the renderer shows them. They disappear when the skin is stretched.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/fold_profile.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/solve/sparse_cholesky.h"

namespace risorius::face {

/// Returns length of the profile / wavelength - 1, for a wave with this depth / wavelength.
double fold_excess(double depth_ratio);
double fold_depth_ratio(double excess);  ///< inverse of fold_excess()
/// Compression c at which folds begin; below it, the skin only becomes thicker. They begin smoothly between `at` - `softness` and `at` +
/// `softness`. At rest there are no folds.
struct FoldOnset {
    double at, softness;
};
inline constexpr FoldOnset kSmoothSkin{0.05, 0.04}, kCreasedSkin{0.025, 0.02};
/// Returns e as a function of c: the fraction of the rest length that the folds take up.
double folded_fraction(double compression, const FoldOnset& onset = kSmoothSkin);

/// Options of the folds of one head.
struct WrinkleOptions {
    double strength = 1.0;              ///< factor on e, 0..1; 0: no folds
    double mean_over_m = 3e-3;          ///< length over which c is averaged
    double mean_along_crease_m = 9e-3;  ///< the same along a crease
};

/// The folds of one head.
class Wrinkles {
  public:
    Wrinkles(const WrinkleLines& lines, const Triangles& skin, const Points& rest,
             const WrinkleOptions& options);

    /// Displaces `vertices` (V x 3, m) by the folds that the mesh resolves and adds the depth of the others to `depth` (V x 3, m, one
    /// column per slot). Do not call it from several threads at once.
    void fold(Points& vertices, Points& depth) const;

    /// Returns c per vertex and slot, with rows in the order of vertex_indices(). For evaluation and tests.
    const Points& compression(const Points& vertices) const;
    const std::vector<int>& vertex_indices() const { return vertex_; }

  private:
    /// Measures F n on one triangle for one slot.
    struct Gauge {
        int corner[3];
        int slot;
        double weight[3];  // F n = sum weight x
        double area;
    };
    /// The skin beside a crease, cut into pieces along it.
    struct Strip {
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
    Points phase_, window_, wavelength_, stays_, later_, resolved_;
    Eigen::Matrix<char, Eigen::Dynamic, kWrinkleSlots> creased_;
    bool any_resolved_ = false;
    Triangles triangles_;  // over vertex_
    WrinkleOptions options_;
    std::optional<solve::SparseCholesky> mean_;
    mutable Points compression_, at_, normals_;
};

}  // namespace risorius::face
