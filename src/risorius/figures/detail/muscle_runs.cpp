// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_runs.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/figures/detail/body_cases.h"

namespace risorius::figures {
namespace {

softbody::MuscleDescription changed_muscle(const JsonCursor& muscle,
                                           const std::optional<JsonCursor>& change,
                                           const std::string& run_name) {
    Json changed = muscle.json();
    if (change) {
        change->keys();  // must be an object
        changed.merge_patch(change->json());
    }
    const JsonCursor json = JsonCursor::from_json(json_object({{"muscle", changed}}),
                                                  muscle.file().string() + " (" + run_name + ")")
                                .at("muscle");
    json.at("grid");  // read_muscle() lets its caller supply the grid; here the file must have it
    return softbody::read_muscle(json);
}

/// Length of a straight belly at rest; 0 for any other shape.
double belly_length_m(const softbody::MuscleDescription& muscle) {
    using Form = muscle::MuscleShape::Form;
    if (!muscle.shape) return muscle.length_m;
    const Form form = muscle.shape->form;
    const bool straight = form == Form::kBlock || form == Form::kRound || form == Form::kSheet;
    return straight ? muscle.shape->length_m : 0;
}

/// Node indices around the section of plane m, each once.
std::vector<int> rim(const tissue::GridShape& grid, int m) {
    std::vector<int> nodes;
    for (int n = 0; n < grid.n - 1; ++n) nodes.push_back(grid.index(m, n, 0));
    for (int o = 0; o < grid.o - 1; ++o) nodes.push_back(grid.index(m, grid.n - 1, o));
    for (int n = grid.n - 1; n > 0; --n) nodes.push_back(grid.index(m, n, grid.o - 1));
    for (int o = grid.o - 1; o > 0; --o) nodes.push_back(grid.index(m, 0, o));
    return nodes;
}

/// Area of the section halfway along the grid, m^2.
double middle_area(const tissue::GridShape& grid, const Points& x) {
    const std::vector<int> below = rim(grid, (grid.m - 1) / 2), above = rim(grid, grid.m / 2);
    Vec3 twice = Vec3::Zero();
    const auto corner = [&](std::size_t i) -> Vec3 {
        return (x.row(below[i]) + x.row(above[i])).transpose() / 2;
    };
    const Vec3 from = corner(0);
    for (std::size_t i = 1; i + 1 < below.size(); ++i)
        twice += (corner(i) - from).cross(corner(i + 1) - from);
    return twice.norm() / 2;
}

}  // namespace

std::vector<MuscleRun> read_runs_of_any_muscle(const JsonCursor& experiment,
                                               const std::vector<std::string_view>& more_keys) {
    std::vector<std::string_view> keys{"name", "label", "change"};
    keys.insert(keys.end(), more_keys.begin(), more_keys.end());
    std::vector<MuscleRun> runs;
    for (const JsonCursor& json : experiment.at("runs").items()) {
        json.allow_keys(keys);
        const std::string name = json.at("name").string();
        for (const MuscleRun& other : runs)
            if (other.name == name)
                json.at("name").fail("a name of its own", "\"" + name + "\" again");
        MuscleRun run{.name = name,
                      .label = json.at("label").string(),
                      .muscle = changed_muscle(experiment.at("muscle"), json.find("change"), name),
                      .json = json};
        softbody::build_muscle(run.muscle, {[](double) { return 0.0; }});
        runs.push_back(std::move(run));
    }
    if (runs.empty()) experiment.at("runs").fail("at least one run");
    return runs;
}

std::vector<MuscleRun> read_muscle_runs(const JsonCursor& experiment,
                                        const std::vector<std::string_view>& more_keys) {
    std::vector<MuscleRun> runs = read_runs_of_any_muscle(experiment, more_keys);
    const auto is_held = [](const softbody::MuscleEnd& end) {
        return end.hold == softbody::MuscleEnd::Hold::kPlate ||
               end.hold == softbody::MuscleEnd::Hold::kPlane;
    };
    for (const MuscleRun& run : runs)
        if (!(belly_length_m(run.muscle) > 0) || !is_held(run.muscle.origin) ||
            !is_held(run.muscle.insertion))
            throw Error(run.muscle.place, "a straight belly between two plates", "another");
    return runs;
}

void require_elastic_tendons(const MuscleRun& run) {
    if (run.muscle.musculotendon.tendon != muscle::TendonModel::kElastic)
        throw Error(run.muscle.place + "/musculotendon/tendon",
                    "\"elastic\", for rigid ones feel no motion", "\"rigid\"");
}

std::string discretisation_of(const softbody::MuscleDescription& muscle) {
    const bool cells = muscle.discretisation == softbody::Discretisation::kCells;
    return grid_name(muscle.grid) + (cells ? " cells" : " differences") +
           ", K = " + format_number(muscle.moduli.bulk_pa / 1e6) + " MPa";
}

double lengthening_m(const softbody::MuscleDescription& muscle, double normalised_length) {
    return normalised_length * muscle.musculotendon.optimal_length_m - belly_length_m(muscle);
}

double normalised_length(const softbody::MuscleDescription& muscle, double lengthening_m) {
    return (belly_length_m(muscle) + lengthening_m) / muscle.musculotendon.optimal_length_m;
}

bool is_at_rest(const softbody::MuscleBody& muscle, const solve::MotionState& state) {
    constexpr double kFraction = 1e-9;
    Points force;
    muscle.body.system.force(state.t_s, state.x, Points::Zero(state.x.rows(), 3), force);
    return force.rowwise().norm().maxCoeff() < kFraction * muscle.musculotendon->parameters().f0_n;
}

Shape muscle_shape(const softbody::MuscleBody& muscle, double t_s, const Points& x,
                   const std::string& name, const std::string& caption) {
    const tissue::GridShape& grid = muscle.body.grid;
    const int chains = grid.n * grid.o;
    Shape shape{.name = name,
                .caption = caption,
                .positions = x,
                .surface = muscle.body.surface,
                .wires = muscle.body.wires,
                .fixed = {}};
    for (const muscle::End end : {muscle::End::kOrigin, muscle::End::kInsertion}) {
        if (!muscle.musculotendon->anchored(end)) continue;
        const Points plate = muscle.musculotendon->tendon_feet(end, t_s, x);
        const auto first = static_cast<int>(shape.positions.rows());
        shape.positions.conservativeResize(first + chains, 3);
        shape.positions.bottomRows(chains) = plate;
        const int belly = end == muscle::End::kOrigin ? 0 : (grid.m - 1) * chains;
        for (int c = 0; c < chains; ++c) shape.wires.push_back({belly + c, first + c});
        for (int n = 0; n < grid.n; ++n)
            for (int o = 0; o < grid.o; ++o) {
                const int at = first + n * grid.o + o;
                if (n + 1 < grid.n) shape.wires.push_back({at, at + grid.o});
                if (o + 1 < grid.o) shape.wires.push_back({at, at + 1});
            }
    }
    return shape;
}

double bulge(const softbody::SoftBody& body, const Points& x) {
    return std::sqrt(middle_area(body.grid, x) / middle_area(body.grid, body.rest));
}

}  // namespace risorius::figures
