// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/mesh_placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "risorius/core/error.h"
#include "risorius/geom/polyline.h"
#include "risorius/geom/tet_boundary.h"
#include "risorius/muscle/fibre_flow.h"

namespace risorius::face {

namespace {

constexpr double kNear_m = 0.03;  // between the middle of a mesh and the path of its muscle
constexpr std::size_t kFewestEndNodes = 3;

Points surface_normals(const Points& nodes, const Tets& tets) {
    Points out = Points::Zero(nodes.rows(), 3);
    const Triangles outer = geom::boundary_of(tets);
    for (Eigen::Index f = 0; f < outer.rows(); ++f) {
        const auto corner = [&](int k) -> Vec3 { return nodes.row(outer(f, k)).transpose(); };
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        for (int k = 0; k < 3; ++k) out.row(outer(f, k)) += normal.transpose();
    }
    for (Eigen::Index i = 0; i < out.rows(); ++i)
        if (const double length = out.row(i).norm(); length > 0) out.row(i) /= length;
    return out;
}

/// Renumbers the nodes by their place from origin to insertion.
void sort_nodes(PlacedMesh& mesh) {
    std::vector<std::size_t> order(mesh.along.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return mesh.along[a] < mesh.along[b]; });
    const Points nodes = mesh.nodes;
    const std::vector<double> along = mesh.along;
    std::vector<int> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        place[order[i]] = static_cast<int>(i);
        mesh.nodes.row(static_cast<Eigen::Index>(i)) =
            nodes.row(static_cast<Eigen::Index>(order[i]));
        mesh.along[i] = along[order[i]];
    }
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            mesh.tets(t, k) = place[static_cast<std::size_t>(mesh.tets(t, k))];
}

void mark_ends(const std::array<double, 2>& ends, const std::string& place, PlacedMesh& mesh) {
    std::array<std::size_t, 2> count{};
    for (const double t : mesh.along) {
        const bool origin = t <= ends[0], insertion = t >= 1 - ends[1];
        count[0] += origin;
        count[1] += insertion;
        mesh.end.push_back(origin      ? PlacedMesh::End::kOrigin
                           : insertion ? PlacedMesh::End::kInsertion
                                       : PlacedMesh::End::kNone);
    }
    for (std::size_t k = 0; k < 2; ++k)
        if (count[k] < kFewestEndNodes)
            throw Error(place + "/ends/" + std::to_string(k),
                        std::string("a fraction with at least 3 nodes of the mesh at the ") +
                            (k == 0 ? "origin" : "insertion"),
                        format_number(ends[k]) + " with " + std::to_string(count[k]));
}

/// grad p of a flow between the ends.
Points flow_of(const PlacedMesh& mesh, const std::string& place) {
    std::vector<char> origin, insertion;
    for (const PlacedMesh::End end : mesh.end) {
        origin.push_back(end == PlacedMesh::End::kOrigin ? 1 : 0);
        insertion.push_back(end == PlacedMesh::End::kInsertion ? 1 : 0);
    }
    try {
        return muscle::flow_gradients(mesh.nodes, mesh.tets, origin, insertion);
    } catch (const std::invalid_argument&) {
        throw Error(place, "a mesh whose tetrahedra are all joined to both ends", "a loose one");
    }
}

/// Density of the fibres, with the mean 1 over the flow: a prism has 1 everywhere.
std::vector<double> density_of(const PlacedMesh& mesh, const Points& flow) {
    double volume = 0, through = 0;
    for (Eigen::Index t = 0; t < flow.rows(); ++t) {
        const auto corner = [&](int k) -> Vec3 {
            return mesh.nodes.row(mesh.tets(t, k)).transpose();
        };
        const double of_tet =
            (corner(1) - corner(0)).dot((corner(2) - corner(0)).cross(corner(3) - corner(0))) / 6;
        volume += of_tet;
        through += of_tet * flow.row(t).squaredNorm();
    }
    std::vector<double> out;
    for (Eigen::Index t = 0; t < flow.rows(); ++t)
        out.push_back(flow.row(t).norm() * volume / (mesh.length_m * through));
    return out;
}

}  // namespace

PlacedMesh place_mesh(const rig::Head& head, const rig::SolidMesh& mesh, Side side,
                      const std::vector<std::vector<Vec3>>& paths, const std::string& place) {
    const bool mirror = side == Side::kRight && !mesh.right;
    const io::TetMesh& file = side == Side::kRight && mesh.right ? *mesh.right : *mesh.left;
    const double unit =
        mesh.metres_per_unit > 0 ? mesh.metres_per_unit / head.frame.metres_per_unit : 1.0;
    PlacedMesh out;
    out.nodes = head.frame.to_head(Points(unit * file.positions));
    out.tets = file.tets;
    Points fibres = file.fibres;
    if (mesh.along) fibres = mesh.along->transpose().replicate(out.tets.rows(), 1);
    fibres = Points(fibres * head.frame.rotation.transpose());
    if (mirror) {
        out.nodes.col(0) *= -1;
        fibres.col(0) *= -1;
        out.tets.col(2).swap(out.tets.col(3));
    }

    const Vec3 middle = out.nodes.colwise().mean().transpose();
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 origin = Vec3::Zero(), insertion = Vec3::Zero();
    for (const std::vector<Vec3>& path : paths) {
        nearest = std::min(nearest, geom::distance_to_polyline(middle, path));
        origin += path.front() / static_cast<double>(paths.size());
        insertion += path.back() / static_cast<double>(paths.size());
    }
    if (!(nearest < head.size * kNear_m))
        throw Error(
            place,
            "a mesh around the path of its muscle, in the coordinates of the mesh of the "
            "rig",
            "one whose middle is " + format_number(std::round(1e3 * nearest)) + " mm away from it");

    const Eigen::VectorXd at = out.nodes * (insertion - origin).normalized();
    const double low = at.minCoeff();
    out.length_m = at.maxCoeff() - low;
    for (Eigen::Index i = 0; i < at.size(); ++i) out.along.push_back((at[i] - low) / out.length_m);
    sort_nodes(out);
    mark_ends(mesh.ends, place, out);
    out.normals = surface_normals(out.nodes, out.tets);
    const Points flow = flow_of(out, place);
    out.density = density_of(out, flow);
    if (fibres.rows() == 0) fibres = flow;
    for (Eigen::Index t = 0; t < fibres.rows(); ++t) {
        const double length = fibres.row(t).norm();
        if (!(length > 0))
            throw Error(place,
                        "a direction of fibres in every tetrahedron, and none that lies within an "
                        "end with all corners",
                        "none in tetrahedron " + std::to_string(t + 1));
        fibres.row(t) /= length;
    }
    out.fibres = std::move(fibres);
    return out;
}

}  // namespace risorius::face
