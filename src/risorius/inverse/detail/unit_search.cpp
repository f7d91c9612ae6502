// SPDX-License-Identifier: MIT
// The equilibria of a search for units, each sought from the nearest one that is known.
#include <array>
#include <iterator>
#include <limits>
#include <utility>

#include "risorius/inverse/detail/unit_bench.h"

namespace risorius::inverse {

namespace {

constexpr int kWalks = 2;

}  // namespace

UnitBench::Search::Search(const UnitBench& bench, const std::vector<KnownUnits>& known)
    : bench_(bench), size_(known.at(0).state.way.colwise().norm().transpose().array()) {
    for (const KnownUnits& one : known) {
        const track::Drive drive = bench.sources().drive_of(one.state.weight);
        found_.push_back({one.state.weight, {one.nodes, drive.excitation, drive}});
    }
}

double UnitBench::Search::apart(const Found& found, const Eigen::VectorXd& weight) const {
    return (size_ * (found.weight - weight).array()).square().sum();
}

std::size_t UnitBench::Search::nearest(const std::vector<Found>& found,
                                       const Eigen::VectorXd& weight) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < found.size(); ++k)
        if (apart(found[k], weight) <= apart(found[best], weight)) best = k;  // the last of equals
    return best;
}

Eigen::VectorXd UnitBench::Search::moved(const Eigen::VectorXd& weight,
                                         const ProgressMonitor& monitor) {
    face::Face& face = bench_.team_.first();
    const std::size_t from = nearest(found_, weight);
    if (!first_is_there_ || from + 1 != found_.size()) face.statics().go_back_to(found_[from].at);
    bench_.go_on_to(face, weight, monitor);
    found_.push_back({weight, face.statics().keep()});
    first_is_there_ = true;
    return bench_.displacement(face.pose().vertices);
}

std::vector<Eigen::VectorXd> UnitBench::Search::moved(const std::vector<Eigen::VectorXd>& weights,
                                                      const ProgressMonitor& monitor) {
    std::vector<Eigen::VectorXd> out(weights.size());
    std::array<std::vector<Found>, kWalks> walks;
    bench_.team_.each(kWalks, [&](int piece, face::Face& face) {
        std::vector<Found>& own = walks[static_cast<std::size_t>(piece)];
        const auto end_of = [&](int p) {
            return weights.size() * static_cast<std::size_t>(p) / kWalks;
        };
        std::vector<std::size_t> left;
        for (std::size_t i = end_of(piece); i < end_of(piece + 1); ++i) left.push_back(i);
        while (!left.empty()) {
            // The weights that are nearest to anything that is known
            const std::vector<Found>* from = &found_;
            std::size_t next = 0, start = 0;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < left.size(); ++i)
                for (const std::vector<Found>* list :
                     {&std::as_const(found_), &std::as_const(own)}) {
                    if (list->empty()) continue;
                    const std::size_t k = nearest(*list, weights[left[i]]);
                    const double far = apart((*list)[k], weights[left[i]]);
                    if (far < least) {
                        least = far;
                        from = list;
                        next = i;
                        start = k;
                    }
                }
            if (from != &own || start + 1 != own.size())
                face.statics().go_back_to((*from)[start].at);
            const std::size_t i = left[next];
            bench_.go_on_to(face, weights[i], monitor);
            own.push_back({weights[i], face.statics().keep()});
            out[i] = bench_.displacement(face.pose().vertices);
            left.erase(left.begin() + static_cast<long>(next));
        }
    });
    for (std::vector<Found>& own : walks)
        found_.insert(found_.end(), std::make_move_iterator(own.begin()),
                      std::make_move_iterator(own.end()));
    first_is_there_ = false;
    return out;
}

UnitState UnitBench::Search::state(const Eigen::VectorXd& weight, const std::vector<bool>& wanted,
                                   const ProgressMonitor& monitor) {
    UnitState out{weight, moved(weight, monitor), {}};
    const face::KeptEquilibrium& at = found_.back().at;
    out.way = bench_.derivatives(bench_.inputs_of(weight, wanted),
                                 [&](int, face::Face& face) { face.statics().go_back_to(at); });
    first_is_there_ = false;
    monitor.throw_if_stopped();
    return out;
}

}  // namespace risorius::inverse
