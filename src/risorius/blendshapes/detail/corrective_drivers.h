// SPDX-License-Identifier: MIT
/// \file
/// Makes the drivers of correctives (blend_shape_rig.h) from three kinds of simulated poses: single shapes at intermediate
/// weights, pairs of shapes, and pairs in which one shape is on one side of the face only.
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

/// Assumed statistics of the weights a and b of a pair of shapes in use. kPairIsMet: of the frames in which a or b is above 0,
/// the fraction in which both are. The real fraction is lower for random weights of four of 52 shapes, and for most pairs in
/// speech and emotion. kSquareOfProduct: the mean of (a b)^2 over the frames in which both are above 0.
constexpr double kPairIsMet = 0.2, kSquareOfProduct = 1.0 / 9.0;

/// A shape, or both halves of a shape, treated as one.
struct Unit {
    std::string name;
    std::vector<int> parts;  ///< indices of the shapes; left and right if there are two
    track::Drive drive;
    Points field;  ///< V x 3, m

    /// Returns the index of the shape of a side, 0 left or 1 right. For a shape without sides, it is that of the shape itself.
    int of_side(std::size_t side) const { return parts[parts.size() == 1 ? 0 : side]; }
};

/// Returns the units of all shapes but two kinds: shapes on top of others (ShapeGoal::on_top_of), which are solved together with
/// them, and shapes that do not move the mesh. `vertices`: number of vertices of the mesh.
std::vector<Unit> units_of(const MadeShapes& shapes, const track::ChannelTable& channels,
                           long vertices);

/// Returns a drive whose values are all 0.
track::Drive no_drive(const track::ChannelTable& channels);
/// Returns one + weight * other, with every value clamped to the limits of its channel.
track::Drive sum_of(const track::Drive& one, const track::Drive& other, double weight,
                    const track::ChannelTable& channels);

/// Weights a and b at which pairs are simulated besides (1, 1), and which of the factors (1 - a) and (1 - b) the driver for them
/// has.
struct PairOnItsWay {
    double a, b;
    bool fades_with_a, fades_with_b;
};
constexpr std::array<PairOnItsWay, 3> kPairsOnTheirWay{
    {{0.5, 1.0, true, false}, {1.0, 0.5, false, true}, {0.5, 0.5, true, true}}};

/// A one-sided version of a pair: the side, 0 left or 1 right, and for each shape whether it is on that side only.
struct OneSidedPair {
    std::size_t side;
    bool a_alone, b_alone;
};
/// Returns the one-sided versions of a pair in which at least one shape has sides. Versions with both shapes on one side come
/// last.
std::vector<OneSidedPair> one_sided_pairs(const Unit& a, const Unit& b);

/// Further simulated poses of a pair. A null pointer means that they were not simulated.
struct PairPoses {
    const SolvedPose* on_its_way = nullptr;  ///< one pose for each entry of kPairsOnTheirWay
    const SolvedPose* one_sided = nullptr;   ///< one pose for each entry of one_sided_pairs()
};

/// Makes drivers, and the field of each, from the errors of shapes and pairs; where these have sides, one driver for each side.
/// The constructor keeps references to its arguments.
class DriverMaker {
  public:
    DriverMaker(const rig::Head& head, const MadeShapes& shapes, const std::vector<Unit>& units,
                const Eigen::VectorXd& area);

    /// Adds the drivers of a shape's path. `lacks`: what the shape at weight 0.5 lacks to the simulated pose, V x 3, m. `quarter`
    /// and `three_quarters`: the simulated poses at the weights 0.25 and 0.75.
    void add_way(const Unit& unit, const Points& lacks, const SolvedPose& quarter,
                 const SolvedPose& three_quarters);

    /// Call this after all shapes and before the pairs, because pairs correct the errors that the drivers of the shapes leave.
    void shapes_are_done() { of_shapes_ = terms_.size(); }

    /// Adds the drivers of a pair. `lacks`: what the sum of both shapes at weight 1 lacks to the simulated pose, V x 3, m.
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

/// Returns the formula of a driver as text, as it is written to files.
std::string weight_rule(const blendshapes::Driver& driver);

}  // namespace risorius::blendshapes
