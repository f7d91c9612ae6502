// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/equilibrium_run.h"
#include "risorius/figures/detail/progress.h"
#include "risorius/softbody/integrator_description.h"
#include "risorius/softbody/mesh_body.h"

namespace risorius::figures {
namespace {

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();

struct Case {
    std::string name, caption, picture;
    softbody::BodyDescription body;
    std::optional<softbody::MeshBodyDescription> mesh;  ///< replaces `body`
    bool to_equilibrium = true;

    bool solid() const { return mesh || body.kind == softbody::Kind::kSolid; }
    softbody::SoftBody build() const {
        return mesh ? softbody::build_mesh_body(*mesh) : softbody::build_body(body);
    }
    Shape shape(const softbody::SoftBody& built, const Points& x) const {
        return mesh ? shape_of(built, x, picture, caption)
                    : shape_of(body, built, x, picture, caption);
    }
};

/// Checks that "length_along" names an axis of the body.
void check_axis(const JsonCursor& experiment, const softbody::BodyDescription& body) {
    const auto along = experiment.find("length_along");
    if (along && along->string() == "a3" && body.kind != softbody::Kind::kSolid)
        along->fail("\"a1\" or \"a2\", the axes of a surface");
}

std::vector<Case> read_cases(const JsonCursor& experiment) {
    std::vector<Case> cases;
    for (const JsonCursor& json : experiment.at("cases").items()) {
        json.allow_keys({"name", "caption", "picture", "change", "at"});
        Case one;
        one.name = json.at("name").string();
        for (const Case& other : cases)
            if (other.name == one.name)
                json.at("name").fail("a name of its own", "\"" + one.name + "\" again");
        one.caption = json.at("caption").string();
        one.picture = json.has("picture") ? json.at("picture").string() : one.name;
        const JsonCursor body = changed_json(experiment.at("body"), json.find("change"), one.name);
        if (softbody::is_mesh_body(body)) {
            one.mesh = softbody::read_mesh_body(body);
            if (experiment.has("length_along"))
                experiment.at("length_along").fail("no axis, since a mesh has none");
        } else {
            one.body = softbody::read_body(body);
            check_axis(experiment, one.body);
        }
        if (const auto at = json.find("at"))
            one.to_equilibrium = at->one_of({"rest", "equilibrium"}) == "equilibrium";
        cases.push_back(std::move(one));
    }
    if (cases.empty()) experiment.at("cases").fail("at least one case");
    return cases;
}

struct Result {
    Shape shape;
    EquilibriumRun equilibrium;
    double volume_change_percent = kUnmeasured, max_move_m = 0;
    Extent extent{kUnmeasured, kUnmeasured};
    std::vector<double> holding_n, fibre_stretch;  ///< of the supports and muscles of a mesh
};

/// Removes columns without any measured value.
void drop_unmeasured(Table& table) {
    for (std::size_t c = table.columns.size(); c-- > 0;) {
        if (!std::all_of(table.rows.begin(), table.rows.end(),
                         [&](const std::vector<double>& row) { return std::isnan(row[c]); }))
            continue;
        const auto place = static_cast<std::ptrdiff_t>(c);
        table.columns.erase(table.columns.begin() + place);
        for (std::vector<double>& row : table.rows) row.erase(row.begin() + place);
    }
}

}  // namespace

void run_equilibrium(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    allow_experiment_keys(experiment,
                          {"body", "cases", "integrator", "duration_s", "length_along"});
    const std::vector<Case> cases = read_cases(experiment);
    const solve::IntegratorOptions integrator =
        softbody::read_integrator(experiment.at("integrator"));
    const double duration_s =
        experiment.has("duration_s") ? experiment.at("duration_s").number({0, kInfinity}) : 0;
    int axis = -1;
    if (const auto along = experiment.find("length_along"))
        axis = along->one_of({"a1", "a2", "a3"})[1] - '1';

    std::vector<Result> results(cases.size());
    Progress progress(options, static_cast<double>(cases.size()));
    parallel_for(static_cast<int>(cases.size()), options.threads, [&](int i) {
        const Case& one = cases[static_cast<std::size_t>(i)];
        Result& result = results[static_cast<std::size_t>(i)];
        const softbody::SoftBody body = one.build();
        result.equilibrium.x = body.rest;
        if (one.to_equilibrium)
            result.equilibrium = run_to_equilibrium(body, integrator, duration_s, options);
        const Points& x = result.equilibrium.x;
        result.shape = one.shape(body, x);
        if (one.to_equilibrium) result.shape.outline = rest_outline(body);
        if (body.kind == softbody::Kind::kSolid)
            result.volume_change_percent = 100 * (body.volume(x) / body.volume(body.rest) - 1);
        result.max_move_m = (x - body.rest).rowwise().norm().maxCoeff();
        if (axis >= 0) result.extent = extent_along(body, x, axis);
        for (const softbody::SoftBody::Support& support : body.supports)
            result.holding_n.push_back(body.holding_n(support, x).norm());
        for (const auto& muscle : body.muscles)
            result.fibre_stretch.push_back(muscle->mean_stretch(x));
        progress.done(1, one.name);
    });

    Table table{
        .name = "cases",
        .columns = {"length_ratio", "drift_ratio", "volume_change_percent", "greatest_move_m",
                    "force_ratio", "speed_per_s", "steps", "evaluations", "linear_solves"},
        .rows = {}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Result& result = results[i];
        const EquilibriumRun& equilibrium = result.equilibrium;
        outcome.figure.shapes.push_back(result.shape);
        if (!cases[i].to_equilibrium) continue;
        const std::string& name = cases[i].name;
        if (axis >= 0) {
            outcome.measured.add("length_ratio/" + name, "", result.extent.length_ratio);
            outcome.measured.add("drift_ratio/" + name, "", result.extent.drift_ratio);
        }
        if (cases[i].solid())
            outcome.measured.add("volume_change_percent/" + name, "%",
                                 result.volume_change_percent);
        outcome.measured.add("greatest_move_m/" + name, "m", result.max_move_m);
        outcome.measured.add("force_ratio/" + name, "", equilibrium.force_ratio);
        outcome.measured.add("diverged/" + name, "", equilibrium.report.diverged ? 1 : 0);
        for (std::size_t k = 0; k < result.holding_n.size(); ++k)
            outcome.measured.add("holding_n/" + name + "/" + std::to_string(k), "N",
                                 result.holding_n[k]);
        for (std::size_t k = 0; k < result.fibre_stretch.size(); ++k)
            outcome.measured.add("fibre_stretch/" + name + "/" + std::to_string(k), "",
                                 result.fibre_stretch[k]);
        table.row_names.push_back(name);
        table.rows.push_back({result.extent.length_ratio, result.extent.drift_ratio,
                              result.volume_change_percent, result.max_move_m,
                              equilibrium.force_ratio, equilibrium.speed_ratio,
                              static_cast<double>(equilibrium.report.steps),
                              static_cast<double>(equilibrium.report.evaluations),
                              static_cast<double>(equilibrium.report.linear_solves)});
    }
    drop_unmeasured(table);
    outcome.figure.tables.push_back(std::move(table));
}

}  // namespace risorius::figures
