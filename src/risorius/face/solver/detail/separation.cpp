// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/separation.h"

#include <algorithm>

namespace risorius::face {

namespace {

using Pair = tissue::Contacts::Contact;

constexpr int kSweeps = 200;  // maximum; about five are usual
// Penetration that is left, about that of equilibria; and the excess at which the sweeps end
constexpr double kLipSlack_m = 0.19e-3, kOtherSlack_m = 0.11e-3, kEnough_m = 0.05e-3;
constexpr double kOverRelaxation = 1.5;
constexpr double kNear_m =
    1e-3;  // pairs farther apart are searched again only after they have moved

double beyond_slack_m(const Pair& pair, const Points& x) {
    return tissue::Contacts::depth(pair, x) - (pair.body == kLipBody ? kLipSlack_m : kOtherSlack_m);
}

/// The moves of one sweep. A node that several pairs move gets the mean of their moves.
class Moves {
  public:
    explicit Moves(long nodes)
        : sum_(Points::Zero(nodes, 3)), times_(static_cast<std::size_t>(nodes)) {}
    void add(int node, const Vec3& by) {
        sum_.row(node) += by.transpose();
        ++times_[static_cast<std::size_t>(node)];
    }
    /// Skin of a lip takes the column below it along. The planes of the lips turn with their columns, so that a lip which turned while
    /// it moves would meet other planes.
    void add_column(int skin, const Vec3& by) {
        for (int layer = kDeep; layer <= kSkin; ++layer) add(skin - kSkin + layer, by);
    }
    void apply(const std::vector<char>& fixed, Points& x, std::vector<char>& moved) {
        for (long i = 0; i < x.rows(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (times_[at] == 0) continue;
            if (!fixed[at]) {
                x.row(i) += sum_.row(i) / times_[at];
                moved[at] = 1;
            }
            sum_.row(i).setZero();
            times_[at] = 0;
        }
    }
    void forget() {
        sum_.setZero();
        std::fill(times_.begin(), times_.end(), 0);
    }

  private:
    Points sum_;
    std::vector<int> times_;
};

// Each lip moves by half of the penetration.
void push_lips(const Pair& pair, double by_m, Moves& moves) {
    moves.add_column(pair.node, 0.5 * by_m * pair.normal);
    double squares = 0;
    for (int i = 0; i < pair.count; ++i) squares += pair.weights[i] * pair.weights[i];
    for (int i = 0; i < pair.count; ++i)
        moves.add_column(pair.others[i], -0.5 * by_m * pair.weights[i] / squares * pair.normal);
}

}  // namespace

Points resolve_penetration(const Points& x, const ContactSearch& search, const Rigid& mandible,
                           const std::array<Mat3, 2>& gaze, const std::vector<char>& fixed) {
    Points out = x;
    Moves moves(x.rows());
    std::vector<char> near;  // empty: all rows are searched
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        // Moving nodes turn planes and meet other nodes
        const std::vector<Pair> pairs = search.find(out, mandible, gaze, near);
        const bool all = near.empty();
        if (all) near.assign(static_cast<std::size_t>(x.rows()), 0);
        double max_m = 0;
        for (const Pair& pair : pairs) {
            if (tissue::Contacts::depth(pair, out) > -kNear_m)
                near[static_cast<std::size_t>(pair.node)] = 1;
            const double beyond_m = beyond_slack_m(pair, out);
            if (beyond_m <= 0) continue;
            max_m = std::max(max_m, beyond_m);
            if (pair.body == kLipBody)
                push_lips(pair, kOverRelaxation * beyond_m, moves);
            else
                moves.add(pair.node, kOverRelaxation * beyond_m * pair.normal);
        }
        // The first sweep is always made, so that the result is continuous in x
        if (max_m > kEnough_m || (sweep == 0 && max_m > 0))
            moves.apply(fixed, out, near);
        else if (all)
            break;
        else {
            moves.forget();
            near.clear();
        }
    }
    return out;
}

}  // namespace risorius::face
