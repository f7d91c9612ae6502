#include "body/soft_body.h"

#include <memory>

#include "tissue/difference_solid.h"
#include "tissue/drag.h"
#include "tissue/gravity.h"
#include "tissue/grid_shape.h"

namespace risorius::body {

SoftBody build_body(const BodyDescription& description) {
    const tissue::GridSolid solid = grid_solid(description);
    tissue::check(solid, description.place);
    const Eigen::VectorXd mass_kg = tissue::node_mass(solid);
    const Eigen::VectorXd drag_ns_per_m = tissue::node_drag(solid);
    const std::vector<char> fixed = fixed_flags(description);

    solve::MotionSystem system(mass_kg, fixed);
    system.add(std::make_shared<tissue::DifferenceSolid>(solid, description.place));
    system.add(std::make_shared<tissue::Gravity>(mass_kg, description.gravity_m_per_s2));
    if ((drag_ns_per_m.array() > 0).any())
        system.add(std::make_shared<tissue::Drag>(drag_ns_per_m));

    SoftBody body{.grid = solid.grid, .rest = solid.rest, .system = std::move(system)};
    body.length_scale_m =
        (body.rest.colwise().maxCoeff() - body.rest.colwise().minCoeff()).maxCoeff();
    body.weight_n = mass_kg.sum() * description.gravity_m_per_s2.norm();
    body.surface = tissue::surface_triangles(body.grid);
    body.wires = tissue::grid_lines(body.grid);
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

double SoftBody::volume(const Points& x) const { return tissue::enclosed_volume(grid, x); }

double SoftBody::volume_element_sum(const Points& x) const {
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

}  // namespace risorius::body
