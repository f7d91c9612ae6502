// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_weights.h"

#include <algorithm>
#include <numeric>

#include "risorius/face/statics.h"
#include "risorius/scene/expression_score.h"

namespace risorius::blendshapes {

namespace {

constexpr double kL1Weight = 1e-3;  // relative to the squared norm of the largest shape
constexpr double kWeightRidge = 1e-6;
constexpr int kHoldingTurns = 5;

}  // namespace

ShapeWeights::ShapeWeights(face::Face& face, const track::ChannelTable& channels,
                           const std::vector<ShapeGoal>& goals, std::vector<Points>* linear) {
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(channels.column_count());
    face.start([&](double) { return rest; });
    face.solve_equilibrium(rest.excitation, rest);
    std::vector<int> columns(static_cast<std::size_t>(channels.column_count()));
    std::iota(columns.begin(), columns.end(), 0);
    std::vector<track::Kinematic> moving;
    for (int k = 0; k < track::kKinematicCount; ++k) {
        const auto channel = static_cast<track::Kinematic>(k);
        if (channel >= track::Kinematic::kHeadYaw && channel <= track::Kinematic::kHeadSide)
            continue;
        kinematic_.push_back(static_cast<std::size_t>(k));
        moving.push_back(channel);
    }
    const std::vector<Points> ways = face.statics().sensitivities(columns, moving);
    const Eigen::VectorXd weight = scene::seen_areas(face);
    const long count = static_cast<long>(ways.size());
    Eigen::MatrixXd G(count, count);
    const Eigen::VectorXd root = weight.cwiseSqrt();
    Eigen::MatrixXd E(3 * weight.size(), count);
    for (long c = 0; c < count; ++c) {
        const Points weighted = root.asDiagonal() * ways[static_cast<std::size_t>(c)];
        E.col(c) = Eigen::Map<const Eigen::VectorXd>(weighted.data(), weighted.size());
    }
    G.noalias() = E.transpose() * E;
    Eigen::MatrixXd S(count, static_cast<long>(goals.size()));
    for (std::size_t s = 0; s < goals.size(); ++s) {
        S.col(static_cast<long>(s)) = vector_of(goals[s].drive);
        on_top_of_.push_back(goals[s].on_top_of);
        // It was solved with the jaw of the shape below it, but without that shape's muscles.
        if (on_top_of_[s] >= 0)
            S.col(static_cast<long>(s)).head(channels.column_count()) -=
                goals[static_cast<std::size_t>(on_top_of_[s])].drive.excitation;
    }
    for (long s = 0; linear && s < S.cols(); ++s) {
        Points& field = linear->emplace_back(Points::Zero(weight.size(), 3));
        for (long c = 0; c < count; ++c)
            if (S(c, s) != 0) field += S(c, s) * ways[static_cast<std::size_t>(c)];
    }
    by_drive_ = S.transpose() * G;
    problem_.A = by_drive_ * S;
    const double scale = problem_.A.diagonal().maxCoeff();
    problem_.A.diagonal().array() += kWeightRidge * scale;
    problem_.l1_weight = kL1Weight * problem_.A.diagonal();
    problem_.min = Eigen::VectorXd::Zero(S.cols());
    problem_.max = Eigen::VectorXd::Ones(S.cols());
}

Eigen::VectorXd ShapeWeights::vector_of(const track::Drive& drive) const {
    Eigen::VectorXd out(drive.excitation.size() + static_cast<long>(kinematic_.size()));
    out.head(drive.excitation.size()) = drive.excitation;
    for (std::size_t k = 0; k < kinematic_.size(); ++k)
        out[drive.excitation.size() + static_cast<long>(k)] = drive.kinematic[kinematic_[k]];
    return out;
}

Eigen::VectorXd ShapeWeights::of(const track::Drive& drive) const {
    solve::BoxQuadratic problem = problem_;
    problem.b = -by_drive_ * vector_of(drive);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(problem_.min.size());
    // A shape on top of another may not have a larger weight. Holding it at that weight may reduce the other, so the problem is
    // solved in turns.
    for (int turn = 0; turn < kHoldingTurns; ++turn) {
        solve::minimise(problem, out, 1e-5);
        bool held = true;
        for (std::size_t s = 0; s < on_top_of_.size(); ++s) {
            if (on_top_of_[s] < 0) continue;
            const auto at = static_cast<long>(s);
            held = held && out[at] <= out[on_top_of_[s]];
            problem.max[at] = std::min(problem.max[at], out[on_top_of_[s]]);
        }
        if (held) break;
    }
    for (std::size_t s = 0; s < on_top_of_.size(); ++s)
        if (on_top_of_[s] >= 0)
            out[static_cast<long>(s)] = std::min(out[static_cast<long>(s)], out[on_top_of_[s]]);
    return out;
}

}  // namespace risorius::blendshapes
