// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "risorius/inverse/detail/joint_keys.h"
#include "risorius/inverse/detail/unit_choice.h"

namespace risorius::inverse {

namespace {

constexpr double kSmallPrice = 1e-5;   // of a weight of 1, so that units that do nothing rest
constexpr double kLeastWeight = 0.03;  // what stays below is left out
constexpr double kKeep = 1e-5;  // of squared differences from the weights of a frame, for keys
constexpr double kGain = 0.8;   // of what was left; with more a search ends
constexpr double kNearEnough =
    2.5;  // a choice with less left, relative to the least gain of a unit, is not made again
constexpr int kCorrections = 4, kCloseChoices = 2, kChoices = 3, kCheckRounds = 3, kTangents = 4,
              kChecks = 2, kSweeps = 3;
constexpr double kSmooth =
    1e-4;  // of squared differences from the mean of the neighbours of a frame
constexpr std::size_t kRivals = 16;
constexpr int kFramesForOne = 10, kLeastFrames = 3;  // for one that is simulated; at least
constexpr int kMostTops = 4;                         // frames that decide which units there are
constexpr double kExplained = 0.15;                  // a frame of which more is left decides, too
// A curve has to explain this multiple of the variance of the noise in the mean of the frames. Any curve explains noise once, and the best of
// forty curves explains that of the neutral face, which is the same in all frames, seven times.
constexpr double kOverNoise = 5;

class UnitSolver {
  public:
    UnitSolver(const UnitBench& bench, const FitTarget& given, std::vector<KnownUnits> known,
               const UnitSolveOptions& options, const ProgressMonitor& monitor)
        : bench_(bench),
          options_(options),
          monitor_(monitor),
          times_s_(given.times_s),
          root_(roots_of(bench, given)),
          equilibria_(bench, known),
          model_(weighted(std::move(known.at(0).state))) {
        for (std::size_t k = 1; k < known.size(); ++k)
            model_.add(weighted(std::move(known[k].state)));
        const std::vector<int>& vertices = bench.vertices();
        points_ = root_.squaredNorm() / 3;
        target_.resize(root_.size(), static_cast<long>(given.fields.size()));
        for (std::size_t t = 0; t < given.fields.size(); ++t)
            for (std::size_t i = 0; i < vertices.size(); ++i)
                target_.col(static_cast<long>(t)).segment<3>(3 * static_cast<long>(i)) =
                    given.fields[t].row(vertices[i]).transpose();
        target_ = root_.asDiagonal() * target_;
        take_confidence(given);
        size_ = target_.colwise().squaredNorm().maxCoeff(&peak_);
        const long n = bench.sources().count();
        active_.assign(static_cast<std::size_t>(n), false);
        price_ = Eigen::VectorXd::Zero(n);
        for (const UnitCandidate& one : bench.sources().candidates())
            for (const std::size_t s : one.sources) price_[static_cast<long>(s)] = one.cost;
        weight_ = Eigen::MatrixXd::Zero(n, target_.cols());
    }

    UnitSolution solve() {
        UnitSolution out;
        if (!(size_ > 0)) return out;
        choose_all();
        fit_frames();
        monitor_.report(0.6, "units");
        simulate(some_frames());
        fit_frames();
        make_channels();
        if (channels_.empty()) return out;
        find_keys();
        if (channels_.empty()) return out;
        const std::vector<long> checked = some_frames();
        // Where the model was off, the new equilibria correct it. The last ones are those of the script as it is written.
        for (int round = 0; round < kChecks; ++round) {
            monitor_.report(0.7 + 0.1 * round, "units");
            if (simulate(checked) < options_.key_error_m || round + 1 == kChecks) break;
            refit_keys();
        }
        report(checked, out);
        return out;
    }

  private:
    static Eigen::VectorXd roots_of(const UnitBench& bench, const FitTarget& given) {
        const std::vector<int>& vertices = bench.vertices();
        Eigen::VectorXd out(3 * static_cast<long>(vertices.size()));
        for (std::size_t i = 0; i < vertices.size(); ++i)
            out.segment<3>(3 * static_cast<long>(i))
                .setConstant(std::sqrt(given.weight[vertices[i]]));
        return out;
    }
    UnitState weighted(UnitState state) const {
        state.moved = root_.asDiagonal() * state.moved;
        state.way = root_.asDiagonal() * state.way;
        return state;
    }
    /// A part of the work: it may be stopped, and reports nothing.
    ProgressMonitor quiet() const { return {.progress = {}, .stopped = monitor_.stopped}; }
    double rms_of(const Eigen::VectorXd& left) const { return left.norm() / std::sqrt(points_); }

    /// How much each row of the target counts in each frame.
    void take_confidence(const FitTarget& given) {
        if (given.sure.empty()) return;
        const std::vector<int>& vertices = bench_.vertices();
        share_.resize(target_.rows(), target_.cols());
        for (long t = 0; t < share_.cols(); ++t)
            for (std::size_t i = 0; i < vertices.size(); ++i)
                for (long k = 0; k < 3; ++k)
                    share_(3 * static_cast<long>(i) + k, t) =
                        given.flat && k == 2
                            ? 0
                            : std::sqrt(given.sure[static_cast<std::size_t>(t)][vertices[i]]);
        target_.array() *= share_.array();
    }
    /// What is seen of displacements of the points in a frame.
    Eigen::VectorXd seen(long frame, Eigen::VectorXd moved) const {
        if (share_.size() > 0) moved.array() *= share_.col(frame).array();
        return moved;
    }
    UnitModel::Tangent tangent(long frame, const Eigen::VectorXd& weight,
                               const std::vector<bool>& active = {}) const {
        UnitModel::Tangent out = model_.tangent(weight, active);
        if (share_.size() == 0) return out;
        out.at_zero = seen(frame, std::move(out.at_zero));
        out.way = share_.col(frame).asDiagonal() * out.way;
        return out;
    }

    UnitFit usual_fit(double price) const {
        return {.size = size_, .price = price * price_, .expected = {}};
    }
    /// Weights for a frame by the model, from weights that are near.
    Eigen::VectorXd fitted(long frame, Eigen::VectorXd near) const {
        return fitted(frame, near, usual_fit(kSmallPrice));
    }
    Eigen::VectorXd fitted(long frame, Eigen::VectorXd near, const UnitFit& how) const {
        for (int round = 0; round < kTangents; ++round) {
            const Eigen::VectorXd next =
                fit_weights(tangent(frame, near, active_), target_.col(frame), active_, near, how);
            const double change = (next - near).cwiseAbs().maxCoeff();
            near = next;
            constexpr double kSame = 1e-3;
            if (change < kSame) break;
        }
        return near;
    }

    /// Chooses units for the frame of the largest motion, and for others that these do not explain.
    void choose_all() {
        long top = peak_;
        for (int count = 0; count < kMostTops; ++count) {
            monitor_.report(0.5 * count / kMostTops, "units");
            choose_for(top);
            fit_frames();
            double most = 0;
            for (long t = 0; t < target_.cols(); ++t) {
                const double left = (seen(t, model_.moved(weight_.col(t))) - target_.col(t)).norm(),
                             whole = target_.col(t).norm();
                if (left < kExplained * whole || rms_of(target_.col(t)) < 0.1 * rms_of_peak())
                    continue;
                if (left > most) {
                    most = left;
                    top = t;
                }
            }
            if (!(most > 0)) break;
        }
    }
    double rms_of_peak() const { return std::sqrt(size_ / points_); }

    /// Finds the units of a frame by the unit shapes, and again after each equilibrium under those that were found.
    void choose_for(long frame) {
        const Eigen::VectorXd goal = target_.col(frame);
        const double cost =
            0.5 * options_.least_gain_m * options_.least_gain_m * points_ / goal.squaredNorm();
        const std::vector<bool> before = active_;
        Eigen::VectorXd w = Eigen::VectorXd::Zero(bench_.sources().count());
        UnitChoice best;
        double least = std::numeric_limits<double>::infinity();
        const auto choose = [&] {
            // What is known of the rig near the first choice may tell a better one.
            for (int round = 0; round < kChoices; ++round) {
                const UnitChoice choice =
                    choose_units(tangent(frame, w), goal, bench_.sources(),
                                 {.most = options_.most, .unit_cost = cost, .price = kSmallPrice});
                const bool same = choice.active == active_;
                active_ = choice.active;
                w = fitted(frame, choice.weight);
                if (same) break;
            }
            // A new choice is judged after a correction.
            double last = std::numeric_limits<double>::infinity();
            for (int round = 0; round < kCorrections; ++round) {
                if (round > 0) w = fitted(frame, w);
                const double left = simulate_one(w, frame);
                const bool ends = left > kGain * last;
                last = left;
                if (left < least) {
                    least = left;
                    best = {active_, w, left};
                }
                if (ends || left < options_.least_gain_m) break;
            }
        };
        choose();
        // With the derivatives in the best of them, units that act alike are told apart.
        for (int round = 0; round < kCloseChoices && least > kNearEnough * options_.least_gain_m;
             ++round) {
            w = best.weight;
            add_state(w, frame);
            const double last_least = least;
            choose();
            if (least > kGain * last_least) break;
        }
        active_ = best.active;
        w = best.weight;
        for (int round = 0; round < kCheckRounds && least > options_.least_gain_m; ++round) {
            w = fitted(frame, w);
            const double left = simulate_one(w, frame);
            if (left < options_.least_gain_m || left > kGain * least) break;
            least = left;
        }
        w = fitted(frame, w);
        for (std::size_t s = 0; s < active_.size(); ++s) active_[s] = active_[s] || before[s];
        weight_.col(frame) = w;
    }

    /// Adds the equilibrium under weights to the model with its derivatives: by the sources that are used, and by those of which a little
    /// would help most. Of all others the model has good ones.
    void add_state(const Eigen::VectorXd& w, long frame) {
        const UnitModel::Tangent now = model_.tangent(w), shown = tangent(frame, w);
        const Eigen::VectorXd left = target_.col(frame) - shown.at_zero - shown.way * w;
        std::vector<std::pair<double, std::size_t>> help;
        for (std::size_t s = 0; s < active_.size(); ++s) {
            const auto way = shown.way.col(static_cast<long>(s));
            help.emplace_back(-std::pow(way.dot(left), 2) / std::max(way.squaredNorm(), 1e-30), s);
        }
        std::sort(help.begin(), help.end());
        std::vector<bool> wanted = active_;
        for (std::size_t i = 0; i < std::min(help.size(), kRivals); ++i)
            wanted[help[i].second] = true;
        UnitState state = weighted(equilibria_.state(w, wanted, quiet()));
        for (std::size_t s = 0; s < wanted.size(); ++s)
            if (!wanted[s]) state.way.col(static_cast<long>(s)) = now.way.col(static_cast<long>(s));
        model_.add(std::move(state));
    }

    /// Adds the equilibrium under weights to the model. Returns the RMS distance from the goal, m.
    double simulate_one(const Eigen::VectorXd& w, long frame) {
        const Eigen::VectorXd moved = root_.asDiagonal() * equilibria_.moved(w, quiet());
        model_.add(w, moved);
        return rms_of(seen(frame, moved) - target_.col(frame));
    }

    /// Fits every frame, then again near its neighbours: units that act alike do not take turns.
    void fit_frames() {
        const Eigen::VectorXd top = weight_.col(peak_);
        for (long t = 0; t < target_.cols(); ++t) {
            Eigen::VectorXd near = weight_.col(t);
            if (near.isZero(0.0))
                near = std::clamp(target_.col(t).dot(target_.col(peak_)) / size_, 0.0, 1.0) * top;
            weight_.col(t) = fitted(t, near);
        }
        UnitFit how = usual_fit(kSmallPrice);
        how.keep = kSmooth;
        for (int sweep = 0; sweep < kSweeps; ++sweep)
            for (long t = 1; t + 1 < target_.cols(); ++t) {
                how.expected = 0.5 * (weight_.col(t - 1) + weight_.col(t + 1));
                weight_.col(t) = fitted(t, weight_.col(t), how);
            }
    }

    /// Frames that are equally far apart in motion, with that of the largest.
    std::vector<long> some_frames() const {
        const long all = target_.cols();
        const int count =
            std::clamp(static_cast<int>(all / kFramesForOne), kLeastFrames, options_.frames);
        std::vector<double> way{0};
        for (long t = 1; t < all; ++t)
            way.push_back(way.back() + (target_.col(t) - target_.col(t - 1)).norm());
        std::set<long> out{peak_};
        for (int k = 0; k + 1 < count; ++k) {
            const double at = way.back() * (k + 0.5) / (count - 1);
            out.insert(std::lower_bound(way.begin(), way.end(), at) - way.begin());
        }
        return {out.begin(), out.end()};
    }

    /// Simulates frames with the weights of now. Returns the largest RMS error of the model, m.
    double simulate(const std::vector<long>& frames) {
        std::vector<Eigen::VectorXd> weights;
        for (const long t : frames) weights.emplace_back(weight_.col(t));
        const std::vector<Eigen::VectorXd> moved = equilibria_.moved(weights, quiet());
        double most = 0;
        std::vector<Eigen::VectorXd> found;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            found.emplace_back(root_.asDiagonal() * moved[i]);
            most = std::max(most, rms_of(found[i] - model_.moved(weights[i])));
        }
        for (std::size_t i = 0; i < frames.size(); ++i) model_.add(weights[i], found[i]);
        return most;
    }

    /// The channels of the script: units that are used, and both sides in one where the face hardly tells the difference.
    void make_channels() {
        for (const UnitCandidate& one : bench_.sources().candidates())
            for (const std::size_t s : one.sources) {
                const auto row = static_cast<long>(s);
                if (active_[s] && weight_.row(row).maxCoeff() >= kLeastWeight)
                    channels_.push_back({bench_.sources().at(s).name, {row}});
                else
                    weight_.row(row).setZero();
            }
        const double noise = cost_over_noise();
        leave_out_noise(noise);
        const std::vector<FrameCost> cost = costs();
        const Eigen::MatrixXd values = channel_values();
        const auto unit = [&](std::size_t c) {
            return Eigen::VectorXd(Eigen::VectorXd::Unit(values.rows(), static_cast<long>(c)));
        };
        const double same = std::max(squares_of(options_.same_sides_m), noise);
        std::vector<Channel> together;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            const auto row = static_cast<std::size_t>(channels_[c].rows[0]);
            const UnitCandidate* both = nullptr;
            for (const UnitCandidate& one : bench_.sources().candidates())
                if (one.sources.size() == 2 && one.sources[0] == row) both = &one;
            const bool next_is_other =
                both && c + 1 < channels_.size() &&
                channels_[c + 1].rows[0] == static_cast<long>(both->sources[1]);
            if (next_is_other && cost_of_zero(cost, values, unit(c) - unit(c + 1)) < same) {
                together.push_back({both->name, {channels_[c].rows[0], channels_[c + 1].rows[0]}});
                ++c;
            } else {
                together.push_back(channels_[c]);
            }
        }
        channels_ = std::move(together);
    }
    /// The cost over all frames, as those of FrameCost, of an RMS error, m.
    double squares_of(double rms_m) const {
        return 0.5 * rms_m * rms_m * points_ / size_ * static_cast<double>(target_.cols());
    }
    /// What a curve has to save: a multiple of the variance of a row that no curve explains.
    double cost_over_noise() const {
        double squares = 0, rows = 0;
        for (long t = 0; t < target_.cols(); ++t) {
            squares += (seen(t, model_.moved(weight_.col(t))) - target_.col(t)).squaredNorm();
            rows += seen(t, root_).squaredNorm() - static_cast<double>(channels_.size());
        }
        const auto frames = static_cast<double>(target_.cols());
        return rows > 0 ? 0.5 * kOverNoise * squares / rows / size_ * frames : 0;
    }
    /// Leaves out channels that explain no more than noise is explained by chance, the least useful one first.
    void leave_out_noise(double noise) {
        while (!channels_.empty()) {
            const std::vector<FrameCost> cost = costs();
            const auto count = static_cast<long>(channels_.size());
            Eigen::VectorXd loss(count);
            for (long c = 0; c < count; ++c)
                loss[c] = cost_of_zero(cost, channel_values(), Eigen::VectorXd::Unit(count, c));
            long least = 0;
            if (!(loss.minCoeff(&least) < noise)) break;
            for (const long row : channels_[static_cast<std::size_t>(least)].rows) {
                active_[static_cast<std::size_t>(row)] = false;
                weight_.row(row).setZero();
            }
            channels_.erase(channels_.begin() + least);
            fit_frames();
        }
    }

    Eigen::VectorXd in_channels(const Eigen::VectorXd& weight) const {
        Eigen::VectorXd out(static_cast<long>(channels_.size()));
        for (std::size_t c = 0; c < channels_.size(); ++c)
            out[static_cast<long>(c)] = weight(channels_[c].rows).mean();
        return out;
    }

    /// Channels x frames.
    Eigen::MatrixXd channel_values() const {
        Eigen::MatrixXd out(static_cast<long>(channels_.size()), target_.cols());
        for (long t = 0; t < target_.cols(); ++t) out.col(t) = in_channels(weight_.col(t));
        return out;
    }
    /// The cost of the channels in every frame near the weights of now.
    std::vector<FrameCost> costs() const {
        std::vector<FrameCost> out;
        for (long t = 0; t < target_.cols(); ++t) {
            const UnitModel::Tangent at = tangent(t, weight_.col(t), active_);
            Eigen::MatrixXd way(target_.rows(), static_cast<long>(channels_.size()));
            for (std::size_t c = 0; c < channels_.size(); ++c)
                way.col(static_cast<long>(c)) =
                    at.way(Eigen::all, channels_[c].rows).rowwise().sum();
            FrameCost& cost = out.emplace_back();
            cost.A = way.transpose() * way / size_;
            cost.A.diagonal().array() += kKeep;
            cost.b = way.transpose() * (target_.col(t) - at.at_zero) / size_ +
                     kKeep * in_channels(weight_.col(t));
        }
        return out;
    }

    void find_keys() {
        for (bool again = true; again && !channels_.empty();) {
            keys_ =
                joint_keys(times_s_, costs(), channel_values(), squares_of(options_.key_error_m));
            again = leave_out_idle();
            use_keys();
        }
    }
    /// Leaves out channels that hardly do anything by their keys. Says whether there are any.
    bool leave_out_idle() {
        bool found = false;
        for (std::size_t c = channels_.size(); c-- > 0;) {
            if (std::any_of(keys_[c].begin(), keys_[c].end(),
                            [](const track::Key& key) { return key.value >= kLeastWeight; }))
                continue;
            channels_.erase(channels_.begin() + static_cast<long>(c));
            keys_.erase(keys_.begin() + static_cast<long>(c));
            found = true;
        }
        return found;
    }
    void refit_keys() {
        for (int round = 0; round < 2; ++round) {
            fit_keys(times_s_, costs(), keys_);
            use_keys();
        }
    }

    /// The weights become what the keys say, as they are written.
    void use_keys() {
        constexpr double kDigits = 1e4;
        for (auto& keys : keys_)
            for (track::Key& key : keys) key.value = std::round(kDigits * key.value) / kDigits;
        const Eigen::MatrixXd values = values_of_keys(keys_, times_s_);
        weight_.setZero();
        for (std::size_t c = 0; c < channels_.size(); ++c)
            for (const long row : channels_[c].rows)
                weight_.row(row) = values.row(static_cast<long>(c));
    }

    void report(const std::vector<long>& checked, UnitSolution& out) {
        for (std::size_t c = 0; c < channels_.size(); ++c)
            out.curves.push_back({channels_[c].name, keys_[c]});
        out.simulated.assign(static_cast<std::size_t>(target_.cols()), false);
        for (const long t : checked) out.simulated[static_cast<std::size_t>(t)] = true;
        for (long t = 0; t < target_.cols(); ++t) {
            const Eigen::VectorXd left = seen(t, model_.moved(weight_.col(t))) - target_.col(t);
            out.rms_m.push_back(rms_of(left));
            double max = 0;
            for (long i = 0; i < left.size(); i += 3)
                if (root_[i] > 0) max = std::max(max, left.segment<3>(i).norm() / root_[i]);
            out.max_m.push_back(max);
            out.drives.push_back(bench_.sources().drive_of(weight_.col(t)));
        }
    }

    /// A channel of the script and the sources that it moves.
    struct Channel {
        std::string name;
        std::vector<long> rows;
    };

    const UnitBench& bench_;
    const UnitSolveOptions& options_;
    const ProgressMonitor& monitor_;
    const std::vector<double>& times_s_;
    Eigen::VectorXd root_;    ///< square roots of the weights of the points, three for each
    double points_ = 0;       ///< sum of the weights
    Eigen::MatrixXd target_;  ///< weighted, one column per frame
    Eigen::MatrixXd share_;   ///< roots of how sure the target is; empty: it is sure
    double size_ = 0;         ///< its squares in the frame of the largest motion
    Eigen::Index peak_ = 0;   ///< this frame
    Eigen::VectorXd price_;   ///< of a source, relative to that of a unit
    UnitBench::Search equilibria_;
    UnitModel model_;
    std::vector<bool> active_;  ///< by source: whether it may have a weight
    Eigen::MatrixXd weight_;    ///< sources x frames
    std::vector<Channel> channels_;
    std::vector<std::vector<track::Key>> keys_;  ///< by channel
};

}  // namespace

UnitSolution solve_units(const UnitBench& bench, const FitTarget& given,
                         std::vector<KnownUnits> known, const UnitSolveOptions& options,
                         const ProgressMonitor& monitor) {
    return UnitSolver(bench, given, std::move(known), options, monitor).solve();
}

}  // namespace risorius::inverse
