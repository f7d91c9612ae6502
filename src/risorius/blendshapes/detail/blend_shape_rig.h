// SPDX-License-Identifier: MIT
/// \file
/// A blend shape rig: a weighted sum of shapes, and correctives for the errors of the sum.
///
///   x = rest + sum_s w_s d_s + sum_c k_c(w) d_c         w in [0, 1]
///   k_c = sum_t a_ct f_t(w), held in [0, 1]             drivers, shared by all correctives, each in [0, 1]
///   f_t = w_a w_b (1 - w_c) ...            driver of several shapes a, b: the product of their weights, which is 0 where one of them is
///                                          0; with a factor 1 - w_c for each shape c of `fades_with`
///   f_t = B_j(w_a) (1 - w_c) ...           driver of a part of the path of one shape a, for motion that is not straight, with
///                                          B_j(w) = w^j (1 - w)^(4 - j) over its maximum, j = 1, 2, 3, which is 0 at the weights 0 and 1
///
/// Here w_s is the weight of shape s, d_s its displacements, d_c those of corrective c, and a_ct a constant
/// (Corrective::of_drivers). The driver of a path fades as other shapes of the same skin are added, because the skin then takes
/// another path. For example, two shapes that both part the lips part them only once.
///
/// Source of combination correctives: Lewis et al. 2014, Practice and Theory of Blendshape Facial Models, Eurographics STAR, 4.2.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/sparse_shape.h"

namespace risorius::blendshapes {

/// A driver: a function f_t of the weights of the shapes, on which the weights of the correctives depend.
struct Driver {
    std::string name;                  ///< "jawOpen*mouthSmileLeft", "eyeBlinkLeft~1"
    std::vector<int> shapes;           ///< indices of the shapes in the product
    int part = 0;                      ///< the index j of B_j, for a single shape; else 0
    std::vector<int> fades_with = {};  ///< shapes c, each with a factor (1 - w_c)

    double value(const Eigen::VectorXd& shape_weights) const;
    /// The name of a corrective that follows this driver alone: "jawOpen_mouthSmileLeft", "eyeBlinkLeft_25"
    std::string target_name() const;
};

/// A sparse field of displacements d_c with the weight k_c, a weighted sum of drivers that is held in [0, 1], because many
/// programs do so with the weights of shapes.
struct Corrective {
    std::string name;
    SparseShape shape;
    Eigen::VectorXd of_drivers;  ///< a_ct, one factor per driver t

    /// The driver that it follows alone with the factor 1, if there is one
    std::optional<long> follows() const;
};

/// Shapes and correctives of one mesh.
struct BlendShapeRig {
    std::vector<SparseShape> shapes;
    std::vector<Driver> drivers = {};
    std::vector<Corrective> correctives = {};

    /// Returns f_t(w), one value per driver. `weights`: w, one per shape.
    Eigen::VectorXd driver_values(const Eigen::VectorXd& weights) const;
    /// Adds the displacement for the weights to `vertices`, m; one weight per shape.
    void add_to(Points& vertices, const Eigen::VectorXd& weights) const;
    /// The given weights of the shapes, followed by the weights of the correctives.
    Eigen::VectorXd all_weights(const Eigen::VectorXd& weights) const;
};

/// Distances between two lists of vertices: the RMS weighted by area, and the maximum over the vertices with area.
struct FieldError {
    double rms_m = 0, max_m = 0;
    long where = 0;  ///< vertex of the maximum
};
FieldError error_between(const Points& one, const Points& other, const Eigen::VectorXd& area);

/// Splits a field of displacements smoothly into a left and a right part whose sum is the field. `half_width_m`: see
/// left_fraction().
std::pair<Points, Points> left_and_right(const Points& rest, const Points& field,
                                         double half_width_m);

}  // namespace risorius::blendshapes
