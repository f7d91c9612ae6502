// SPDX-License-Identifier: MIT
#include "risorius/softbody/detail/mesh_muscle.h"

#include <cmath>
#include <stdexcept>

#include "risorius/muscle/fibre_flow.h"
#include "risorius/softbody/detail/read_numbers.h"

namespace risorius::softbody {

namespace {

/// The nodes of a muscle in a box, one flag per node of the mesh.
std::vector<char> end_nodes(const Box& box, const Points& rest, const Tets& tets,
                            const std::string& place) {
    std::vector<char> out(static_cast<std::size_t>(rest.rows()), 0);
    bool any = false;
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            if (box.holds(rest.row(tets(t, k)).transpose())) {
                out[static_cast<std::size_t>(tets(t, k))] = 1;
                any = true;
            }
    if (!any) throw Error(place, "a box with nodes of the muscle in it", "none");
    return out;
}

Points flow_between(const std::pair<Box, Box>& ends, const Points& rest, const Tets& tets,
                    const std::string& place) {
    const std::vector<char> from = end_nodes(ends.first, rest, tets, place + "/from"),
                            to = end_nodes(ends.second, rest, tets, place + "/to");
    for (std::size_t i = 0; i < from.size(); ++i)
        if (from[i] && to[i]) throw Error(place, "boxes without a node of both", "one");
    try {
        return muscle::fibre_flow(rest, tets, from, to);
    } catch (const std::invalid_argument&) {
        throw Error(place,
                    "a muscle whose tetrahedra are all joined to both boxes, and lie in none of "
                    "them with all corners",
                    "others");
    }
}

}  // namespace

Box read_box(const JsonCursor& json) { return {json.at("low_m").vec3(), json.at("high_m").vec3()}; }

MeshMuscle read_mesh_muscle(const JsonCursor& json) {
    json.allow_keys(
        {"tension_pa", "optimal_stretch", "greatest_speed_hz", "damping", "curves", "fibres"});
    MeshMuscle out;
    out.place = json.place();
    out.parameters.tension_pa = detail::positive(json.at("tension_pa"));
    if (const auto v = json.find("optimal_stretch"))
        out.parameters.optimal_stretch = v->number({0.1, 10});
    if (const auto v = json.find("greatest_speed_hz"))
        out.parameters.max_speed_hz = detail::positive(*v);
    out.parameters.damping = detail::not_negative(json, "damping", out.parameters.damping);
    if (const auto v = json.find("curves")) out.parameters.curves = muscle::read_curve_shape(*v);
    const auto fibres = json.find("fibres");
    if (!fibres) return out;
    if (fibres->has("along")) {
        fibres->allow_keys({"along"});
        out.along = fibres->at("along").vec3();
        if (!(out.along->norm() > 0)) fibres->at("along").fail("a direction");
        out.along->normalize();
        return out;
    }
    fibres->allow_keys({"from", "to"});
    const auto box = [](const JsonCursor& one) {
        one.allow_keys({"low_m", "high_m"});
        return read_box(one);
    };
    out.ends = {box(fibres->at("from")), box(fibres->at("to"))};
    return out;
}

Points fibre_directions(const MeshMuscle& muscle, const io::TetMesh& mesh,
                        const std::vector<int>& tets) {
    const auto count = static_cast<Eigen::Index>(tets.size());
    if (muscle.along) return muscle.along->transpose().replicate(count, 1);
    if (muscle.ends)
        return flow_between(*muscle.ends, mesh.positions, mesh.tets(tets, Eigen::all),
                            muscle.place + "/fibres");
    if (mesh.fibres.rows() == 0)
        throw Error(muscle.place, "\"fibres\", or a mesh with a field \"fibre\"", "neither");
    Points out(count, 3);
    for (Eigen::Index t = 0; t < count; ++t) {
        const int tet = tets[static_cast<std::size_t>(t)];
        const double length = mesh.fibres.row(tet).norm();
        if (!(length > 0))
            throw Error(muscle.place, "a field with a direction in every tetrahedron of the muscle",
                        "none in tetrahedron " + std::to_string(tet + 1));
        out.row(t) = mesh.fibres.row(tet) / length;
    }
    return out;
}

}  // namespace risorius::softbody
