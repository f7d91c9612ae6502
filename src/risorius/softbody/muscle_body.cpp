// SPDX-License-Identifier: MIT
#include "risorius/softbody/muscle_body.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "risorius/softbody/detail/read_numbers.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/difference_solid.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/grid_shape.h"
#include "risorius/tissue/moduli.h"
#include "risorius/tissue/point_springs.h"

namespace risorius::softbody {

namespace {

using detail::kMaxNodesPerAxis;
using detail::not_negative;
using detail::positive;

tissue::GridShape read_grid(const JsonCursor& json) {
    const std::vector<JsonCursor> counts = json.items();
    if (counts.size() != 3) json.fail("three numbers of nodes, one per axis");
    return {counts[0].integer(2, kMaxNodesPerAxis), counts[1].integer(2, kMaxNodesPerAxis),
            counts[2].integer(2, kMaxNodesPerAxis)};
}

void read_sizes(const JsonCursor& json, MuscleDescription& d) {
    if (const auto v = json.find("section"))
        d.section = v->one_of({"block", "round"}) == "round" ? MuscleDescription::Section::kRound
                                                             : MuscleDescription::Section::kBlock;
    d.length_m = positive(json.at("length_m"));
    d.width_m = positive(json.at("width_m"));
    d.thickness_m = positive(json.at("thickness_m"));
}

bool is_ring(const MuscleDescription& d) {
    return d.shape && d.shape->form == muscle::MuscleShape::Form::kRing;
}

MuscleEnd read_end(const JsonCursor& json, const MuscleDescription& d) {
    if (is_ring(d)) json.fail("no end of a ring");
    if (json.is_string()) {
        const std::string hold = json.one_of({"plate", "plane", "free"});
        return {.hold = hold == "free"    ? MuscleEnd::Hold::kFree
                        : hold == "plane" ? MuscleEnd::Hold::kPlane
                                          : MuscleEnd::Hold::kPlate};
    }
    if (!json.is_object())
        json.fail("\"plate\", \"plane\", \"free\" or {\"points_m\": [[..], ..]}");
    json.allow_keys({"points_m"});
    const std::vector<JsonCursor> rows = json.at("points_m").items();
    if (rows.empty()) json.at("points_m").fail("at least one point", "none");
    MuscleEnd end{.hold = MuscleEnd::Hold::kBone,
                  .points_m = Points(static_cast<Eigen::Index>(rows.size()), 3)};
    for (std::size_t i = 0; i < rows.size(); ++i)
        end.points_m.row(static_cast<Eigen::Index>(i)) = rows[i].vec3().transpose();
    return end;
}

muscle::Anchor anchor_of(const MuscleDescription& d, muscle::End end, const Points& rest) {
    const MuscleEnd& here = end == muscle::End::kOrigin ? d.origin : d.insertion;
    const MuscleEnd& there = end == muscle::End::kOrigin ? d.insertion : d.origin;
    if (is_ring(d) || here.hold == MuscleEnd::Hold::kFree) return {};
    if (here.hold == MuscleEnd::Hold::kBone)
        return muscle::bone_anchor(end, d.grid, rest, here.points_m);
    const double away_m =
        d.musculotendon.tendon_slack_m / (there.hold == MuscleEnd::Hold::kFree ? 1 : 2);
    return here.hold == MuscleEnd::Hold::kPlane ? muscle::plane_anchor(end, d.grid, rest, away_m)
                                                : muscle::planar_anchor(end, d.grid, rest, away_m);
}

/// The belly as cells. The mass of each cell is on its corners.
tissue::CellBody shaped_cells(const MuscleDescription& d, const muscle::Belly& belly) {
    tissue::CellMesh mesh = tissue::uniform_cells(belly.grid);
    const auto rest = [&](const Vec3& a) -> Vec3 {
        int at[3];
        for (int axis = 0; axis < 3; ++axis)
            at[axis] = static_cast<int>(std::lround(a[axis] * belly.grid.cells(axis)));
        return belly.rest.row(belly.grid.index(at[0], at[1], at[2])).transpose();
    };
    return tissue::cell_body(std::move(mesh), rest, d.moduli, d.density_kg_per_m3);
}

Points belly_rest(const MuscleDescription& d) {
    if (d.section == MuscleDescription::Section::kBlock)
        return tissue::block_rest(
            d.grid, {d.length_m, d.width_m, d.thickness_m},
            Rigid(Eigen::Translation3d(0, -d.width_m / 2, -d.thickness_m / 2)));
    Points rest = tissue::cylinder_rest(d.grid, d.width_m / 2, d.length_m);
    rest.col(2) *= d.thickness_m / d.width_m;
    return rest;
}

/// The belly in the thesis' differences, with the parameters of a block whose edges give the same volume.
tissue::GridSolid difference_belly(const MuscleDescription& d, const Points& rest) {
    const double volume = d.rest_volume_m3();
    const double shrink = std::sqrt(volume / (d.length_m * d.width_m * d.thickness_m));
    const Vec3 edges(d.length_m, shrink * d.width_m, shrink * d.thickness_m);
    tissue::SolidMaterial material;
    material.elastic_n_per_m3 = tissue::block_tensor(d.moduli.mu_pa, edges);
    material.damping_ns_per_m3 = tissue::block_tensor(d.moduli.viscosity_pa_s, edges);
    material.incompressibility_n_per_m5 =
        tissue::nodal_incompressibility(d.moduli.bulk_pa, volume, d.grid);
    material.mass_kg = d.density_kg_per_m3 * volume;
    return {.grid = d.grid, .rest = rest, .material = {material}};
}

}  // namespace

double MuscleDescription::rest_volume_m3() const {
    return length_m * width_m * thickness_m *
           (section == Section::kRound ? std::numbers::pi / 4 : 1.0);
}

MuscleDescription read_muscle(const JsonCursor& json) {
    json.allow_keys({"discretisation", "grid", "section", "length_m", "width_m", "thickness_m",
                     "moduli", "musculotendon", "gravity_m_per_s2", "shape", "origin", "insertion",
                     "bed_n_per_m"});
    MuscleDescription d;
    d.place = json.place();
    if (const auto v = json.find("discretisation"))
        d.discretisation = v->one_of({"differences", "cells"}) == "cells"
                               ? Discretisation::kCells
                               : Discretisation::kDifferences;
    if (const auto v = json.find("grid")) d.grid = read_grid(*v);
    if (const auto v = json.find("shape")) {
        for (const char* key : {"section", "length_m", "width_m", "thickness_m"})
            if (json.has(key)) json.at(key).fail("no sizes beside \"shape\"");
        if (d.discretisation != Discretisation::kCells)
            json.at("discretisation").fail("\"cells\", which alone know shapes");
        d.shape = muscle::read_muscle_shape(*v);
    } else {
        read_sizes(json, d);
    }
    if (const auto v = json.find("bed_n_per_m")) d.bed_n_per_m = not_negative(*v);
    if (const auto v = json.find("origin")) d.origin = read_end(*v, d);
    if (const auto v = json.find("insertion")) d.insertion = read_end(*v, d);

    const JsonCursor moduli = json.at("moduli");
    moduli.allow_keys({"shear_pa", "bulk_pa", "viscosity_pa_s", "density_kg_per_m3"});
    d.moduli.mu_pa = positive(moduli.at("shear_pa"));
    d.moduli.bulk_pa = not_negative(moduli.at("bulk_pa"));
    if (const auto v = moduli.find("viscosity_pa_s")) d.moduli.viscosity_pa_s = not_negative(*v);
    if (const auto v = moduli.find("density_kg_per_m3")) d.density_kg_per_m3 = positive(*v);

    d.musculotendon = muscle::read_muscle_parameters(json.at("musculotendon"));
    if (const auto v = json.find("gravity_m_per_s2")) d.gravity_m_per_s2 = v->vec3();
    return d;
}

double MuscleBody::tension(double t_s, const Points& x) const {
    const double f0 = musculotendon->parameters().f0_n;
    double pull = 0;
    int ends = 0;
    const bool rigid = musculotendon->parameters().tendon == muscle::TendonModel::kRigid;
    Points force;
    if (rigid) body.system.force(t_s, x, Points::Zero(x.rows(), 3), force);
    for (const muscle::End end : {muscle::End::kOrigin, muscle::End::kInsertion}) {
        if (!musculotendon->anchored(end)) continue;
        const int chains = body.grid.n * body.grid.o;
        const int first = end == muscle::End::kOrigin ? 0 : (body.grid.m - 1) * chains;
        const Vec3 felt = rigid ? Vec3(force.middleRows(first, chains).colwise().sum())
                                : musculotendon->anchor_pull(end, t_s, x);
        pull -= felt.dot(muscle::outward_at(end, body.grid, body.rest));
        ++ends;
    }
    return ends == 0 ? 0 : pull / (ends * f0);
}

MuscleBody build_muscle(const MuscleDescription& description, MuscleTask task) {
    MuscleDescription d = description;
    Points rest;
    std::optional<tissue::CellBody> cells;
    Eigen::VectorXd mass_kg;
    std::shared_ptr<solve::EnergyTerm> difference_solid;
    if (d.shape) {
        const muscle::Belly belly = muscle::muscle_belly(*d.shape, d.grid);
        d.grid = belly.grid;
        rest = belly.rest;
        cells = shaped_cells(d, belly);
        mass_kg = cells->mass_kg;
    } else {
        rest = belly_rest(d);
        const tissue::GridSolid belly = difference_belly(d, rest);
        tissue::check(belly, d.place);
        mass_kg = tissue::node_mass(belly);
        if (d.discretisation == Discretisation::kDifferences) {
            difference_solid = std::make_shared<tissue::DifferenceSolid>(belly, d.place);
        } else {
            tissue::CellMesh mesh = tissue::uniform_cells(d.grid);
            const std::vector<tissue::CellModuli> moduli(mesh.cells().size(), d.moduli);
            cells = tissue::CellBody{.mesh = std::move(mesh),
                                     .rest = rest,
                                     .parameters = {},
                                     .moduli = moduli,
                                     .mass_kg = mass_kg,
                                     .drag_ns_per_m = Eigen::VectorXd::Zero(d.grid.size())};
        }
    }

    muscle::Anchors anchors{anchor_of(d, muscle::End::kOrigin, rest),
                            anchor_of(d, muscle::End::kInsertion, rest)};
    if (task.lengthening_m && anchors.insertion.rest.rows() > 0) {
        const auto middle = [](const Points& points) -> Vec3 {
            return points.colwise().mean().transpose();
        };
        const Vec3 from =
            middle(anchors.origin.rest.rows() > 0 ? anchors.origin.rest
                                                  : Points(rest.topRows(d.grid.n * d.grid.o)));
        const Vec3 line = (middle(anchors.insertion.rest) - from).normalized();
        anchors.insertion.motion = [lengthening_m = std::move(task.lengthening_m),
                                    line](double t_s) {
            return Rigid(Eigen::Translation3d(lengthening_m(t_s) * line));
        };
    }
    auto musculotendon = std::make_shared<muscle::Musculotendon>(
        d.musculotendon, muscle::make_curves(d.musculotendon.curves), d.grid, rest,
        std::move(anchors), std::move(task.activation), d.place + "/musculotendon");

    std::vector<char> fixed(static_cast<std::size_t>(d.grid.size()));
    for (const int node : musculotendon->tied_nodes()) fixed[static_cast<std::size_t>(node)] = 1;
    solve::MotionSystem system(mass_kg, std::move(fixed));
    system.set_boundary_conditions([musculotendon](double t_s, Points& x, Points& v) {
        musculotendon->place_tied(t_s, x, v);
    });
    if (cells)
        system.add(std::make_shared<tissue::CellSolid>(std::move(*cells)));
    else
        system.add(std::move(difference_solid));
    system.add(musculotendon);
    if (d.bed_n_per_m > 0) {
        std::vector<tissue::PointSpring> springs;
        for (int i = 0; i < d.grid.size(); ++i) {
            springs.push_back({.at = solve::NodeBlend(i), .tied_to = rest.row(i).transpose()});
            springs.back().stiffness_n_per_m = d.bed_n_per_m / d.grid.size();
        }
        system.add(std::make_shared<tissue::PointSprings>(std::move(springs)));
    }
    if (!d.gravity_m_per_s2.isZero())
        system.add(std::make_shared<tissue::Gravity>(mass_kg, d.gravity_m_per_s2));

    SoftBody body{.grid = d.grid, .rest = rest, .system = std::move(system)};
    body.length_scale_m =
        d.shape ? (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff() : d.length_m;
    body.surface = tissue::surface_triangles(d.grid);
    body.wires = tissue::grid_lines(d.grid);
    body.fixed = musculotendon->tied_nodes();
    return {.body = std::move(body), .musculotendon = std::move(musculotendon)};
}

}  // namespace risorius::softbody
