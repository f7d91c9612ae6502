// SPDX-License-Identifier: MIT
#include "risorius/muscle/fibre_flow.h"

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <numeric>
#include <stdexcept>

#include "risorius/solve/sparse_cholesky.h"

namespace risorius::muscle {

namespace {

using Slopes = Eigen::Matrix<double, 4, 3>;

struct FlowTet {
    Slopes slope;  ///< of the shape functions, 1/m
    double volume_m3;
};

FlowTet flow_tet(const Points& rest, const Tets& tets, Eigen::Index t) {
    Mat3 edges;
    for (int k = 0; k < 3; ++k)
        edges.col(k) = (rest.row(tets(t, k + 1)) - rest.row(tets(t, 0))).transpose();
    FlowTet out;
    out.volume_m3 = edges.determinant() / 6;
    out.slope.bottomRows<3>() = edges.inverse();
    out.slope.row(0) = -out.slope.bottomRows<3>().colwise().sum();
    return out;
}

/// Throws unless every part of the muscle has nodes of both ends.
void check_joined(const Tets& tets, const std::vector<char>& origin,
                  const std::vector<char>& insertion) {
    std::vector<int> above(origin.size());
    std::iota(above.begin(), above.end(), 0);
    const auto top = [&](int i) {
        while (above[static_cast<std::size_t>(i)] != i)
            i = above[static_cast<std::size_t>(i)] =
                above[static_cast<std::size_t>(above[static_cast<std::size_t>(i)])];
        return i;
    };
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        for (int k = 1; k < 4; ++k)
            above[static_cast<std::size_t>(top(tets(t, k)))] = top(tets(t, 0));
    std::vector<char> ends(origin.size(), 0);
    for (std::size_t i = 0; i < origin.size(); ++i)
        ends[static_cast<std::size_t>(top(static_cast<int>(i)))] |=
            static_cast<char>((origin[i] ? 1 : 0) | (insertion[i] ? 2 : 0));
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        if (ends[static_cast<std::size_t>(top(tets(t, 0)))] != 3)
            throw std::invalid_argument("fibre_flow: a tetrahedron is not joined to both ends");
}

}  // namespace

Points flow_gradients(const Points& rest, const Tets& tets, const std::vector<char>& origin,
                      const std::vector<char>& insertion) {
    check_joined(tets, origin, insertion);
    const auto nodes = static_cast<std::size_t>(rest.rows());
    std::vector<int> row(nodes, -1);
    int unknowns = 0;
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(tets(t, k));
            if (row[i] < 0 && !origin[i] && !insertion[i]) row[i] = unknowns++;
        }
    std::vector<Eigen::Triplet<double>> entries;
    Points flow = Points::Zero(unknowns, 3);  // in its first column
    for (Eigen::Index t = 0; t < tets.rows(); ++t) {
        const FlowTet tet = flow_tet(rest, tets, t);
        const Eigen::Matrix4d block = tet.volume_m3 * tet.slope * tet.slope.transpose();
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) {
                const auto i = static_cast<std::size_t>(tets(t, a)),
                           j = static_cast<std::size_t>(tets(t, b));
                if (row[i] < 0) continue;
                if (row[j] >= 0)
                    entries.emplace_back(row[i], row[j], block(a, b));
                else if (insertion[j])
                    flow(row[i], 0) -= block(a, b);
            }
    }
    if (unknowns > 0) {
        Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
        matrix.setFromTriplets(entries.begin(), entries.end());
        solve::SparseCholesky(matrix).solve(flow, flow);
    }
    Points out(tets.rows(), 3);
    for (Eigen::Index t = 0; t < tets.rows(); ++t) {
        const Slopes slope = flow_tet(rest, tets, t).slope;
        Vec3 direction = Vec3::Zero();
        for (int k = 0; k < 4; ++k) {
            const auto i = static_cast<std::size_t>(tets(t, k));
            const double p = row[i] >= 0 ? flow(row[i], 0) : insertion[i] ? 1.0 : 0.0;
            direction += p * slope.row(k).transpose();
        }
        out.row(t) = direction.transpose();
    }
    return out;
}

Points fibre_flow(const Points& rest, const Tets& tets, const std::vector<char>& origin,
                  const std::vector<char>& insertion) {
    Points out = flow_gradients(rest, tets, origin, insertion);
    for (Eigen::Index t = 0; t < tets.rows(); ++t) {
        const double length = out.row(t).norm();
        if (!(length > 1e-12 * flow_tet(rest, tets, t).slope.row(1).norm()))
            throw std::invalid_argument("fibre_flow: nothing flows in a tetrahedron");
        out.row(t) /= length;
    }
    return out;
}

}  // namespace risorius::muscle
