// SPDX-License-Identifier: MIT
#include "risorius/tissue/cell_body.h"

#include <cassert>
#include <stdexcept>
#include <utility>

namespace risorius::tissue {

namespace {

/// Converts per-node parameters of the original model to the resolution-independent ones of eq. (10).
SolidMaterial resolution_independent(SolidMaterial material, const GridSolid& solid) {
    if (solid.parameters == Parameters::kResolutionIndependent) return material;
    const Mat3 per_node = per_node_tensor(Mat3::Ones(), solid.grid);
    material.elastic_n_per_m3 = material.elastic_n_per_m3.cwiseQuotient(per_node);
    material.damping_ns_per_m3 = material.damping_ns_per_m3.cwiseQuotient(per_node);
    material.incompressibility_n_per_m5 *=
        (solid.grid.m - 1.0) * (solid.grid.n - 1.0) * (solid.grid.o - 1.0);
    return material;
}

/// A point's position in the description's grid: the eight nodes of its cell and their trilinear weights.
struct GridPlace {
    int node[8];
    std::array<double, 8> weight;

    GridPlace(const GridShape& grid, const Vec3& a) {
        int low[3];
        Vec3 s;
        for (int axis = 0; axis < 3; ++axis) {
            const int cells = grid.along(axis) - 1;
            const double at = std::min(std::max(a[axis], 0.0), 1.0) * cells;
            low[axis] = std::min(static_cast<int>(at), cells - 1);
            s[axis] = at - low[axis];
        }
        weight = trilinear_weights(s);
        for (int c = 0; c < 8; ++c)
            node[c] = grid.index(low[0] + (c >> 2 & 1), low[1] + (c >> 1 & 1), low[2] + (c & 1));
    }
};

SolidMaterial material_at(const GridSolid& solid, const Vec3& a) {
    if (solid.material.size() == 1) return solid.material.front();
    const GridPlace place(solid.grid, a);
    SolidMaterial sum;
    sum.mass_kg = 0;
    for (int c = 0; c < 8; ++c) {
        const double w = place.weight[static_cast<std::size_t>(c)];
        const SolidMaterial& material = material_of(solid, place.node[c]);
        sum.elastic_n_per_m3 += w * material.elastic_n_per_m3;
        sum.damping_ns_per_m3 += w * material.damping_ns_per_m3;
        sum.incompressibility_n_per_m5 += w * material.incompressibility_n_per_m5;
        sum.mass_kg += w * material.mass_kg;
        sum.drag_ns_per_m += w * material.drag_ns_per_m;
    }
    return sum;
}

Vec3 rest_at(const GridSolid& solid, const Vec3& a) {
    const GridPlace place(solid.grid, a);
    Vec3 sum = Vec3::Zero();
    for (int c = 0; c < 8; ++c)
        sum +=
            place.weight[static_cast<std::size_t>(c)] * solid.rest.row(place.node[c]).transpose();
    return sum;
}

Points rest_of_nodes(const CellMesh& mesh, const RestShape& rest) {
    Points x(mesh.node_count(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        x.row(i) = rest(mesh.material_coordinates().row(i).transpose()).transpose();
    return x;
}

/// Spreads `amount` of a cell over its corners, and from hanging corners on to their nodes.
void share_out(const CellMesh& mesh, std::size_t cell, double amount, Eigen::VectorXd& nodes) {
    const CellMesh::Support support = mesh.support(mesh.cells()[cell]);
    const Eigen::RowVectorXd fractions = support.weight.colwise().sum() * (amount / 8);
    for (std::size_t k = 0; k < support.node.size(); ++k)
        nodes[support.node[k]] += fractions[static_cast<Eigen::Index>(k)];
}

}  // namespace

CellBody cell_body(const GridSolid& solid, CellMesh mesh, MassFractions fractions,
                   const RestShape& rest) {
    CellBody body{std::move(mesh), {}, {}, {}, {}, {}};
    body.rest = rest_of_nodes(
        body.mesh, rest ? rest : [&](const Vec3& a) -> Vec3 { return rest_at(solid, a); });
    const int nodes = body.mesh.node_count();
    const auto& cells = body.mesh.cells();
    body.mass_kg.setZero(nodes);
    body.drag_ns_per_m.setZero(nodes);
    std::vector<SolidMaterial> sampled;
    for (const CellMesh::Cell& cell : cells) {
        sampled.push_back(
            resolution_independent(material_at(solid, cell.low + 0.5 * cell.size), solid));
        body.parameters.push_back({sampled.back().elastic_n_per_m3,
                                   sampled.back().damping_ns_per_m3,
                                   sampled.back().incompressibility_n_per_m5});
    }
    const Eigen::VectorXd described_drag = node_drag(solid);
    if (fractions == MassFractions::kNodes) {
        if (!body.mesh.uniform())
            throw std::invalid_argument("the same mass on every node needs a uniform mesh");
        for (int i = 0; i < nodes; ++i) {
            const SolidMaterial here =
                material_at(solid, body.mesh.material_coordinates().row(i).transpose());
            body.mass_kg[i] = here.mass_kg / nodes;
            body.drag_ns_per_m[i] = here.drag_ns_per_m * solid.grid.size() / nodes;
        }
    } else {
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const double fraction = cells[c].size.prod();
            share_out(body.mesh, c, fraction * sampled[c].mass_kg, body.mass_kg);
            share_out(body.mesh, c, fraction * sampled[c].drag_ns_per_m * solid.grid.size(),
                      body.drag_ns_per_m);
        }
    }
    // Corrects the totals, which sampling has changed.
    body.mass_kg *= node_mass(solid).sum() / body.mass_kg.sum();
    if (described_drag.sum() > 0 && body.drag_ns_per_m.sum() > 0)
        body.drag_ns_per_m *= described_drag.sum() / body.drag_ns_per_m.sum();
    return body;
}

CellBody cell_body(const GridSolid& solid) {
    return cell_body(solid, uniform_cells(solid.grid), MassFractions::kNodes);
}

CellBody cell_body(CellMesh mesh, const RestShape& rest, const CellModuli& moduli,
                   double density_kg_per_m3) {
    CellBody body{std::move(mesh), {}, {}, {}, {}, {}};
    body.rest = rest_of_nodes(body.mesh, rest);
    body.moduli.assign(body.mesh.cells().size(), moduli);
    body.mass_kg.setZero(body.mesh.node_count());
    body.drag_ns_per_m.setZero(body.mesh.node_count());
    Points vertices(body.mesh.vertex_count(), 3);
    vertices.topRows(body.rest.rows()) = body.rest;
    body.mesh.spread(vertices);
    for (std::size_t c = 0; c < body.mesh.cells().size(); ++c)
        share_out(body.mesh, c, density_kg_per_m3 * cell_volume(body.mesh.cells()[c], vertices),
                  body.mass_kg);
    return body;
}

double cell_volume(const CellMesh::Cell& cell, const Points& vertices) {
    // The map r is a sum of trilinear modes; terms that are odd in a coordinate integrate to zero.
    Vec3 mode[8];
    for (std::size_t m = 0; m < 8; ++m) {
        mode[m].setZero();
        for (std::size_t c = 0; c < 8; ++c) {
            // Number of signs that are -1.
            const int low = __builtin_popcount(static_cast<unsigned>(m & ~c));
            mode[m] += (low % 2 ? -0.125 : 0.125) * vertices.row(cell.vertex[c]).transpose();
        }
    }
    const Vec3 &a = mode[4], &b = mode[2], &c = mode[1], &d = mode[6], &e = mode[5], &f = mode[3];
    return 8 *
           (a.dot(b.cross(c)) + (a.dot(d.cross(e)) + b.dot(f.cross(d)) + c.dot(e.cross(f))) / 3);
}

}  // namespace risorius::tissue
