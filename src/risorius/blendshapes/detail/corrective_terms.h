// What correctives hang on (blendshapes/detail/blend_shape_rig.h), made of poses in which shapes were simulated on their way, in pairs, and in pairs on
// one side of the face.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/low_rank.h"
#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

constexpr double kSharedStrip_mm = 15;  ///< of the middle of the face, as of halves

/// How often two given shapes are there at once: in a fifth of the frames that have one of them (random weights, four of 52 at a
/// time: less; faces that speak and feel: less for most pairs); and the mean square of their product then, at weights from 0 to 1.
constexpr double kPairIsMet = 0.2, kSquareOfProduct = 1.0 / 9.0;

/// What is tried together: a shape, or both its halves.
struct Unit {
    std::string name;
    std::vector<int> parts;  ///< shapes; left and right when there are two
    track::Drive drive;
    Points field;  ///< V x 3, m

    /// The shape of a side, 0 left and 1 right: itself if it has none.
    int of_side(std::size_t side) const { return parts[parts.size() == 1 ? 0 : side]; }
};

/// Without what lies on other shapes, which is solved with them, and without what does not move the mesh.
std::vector<Unit> units_of(const MadeShapes& shapes, const track::ChannelTable& channels,
                           long vertices);

track::Drive no_drive(const track::ChannelTable& channels);
/// one + weight other, held inside the channels' limits.
track::Drive sum_of(const track::Drive& one, const track::Drive& other, double weight,
                    const track::ChannelTable& channels);

/// Of pairs that are looked at on their way: the weights of both, and of which of the factors (1 - a), (1 - b) each puts a term right.
struct PairOnItsWay {
    double a, b;
    bool fades_with_a, fades_with_b;
};
constexpr std::array<PairOnItsWay, 3> kPairsOnTheirWay{
    {{0.5, 1.0, true, false}, {1.0, 0.5, false, true}, {0.5, 0.5, true, true}}};

/// Of pairs that are looked at on one side: 0 left or 1 right, and which of the two is there on that side alone.
struct OneSidedPair {
    std::size_t side;
    bool a_alone, b_alone;
};
/// Those of a pair, of which at least one shape has sides; both alone come after each alone.
std::vector<OneSidedPair> one_sided_pairs(const Unit& a, const Unit& b);

/// Poses of a pair that is looked at closely: null what was not.
struct PairPoses {
    const SolvedPose* on_its_way = nullptr;  ///< as many as kPairsOnTheirWay
    const SolvedPose* one_sided = nullptr;   ///< as many as one_sided_pairs
};

/// Makes terms of what shapes and pairs lack, a left and a right one where they have sides. References live as long as it does.
class TermMaker {
  public:
    TermMaker(const rig::Head& head, const MadeShapes& shapes, const std::vector<Unit>& units,
              const Eigen::VectorXd& area);

    /// What a shape lacks half way, and its poses a quarter and three quarters of the way.
    void add_way(const Unit& unit, const Points& lacks, const SolvedPose& quarter,
                 const SolvedPose& three_quarters);

    /// From here on pairs, which lack what is left by the shapes' own ways.
    void shapes_are_done() { of_shapes_ = terms_.size(); }

    /// What a pair lacks where both are whole.
    void add_pair(const Unit& a, const Unit& b, const Points& lacks, const PairPoses& poses);

    std::vector<blendshapes::TermField> take() { return std::move(terms_); }

  private:
    void add_one_sided(const Unit& a, const Unit& b, const Points& lacks, const SolvedPose* poses);
    std::vector<std::size_t> sharing(const Unit& unit) const;
    template <class TermOfSide>
    void add(const Points& field, bool sided, const TermOfSide& term,
             const std::array<std::string, 2>& endings);
    void add(const Points& field, blendshapes::Term term, const std::string& ending);

    const rig::Head& head_;
    const MadeShapes& shapes_;
    const std::vector<Unit>& units_;
    const Eigen::VectorXd& area_;
    std::vector<Eigen::VectorXd> moved_;  // of each unit, by each vertex
    std::vector<blendshapes::TermField> terms_;
    std::size_t of_shapes_ = 0;
};

/// The rule a term follows, as files state it.
std::string weight_rule(const blendshapes::Term& term);

}  // namespace risorius::blendshapes
