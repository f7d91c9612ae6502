// SPDX-License-Identifier: MIT
#include "risorius/softbody/refined_body.h"

#include <algorithm>
#include <set>
#include <utility>

#include "risorius/tissue/drag.h"
#include "risorius/tissue/gravity.h"

namespace risorius::softbody {

namespace {

constexpr double kOnBorder = 1e-9;  // tolerance; material coordinates are multiples of cell sizes

/// The face of a cell at one end of an axis. Its corners are in order, facing outward.
std::array<int, 4> face_of(const tissue::CellMesh::Cell& cell, int axis, bool last) {
    const auto corner = [&](int b, int c) {
        int bits[3];
        bits[axis] = last ? 1 : 0;
        bits[(axis + 1) % 3] = b;
        bits[(axis + 2) % 3] = c;
        return cell.vertex[static_cast<std::size_t>(4 * bits[0] + 2 * bits[1] + bits[2])];
    };
    std::array<int, 4> face = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    if (!last) std::swap(face[1], face[3]);
    return face;
}

bool on_border(const tissue::CellMesh::Cell& cell, int axis, bool last) {
    return last ? cell.low[axis] + cell.size[axis] > 1 - kOnBorder : cell.low[axis] < kOnBorder;
}

}  // namespace

std::vector<char> held_nodes(const std::vector<NodeSelection>& selections,
                             const tissue::CellMesh& mesh) {
    std::vector<char> held(static_cast<std::size_t>(mesh.node_count()), 0);
    const tissue::CellMesh root = tissue::uniform_cells(mesh.root());
    for (const NodeSelection& selection : selections) {
        // A field that is 1 on the picked nodes interpolates to 1 where all corners around are picked.
        Points mark = Points::Zero(root.node_count(), 3);
        for (const int node : select(selection, mesh.root())) mark(node, 0) = 1;
        for (int i = 0; i < mesh.node_count(); ++i)
            if (root.interpolate(mark, mesh.material_coordinates().row(i).transpose())[0] >
                1 - kOnBorder)
                held[static_cast<std::size_t>(i)] = 1;
    }
    return held;
}

void check_refinable(const BodyDescription& description) {
    const auto refuse = [&](const char* key, const char* expected, const char* found) {
        throw Error(description.place + key, expected, found);
    };
    if (description.kind != Kind::kSolid)
        refuse("/kind", "\"solid\", which can be refined", "a surface");
    if (description.discretisation != Discretisation::kCells)
        refuse("/discretisation", "\"cells\", which can be refined", "\"differences\"");
    if (!description.springs.empty()) refuse("/springs", "none on a refined body", "some");
    if (!description.pulses.empty()) refuse("/pulses", "none on a refined body", "some");
    if (!description.obstacles.empty()) refuse("/obstacles", "none on a refined body", "some");
}

solve::MotionSystem refined_system(const BodyDescription& description,
                                   const std::shared_ptr<tissue::CellSolid>& solid,
                                   const std::vector<NodeSelection>& also_fixed) {
    std::vector<NodeSelection> holds = description.fixed;
    holds.insert(holds.end(), also_fixed.begin(), also_fixed.end());
    const tissue::CellBody& body = solid->body();
    solve::MotionSystem system(body.mass_kg, held_nodes(holds, body.mesh));
    system.add(solid);
    system.add(std::make_shared<tissue::Gravity>(body.mass_kg, description.gravity_m_per_s2));
    if ((body.drag_ns_per_m.array() > 0).any())
        system.add(std::make_shared<tissue::Drag>(body.drag_ns_per_m));
    return system;
}

CellBoundary boundary_of(const tissue::CellMesh& mesh) {
    std::vector<std::array<int, 4>> faces;
    std::set<std::array<int, 2>> wires;
    for (const tissue::CellMesh::Cell& cell : mesh.cells())
        for (int axis = 0; axis < 3; ++axis)
            for (const bool last : {false, true}) {
                if (!on_border(cell, axis, last)) continue;
                faces.push_back(face_of(cell, axis, last));
                for (std::size_t k = 0; k < 4; ++k) {
                    const int a = faces.back()[k], b = faces.back()[(k + 1) % 4];
                    wires.insert({std::min(a, b), std::max(a, b)});
                }
            }
    CellBoundary boundary;
    boundary.surface.resize(2 * static_cast<Eigen::Index>(faces.size()), 3);
    Eigen::Index row = 0;
    for (const std::array<int, 4>& face : faces) {
        boundary.surface.row(row++) << face[0], face[1], face[2];
        boundary.surface.row(row++) << face[0], face[2], face[3];
    }
    boundary.wires.assign(wires.begin(), wires.end());
    return boundary;
}

Vec3 face_centre(const tissue::CellSolid& solid, const Points& x, int axis, bool last) {
    const Points vertices = solid.vertices(x);
    Vec3 sum = Vec3::Zero();
    for (const tissue::CellMesh::Cell& cell : solid.mesh().cells()) {
        if (!on_border(cell, axis, last)) continue;
        const double area = cell.size.prod() / cell.size[axis];
        for (const int vertex : face_of(cell, axis, last))
            sum += 0.25 * area * vertices.row(vertex).transpose();
    }
    return sum;
}

}  // namespace risorius::softbody
