// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/skin_surface.h"

#include "risorius/geom/surface_topology.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::face {

namespace {

constexpr int kSteps = 2;
constexpr double kMinArea_m2 = 1e-12;
// A membrane stretched by half has three times its curvature at rest. The matrix has twice that at rest, since steps may be too long by
// a factor of two.
constexpr int kStretchReserve = 2;

}  // namespace

SkinSurface::SkinSurface(const SkinSheetOnBed& sheet) {
    const auto at = [&](int v) { return Vec3(sheet.rest.row(v).transpose()); };
    std::vector<int> own(static_cast<std::size_t>(sheet.rest.rows()), -1);
    Triangles triangles(sheet.triangles.rows(), 3);
    std::vector<double> area;
    for (long f = 0; f < sheet.triangles.rows(); ++f) {
        const int a = sheet.triangles(f, 0), b = sheet.triangles(f, 1), c = sheet.triangles(f, 2);
        const double of_face = 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).norm();
        if (of_face < kMinArea_m2) continue;
        for (int k = 0; k < 3; ++k) {
            const int v = sheet.triangles(f, k);
            if (own[v] < 0) {
                own[v] = static_cast<int>(vertex_.size());
                vertex_.push_back(v);
            }
            triangles(static_cast<long>(area.size()), k) = own[v];
        }
        area.push_back(of_face);
    }
    triangles.conservativeResize(static_cast<long>(area.size()), 3);
    const auto count = static_cast<int>(vertex_.size());
    if (count == 0) return;

    Points rest(count, 3);
    for (int i = 0; i < count; ++i) {
        rest.row(i) = sheet.rest.row(vertex_[i]);
        held_.push_back(sheet.held[vertex_[i]]);
    }
    const geom::SurfaceEdges edges = geom::surface_edges(triangles);
    for (int e = 0; e < edges.count(); ++e)
        if (edges.triangle_count(e) != 2)
            for (int v : edges.vertices[e]) held_[v] = 1;

    weight_.assign(static_cast<std::size_t>(count), 0.0);
    for (long f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            weight_[triangles(f, k)] += area[f] / 3 * sheet.bed_pa_per_m[vertex_[triangles(f, k)]];

    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(triangles.rows());
    sheet_.emplace(triangles, rest, sheet.membrane_n_per_m * ones, sheet.bending_n_m * ones);
    solve::MetricBuilder metric(count);
    for (int i = 0; i < count; ++i) metric.add_diagonal(i, weight_[i]);
    for (int i = 0; i < kStretchReserve; ++i) sheet_->add_metric(metric);
    factor_.emplace(metric.build(held_));
    p_.resize(count, 3);
    x_.resize(count, 3);
    gradient_.resize(count, 3);
}

void SkinSurface::relax(Points& vertices) const {
    const auto count = static_cast<long>(vertex_.size());
    if (count == 0) return;
    for (long i = 0; i < count; ++i) p_.row(i) = vertices.row(vertex_[i]);
    x_ = p_;
    for (int step = 0; step < kSteps; ++step) {
        for (long i = 0; i < count; ++i) gradient_.row(i) = weight_[i] * (x_.row(i) - p_.row(i));
        sheet_->add_energy(x_, gradient_);
        for (long i = 0; i < count; ++i)
            if (held_[i]) gradient_.row(i).setZero();
        factor_->solve(gradient_, gradient_);
        x_ -= gradient_;
    }
    for (long i = 0; i < count; ++i) vertices.row(vertex_[i]) = x_.row(i);
}

}  // namespace risorius::face
