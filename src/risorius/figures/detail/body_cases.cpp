// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/body_cases.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/softbody/integrator_description.h"

namespace risorius::figures {
namespace {

constexpr int kMaxNodesPerAxis = 1000;

Vec3 plane_centre(const tissue::GridShape& grid, const Points& x, int axis, bool last) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    const int wanted = last ? grid.along(axis) - 1 : 0;
    for (int i = 0; i < grid.m; ++i)
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k) {
                const int at[3] = {i, j, k};
                if (at[axis] != wanted) continue;
                sum += x.row(grid.index(i, j, k)).transpose();
                ++count;
            }
    return sum / count;
}

}  // namespace

JsonCursor changed_json(const JsonCursor& body, const std::optional<JsonCursor>& change,
                        const std::string& case_name) {
    if (!change) return body;
    change->keys();  // must be an object
    Json changed = body.json();
    changed.merge_patch(change->json());
    return JsonCursor::from_json(json_object({{"body", changed}}),
                                 body.file().string() + " (" + case_name + ")")
        .at("body");
}

softbody::BodyDescription changed_body(const JsonCursor& body,
                                       const std::optional<JsonCursor>& change,
                                       const std::string& case_name) {
    return softbody::read_body(changed_json(body, change, case_name));
}

std::string grid_name(const tissue::GridShape& grid) {
    return std::to_string(grid.m) + "x" + std::to_string(grid.n) + "x" + std::to_string(grid.o);
}

std::vector<tissue::GridShape> read_grids(const JsonCursor& json) {
    std::vector<tissue::GridShape> grids;
    for (const JsonCursor& entry : json.items()) {
        if (!entry.is_array()) {
            const int count = entry.integer(2, kMaxNodesPerAxis);
            grids.push_back({count, count, count});
            continue;
        }
        const auto counts = entry.items();
        if (counts.size() != 3) entry.fail("a number of nodes, or three");
        const auto count = [&](std::size_t axis) {
            return counts[axis].integer(2, kMaxNodesPerAxis);
        };
        grids.push_back({count(0), count(1), count(2)});
    }
    if (grids.empty()) json.fail("at least one grid");
    return grids;
}

std::vector<BodyRun> read_runs(const JsonCursor& experiment) {
    std::vector<BodyRun> runs;
    for (const JsonCursor& json : experiment.at("runs").items()) {
        json.allow_keys({"name", "label", "change", "grids", "integrator", "steps_s"});
        const std::string name = json.at("name").string();
        for (const BodyRun& other : runs)
            if (other.name == name)
                json.at("name").fail("a name of its own", "\"" + name + "\" again");
        BodyRun run{.name = name,
                    .label = json.at("label").string(),
                    .body = changed_body(experiment.at("body"), json.find("change"), name),
                    .integrator = softbody::read_integrator(json.at("integrator"))};
        if (run.body.kind != softbody::Kind::kSolid)
            experiment.at("body").fail("a body of kind \"solid\"", "a surface");
        const std::vector<tissue::GridShape> grids = read_grids(json.at("grids"));
        std::vector<double> steps_s(grids.size(), run.integrator.step_s);
        if (const auto own = json.find("steps_s")) {
            const std::vector<JsonCursor> items = own->items();
            if (items.size() != grids.size())
                own->fail("as many steps as \"grids\", " + std::to_string(grids.size()),
                          std::to_string(items.size()));
            for (std::size_t i = 0; i < items.size(); ++i)
                steps_s[i] = items[i].number({1e-12, 1e6});
        }
        for (std::size_t i = 0; i < grids.size(); ++i) {
            run.body.grid = grids[i];
            run.integrator.step_s = steps_s[i];
            tissue::check(softbody::grid_solid(run.body), run.body.place);
            runs.push_back(run);
        }
    }
    if (runs.empty()) experiment.at("runs").fail("at least one run");
    return runs;
}

Workload workload_of(const std::vector<BodyRun>& runs) {
    Workload load;
    for (const BodyRun& run : runs) {
        // The cost of a step grows with the number of nodes, and the number of explicit steps grows with their density.
        const double one = std::pow(run.body.grid.size(), 5.0 / 3);
        load.order.push_back(load.order.size());
        load.work.push_back(one);
        load.whole += one;
    }
    std::stable_sort(load.order.begin(), load.order.end(),
                     [&](std::size_t a, std::size_t b) { return load.work[a] > load.work[b]; });
    return load;
}

Shape shape_of(const softbody::SoftBody& body, const Points& x, const std::string& name,
               const std::string& caption) {
    return {.name = name,
            .caption = caption,
            .positions = x,
            .surface = body.surface,
            .wires = body.wires,
            .fixed = body.fixed};
}

Shape shape_of(const softbody::BodyDescription& description, const softbody::SoftBody& body,
               const Points& x, const std::string& name, const std::string& caption) {
    Shape shape = shape_of(body, x, name, caption);
    const std::vector<double> stiffness = softbody::relative_stiffness(description);
    if (stiffness.empty()) return shape;
    const auto [min, max] = std::minmax_element(stiffness.begin(), stiffness.end());
    if (!(*max > *min)) return shape;
    shape.shade_ends = {"softest", "stiffest"};
    for (const double value : stiffness) shape.shade.push_back((value - *min) / (*max - *min));
    return shape;
}

Points rest_outline(const softbody::SoftBody& body) {
    Points outline(2 * static_cast<Eigen::Index>(body.edges.size()), 3);
    Eigen::Index row = 0;
    for (const auto& edge : body.edges)
        for (const int node : edge) outline.row(row++) = body.rest.row(node);
    return outline;
}

Extent extent_along(const softbody::SoftBody& body, const Points& x, int axis) {
    const auto span = [&](const Points& at) -> Vec3 {
        return plane_centre(body.grid, at, axis, /*last=*/true) -
               plane_centre(body.grid, at, axis, /*last=*/false);
    };
    const Vec3 at_rest = span(body.rest), now = span(x);
    const double length = at_rest.norm();
    const double along = now.dot(at_rest) / length;
    return {.length_ratio = along / length,
            .drift_ratio = (now - along * at_rest / length).norm() / length};
}

}  // namespace risorius::figures
