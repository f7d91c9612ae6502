// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/verification.h"

#include <cmath>
#include <string>

#include "risorius/figures/detail/known_problems.h"
#include "risorius/figures/detail/progress.h"

namespace risorius::figures {
namespace {

constexpr double kRounding = 1e-12;  // distances below this have no order

struct VerificationPlan {
    const KnownProblem* problem = nullptr;
    KnownMaterial material;  ///< without Poisson's ratio
    std::vector<double> poisson_ratios;
    std::vector<double> solutions;  ///< for each Poisson's ratio, times that of the problem
    std::vector<int> cells;         ///< ascending
};

/// What a cantilever alone may have.
void read_clamped(const JsonCursor& experiment, VerificationPlan& plan) {
    plan.solutions.assign(plan.poisson_ratios.size(), 1);
    for (const char* key : {"lengthwise", "solutions"})
        if (experiment.has(key) && plan.problem->name != "cantilever")
            experiment.at(key).fail("no such key but for the problem \"cantilever\"");
    if (const auto lengthwise = experiment.find("lengthwise"))
        plan.material.lengthwise = lengthwise->integer(1, 8);
    const auto solutions = experiment.find("solutions");
    if (!solutions) return;
    const std::vector<JsonCursor> list = solutions->items();
    if (list.size() != plan.solutions.size())
        solutions->fail("one number for each of \"poisson_ratios\"", std::to_string(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) plan.solutions[i] = list[i].number({0.5, 2});
}

VerificationPlan read_verification(const JsonCursor& experiment) {
    allow_experiment_keys(experiment, {"problem", "element", "young_pa", "poisson_ratios", "cells",
                                       "lengthwise", "solutions"});
    VerificationPlan plan;
    std::vector<std::string_view> names;
    for (const KnownProblem& problem : known_problems()) names.push_back(problem.name);
    const std::string name = experiment.at("problem").one_of(names);
    for (const KnownProblem& problem : known_problems())
        if (problem.name == name) plan.problem = &problem;
    if (const auto element = experiment.find("element")) {
        plan.material.bending_cells =
            element->one_of({"cells", "bending-cells"}) == "bending-cells";
        if (plan.material.bending_cells && !plan.problem->boxes)
            element->fail("cells: those of this problem are no boxes");
    }
    plan.material.young_pa = experiment.at("young_pa").number({1e-6, 1e12});
    for (const JsonCursor& json : experiment.at("poisson_ratios").items())
        plan.poisson_ratios.push_back(json.number({0, 0.4999}));
    for (const JsonCursor& json : experiment.at("cells").items()) {
        plan.cells.push_back(json.integer(1, 40));
        if (plan.cells.size() > 1 && plan.cells.back() <= plan.cells[plan.cells.size() - 2])
            json.fail("more cells than before");
        const bool even = name == "cook" || name == "torsion" || name == "thick-plate";
        if (even && plan.cells.back() % 2 != 0) json.fail("an even number of cells");
        if (name == "patch" && plan.cells.back() < 2) json.fail("2 cells at least");
    }
    if (plan.poisson_ratios.empty()) experiment.at("poisson_ratios").fail("at least one");
    read_clamped(experiment, plan);
    if (plan.cells.empty()) experiment.at("cells").fail("at least one");
    return plan;
}

}  // namespace

void run_verification(const JsonCursor& experiment, const RunOptions& options, Outcome& outcome) {
    const VerificationPlan plan = read_verification(experiment);
    const std::size_t meshes = plan.cells.size();
    std::vector<double> found(plan.poisson_ratios.size() * meshes);
    double all = 0;
    const auto work = [&](std::size_t i) { return std::pow(plan.cells[i % meshes], 4.0); };
    for (std::size_t i = 0; i < found.size(); ++i) all += work(i);
    Progress progress(options, all);
    options.monitor.throw_if_stopped();
    parallel_for(static_cast<int>(found.size()), options.threads, [&](int i) {
        // The longest first
        const std::size_t at = found.size() - 1 - static_cast<std::size_t>(i);
        options.monitor.throw_if_stopped();
        KnownMaterial material = plan.material;
        material.poisson_ratio = plan.poisson_ratios[at / meshes];
        found[at] =
            plan.problem->solve(material, plan.cells[at % meshes]) / plan.solutions[at / meshes];
        progress.done(work(at), std::to_string(plan.cells[at % meshes]) + " cells");
    });

    const std::string measure(plan.problem->measure);
    const double exact = plan.problem->exact;
    Table table{.name = measure, .columns = {}, .rows = {}};
    for (const int cells : plan.cells) table.columns.push_back(std::to_string(cells) + "_cells");
    plot::Chart values{.name = measure,
                       .title = experiment.has("title") ? experiment.at("title").string()
                                                        : std::string(plan.problem->name),
                       .x = {.label = "cells", .logarithmic = true},
                       .y = {.label = exact == 1   ? "measured over exact"
                                      : exact == 0 ? "distance from the solution"
                                                   : measure,
                             .logarithmic = exact == 0}};
    for (std::size_t p = 0; p < plan.poisson_ratios.size(); ++p) {
        const std::string of = format_number(plan.poisson_ratios[p]);
        plot::Series series{
            .label = "nu = " + of, .x = {}, .y = {}, .mark = plot::Mark::kLinePoints};
        table.row_names.push_back("nu = " + of);
        table.rows.emplace_back();
        for (std::size_t c = 0; c < meshes; ++c) {
            const double value = found[p * meshes + c];
            const std::string name = of + "/" + std::to_string(plan.cells[c]);
            outcome.measured.add(measure + "/" + name, "", value);
            table.rows.back().push_back(value);
            series.x.push_back(plan.cells[c]);
            // Rounding errors of an exact solution have no place on a logarithmic axis
            series.y.push_back(exact == 0 ? std::max(value, 1e-16) : value);
            const double before = c == 0 ? 0 : std::abs(found[p * meshes + c - 1] - exact);
            if (before < kRounding) continue;
            outcome.measured.add(
                "order/" + name, "",
                std::log(before / std::abs(value - exact)) /
                    std::log(static_cast<double>(plan.cells[c]) / plan.cells[c - 1]));
        }
        values.series.push_back(std::move(series));
    }
    if (exact != 0) {
        const auto first = static_cast<double>(plan.cells.front()),
                   last = static_cast<double>(plan.cells.back());
        values.series.push_back({.label = "exact",
                                 .x = {first, last},
                                 .y = {exact, exact},
                                 .mark = plot::Mark::kDashed});
    }
    outcome.figure.tables.push_back(std::move(table));
    outcome.figure.charts.push_back(std::move(values));
}

}  // namespace risorius::figures
