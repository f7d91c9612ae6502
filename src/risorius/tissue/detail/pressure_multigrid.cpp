// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/pressure_multigrid.h"

#include <algorithm>
#include <cmath>

namespace risorius::tissue::detail {

namespace {

int index_behind(int i, int j, int k) {
    for (int q = 0; q < 13; ++q)
        if (kBehind[q][0] == i && kBehind[q][1] == j && kBehind[q][2] == k) return q;
    return -1;
}

}  // namespace

PressureMultigrid::Level::Level(const GridShape& nodes)
    : grid{nodes},
      diagonal(grid),
      compliance(grid),
      inverse(grid),
      b(grid),
      x(grid),
      z(grid),
      r(grid) {
    behind.fill(Field(grid));
}

PressureMultigrid::PressureMultigrid(const GridShape& nodes, int coarsest_cells) {
    GridShape shape = nodes;
    for (;;) {
        levels_.emplace_back(shape);
        const int cells = (shape.m - 1) * (shape.n - 1) * (shape.o - 1);
        if (cells <= std::max(coarsest_cells, 1)) break;
        const auto halved = [](int along) { return along / 2 + 1; };
        shape = {halved(shape.m), halved(shape.n), halved(shape.o)};
    }
    for (int i = 0; i + 1 < shape.m; ++i)
        for (int j = 0; j + 1 < shape.n; ++j)
            for (int k = 0; k + 1 < shape.o; ++k)
                coarsest_.push_back(levels_.back().grid.distance(i, j, k));
}

// r -= S x
void PressureMultigrid::subtract_product(const Level& level, const Field& x, Field& r) const {
    const int size = level.grid.size();
    std::array<std::ptrdiff_t, 13> away;
    std::array<const float*, 13> entry;
    for (std::size_t q = 0; q < 13; ++q) {
        away[q] = level.grid.distance(kBehind[q][0], kBehind[q][1], kBehind[q][2]);
        entry[q] = level.behind[q].data();
    }
    const float *const from = x.data(), *const d = level.diagonal.data();
    float* const to = r.data();
    for (int c = 0; c < size; c += 8) {
        Lanes8 behind = load8(d + c) * load8(from + c), before{};
        for (std::size_t q = 0; q < 13; ++q) {
            behind += load8(entry[q] + c) * load8(from + c + away[q]);
            before += load8(entry[q] + c - away[q]) * load8(from + c - away[q]);
        }
        store8(to + c, load8(to + c) - (behind + before));
    }
}

void PressureMultigrid::coarsen(Level& from, Level& to) const {
    // The coarse entry that an entry is added to depends on where in its group of eight the cell lies.
    struct Target {
        int neighbour;  ///< -1: both cells are in the same group
        bool turned;    ///< the entry belongs to the parent of the other cell
    };
    Target target[8][13];
    for (int parity = 0; parity < 8; ++parity)
        for (int q = 0; q < 13; ++q) {
            int away[3];
            for (int axis = 0; axis < 3; ++axis) {
                const int at = (parity >> (2 - axis) & 1) + kBehind[q][axis];
                away[axis] = at < 0 ? -1 : at / 2;
            }
            const int straight = index_behind(away[0], away[1], away[2]);
            const int turned = index_behind(-away[0], -away[1], -away[2]);
            target[parity][q] = {std::max(straight, turned), turned >= 0};
        }

    // The sum of a row holds the border in place and needs no factor, because nothing jumps there; r = - S 1.
    for (int c = 0; c < from.grid.size(); ++c) from.x[c] = from.diagonal[c] > 0 ? 1.0f : 0.0f;
    from.r.set_zero();
    subtract_product(from, from.x, from.r);

    to.diagonal.set_zero();
    to.compliance.set_zero();
    for (Field& field : to.behind) field.set_zero();
    const GridShape& shape = from.grid.nodes;
    for (int i = 0; i + 1 < shape.m; ++i)
        for (int j = 0; j + 1 < shape.n; ++j)
            for (int k = 0; k + 1 < shape.o; ++k) {
                const int c = from.grid.distance(i, j, k);
                const int parent = to.grid.distance(i / 2, j / 2, k / 2);
                to.compliance[parent] += from.compliance[c];
                float diagonal = 0.5f * (from.diagonal[c] - from.r[c]);
                const Target* const targets = target[4 * (i & 1) + 2 * (j & 1) + (k & 1)];
                for (int q = 0; q < 13; ++q) {
                    const float entry = from.behind[static_cast<std::size_t>(q)][c];
                    const auto [neighbour, turned] = targets[q];
                    if (neighbour < 0) {
                        diagonal += entry;
                        continue;
                    }
                    if (entry == 0) continue;
                    const int* const step = kBehind[q];
                    const int at = turned ? to.grid.distance((i + step[0]) / 2, (j + step[1]) / 2,
                                                             (k + step[2]) / 2)
                                          : parent;
                    to.behind[static_cast<std::size_t>(neighbour)][at] += 0.5f * entry;
                }
                to.diagonal[parent] += diagonal;
            }
}

void PressureMultigrid::refresh(const Field& compliance) {
    levels_.front().compliance = compliance;
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        if (l + 1 < levels_.size()) coarsen(level, levels_[l + 1]);
        const int size = level.grid.size();
        for (int c = 0; c < size; ++c) level.diagonal[c] += level.compliance[c];
        // Gershgorin bound
        std::array<std::ptrdiff_t, 13> away;
        for (std::size_t q = 0; q < 13; ++q)
            away[q] = level.grid.distance(kBehind[q][0], kBehind[q][1], kBehind[q][2]);
        Lanes8 largest{};
        const auto magnitude = [](const Lanes8& a) { return a < 0.0f ? -a : a; };
        for (int c = 0; c < size; c += 8) {
            const Lanes8 d = load8(level.diagonal.data() + c);
            const Lanes8 inverse = d > 0.0f ? 1.0f / d : Lanes8{};
            store8(level.inverse.data() + c, inverse);
            Lanes8 sum = d;
            for (std::size_t q = 0; q < 13; ++q)
                sum += magnitude(load8(level.behind[q].data() + c)) +
                       magnitude(load8(level.behind[q].data() + c - away[q]));
            sum *= inverse;
            largest = sum > largest ? sum : largest;
        }
        level.largest = 0;
        for (int lane = 0; lane < 8; ++lane) level.largest = std::max(level.largest, largest[lane]);
    }
    const Level& last = levels_.back();
    const auto count = static_cast<Eigen::Index>(coarsest_.size());
    Eigen::MatrixXf dense = Eigen::MatrixXf::Zero(count, count);
    const GridShape& shape = last.grid.nodes;
    const auto cell = [&](int i, int j, int k) {
        return (i * (shape.n - 1) + j) * (shape.o - 1) + k;
    };
    for (int i = 0; i + 1 < shape.m; ++i)
        for (int j = 0; j + 1 < shape.n; ++j)
            for (int k = 0; k + 1 < shape.o; ++k) {
                const int c = last.grid.distance(i, j, k);
                const Eigen::Index at = cell(i, j, k);
                dense(at, at) = last.diagonal[c];
                for (std::size_t q = 0; q < 13; ++q)
                    if (last.behind[q][c] != 0)
                        dense(cell(i + kBehind[q][0], j + kBehind[q][1], k + kBehind[q][2]), at) =
                            last.behind[q][c];
            }
    direct_.compute(dense);
}

// x += polynomial(D^-1 S) D^-1 r. r must be the residual of x; it is updated when asked for.
void PressureMultigrid::smooth(Level& level, int degree, bool residual_after) const {
    const int size = level.grid.size();
    float *const x = level.x.data(), *const z = level.z.data();
    const float *const r = level.r.data(), *const inverse = level.inverse.data();
    for (int i = 1; i <= degree; ++i) {
        const float keep = static_cast<float>(2 * i - 3) / static_cast<float>(2 * i + 1);
        const float take =
            static_cast<float>(8 * i - 4) / (static_cast<float>(2 * i + 1) * level.largest);
        if (i == 1)
            for (int c = 0; c < size; c += 8)
                store8(z + c, take * (load8(inverse + c) * load8(r + c)));
        else
            for (int c = 0; c < size; c += 8)
                store8(z + c, keep * load8(z + c) + take * (load8(inverse + c) * load8(r + c)));
        for (int c = 0; c < size; c += 8) store8(x + c, load8(x + c) + load8(z + c));
        if (i < degree || residual_after) subtract_product(level, level.z, level.r);
    }
}

// Along one axis, fine cell c lies a quarter of the way from coarse cell c/2 to the next coarse cell on the same side.
void PressureMultigrid::restrict_residual(Level& from, Level& to) const {
    const GridShape &fine = from.grid.nodes, &coarse = to.grid.nodes;
    const int m = fine.m - 1, n = fine.n - 1, o = fine.o - 1;
    const int M = coarse.m - 1, N = coarse.n - 1, O = coarse.o - 1;
    const auto beside = [](int c, int count) {
        return std::clamp(c / 2 + ((c & 1) ? 1 : -1), 0, count - 1);
    };
    from.along_k.assign(static_cast<std::size_t>(m * n * O), 0.0f);
    from.along_jk.assign(static_cast<std::size_t>(m * N * O), 0.0f);
    for (int ij = 0; ij < m * n; ++ij) {
        const float* const r = from.r.data() + from.grid.distance(ij / n, ij % n, 0);
        float* const sum = from.along_k.data() + ij * O;
        for (int k = 0; k < o; ++k) {
            sum[k / 2] += 0.75f * r[k];
            sum[beside(k, O)] += 0.25f * r[k];
        }
    }
    const auto add = [](float* sum, float weight, const float* row, int count) {
        for (int k = 0; k < count; ++k) sum[k] += weight * row[k];
    };
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j) {
            const float* const row = from.along_k.data() + (i * n + j) * O;
            add(from.along_jk.data() + (i * N + j / 2) * O, 0.75f, row, O);
            add(from.along_jk.data() + (i * N + beside(j, N)) * O, 0.25f, row, O);
        }
    to.b.set_zero();
    for (int i = 0; i < m; ++i)
        for (int J = 0; J < N; ++J) {
            const float* const row = from.along_jk.data() + (i * N + J) * O;
            add(to.b.data() + to.grid.distance(i / 2, J, 0), 0.75f, row, O);
            add(to.b.data() + to.grid.distance(beside(i, M), J, 0), 0.25f, row, O);
        }
}

void PressureMultigrid::add_prolonged(Level& to, Level& from) const {
    const GridShape &fine = to.grid.nodes, &coarse = from.grid.nodes;
    const int m = fine.m - 1, n = fine.n - 1, o = fine.o - 1;
    const int M = coarse.m - 1, N = coarse.n - 1, O = coarse.o - 1;
    const auto beside = [](int c, int count) {
        return std::clamp(c / 2 + ((c & 1) ? 1 : -1), 0, count - 1);
    };
    const auto blend = [](float* row, const float* near, const float* far, int count) {
        for (int k = 0; k < count; ++k) row[k] = 0.75f * near[k] + 0.25f * far[k];
    };
    for (int i = 0; i < m; ++i)
        for (int J = 0; J < N; ++J)
            blend(to.along_jk.data() + (i * N + J) * O,
                  from.x.data() + from.grid.distance(i / 2, J, 0),
                  from.x.data() + from.grid.distance(beside(i, M), J, 0), O);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < n; ++j)
            blend(to.along_k.data() + (i * n + j) * O, to.along_jk.data() + (i * N + j / 2) * O,
                  to.along_jk.data() + (i * N + beside(j, N)) * O, O);
    for (int ij = 0; ij < m * n; ++ij) {
        float* const x = to.x.data() + to.grid.distance(ij / n, ij % n, 0);
        const float* const row = to.along_k.data() + ij * O;
        for (int k = 0; k < o; ++k) x[k] += 0.75f * row[k / 2] + 0.25f * row[beside(k, O)];
    }
}

// Replaces x of the level by one cycle's approximate solution for b of the level.
void PressureMultigrid::cycle(std::size_t l, int degree) {
    Level& level = levels_[l];
    if (l + 1 == levels_.size()) {
        Eigen::VectorXf v(static_cast<Eigen::Index>(coarsest_.size()));
        for (std::size_t c = 0; c < coarsest_.size(); ++c)
            v[static_cast<Eigen::Index>(c)] = level.b[coarsest_[c]];
        direct_.solveInPlace(v);
        for (std::size_t c = 0; c < coarsest_.size(); ++c)
            level.x[coarsest_[c]] = v[static_cast<Eigen::Index>(c)];
        return;
    }
    level.x.set_zero();
    level.r = level.b;
    smooth(level, degree, /*residual_after=*/true);
    restrict_residual(level, levels_[l + 1]);
    cycle(l + 1, degree);
    add_prolonged(level, levels_[l + 1]);
    level.r = level.b;
    subtract_product(level, level.x, level.r);
    smooth(level, degree, /*residual_after=*/false);
}

void PressureMultigrid::solve(const Field& t, int degree, Field& q) {
    levels_.front().b = t;
    cycle(0, degree);
    q = levels_.front().x;
}

}  // namespace risorius::tissue::detail
