// SPDX-License-Identifier: MIT
/// \file
/// Drivers of correctives (blend_shape_rig.h), made from simulated poses: shapes at intermediate weights, pairs of shapes, and
/// pairs with one shape on one side only.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/low_rank.h"
#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

/// Width of the strip in the middle of the face where the sides merge
constexpr double kSharedStrip_mm = 15;

/// kPairIsMet: of the frames in which one of two shapes has a weight above 0, the fraction in which both do. It is lower for random
/// weights of four of 52 shapes, and for most pairs in speech and emotion. kSquareOfProduct: mean square of the product of the two
/// weights in those frames.
constexpr double kPairIsMet = 0.2, kSquareOfProduct = 1.0 / 9.0;

/// A shape, or both halves of a shape, treated as one.
struct Unit {
    std::string name;
    std::vector<int> parts;  ///< indices of the shapes; left and right if there are two
    track::Drive drive;
    Points field;  ///< V x 3, m

    /// The shape of a side, 0 left and 1 right; a shape without sides itself.
    int of_side(std::size_t side) const { return parts[parts.size() == 1 ? 0 : side]; }
};

/// Units of all shapes, except those on top of others, which are solved together with them, and those that do not move the mesh.
std::vector<Unit> units_of(const MadeShapes& shapes, const track::ChannelTable& channels,
                           long vertices);

/// A drive of zeros.
track::Drive no_drive(const track::ChannelTable& channels);
/// one + weight * other, clamped to the limits of the channels.
track::Drive sum_of(const track::Drive& one, const track::Drive& other, double weight,
                    const track::ChannelTable& channels);

/// Weights at which pairs are simulated at intermediate weights, and which of the factors (1 - a), (1 - b) the driver has.
struct PairOnItsWay {
    double a, b;
    bool fades_with_a, fades_with_b;
};
constexpr std::array<PairOnItsWay, 3> kPairsOnTheirWay{
    {{0.5, 1.0, true, false}, {1.0, 0.5, false, true}, {0.5, 0.5, true, true}}};

/// A pair that is simulated on one side: 0 left or 1 right, and which of the two shapes is on that side only.
struct OneSidedPair {
    std::size_t side;
    bool a_alone, b_alone;
};
/// The one-sided versions of a pair in which at least one shape has sides. Versions with both shapes on one side come last.
std::vector<OneSidedPair> one_sided_pairs(const Unit& a, const Unit& b);

/// Further poses of a pair; null: not simulated.
struct PairPoses {
    const SolvedPose* on_its_way = nullptr;  ///< array of the size of kPairsOnTheirWay
    const SolvedPose* one_sided = nullptr;   ///< array of the size of one_sided_pairs()
};

/// Makes drivers from the errors of shapes and pairs, one for each side where they have sides. Keeps references to its arguments.
class DriverMaker {
  public:
    DriverMaker(const rig::Head& head, const MadeShapes& shapes, const std::vector<Unit>& units,
                const Eigen::VectorXd& area);

    /// Adds the drivers of a shape's path: `lacks` is the error at weight 0.5, V x 3, m; the poses are those at 0.25 and 0.75.
    void add_way(const Unit& unit, const Points& lacks, const SolvedPose& quarter,
                 const SolvedPose& three_quarters);

    /// Call this after all shapes and before the pairs, because pairs correct the errors that the drivers of the shapes leave.
    void shapes_are_done() { of_shapes_ = terms_.size(); }

    /// Adds the driver of a pair: `lacks` is the error at weight 1 of both, V x 3, m.
    void add_pair(const Unit& a, const Unit& b, const Points& lacks, const PairPoses& poses);

    std::vector<blendshapes::DriverField> take() { return std::move(terms_); }

  private:
    void add_one_sided(const Unit& a, const Unit& b, const Points& lacks, const SolvedPose* poses);
    std::vector<std::size_t> sharing(const Unit& unit) const;
    template <class DriverOfSide>
    void add(const Points& field, bool sided, const DriverOfSide& driver,
             const std::array<std::string, 2>& endings);
    void add(const Points& field, blendshapes::Driver driver, const std::string& ending);

    const rig::Head& head_;
    const MadeShapes& shapes_;
    const std::vector<Unit>& units_;
    const Eigen::VectorXd& area_;
    std::vector<Eigen::VectorXd> moved_;  // displacement of each vertex for each unit
    std::vector<blendshapes::DriverField> terms_;
    std::size_t of_shapes_ = 0;
};

/// The formula of a driver as text, as it is written to files.
std::string weight_rule(const blendshapes::Driver& driver);

}  // namespace risorius::blendshapes
