// A linear rig: blend shapes added up by weight, and correctives for what the sum gets wrong.
//
//   x = rest + sum_s w_s d_s + sum_c k_c(w) d_c         w in [0, 1]
//   k_c = sum_t a_ct f_t(w)                             terms, shared by all correctives
//   f_t = w_a w_b (1 - w_a) ...            several drivers: a product of their weights, 0 where any is not there, and where one that
//                                it goes with (`fades_with`) is whole
//   f_t = B_k(w) (1 - w_a) (1 - w_b) ...   one driver: a part of its way, for what goes round a corner; B_k = binomial(4, k)
//                                w^k (1 - w)^(4 - k), k = 1, 2, 3, which are 0 at rest and where the shape is whole. It goes as
//                                others come that move the same skin, which then takes another way: two shapes that both part
//                                the lips part them but once
//
// Source of combination correctives: Lewis et al. 2014, Practice and Theory of Blendshape Facial Models, Eurographics STAR, 4.2.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/sparse_shape.h"

namespace risorius::blendshapes {

/// What correctives hang on.
struct Term {
    std::string name;                  ///< "jawOpen*mouthSmileLeft", "eyeBlinkLeft~1"
    std::vector<int> drivers;          ///< shapes
    int part = 0;                      ///< k, of a single driver
    std::vector<int> fades_with = {};  ///< shapes that it goes with

    double value(const Eigen::VectorXd& shape_weights) const;
};

struct Corrective {
    std::string name;
    SparseShape shape;
    Eigen::VectorXd of_terms;  ///< a, one number per term
};

struct BlendShapeRig {
    std::vector<SparseShape> shapes;
    std::vector<Term> terms = {};
    std::vector<Corrective> correctives = {};

    Eigen::VectorXd term_values(const Eigen::VectorXd& weights) const;
    /// Adds what the weights, one per shape, do to `vertices`.
    void add_to(Points& vertices, const Eigen::VectorXd& weights) const;
    /// Those of the shapes, then those of the correctives that follow from them.
    Eigen::VectorXd all_weights(const Eigen::VectorXd& weights) const;
};

/// Distances between two lists of vertices, m: RMS weighted by `area`, and the largest where it is positive.
struct FieldError {
    double rms_m = 0, greatest_m = 0;
    long where = 0;  ///< vertex of the largest
};
FieldError error_between(const Points& one, const Points& other, const Eigen::VectorXd& area);

/// Splits a field into what lies left and what lies right, smoothly; they add up to it.
std::pair<Points, Points> left_and_right(const Points& rest, const Points& field,
                                         double half_width_m);

}  // namespace risorius::blendshapes
