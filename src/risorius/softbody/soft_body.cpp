// SPDX-License-Identifier: MIT
#include "risorius/softbody/soft_body.h"

#include <algorithm>
#include <cassert>
#include <memory>

#include "risorius/contact/obstacle_contact.h"
#include "risorius/contact/surface_samples.h"
#include "risorius/tissue/bending_cells.h"
#include "risorius/tissue/cell_body.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/difference_solid.h"
#include "risorius/tissue/drag.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/grid_curve.h"
#include "risorius/tissue/grid_point.h"
#include "risorius/tissue/grid_shape.h"
#include "risorius/tissue/grid_surface.h"
#include "risorius/tissue/triangle_sheet.h"

namespace risorius::softbody {
namespace {

/// The parts that each kind of body builds in its own way.
struct Matter {
    Points rest;
    Eigen::VectorXd mass_kg, drag_ns_per_m;
    std::shared_ptr<solve::EnergyTerm> inner;  ///< elasticity, damping, incompressibility
    Triangles surface;
    std::vector<std::array<int, 2>> wires;
};

Matter matter_of_solid(const BodyDescription& description) {
    const tissue::GridSolid solid = grid_solid(description);
    tissue::check(solid, description.place);
    Matter matter;
    matter.rest = solid.rest;
    matter.mass_kg = tissue::node_mass(solid);
    matter.drag_ns_per_m = tissue::node_drag(solid);
    if (description.discretisation == Discretisation::kBendingCells) {
        tissue::CellBody body = tissue::cell_body(solid);
        body.parameters.clear();
        body.moduli.assign(body.mesh.cells().size(),
                           {.mu_pa = description.moduli->elastic.shear_pa,
                            .bulk_pa = description.moduli->elastic.volume_pa,
                            .viscosity_pa_s = 0});
        matter.inner = std::make_shared<tissue::BendingCells>(std::move(body));
    } else if (description.discretisation == Discretisation::kCells) {
        matter.inner = std::make_shared<tissue::CellSolid>(tissue::cell_body(solid));
    } else {
        matter.inner = std::make_shared<tissue::DifferenceSolid>(solid, description.place);
    }
    matter.surface = tissue::surface_triangles(solid.grid);
    matter.wires = tissue::grid_lines(solid.grid);
    return matter;
}

/// The common parts of sheets and curves, without wires.
template <class Term, class Grid>
Matter matter_of_grid(const Grid& grid, const std::string& place) {
    tissue::check(grid, place);
    Matter matter;
    matter.rest = grid.rest;
    matter.mass_kg = tissue::node_mass(grid);
    matter.drag_ns_per_m = tissue::node_drag(grid);
    matter.inner = std::make_shared<Term>(grid);
    return matter;
}

Matter matter_of_surface(const BodyDescription& description) {
    const tissue::GridSurface surface = grid_surface(description);
    Matter matter = matter_of_grid<tissue::GridSurfaceTerm>(surface, description.place);
    matter.surface = tissue::surface_triangles(surface.grid);
    matter.wires = tissue::grid_lines(surface.grid);
    return matter;
}

Matter matter_of_triangles(const BodyDescription& description) {
    const tissue::TriangleSurface surface = triangle_surface(description);
    tissue::check(surface, description.place);
    Matter matter;
    matter.rest = surface.rest;
    matter.mass_kg = tissue::node_mass(surface);
    matter.drag_ns_per_m = tissue::node_drag(grid_surface(description));
    matter.inner = std::make_shared<tissue::TriangleSheetTerm>(surface);
    matter.surface = surface.triangles;
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] =
                std::minmax({surface.triangles(t, k), surface.triangles(t, (k + 1) % 3)});
            matter.wires.push_back({a, b});
        }
    std::sort(matter.wires.begin(), matter.wires.end());
    matter.wires.erase(std::unique(matter.wires.begin(), matter.wires.end()), matter.wires.end());
    return matter;
}

Matter matter_of_curve(const BodyDescription& description) {
    Matter matter =
        matter_of_grid<tissue::GridCurveTerm>(grid_curve(description), description.place);
    for (int i = 0; i + 1 < description.grid.m; ++i) matter.wires.push_back({i, i + 1});
    return matter;
}

Matter matter_of(const BodyDescription& description) {
    if (description.kind == Kind::kSolid) return matter_of_solid(description);
    if (description.kind == Kind::kCurve) return matter_of_curve(description);
    return description.discretisation == Discretisation::kTriangles
               ? matter_of_triangles(description)
               : matter_of_surface(description);
}

/// Wires of the grid that lie on the border of all axes but one.
std::vector<std::array<int, 2>> edges_of(const BodyDescription& description) {
    const tissue::GridShape& grid = description.grid;
    std::vector<std::array<int, 2>> edges;
    const auto add = [&](std::array<int, 3> at, int axis) {
        for (int other = 0; other < 3; ++other) {
            if (other == axis || grid.along(other) == 1) continue;
            // A tube is periodic: its last row is next to its first.
            if (description.kind == Kind::kCylinder && other == 1) return;
            if (at[static_cast<std::size_t>(other)] != 0 &&
                at[static_cast<std::size_t>(other)] != grid.along(other) - 1)
                return;
        }
        const int from = grid.index(at[0], at[1], at[2]);
        auto& step = at[static_cast<std::size_t>(axis)];
        step = (step + 1) % grid.along(axis);
        edges.push_back({from, grid.index(at[0], at[1], at[2])});
    };
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k) {
                if (i + 1 < grid.m) add({i, j, k}, 0);
                if (j + 1 < grid.n || (description.kind == Kind::kCylinder && grid.n > 1))
                    add({i, j, k}, 1);
                if (k + 1 < grid.o) add({i, j, k}, 2);
            }
    return edges;
}

/// A point by its material coordinates. A grid of one layer has no third axis, and in a tube the last row of nodes is next to
/// the first.
solve::NodeBlend point_of(const BodyDescription& description, const Vec3& a) {
    if (description.kind == Kind::kSolid) return tissue::point_of_grid(description.grid, a);
    if (description.kind == Kind::kCurve) {
        const int links = description.grid.m - 1;
        const int first = std::min(static_cast<int>(a[0] * links), links - 1);
        solve::NodeBlend point;
        point.add(first, 1 - (a[0] * links - first));
        point.add(first + 1, a[0] * links - first);
        return point;
    }
    const tissue::SurfaceGrid grid{.m = description.grid.m,
                                   .n = description.grid.n,
                                   .closed = description.kind == Kind::kCylinder};
    const auto cell = [&](int axis) {
        const double at = a[axis] * grid.links(axis);
        const int first = std::min(static_cast<int>(at), grid.links(axis) - 1);
        return std::pair<int, double>(first, at - first);
    };
    const auto [i, s] = cell(0);
    const auto [j, t] = cell(1);
    solve::NodeBlend point;
    for (const int di : {0, 1})
        for (const int dj : {0, 1})
            point.add(grid.index(i + di, (j + dj) % grid.n), (di ? s : 1 - s) * (dj ? t : 1 - t));
    return point;
}

void add_actions(const BodyDescription& description, const Matter& matter,
                 solve::MotionSystem& system) {
    std::vector<tissue::PointSpring> springs;
    for (const SpringDescription& one : description.springs) {
        springs.push_back(one.spring);
        springs.back().at = point_of(description, one.at);
    }
    if (!springs.empty()) system.add(std::make_shared<tissue::PointSprings>(std::move(springs)));

    std::vector<tissue::ForceGenerator> generators;
    for (const PulseDescription& one : description.pulses) {
        generators.push_back(one.generator);
        generators.back().at = point_of(description, one.at);
    }
    if (!generators.empty())
        system.add(std::make_shared<tissue::ForceGenerators>(std::move(generators)));

    for (const ObstacleDescription& one : description.obstacles)
        system.add(std::make_shared<contact::ObstacleContact>(
            contact::surface_samples(matter.rest, matter.surface), one.obstacle, one.contact));
}

}  // namespace

SoftBody build_body(const BodyDescription& description) {
    const Matter matter = matter_of(description);
    const std::vector<char> fixed = fixed_flags(description);

    solve::MotionSystem system(matter.mass_kg, fixed);
    system.add(matter.inner);
    system.add(std::make_shared<tissue::Gravity>(matter.mass_kg, description.gravity_m_per_s2));
    if ((matter.drag_ns_per_m.array() > 0).any())
        system.add(std::make_shared<tissue::Drag>(matter.drag_ns_per_m));
    add_actions(description, matter, system);

    SoftBody body{.kind = description.kind,
                  .grid = description.grid,
                  .rest = matter.rest,
                  .system = std::move(system),
                  .surface = matter.surface,
                  .wires = matter.wires,
                  .edges = edges_of(description)};
    body.length_scale_m =
        (body.rest.colwise().maxCoeff() - body.rest.colwise().minCoeff()).maxCoeff();
    body.weight_n = matter.mass_kg.sum() * description.gravity_m_per_s2.norm();
    for (int i = 0; i < body.grid.size(); ++i)
        if (fixed[static_cast<std::size_t>(i)]) body.fixed.push_back(i);
    return body;
}

solve::MotionState SoftBody::start() const {
    solve::MotionState state;
    state.x = rest;
    state.v = Points::Zero(rest.rows(), 3);
    return state;
}

Vec3 SoftBody::holding_n(const Support& support, const Points& x) const {
    Vec3 sum = Vec3::Zero();
    if (!support.whole()) {
        for (const int node : support.nodes)
            for (int axis = 0; axis < 3; ++axis)
                if (support.axes[static_cast<std::size_t>(axis)])
                    sum[axis] += slides->force_n({node, axis, rest(node, axis)}, x);
        return sum;
    }
    Points force;
    system.force(0, x, Points::Zero(x.rows(), 3), force);
    for (const int node : support.nodes) sum -= force.row(node).transpose();
    return sum;
}

double SoftBody::volume(const Points& x) const {
    assert(kind == Kind::kSolid);
    if (tets) return tets->volume(x);
    return tissue::enclosed_volume(grid, x);
}

double SoftBody::volume_element_sum(const Points& x) const {
    assert(kind == Kind::kSolid && !tets);
    double sum = 0;
    for (int i = 0; i + 1 < grid.m; ++i)
        for (int j = 0; j + 1 < grid.n; ++j)
            for (int k = 0; k + 1 < grid.o; ++k) {
                const auto at = [&](int di, int dj, int dk) {
                    return Vec3(x.row(grid.index(i + di, j + dj, k + dk)).transpose());
                };
                const Vec3 here = at(0, 0, 0);
                sum += (at(1, 0, 0) - here).cross(at(0, 1, 0) - here).dot(at(0, 0, 1) - here);
            }
    return sum / (grid.spacing(0) * grid.spacing(1) * grid.spacing(2));
}

}  // namespace risorius::softbody
