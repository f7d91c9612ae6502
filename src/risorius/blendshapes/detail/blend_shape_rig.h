// SPDX-License-Identifier: MIT
/// \file
/// A blend shape rig: a weighted sum of shapes, and correctives for the errors of the sum.
///
///   x = rest + sum_s w_s d_s + sum_c k_c(w) d_c         w in [0, 1]
///   k_c = sum_t a_ct f_t(w)                             drivers, shared by all correctives
///   f_t = w_a w_b (1 - w_a) ...            several shapes: a product of their weights, which is 0 where one of them is 0, and where a
///                                          shape of `fades_with` has weight 1
///   f_t = B_k(w) (1 - w_a) (1 - w_b) ...   one shape: a part of its path, for motion that is not straight; B_k = binomial(4, k)
///                                          w^k (1 - w)^(4 - k), k = 1, 2, 3, which is 0 at weights 0 and 1
///
/// The driver of a path fades as other shapes of the same skin are added, because the skin then takes another path: two shapes
/// that both part the lips part them only once.
///
/// Source of combination correctives: Lewis et al. 2014, Practice and Theory of Blendshape Facial Models, Eurographics STAR, 4.2.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/sparse_shape.h"

namespace risorius::blendshapes {

/// A function of the weights that correctives depend on.
struct Driver {
    std::string name;                  ///< "jawOpen*mouthSmileLeft", "eyeBlinkLeft~1"
    std::vector<int> shapes;           ///< indices of the shapes in the product
    int part = 0;                      ///< k, for a single shape; else 0
    std::vector<int> fades_with = {};  ///< shapes w_a with a factor (1 - w_a)

    double value(const Eigen::VectorXd& shape_weights) const;
};

/// A sparse field of displacements, scaled by a weighted sum of drivers.
struct Corrective {
    std::string name;
    SparseShape shape;
    Eigen::VectorXd of_drivers;  ///< a, one factor per driver
};

/// Shapes and correctives of one mesh.
struct BlendShapeRig {
    std::vector<SparseShape> shapes;
    std::vector<Driver> drivers = {};
    std::vector<Corrective> correctives = {};

    /// f_t(w), one value per driver.
    Eigen::VectorXd driver_values(const Eigen::VectorXd& weights) const;
    /// Adds the displacement for the weights to `vertices`, m; one weight per shape.
    void add_to(Points& vertices, const Eigen::VectorXd& weights) const;
    /// The given weights of the shapes, followed by the weights of the correctives.
    Eigen::VectorXd all_weights(const Eigen::VectorXd& weights) const;
};

/// Distances between two lists of vertices, m: RMS weighted by `area`, and the maximum over vertices with area.
struct FieldError {
    double rms_m = 0, max_m = 0;
    long where = 0;  ///< vertex of the maximum
};
FieldError error_between(const Points& one, const Points& other, const Eigen::VectorXd& area);

/// Splits a field smoothly into a left and a right part whose sum is the field.
std::pair<Points, Points> left_and_right(const Points& rest, const Points& field,
                                         double half_width_m);

}  // namespace risorius::blendshapes
