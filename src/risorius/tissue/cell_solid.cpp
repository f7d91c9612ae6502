// SPDX-License-Identifier: MIT
#include "risorius/tissue/cell_solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "risorius/tissue/detail/cell_kernel.h"
#include "risorius/tissue/detail/cell_point.h"

namespace risorius::tissue {

using detail::CellCorners;
using solve::ImplicitStep;

CellSolid::CellSolid(CellBody body) : body_(std::move(body)) {
    const CellMesh& mesh = body_.mesh;
    const auto cells = mesh.cells().size();
    if (body_.rest.rows() != mesh.node_count())
        throw std::invalid_argument("CellSolid: one rest position per node is needed");
    if (body_.parameters.size() != (body_.parameters.empty() ? 0 : cells) ||
        body_.moduli.size() != (body_.parameters.empty() ? cells : 0))
        throw std::invalid_argument("CellSolid: parameters or moduli, one per cell, are needed");
    rest_vertices_ = vertices(body_.rest);
    rest_volume_ = cell_volumes(body_.rest);
    for (std::size_t c = 0; c < cells; ++c)
        if (!(rest_volume_[static_cast<Eigen::Index>(c)] > 0))
            throw std::invalid_argument("CellSolid: cell " + std::to_string(c) +
                                        " has no positive volume at rest");
    kernel_ = std::make_unique<detail::CellKernel>(body_, rest_vertices_, rest_volume_);
}

CellSolid::~CellSolid() = default;

Points CellSolid::vertices(const Points& x) const {
    assert(x.rows() == mesh().node_count());
    Points all(mesh().vertex_count(), 3);
    all.topRows(x.rows()) = x;
    mesh().spread(all);
    return all;
}

Eigen::VectorXd CellSolid::cell_volumes(const Points& x) const {
    const Points all = vertices(x);
    Eigen::VectorXd volume(static_cast<Eigen::Index>(mesh().cells().size()));
    for (std::size_t c = 0; c < mesh().cells().size(); ++c)
        volume[static_cast<Eigen::Index>(c)] = cell_volume(mesh().cells()[c], all);
    return volume;
}

double CellSolid::volume(const Points& x) const { return cell_volumes(x).sum(); }

int CellSolid::inverted_count(const Points& x) const {
    return static_cast<int>((cell_volumes(x).array() <= 0).count());
}

void CellSolid::add_force(double /*t_s*/, const Points& x, const Points& v, Points& force) const {
    Points gradient = Points::Zero(x.rows(), 3);
    kernel_->add_gradient(body_.mesh, x, &v, gradient);
    force -= gradient;
}

double CellSolid::energy(double /*t_s*/, const Points& x) const {
    Points gradient = Points::Zero(x.rows(), 3);
    return kernel_->add_gradient(body_.mesh, x, nullptr, gradient);
}

double CellSolid::add_potential(const ImplicitStep& step, const Points& x, Points& gradient) const {
    return kernel_->add_potential(body_.mesh, step, x, gradient);
}

detail::CellMaterialLaw CellSolid::law(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    if (body_.moduli.empty()) return detail::CellMaterialLaw(body_.parameters[c]);
    return detail::CellMaterialLaw(body_.moduli[c]);
}

void CellSolid::add_hessian(const ImplicitStep& step, const Points& x, solve::Curvature curvature,
                            solve::HessianBuilder& hessian) const {
    const Points now = vertices(x);
    const bool damped = std::isfinite(step.step_s);
    const Points start = damped ? vertices(step.start) : Points();
    detail::CellStiffness stiffness;
    for (int c = 0; c < static_cast<int>(mesh().cells().size()); ++c) {
        const CellMesh::Cell& cell = mesh().cells()[static_cast<std::size_t>(c)];
        const CellCorners corners(cell, now), rest(cell, rest_vertices_);
        detail::RateReference rate;
        if (damped) rate = {step.rate_hz(), CellCorners(cell, start)};
        detail::cell_stiffness(law(c), cell.size, rest, corners, damped ? &rate : nullptr,
                               curvature, stiffness);
        const CellMesh::Support support = mesh().support(cell);
        const int count = static_cast<int>(support.node.size());
        if (support.plain) {
            hessian.add_dense(support.node.data(), 8, stiffness.data());
            continue;
        }
        // P^T K P, block by block
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> onto =
            Eigen::MatrixXd::Zero(24, 3 * count);
        for (int v = 0; v < 8; ++v)
            for (int k = 0; k < count; ++k)
                onto.block<3, 3>(3 * v, 3 * k) = support.weight(v, k) * Mat3::Identity();
        const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> reduced =
            onto.transpose() * stiffness * onto;
        hessian.add_dense(support.node.data(), count, reduced.data());
    }
}

namespace {

void add_scalar(const CellMesh& mesh, const CellMesh::Cell& cell,
                const Eigen::Matrix<double, 8, 8, Eigen::RowMajor>& matrix,
                solve::MetricBuilder& builder) {
    const CellMesh::Support support = mesh.support(cell);
    if (support.plain) {
        builder.add_block(support.node.data(), matrix.data(), 8);
        return;
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> reduced =
        support.weight.transpose() * matrix * support.weight;
    builder.add_block(support.node.data(), reduced.data(), static_cast<int>(support.node.size()));
}

}  // namespace

void CellSolid::add_metric(double step_s, solve::MetricBuilder& metric) const {
    for (int c = 0; c < static_cast<int>(mesh().cells().size()); ++c) {
        const CellMesh::Cell& cell = mesh().cells()[static_cast<std::size_t>(c)];
        add_scalar(
            mesh(), cell,
            detail::cell_metric(law(c), cell.size, CellCorners(cell, rest_vertices_), 1.0 / step_s),
            metric);
    }
}

void CellSolid::add_secant(double /*t_s*/, const Points& x, const Points& v, bool lag_rate,
                           solve::MetricBuilder& K, solve::MetricBuilder& /*damping*/,
                           Points& force) const {
    const Points now = vertices(x), speed = vertices(v);
    Points left = Points::Zero(now.rows(), 3);  // forces on the vertices that are not part of K
    for (int c = 0; c < static_cast<int>(mesh().cells().size()); ++c) {
        const CellMesh::Cell& cell = mesh().cells()[static_cast<std::size_t>(c)];
        const detail::CellSecant secant =
            detail::cell_secant(law(c), cell.size, CellCorners(cell, rest_vertices_),
                                CellCorners(cell, now), CellCorners(cell, speed), lag_rate);
        add_scalar(mesh(), cell, secant.matrix, K);
        for (int k = 0; k < 8; ++k)
            left.row(cell.vertex[static_cast<std::size_t>(k)]) += secant.force.row(k);
    }
    for (std::size_t h = 0; h < mesh().hanging().size(); ++h) {
        const CellMesh::Hanging& hanging = mesh().hanging()[h];
        for (int k = 0; k < hanging.count; ++k)
            left.row(hanging.node[static_cast<std::size_t>(k)]) +=
                left.row(mesh().node_count() + static_cast<Eigen::Index>(h)) / hanging.count;
    }
    force += left.topRows(mesh().node_count());
}

void CellSolid::metric_strain(const Points& vertices, int cell, Mat3 (&strain)[8]) const {
    const CellMesh::Cell& c = mesh().cells()[static_cast<std::size_t>(cell)];
    const CellCorners now(c, vertices), rest(c, rest_vertices_);
    for (int g = 0; g < 8; ++g)
        strain[g] = detail::metric_at(now, c.size, g) - detail::metric_at(rest, c.size, g);
}

Mat3 CellSolid::deformation_gradient(const Points& vertices, int cell) const {
    const CellMesh::Cell& c = mesh().cells()[static_cast<std::size_t>(cell)];
    const CellCorners now(c, vertices), rest(c, rest_vertices_);
    Mat3 tangents = Mat3::Zero(), tangents_at_rest = Mat3::Zero();
    for (int g = 0; g < 8; ++g) {
        tangents += 0.125 * detail::tangents_at(now, c.size, g);
        tangents_at_rest += 0.125 * detail::tangents_at(rest, c.size, g);
    }
    return tangents * tangents_at_rest.inverse();
}

Mat3 CellSolid::inverse_rest_metric(int cell) const {
    const CellMesh::Cell& c = mesh().cells()[static_cast<std::size_t>(cell)];
    const CellCorners rest(c, rest_vertices_);
    Mat3 mean = Mat3::Zero();
    for (int g = 0; g < 8; ++g) mean += 0.125 * detail::tangents_at(rest, c.size, g);
    return (mean.transpose() * mean).inverse();
}

}  // namespace risorius::tissue
