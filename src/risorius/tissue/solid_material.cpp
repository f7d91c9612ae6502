// SPDX-License-Identifier: MIT
#include "risorius/tissue/solid_material.h"

#include <cassert>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/tissue/detail/material_checks.h"

namespace risorius::tissue {

namespace {

void check_material(const SolidMaterial& material, const std::string& place) {
    check_tensor(material.elastic_n_per_m3, place + "/elastic_n_per_m3");
    check_tensor(material.damping_ns_per_m3, place + "/damping_ns_per_m3");
    check_range(material.incompressibility_n_per_m5, /*zero_allowed=*/true,
                place + "/incompressibility_n_per_m5");
    check_range(material.mass_kg, /*zero_allowed=*/false, place + "/mass_kg");
    check_range(material.drag_ns_per_m, /*zero_allowed=*/true, place + "/drag_ns_per_m");
}

/// Volume spanned by the three grid edges that meet in a corner of a cell, oriented like the axes.
double corner_volume(const GridSolid& solid, const int cell[3], int corner) {
    const GridShape& grid = solid.grid;
    int at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis] = cell[axis] + ((corner >> axis) & 1);
    const auto position = [&](const int node[3]) -> Vec3 {
        return solid.rest.row(grid.index(node[0], node[1], node[2])).transpose();
    };
    Mat3 edges;
    for (int axis = 0; axis < 3; ++axis) {
        int along[3] = {at[0], at[1], at[2]};
        const int way = at[axis] == cell[axis] ? 1 : -1;
        along[axis] += way;
        edges.col(axis) = way * (position(along) - position(at));
    }
    return edges.determinant();
}

void check_not_folded(const GridSolid& solid, const std::string& place) {
    int cell[3];
    for (cell[0] = 0; cell[0] + 1 < solid.grid.m; ++cell[0])
        for (cell[1] = 0; cell[1] + 1 < solid.grid.n; ++cell[1])
            for (cell[2] = 0; cell[2] + 1 < solid.grid.o; ++cell[2])
                for (int corner = 0; corner < 8; ++corner) {
                    const double volume = corner_volume(solid, cell, corner);
                    if (!(volume > 0))
                        throw Error(place,
                                    "a shape that is nowhere folded, with a positive volume in "
                                    "each corner of every cell",
                                    shown(volume) + " m^3 in cell [" + std::to_string(cell[0]) +
                                        ", " + std::to_string(cell[1]) + ", " +
                                        std::to_string(cell[2]) + "]");
                }
}

}  // namespace

SolidMaterial isotropic_material(double elastic_n_per_m3, double damping_ns_per_m3,
                                 double incompressibility_n_per_m5, double mass_kg,
                                 double drag_ns_per_m) {
    SolidMaterial material;
    material.elastic_n_per_m3.setConstant(elastic_n_per_m3);
    material.damping_ns_per_m3.setConstant(damping_ns_per_m3);
    material.incompressibility_n_per_m5 = incompressibility_n_per_m5;
    material.mass_kg = mass_kg;
    material.drag_ns_per_m = drag_ns_per_m;
    return material;
}

Points block_rest(const GridShape& grid, const Vec3& size_m, const Rigid& place) {
    Points rest(grid.size(), 3);
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k) {
                const Vec3 a(i * grid.spacing(0), j * grid.spacing(1), k * grid.spacing(2));
                rest.row(grid.index(i, j, k)) = (place * size_m.cwiseProduct(a)).transpose();
            }
    return rest;
}

void check(const GridSolid& solid, const std::string& place) {
    const GridShape& grid = solid.grid;
    const char* const axis_name[3] = {"m", "n", "o"};
    for (int axis = 0; axis < 3; ++axis)
        if (grid.along(axis) < 2)
            throw Error(place + "/grid/" + axis_name[axis], "at least 2 nodes",
                        std::to_string(grid.along(axis)));
    const std::string sizes = std::to_string(grid.m) + " x " + std::to_string(grid.n) + " x " +
                              std::to_string(grid.o) + " = " + std::to_string(grid.size());

    if (solid.rest.rows() != grid.size())
        throw Error(place + "/rest", sizes + " points", std::to_string(solid.rest.rows()));
    for (int node = 0; node < grid.size(); ++node)
        if (!solid.rest.row(node).allFinite())
            throw Error(place + "/rest/" + std::to_string(node), "three finite numbers",
                        shown(Vec3(solid.rest.row(node))));
    check_not_folded(solid, place + "/rest");

    if (solid.material.size() == 1) {
        check_material(solid.material.front(), place + "/material");
        return;
    }
    if (static_cast<int>(solid.material.size()) != grid.size())
        throw Error(place + "/material", "1 material or " + sizes + ", one per node",
                    std::to_string(solid.material.size()));
    for (std::size_t node = 0; node < solid.material.size(); ++node)
        check_material(solid.material[node], place + "/material/" + std::to_string(node));
}

Mat3 per_node_tensor(const Mat3& tensor, const GridShape& grid) {
    // Inverse number of forward differences along the axis in the whole grid.
    Vec3 w;
    for (int axis = 0; axis < 3; ++axis)
        w[axis] = grid.along(axis) / (static_cast<double>(grid.size()) * (grid.along(axis) - 1));
    Mat3 eta;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) eta(i, j) = tensor(i, j) * 0.5 * (w[i] + w[j]);
    return eta;
}

const SolidMaterial& material_of(const GridSolid& solid, int node) {
    assert(!solid.material.empty());
    return solid.material.size() == 1 ? solid.material.front()
                                      : solid.material[static_cast<std::size_t>(node)];
}

Eigen::VectorXd node_mass(const GridSolid& solid) {
    const int nodes = solid.grid.size();
    Eigen::VectorXd mass(nodes);
    for (int node = 0; node < nodes; ++node) mass[node] = material_of(solid, node).mass_kg / nodes;
    return mass;
}

Eigen::VectorXd node_drag(const GridSolid& solid) {
    Eigen::VectorXd drag(solid.grid.size());
    for (int node = 0; node < solid.grid.size(); ++node)
        drag[node] = material_of(solid, node).drag_ns_per_m;
    return drag;
}

}  // namespace risorius::tissue
