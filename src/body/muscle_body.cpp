#include "body/muscle_body.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "body/detail/read_numbers.h"
#include "tissue/cell_solid.h"
#include "tissue/difference_solid.h"
#include "tissue/gravity.h"
#include "tissue/grid_shape.h"
#include "tissue/moduli.h"

namespace risorius::body {

namespace {

using detail::kMostNodesPerAxis;
using detail::not_negative;
using detail::positive;

tissue::GridShape read_grid(const JsonCursor& json) {
    const std::vector<JsonCursor> counts = json.items();
    if (counts.size() != 3) json.fail("three numbers of nodes, one per axis");
    return {counts[0].integer(2, kMostNodesPerAxis), counts[1].integer(2, kMostNodesPerAxis),
            counts[2].integer(2, kMostNodesPerAxis)};
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

/// The belly in the thesis' differences: a block's parameters with the edges of a box of equal volume.
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
                     "moduli", "musculotendon", "gravity_m_per_s2"});
    MuscleDescription d;
    d.place = json.place();
    if (const auto v = json.find("discretisation"))
        d.discretisation = v->one_of({"differences", "cells"}) == "cells"
                               ? Discretisation::kCells
                               : Discretisation::kDifferences;
    if (const auto v = json.find("grid")) d.grid = read_grid(*v);
    if (const auto v = json.find("section"))
        d.section = v->one_of({"block", "round"}) == "round" ? MuscleDescription::Section::kRound
                                                             : MuscleDescription::Section::kBlock;
    d.length_m = positive(json.at("length_m"));
    d.width_m = positive(json.at("width_m"));
    d.thickness_m = positive(json.at("thickness_m"));

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
    const double pull = musculotendon->anchor_pull(muscle::End::kOrigin, t_s, x).x() -
                        musculotendon->anchor_pull(muscle::End::kInsertion, t_s, x).x();
    return pull / (2 * musculotendon->parameters().f0_n);
}

MuscleBody build_muscle(const MuscleDescription& d, MuscleTask task) {
    const Points rest = belly_rest(d);
    const tissue::GridSolid belly = difference_belly(d, rest);
    tissue::check(belly, d.place);
    const Eigen::VectorXd mass_kg = tissue::node_mass(belly);

    muscle::Anchors anchors = muscle::planar_anchors(d.grid, rest, d.musculotendon.tendon_slack_m);
    if (task.lengthening_m)
        anchors.insertion.motion = [lengthening_m = std::move(task.lengthening_m)](double t_s) {
            return Rigid(Eigen::Translation3d(lengthening_m(t_s), 0, 0));
        };
    auto musculotendon = std::make_shared<muscle::Musculotendon>(
        d.musculotendon, muscle::zajac_curves(), d.grid, rest, std::move(anchors),
        std::move(task.activation), d.place + "/musculotendon");

    solve::MotionSystem system(mass_kg, std::vector<char>(static_cast<std::size_t>(d.grid.size())));
    if (d.discretisation == Discretisation::kDifferences) {
        system.add(std::make_shared<tissue::DifferenceSolid>(belly, d.place));
    } else {
        tissue::CellMesh mesh = tissue::uniform_cells(d.grid);
        const std::vector<tissue::CellModuli> moduli(mesh.cells().size(), d.moduli);
        tissue::CellBody cells{.mesh = std::move(mesh),
                               .rest = rest,
                               .parameters = {},
                               .moduli = moduli,
                               .mass_kg = mass_kg,
                               .drag_ns_per_m = Eigen::VectorXd::Zero(d.grid.size())};
        system.add(std::make_shared<tissue::CellSolid>(std::move(cells)));
    }
    system.add(musculotendon);
    if (!d.gravity_m_per_s2.isZero())
        system.add(std::make_shared<tissue::Gravity>(mass_kg, d.gravity_m_per_s2));

    SoftBody body{.grid = d.grid, .rest = rest, .system = std::move(system)};
    body.length_scale_m = d.length_m;
    body.surface = tissue::surface_triangles(d.grid);
    body.wires = tissue::grid_lines(d.grid);
    return {.body = std::move(body), .musculotendon = std::move(musculotendon)};
}

}  // namespace risorius::body
