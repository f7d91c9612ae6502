// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/low_rank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "risorius/core/dense_algebra.h"

namespace risorius::blendshapes {

namespace {

// Smaller errors of frames are not fitted where no field moves the vertex
constexpr double kMoved_m = 2e-5;
// Smaller singular values, relative to the largest, are dropped
constexpr double kOfLargest = 1e-3;
constexpr double kOfOthers = 0.1;  // weight of the use in general, relative to the given frames
// Factor by which the fade is enlarged while the budget is exceeded
constexpr double kCoarser = 1.2;
// A corrective may have this much of its largest weight in the given frames before it is held at 1
constexpr double kHeadroom = 4;
// Smaller factors of drivers in a corrective, relative to its largest, are dropped
constexpr double kShareCounts = 0.02;
// When what is kept is fitted again: the mean weight of the fields, relative to a frame, and that of squared changes
constexpr double kFieldCounts = 0.1, kChangeCounts = 0.01;

/// Fields at the vertices that at least one of them moves, stacked in columns.
struct Stack {
    std::vector<int> vertex;
    Eigen::MatrixXd column;  ///< 3 rows per vertex
};

Eigen::VectorXd rows_of(const Points& field, const std::vector<int>& vertex) {
    Eigen::VectorXd out(3 * static_cast<long>(vertex.size()));
    for (std::size_t i = 0; i < vertex.size(); ++i)
        out.segment<3>(3 * static_cast<long>(i)) = field.row(vertex[i]).transpose();
    return out;
}

Stack stacked(const std::vector<DriverField>& fields, const std::vector<PlayedFrame>& frames,
              long vertices) {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(vertices);
    for (const DriverField& one : fields) moved = moved.cwiseMax(one.field.rowwise().squaredNorm());
    for (const PlayedFrame& frame : frames)
        for (long v = 0; v < vertices; ++v)
            if (const double size = frame.left.row(v).norm(); size > kMoved_m)
                moved[v] = std::max(moved[v], size);
    Stack out;
    for (long v = 0; v < vertices; ++v)
        if (moved[v] > 0) out.vertex.push_back(static_cast<int>(v));
    out.column.resize(3 * static_cast<long>(out.vertex.size()), static_cast<long>(fields.size()));
    for (std::size_t t = 0; t < fields.size(); ++t)
        out.column.col(static_cast<long>(t)) = rows_of(fields[t].field, out.vertex);
    return out;
}

Eigen::MatrixXd drivers_in(const std::vector<PlayedFrame>& frames,
                           const std::vector<DriverField>& fields) {
    Eigen::MatrixXd out(static_cast<long>(frames.size()), static_cast<long>(fields.size()));
    for (std::size_t f = 0; f < frames.size(); ++f)
        for (std::size_t t = 0; t < fields.size(); ++t)
            out(static_cast<long>(f), static_cast<long>(t)) =
                fields[t].driver.value(frames[f].weights);
    return out;
}

void fit(Stack& stack, const std::vector<PlayedFrame>& frames, const Eigen::MatrixXd& drivers,
         double ridge_weight) {
    if (frames.empty()) return;
    Eigen::MatrixXd left(stack.column.rows(), static_cast<long>(frames.size()));
    for (std::size_t f = 0; f < frames.size(); ++f)
        left.col(static_cast<long>(f)) = rows_of(frames[f].left, stack.vertex);
    left.noalias() -= stack.column * drivers.transpose();
    Eigen::MatrixXd normal = drivers * drivers.transpose();
    normal.diagonal().array() += ridge_weight;
    stack.column.noalias() += left * solved_symmetric(normal, drivers);
}

/// Correctives of one side, the largest singular value first.
struct HalfCorrectives {
    std::vector<Points> field;
    std::vector<Eigen::VectorXd> of_drivers;  ///< by corrective, one factor per driver
    std::vector<std::string> ending;          ///< of their names
};

/// The largest weight that counts of a corrective with these factors, with drivers in [0, 1]: 0 if it is never above 0.
double largest_weight(const Eigen::VectorXd& fractions, const Eigen::MatrixXd& frames) {
    const double bound = fractions.cwiseMax(0.0).sum();
    if (frames.rows() == 0) return bound;
    const double alone = std::max(0.0, fractions.maxCoeff()),
                 seen = (frames * fractions).maxCoeff();
    return std::min(bound, std::max(alone, kHeadroom * seen));
}

/// How much each driver matters: the mean of its square over frames in use.
Eigen::VectorXd use_of(const std::vector<DriverField>& fields, const Eigen::MatrixXd& drivers) {
    const long frames = drivers.rows();
    Eigen::VectorXd use(static_cast<long>(fields.size()));
    for (std::size_t t = 0; t < fields.size(); ++t)
        use[static_cast<long>(t)] = (frames == 0 ? 1 : kOfOthers) * fields[t].use;
    if (frames > 0)
        use += drivers.colwise().squaredNorm().transpose() / static_cast<double>(frames);
    return use;
}

HalfCorrectives side_of(const Stack& stack, bool left, const Points& rest,
                        const Eigen::VectorXd& root_area, const Eigen::VectorXd& root_use,
                        const Eigen::MatrixXd& frames, const Compression& how) {
    Eigen::MatrixXd half = stack.column;
    Eigen::VectorXd root(half.rows());
    for (std::size_t i = 0; i < stack.vertex.size(); ++i) {
        const double fraction = left_fraction(rest(stack.vertex[i], 0), how.half_width_m);
        half.middleRows<3>(3 * static_cast<long>(i)) *= left ? fraction : 1 - fraction;
        root.segment<3>(3 * static_cast<long>(i)).setConstant(root_area[stack.vertex[i]]);
    }
    // Right singular vectors of  root half root_use, from the small Gram matrix: there are far fewer drivers than vertices.
    const Eigen::MatrixXd weighted = root.asDiagonal() * half * root_use.asDiagonal();
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(half.cols(), half.cols());
    gram.selfadjointView<Eigen::Lower>().rankUpdate(weighted.transpose());
    const SymmetricEigen eigen = symmetric_eigen(gram);
    const long all = gram.cols();
    const double min = kOfLargest * kOfLargest * eigen.values[all - 1];
    long count = 0;
    while (count < std::min<long>(all, how.most_of_a_side) &&
           eigen.values[all - 1 - count] > std::max(0.0, min))
        ++count;
    HalfCorrectives out;
    for (long c = 0; c < count; ++c) {
        Eigen::VectorXd right = eigen.vectors.col(all - 1 - c);
        // The sign of a singular vector is arbitrary; its largest entry is made positive.
        Eigen::Index where;
        right.cwiseAbs().maxCoeff(&where);
        if (right[where] < 0) right = -right;
        const Eigen::VectorXd fractions = right.cwiseQuotient(root_use);
        const Eigen::VectorXd field = half * root_use.cwiseProduct(right);
        const double counts = kShareCounts * fractions.cwiseAbs().maxCoeff();
        // One for either sign, because a weight below 0 is none in many programs.
        for (const double sign : {1.0, -1.0}) {
            const Eigen::VectorXd signed_fractions =
                sign * (fractions.array().abs() < counts).select(0.0, fractions).matrix();
            const double max = largest_weight(signed_fractions, frames);
            if (max <= counts) continue;
            out.of_drivers.push_back(signed_fractions / max);
            out.ending.push_back(std::to_string(c + 1) + (sign > 0 ? "" : "_minus"));
            Points& moved = out.field.emplace_back(Points::Zero(rest.rows(), 3));
            for (std::size_t i = 0; i < stack.vertex.size(); ++i)
                moved.row(stack.vertex[i]) =
                    sign * max * field.segment<3>(3 * static_cast<long>(i)).transpose();
        }
    }
    return out;
}

SparseShape faded(Points field, const Fade& fade) {
    fade_out(field, fade);
    return sparse(field);
}

/// What correctives are fitted to: rows of their weights, and of the displacements that are wanted at the vertices of a stack.
struct Wanted {
    Eigen::MatrixXd weights;  ///< rows x correctives
    Eigen::MatrixXd moved;    ///< rows x 3 per vertex
};

/// What the fields give in the frames, and where each driver alone is at 1, which counts by its use.
Wanted wanted_of(const Stack& stack, const Eigen::MatrixXd& drivers, const Eigen::VectorXd& use,
                 const Eigen::MatrixXd& of_drivers) {
    const Eigen::VectorXd counts = (kFieldCounts / use.mean() * use).cwiseSqrt();
    const long count = drivers.rows(), all = count + of_drivers.cols();
    Wanted out{Eigen::MatrixXd(all, of_drivers.rows()), Eigen::MatrixXd(all, stack.column.rows())};
    const auto held = [](const Eigen::MatrixXd& weights) {
        return weights.cwiseMax(0.0).cwiseMin(1.0);
    };
    out.weights.topRows(count) = held(drivers * of_drivers.transpose());
    out.weights.bottomRows(of_drivers.cols()) = counts.asDiagonal() * held(of_drivers.transpose());
    out.moved.topRows(count) = drivers * stack.column.transpose();
    out.moved.bottomRows(of_drivers.cols()) = counts.asDiagonal() * stack.column.transpose();
    return out;
}

// Fits the faded correctives again, vertex by vertex, so that those that are kept there make up for what the others have lost.
// A change is in proportion to how little the corrective is faded, so that it ends as smoothly as before.
void fit_again(std::vector<SparseShape>& shapes, const std::vector<Points>& whole,
               const Wanted& wanted, const Stack& stack) {
    struct Kept {
        std::size_t shape;
        long row;
        double share;
    };
    std::vector<std::vector<Kept>> kept(static_cast<std::size_t>(
        stack.vertex.empty() ? 0
                             : 1 + *std::max_element(stack.vertex.begin(), stack.vertex.end())));
    for (std::size_t c = 0; c < shapes.size(); ++c)
        for (std::size_t i = 0; i < shapes[c].vertex.size(); ++i) {
            const int v = shapes[c].vertex[i];
            const auto row = static_cast<long>(i);
            kept[static_cast<std::size_t>(v)].push_back(
                {c, row, shapes[c].delta.row(row).norm() / whole[c].row(v).norm()});
        }
    const Eigen::MatrixXd normal = wanted.weights.transpose() * wanted.weights,
                          moved = wanted.weights.transpose() * wanted.moved;
    for (std::size_t at = 0; at < stack.vertex.size(); ++at) {
        const std::vector<Kept>& here = kept[static_cast<std::size_t>(stack.vertex[at])];
        const auto count = static_cast<long>(here.size());
        if (count == 0) continue;
        Eigen::MatrixXd left(count, 3), own(count, count);
        for (long i = 0; i < count; ++i) {
            const Kept& a = here[static_cast<std::size_t>(i)];
            const auto shape = static_cast<long>(a.shape);
            left.row(i) = moved.block<1, 3>(shape, 3 * static_cast<long>(at));
            for (long k = 0; k < count; ++k) {
                const Kept& b = here[static_cast<std::size_t>(k)];
                const double both = normal(shape, static_cast<long>(b.shape));
                left.row(i) -= both * shapes[b.shape].delta.row(b.row);
                own(i, k) = a.share * both * b.share;
            }
            left.row(i) *= a.share;
        }
        own.diagonal().array() += kChangeCounts;
        const Eigen::MatrixXd change = solved_symmetric(own, left);
        for (long i = 0; i < count; ++i) {
            const Kept& a = here[static_cast<std::size_t>(i)];
            shapes[a.shape].delta.row(a.row) += a.share * change.row(i);
        }
    }
}

/// Which correctives move the skin the most: indices of `most` at most, in their order.
std::vector<std::size_t> worth_most(const std::vector<Points>& whole, const Wanted& wanted,
                                    const Eigen::VectorXd& area, int most) {
    std::vector<std::pair<double, std::size_t>> by_worth;
    for (std::size_t c = 0; c < whole.size(); ++c)
        by_worth.emplace_back(-wanted.weights.col(static_cast<long>(c)).squaredNorm() *
                                  area.dot(whole[c].rowwise().squaredNorm()),
                              c);
    std::stable_sort(by_worth.begin(), by_worth.end());
    if (by_worth.size() > static_cast<std::size_t>(most))
        by_worth.resize(static_cast<std::size_t>(most));
    std::vector<std::size_t> out;
    for (const auto& [worth, c] : by_worth) out.push_back(c);
    std::sort(out.begin(), out.end());
    return out;
}

/// The fields, faded as little as the budget allows, all alike. Returns their bytes.
long fade_to_budget(const std::vector<Points>& whole, const Compression& how,
                    std::vector<SparseShape>& out) {
    for (Fade fade = how.fade;; fade.none_m *= kCoarser, fade.all_m *= kCoarser) {
        out.clear();
        long bytes = 0;
        for (const Points& field : whole) {
            out.push_back(faded(field, fade));
            bytes += how.bytes_of_a_vertex * static_cast<long>(out.back().vertex.size());
        }
        if (bytes <= how.budget_bytes) return bytes;
    }
}

}  // namespace

LowRank low_rank(std::vector<DriverField> fields, const std::vector<PlayedFrame>& frames,
                 const Points& rest, const Eigen::VectorXd& area, const Compression& how) {
    LowRank out;
    if (fields.empty()) return out;
    Stack stack = stacked(fields, frames, rest.rows());
    const Eigen::MatrixXd drivers = drivers_in(frames, fields);
    fit(stack, frames, drivers, how.ridge_weight);

    const Eigen::VectorXd use = use_of(fields, drivers), root_use = use.cwiseSqrt(),
                          root_area = area.cwiseSqrt();
    std::array<HalfCorrectives, 2> side;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
        side[k] = side_of(stack, k == 0, rest, root_area, root_use, drivers, how);

    std::vector<Points> whole;
    std::vector<std::string> names;
    std::vector<Eigen::VectorXd> of_drivers;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
        for (std::size_t c = 0; c < side[k].field.size(); ++c) {
            whole.push_back(std::move(side[k].field[c]));
            names.push_back((k == 0 ? "correctiveLeft" : "correctiveRight") + side[k].ending[c]);
            of_drivers.push_back(std::move(side[k].of_drivers[c]));
        }
    const auto wanted = [&] {
        Eigen::MatrixXd factors(static_cast<long>(whole.size()), static_cast<long>(fields.size()));
        for (std::size_t c = 0; c < whole.size(); ++c)
            factors.row(static_cast<long>(c)) = of_drivers[c].transpose();
        return wanted_of(stack, drivers, use, factors);
    };
    const std::vector<std::size_t> kept = worth_most(whole, wanted(), area, how.most);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i] == i) continue;
        whole[i] = std::move(whole[kept[i]]);
        names[i] = std::move(names[kept[i]]);
        of_drivers[i] = std::move(of_drivers[kept[i]]);
    }
    whole.resize(kept.size());
    names.resize(kept.size());
    of_drivers.resize(kept.size());
    std::vector<SparseShape> shapes;
    out.bytes = fade_to_budget(whole, how, shapes);
    fit_again(shapes, whole, wanted(), stack);
    for (std::size_t c = 0; c < whole.size(); ++c)
        if (!shapes[c].empty())
            out.correctives.push_back(
                {std::move(names[c]), std::move(shapes[c]), std::move(of_drivers[c])});
    if (out.correctives.empty()) return out;
    for (DriverField& one : fields) out.drivers.push_back(std::move(one.driver));
    return out;
}

LowRank one_of_each(std::vector<DriverField> fields, const std::vector<PlayedFrame>& frames,
                    const Points& rest, const Eigen::VectorXd& area, const Compression& how) {
    // Those that matter most, in their order
    const Eigen::VectorXd use = use_of(fields, drivers_in(frames, fields));
    std::vector<std::pair<double, std::size_t>> by_worth;
    for (std::size_t t = 0; t < fields.size(); ++t)
        by_worth.emplace_back(
            -use[static_cast<long>(t)] * area.dot(fields[t].field.rowwise().squaredNorm()), t);
    std::stable_sort(by_worth.begin(), by_worth.end());
    const auto most = static_cast<std::size_t>(how.most);
    if (by_worth.size() > most) by_worth.resize(most);
    std::sort(by_worth.begin(), by_worth.end(),
              [](const auto& x, const auto& y) { return x.second < y.second; });
    std::vector<DriverField> kept;
    for (const auto& [worth, t] : by_worth) kept.push_back(std::move(fields[t]));

    LowRank out;
    if (kept.empty()) return out;
    Stack stack = stacked(kept, frames, rest.rows());
    fit(stack, frames, drivers_in(frames, kept), how.ridge_weight);
    for (std::size_t t = 0; t < kept.size(); ++t)
        for (std::size_t i = 0; i < stack.vertex.size(); ++i)
            kept[t].field.row(stack.vertex[i]) = stack.column.col(static_cast<long>(t))
                                                     .segment<3>(3 * static_cast<long>(i))
                                                     .transpose();
    std::vector<Points> whole;
    for (const DriverField& one : kept) whole.push_back(one.field);
    std::vector<SparseShape> shapes;
    out.bytes = fade_to_budget(whole, how, shapes);
    const auto all = static_cast<long>(kept.size());
    const Eigen::MatrixXd values = drivers_in(frames, kept);
    fit_again(shapes, whole,
              wanted_of(stack, values, use_of(kept, values), Eigen::MatrixXd::Identity(all, all)),
              stack);
    for (std::size_t t = 0; t < kept.size(); ++t)
        if (!shapes[t].empty()) {
            out.drivers.push_back(std::move(kept[t].driver));
            out.correctives.push_back({out.drivers.back().target_name(), std::move(shapes[t]), {}});
        }
    const auto count = static_cast<long>(out.drivers.size());
    for (long c = 0; c < count; ++c)
        out.correctives[static_cast<std::size_t>(c)].of_drivers = Eigen::VectorXd::Unit(count, c);
    return out;
}

}  // namespace risorius::blendshapes
