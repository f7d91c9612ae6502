// Few correctives that do the work of many: what terms stand for is fitted to frames that were simulated, then compressed to low rank,
// each corrective sparse and of one side of the face.
//
//   fit       D = D0 + R (K K' + p I)^-1 K      D, D0  3V x T   what terms stand for, as fitted and as found one by one
//                                               K      F x T    terms in the frames     R  3V x F  what D0 leaves of them
//             least squares over the frames, with the price p on every change (ridge regression; p in squares of a term)
//   compress  D ~ B A by the singular values of  root(area) D root(use): B the correctives, A their shares of the terms
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"

namespace risorius::blendshapes {

/// What a term stands for: what is lacking where it is 1 and no other is there.
struct TermField {
    Term term;
    Points field;    ///< V x 3, m
    double use = 0;  ///< its mean square in frames of any kind
};

/// A frame that the rig will be played with.
struct PlayedFrame {
    Eigen::VectorXd weights;  ///< of the shapes
    Points left;              ///< V x 3, m: what the plain sum of shapes leaves of the true frame
};

struct Compression {
    double price = 0.5;  ///< p above
    Fade fade = {};      ///< of correctives, each at the greatest weight that it has in use
    double half_width_m = 0.015;  ///< of the strip in which the sides of the face merge
    int most_of_a_side = 32;      ///< correctives
    long bytes_of_a_vertex = 15;  ///< in a file
    long budget_bytes = 800'000;  ///< of all correctives
};

struct LowRank {
    std::vector<Term> terms;
    std::vector<Corrective> correctives;  ///< of_terms as many as terms
    long bytes = 0;
};

/// `rest` V x 3, m; `area` of the vertices, m^2: those without any are compressed like others but count for nothing.
LowRank low_rank(std::vector<TermField> fields, const std::vector<PlayedFrame>& frames,
                 const Points& rest, const Eigen::VectorXd& area, const Compression& how = {});

}  // namespace risorius::blendshapes
