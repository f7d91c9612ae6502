// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/classification.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>

#include "risorius/core/counter_rng.h"
#include "risorius/core/types.h"

namespace risorius::stimuli {

namespace {

constexpr double kInterval = 0.95, kLevel = 0.05;
constexpr double kRidge = 1;  // on the weights of the logistic model, not on its constant
constexpr int kNewtonSteps = 25;
constexpr double kNewtonEnd = 1e-9;
constexpr double kTunedShare = 0.75;  // of the range of a parameter that matters
constexpr double kShortestFlank_s = 0.05;
enum Purpose : std::uint64_t { kPermuting = 1, kTuning, kResampling, kGrading };
constexpr std::size_t kLeastIntensities = 10;  // of a unit, for a correlation with them

/// The answers of one question as numbers.
struct Table {
    int units = 0;
    std::vector<std::vector<int>> active;  ///< units of each row
    std::vector<char> hit;
    std::vector<std::size_t> first_row;  ///< of each participant, and the end

    std::size_t rows() const { return hit.size(); }
    std::size_t hits() const {
        return static_cast<std::size_t>(std::count(hit.begin(), hit.end(), 1));
    }
};

Table table_of(const Observations& observations, const std::string& answer) {
    Table out;
    out.units = static_cast<int>(observations.units.size());
    int participant = -1;
    for (const Observations::Answer& one : observations.answers) {
        if (one.participant != participant) out.first_row.push_back(out.rows());
        participant = one.participant;
        std::vector<int>& units = out.active.emplace_back();
        for (const design::UnitCourse& course :
             observations.trials[static_cast<std::size_t>(one.trial)].units)
            units.push_back(static_cast<int>(
                std::find(observations.units.begin(), observations.units.end(), course.unit) -
                observations.units.begin()));
        out.hit.push_back(one.given == answer ? 1 : 0);
    }
    out.first_row.push_back(out.rows());
    return out;
}

/// Random numbers of a purpose and a round.
class Chance {
  public:
    Chance(unsigned seed, Purpose purpose, std::uint64_t round)
        : seed_(seed), purpose_(purpose), round_(round) {}
    std::size_t below(std::size_t count) {
        const double u = CounterRng(seed_).at(purpose_).at(round_).at(drawn_++).uniform();
        return std::min(count - 1, static_cast<std::size_t>(u * static_cast<double>(count)));
    }

  private:
    std::uint64_t seed_, purpose_, round_, drawn_ = 0;
};

template <class Value>
void shuffle(typename std::vector<Value>::iterator first, std::size_t count, Chance& chance) {
    for (std::size_t i = count; i > 1; --i)
        std::swap(*(first + static_cast<std::ptrdiff_t>(i - 1)),
                  *(first + static_cast<std::ptrdiff_t>(chance.below(i))));
}

/// The answers in another order within each participant.
std::vector<char> permuted(const Table& table, Chance chance) {
    std::vector<char> hit = table.hit;
    for (std::size_t p = 0; p + 1 < table.first_row.size(); ++p)
        shuffle<char>(hit.begin() + static_cast<std::ptrdiff_t>(table.first_row[p]),
                      table.first_row[p + 1] - table.first_row[p], chance);
    return hit;
}

/// Pearson's correlation of two things that are there or not, from how often they are.
double correlation(double both, double one, double other, double all) {
    const double p = one / all, q = other / all, spread = p * (1 - p) * q * (1 - q);
    return spread > 0 ? (both / all - p * q) / std::sqrt(spread) : 0;
}

/// How often each unit is shown, and shown with the answer, when each row counts `times`.
struct Counts {
    std::vector<double> shown, both;
    double all = 0, hits = 0;
    std::vector<double> correlations() const {
        std::vector<double> out;
        for (std::size_t u = 0; u < shown.size(); ++u)
            out.push_back(correlation(both[u], shown[u], hits, all));
        return out;
    }
};

Counts counts_of(const Table& table, const std::vector<char>& hit, const std::vector<int>* times) {
    Counts out;
    out.shown.resize(static_cast<std::size_t>(table.units));
    out.both = out.shown;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double n = times ? (*times)[row] : 1;
        if (n == 0) continue;
        out.all += n;
        out.hits += hit[row] ? n : 0;
        for (const int unit : table.active[row]) {
            out.shown[static_cast<std::size_t>(unit)] += n;
            if (hit[row]) out.both[static_cast<std::size_t>(unit)] += n;
        }
    }
    return out;
}

/// Solves A x = b for a symmetric positive definite matrix by Cholesky's method. Overwrites A and b.
void solve_in_place(Eigen::MatrixXd& a, Eigen::VectorXd& b) {
    const Eigen::Index n = a.rows();
    for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index k = 0; k < j; ++k)
            for (Eigen::Index i = j; i < n; ++i) a(i, j) -= a(i, k) * a(j, k);
        const double root = std::sqrt(std::max(a(j, j), 1e-12));
        for (Eigen::Index i = j; i < n; ++i) a(i, j) /= root;
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index k = 0; k < i; ++k) b(i) -= a(i, k) * b(k);
        b(i) /= a(i, i);
    }
    for (Eigen::Index i = n; i-- > 0;) {
        for (Eigen::Index k = i + 1; k < n; ++k) b(i) -= a(k, i) * b(k);
        b(i) /= a(i, i);
    }
}

/// The logistic model with a ridge, by Newton's method. The constant is behind the weights.
Eigen::VectorXd logistic_weights(const Table& table, const std::vector<int>* times,
                                 Eigen::VectorXd weights) {
    const Eigen::Index n = table.units + 1, constant = table.units;
    for (int step = 0; step < kNewtonSteps; ++step) {
        Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd slope = Eigen::VectorXd::Zero(n);
        for (Eigen::Index u = 0; u < table.units; ++u) {
            curvature(u, u) = kRidge;
            slope(u) = -kRidge * weights(u);
        }
        curvature(constant, constant) = 1e-9;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const double count = times ? (*times)[row] : 1;
            if (count == 0) continue;
            double sum = weights(constant);
            for (const int u : table.active[row]) sum += weights(u);
            const double p = 1 / (1 + std::exp(-sum)), left = count * (table.hit[row] - p),
                         steep = count * p * (1 - p);
            slope(constant) += left;
            curvature(constant, constant) += steep;
            for (const int u : table.active[row]) {
                slope(u) += left;
                curvature(constant, u) += steep;
                for (const int v : table.active[row])
                    if (v <= u) curvature(u, v) += steep;
            }
        }
        solve_in_place(curvature, slope);
        weights += slope;
        if (slope.lpNorm<Eigen::Infinity>() < kNewtonEnd) break;
    }
    return weights;
}

/// The value below which this share of the values lies, linear between neighbours.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(low);
    return low + 1 < values.size() ? values[low] + part * (values[low + 1] - values[low])
                                   : values[low];
}

void set_interval(const std::vector<double>& values, Estimate& estimate) {
    estimate.low = quantile(values, (1 - kInterval) / 2);
    estimate.high = quantile(values, (1 + kInterval) / 2);
}

/// The rows that show a unit, with its course.
struct Shown {
    std::vector<std::size_t> rows;
    std::vector<const design::UnitCourse*> courses;
};

Shown shown_of(const Observations& observations, const std::string& unit) {
    Shown out;
    for (std::size_t row = 0; row < observations.answers.size(); ++row)
        for (const design::UnitCourse& course :
             observations.trials[static_cast<std::size_t>(observations.answers[row].trial)].units)
            if (course.unit == unit) {
                out.rows.push_back(row);
                out.courses.push_back(&course);
            }
    return out;
}

template <class Value>
double pearson(const std::vector<double>& x, const std::vector<Value>& y) {
    const auto n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
        syy += y[i] * y[i];
    }
    const double spread = (sxx - sx * sx / n) * (syy - sy * sy / n);
    return spread > 0 ? (sxy - sx * sy / n) / std::sqrt(spread) : 0;
}

/// Corrects p for the number of parameters of a unit, by Holm's method.
void correct(std::vector<double>& p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(p[a], a) < std::pair(p[b], b);
    });
    double least = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        least = std::max(least, std::min(1.0, p[order[i]] * static_cast<double>(order.size() - i)));
        p[order[i]] = least;
    }
}

/// Where the answers of each participant begin among some rows, and their end.
std::vector<std::size_t> firsts_of(const Observations& observations,
                                   const std::vector<std::size_t>& rows) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (i == 0 || observations.answers[rows[i]].participant !=
                          observations.answers[rows[i - 1]].participant)
            out.push_back(i);
    out.push_back(rows.size());
    return out;
}

/// For each column of x: how often y that is permuted within each participant correlates with it as strongly as y does.
template <class Value>
std::vector<double> chances(const std::vector<std::vector<double>>& x, const std::vector<Value>& y,
                            const std::vector<std::size_t>& first,
                            const ClassificationOptions& options, Purpose purpose,
                            std::uint64_t number) {
    std::vector<double> r;
    for (const std::vector<double>& column : x) r.push_back(std::abs(pearson(column, y)));
    std::vector<int> larger(x.size());
    for (int round = 0; round < options.permutations; ++round) {
        Chance chance(options.seed, purpose,
                      number * static_cast<std::uint64_t>(options.permutations) +
                          static_cast<std::uint64_t>(round));
        std::vector<Value> other = y;
        for (std::size_t p = 0; p + 1 < first.size(); ++p)
            shuffle<Value>(other.begin() + static_cast<std::ptrdiff_t>(first[p]),
                           first[p + 1] - first[p], chance);
        for (std::size_t k = 0; k < x.size(); ++k)
            larger[k] += std::abs(pearson(x[k], other)) >= r[k] * (1 - 1e-12);
    }
    std::vector<double> out;
    for (const int count : larger) out.push_back((1.0 + count) / (1.0 + options.permutations));
    correct(out);
    return out;
}

/// What the rated intensities of an answer say about the parameters, in the trials that show the unit.
void add_intensity(const Observations& observations, const Table& table, const Shown& shown,
                   const ClassificationOptions& options, std::uint64_t number, UnitModel& unit) {
    std::vector<std::size_t> rows;
    std::vector<double> intensity;
    std::vector<std::vector<double>> values(unit.parameters.size());
    for (std::size_t i = 0; i < shown.rows.size(); ++i) {
        const auto& rated = observations.answers[shown.rows[i]].intensity;
        if (!rated || !table.hit[shown.rows[i]]) continue;
        rows.push_back(shown.rows[i]);
        intensity.push_back(*rated);
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k].push_back(design::parameter(*shown.courses[i], k));
    }
    if (rows.size() < kLeastIntensities) return;
    const std::vector<double> p =
        chances(values, intensity, firsts_of(observations, rows), options, kGrading, number);
    for (std::size_t k = 0; k < values.size(); ++k) {
        unit.parameters[k].r_intensity = pearson(values[k], intensity);
        unit.parameters[k].p_intensity = p[k];
    }
}

/// The value of a parameter in the resulting expression: the mean over trials with the answer, or for one that matters the end of
/// its range that it prefers, to three quarters.
double model_value(const ParameterModel& parameter, const std::vector<double>& values,
                   const std::vector<char>& hits, const std::vector<int>* times) {
    if (parameter.tuned) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const double share = parameter.r > 0 ? kTunedShare : 1 - kTunedShare;
        return *low + share * (*high - *low);
    }
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double n = hits[i] ? (times ? (*times)[i] : 1) : 0;
        sum += n * values[i];
        count += n;
    }
    return count > 0 ? sum / count
                     : std::accumulate(values.begin(), values.end(), 0.0) /
                           static_cast<double>(values.size());
}

void add_parameters(const Observations& observations, const Table& table,
                    const ClassificationOptions& options, std::uint64_t number, UnitModel& unit) {
    const Shown shown = shown_of(observations, unit.unit);
    std::vector<char> hits;
    for (const std::size_t row : shown.rows) hits.push_back(table.hit[row]);
    const std::vector<std::size_t> first = firsts_of(observations, shown.rows);
    const std::size_t parameters = design::course_parameters().size();
    std::vector<std::vector<double>> values(parameters);
    for (std::size_t k = 0; k < parameters; ++k) {
        for (const design::UnitCourse* course : shown.courses)
            values[k].push_back(design::parameter(*course, k));
        unit.parameters.push_back({.model = {}, .r = pearson(values[k], hits), .p = 1});
    }
    const std::vector<double> p = chances(values, hits, first, options, kTuning, number);
    for (std::size_t k = 0; k < parameters; ++k) {
        unit.parameters[k].p = p[k];
        unit.parameters[k].tuned = p[k] < kLevel;
    }
    add_intensity(observations, table, shown, options, number, unit);
    std::vector<std::vector<double>> again(parameters);
    for (int round = 0; round < options.bootstraps; ++round) {
        Chance chance(options.seed, kResampling,
                      (number + 1) * static_cast<std::uint64_t>(options.bootstraps) +
                          static_cast<std::uint64_t>(round));
        std::vector<int> times(hits.size());
        for (std::size_t who = 0; who + 1 < first.size(); ++who)
            for (std::size_t i = first[who]; i < first[who + 1]; ++i)
                ++times[first[who] + chance.below(first[who + 1] - first[who])];
        for (std::size_t k = 0; k < parameters; ++k)
            again[k].push_back(model_value(unit.parameters[k], values[k], hits, &times));
    }
    for (std::size_t k = 0; k < parameters; ++k) {
        unit.parameters[k].model.value = model_value(unit.parameters[k], values[k], hits, nullptr);
        set_interval(again[k], unit.parameters[k].model);
    }
}

/// Intervals of correlations and weights, from trials that are drawn again within each participant.
void add_intervals(const Table& table, const ClassificationOptions& options,
                   const Eigen::VectorXd& weights, const ProgressMonitor& monitor,
                   AnswerModel& model) {
    std::vector<std::vector<double>> r(model.units.size()), weight(model.units.size());
    for (int round = 0; round < options.bootstraps; ++round) {
        monitor.throw_if_stopped();
        Chance chance(options.seed, kResampling, static_cast<std::uint64_t>(round));
        std::vector<int> times(table.rows());
        for (std::size_t p = 0; p + 1 < table.first_row.size(); ++p)
            for (std::size_t i = table.first_row[p]; i < table.first_row[p + 1]; ++i)
                ++times[table.first_row[p] +
                        chance.below(table.first_row[p + 1] - table.first_row[p])];
        const std::vector<double> all = counts_of(table, table.hit, &times).correlations();
        const Eigen::VectorXd again = logistic_weights(table, &times, weights);
        for (std::size_t u = 0; u < model.units.size(); ++u) {
            r[u].push_back(all[u]);
            weight[u].push_back(again(static_cast<Eigen::Index>(u)));
        }
    }
    for (std::size_t u = 0; u < model.units.size(); ++u) {
        set_interval(r[u], model.units[u].r);
        set_interval(weight[u], model.units[u].weight);
    }
}

}  // namespace

design::UnitCourse UnitModel::course(int which) const {
    design::UnitCourse out;
    out.unit = unit;
    for (std::size_t k = 0; k < parameters.size(); ++k)
        design::parameter(out, k) = parameters[k].model.value;
    if (which != 0) out.amplitude = which < 0 ? parameters[0].model.low : parameters[0].model.high;
    out.peak_latency_s = std::max(out.peak_latency_s, out.onset_latency_s + kShortestFlank_s);
    out.offset_latency_s = std::max(out.offset_latency_s, out.peak_latency_s + kShortestFlank_s);
    return out;
}

AnswerModel classification_model(const Observations& observations, const std::string& answer,
                                 const ClassificationOptions& options,
                                 const ProgressMonitor& monitor) {
    const Table table = table_of(observations, answer);
    AnswerModel model;
    model.answer = answer;
    model.trials = static_cast<int>(table.rows());
    model.given = static_cast<int>(table.hits());
    const Counts counts = counts_of(table, table.hit, nullptr);
    const std::vector<double> r = counts.correlations();
    const Eigen::VectorXd weights =
        logistic_weights(table, nullptr, Eigen::VectorXd::Zero(table.units + 1));
    std::vector<double> largest, smallest;
    for (int round = 0; round < options.permutations; ++round) {
        monitor.throw_if_stopped();
        const std::vector<char> hit =
            permuted(table, Chance(options.seed, kPermuting, static_cast<std::uint64_t>(round)));
        const std::vector<double> by_chance = counts_of(table, hit, nullptr).correlations();
        const auto [low, high] = std::minmax_element(by_chance.begin(), by_chance.end());
        largest.push_back(*high);
        smallest.push_back(*low);
    }
    model.threshold_up = quantile(largest, 1 - kLevel / 2);
    model.threshold_down = quantile(smallest, kLevel / 2);
    for (std::size_t u = 0; u < observations.units.size(); ++u) {
        UnitModel& unit = model.units.emplace_back();
        unit.unit = observations.units[u];
        unit.shown = static_cast<int>(counts.shown[u]);
        unit.answered = static_cast<int>(counts.both[u]);
        unit.r.value = r[u];
        unit.weight.value = weights(static_cast<Eigen::Index>(u));
        if (r[u] > model.threshold_up)
            unit.role = UnitModel::Role::kFacilitates;
        else if (r[u] < model.threshold_down)
            unit.role = UnitModel::Role::kInhibits;
        if (unit.role != UnitModel::Role::kNone)
            add_parameters(observations, table, options, u, unit);
    }
    if (options.bootstraps > 0) add_intervals(table, options, weights, monitor, model);
    return model;
}

}  // namespace risorius::stimuli
