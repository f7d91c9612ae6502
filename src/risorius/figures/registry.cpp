// SPDX-License-Identifier: MIT
#include "risorius/figures/registry.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/figures/detail/adaptive.h"
#include "risorius/figures/detail/contact_scenes.h"
#include "risorius/figures/detail/equilibrium.h"
#include "risorius/figures/detail/experiment_kind.h"
#include "risorius/figures/detail/force_curves.h"
#include "risorius/figures/detail/hanging_curve.h"
#include "risorius/figures/detail/implicit_steps.h"
#include "risorius/figures/detail/muscle_history.h"
#include "risorius/figures/detail/muscle_shapes.h"
#include "risorius/figures/detail/muscle_stability.h"
#include "risorius/figures/detail/muscle_statics.h"
#include "risorius/figures/detail/muscle_velocity.h"
#include "risorius/figures/detail/stable_step.h"
#include "risorius/figures/detail/static_resolution.h"
#include "risorius/figures/detail/verification.h"
#include "risorius/figures/detail/volume_history.h"

namespace risorius::figures {
namespace {

struct NamedKind {
    std::string_view name;
    RunExperiment run;
};

const std::vector<NamedKind>& kind_table() {
    static const std::vector<NamedKind> table = {
        {"equilibrium", run_equilibrium},
        {"volume-history", run_volume_history},
        {"static-resolution", run_static_resolution},
        {"stable-step", run_stable_step},
        {"muscle-stability", run_muscle_stability},
        {"muscle-statics", run_muscle_statics},
        {"muscle-history", run_muscle_history},
        {"muscle-velocity", run_muscle_velocity},
        {"muscle-curves", run_muscle_curves},
        {"muscle-shapes", run_muscle_shapes},
        {"implicit-steps", run_implicit_steps},
        {"contact", run_contact_scenes},
        {"hanging-curve", run_hanging_curve},
        {"adaptive", run_adaptive},
        {"verification", run_verification},
    };
    return table;
}

}  // namespace

const std::vector<Figure>& figures() {
    static const std::vector<Figure> list = {
        {"5", "Resolution dependent and independent parameters", "equilibrium", 1},
        {"8a", "Cloth hanging from three corners", "equilibrium", 2},
        {"8b", "Metal sheet held in two corners, softer on its right half", "equilibrium", 3},
        {"8c", "Stiff tube held at one end", "equilibrium", 2},
        {"8d", "Tube softer on its right half", "equilibrium", 3},
        {"8e", "Incompressible cube hanging", "equilibrium", 2},
        {"8f", "Inhomogeneous anisotropic block held at both sides", "equilibrium", 2},
        {"9a", "Change of the sum of volume elements", "volume-history", 18},
        {"9b", "Change of volume", "volume-history", 18},
        {"10", "Muscle at rest, and shortened and activated", "muscle-statics", 1},
        {"11a", "Zajac's tension-length experiment", "muscle-statics", 10},
        {"11b", "Quick release after Gasser and Hill", "muscle-history", 6},
        {"12a", "Longest stable step of explicit methods over damping", "stable-step", 12},
        {"12b", "Longest stable step of explicit methods over the nodes of a muscle",
         "muscle-stability", 50},
        {"implicit", "Longest usable step of implicit methods", "implicit-steps", 3},
        {"cells", "Trilinear cells against finite differences", "static-resolution", 18,
         Origin::kBeyond},
        {"curve", "Curve hanging between two points against the catenary", "hanging-curve", 2,
         Origin::kBeyond},
        {"muscle-curves", "Published force curves of muscle side by side", "muscle-curves", 1,
         Origin::kBeyond},
        {"force-velocity", "Force of a muscle that shortens or lengthens", "muscle-velocity", 2,
         Origin::kBeyond},
        {"isotonic", "Isotonic contraction: lifting weights", "muscle-velocity", 2,
         Origin::kBeyond},
        {"twitch", "Twitch, and twitches that fuse to a tetanus", "muscle-history", 3,
         Origin::kBeyond},
        {"muscles", "Muscles of every shape, at rest and contracted", "muscle-shapes", 3,
         Origin::kBeyond},
        {"pennation", "What the angle of the fibres does", "muscle-statics", 3, Origin::kBeyond},
        {"contact", "Soft bodies on rigid things and on each other", "contact", 30,
         Origin::kBeyond},
        {"adaptive", "Resolution where the strain asks for it", "adaptive", 10, Origin::kBeyond},
        {"cantilever", "Cells against Timoshenko's cantilever", "verification", 20,
         Origin::kBeyond},
        {"bar", "Bending cells against Timoshenko's bar", "verification", 5, Origin::kBeyond},
        {"cook", "Cells against Cook's panel", "verification", 5, Origin::kBeyond},
        {"patch", "Patch test on distorted cells", "verification", 1, Origin::kBeyond},
        {"torsion", "Cells against pure torsion", "verification", 10, Origin::kBeyond},
        {"manufactured", "Cells against a manufactured solution", "verification", 10,
         Origin::kBeyond},
    };
    return list;
}

Origin origin_of(std::string_view id) {
    for (const Figure& figure : figures())
        if (figure.id == id) return figure.origin;
    return Origin::kOwn;
}

std::vector<std::string_view> kinds() {
    std::vector<std::string_view> names;
    for (const NamedKind& kind : kind_table()) names.push_back(kind.name);
    return names;
}

FigureResult run_figure(const JsonCursor& experiment, const RunOptions& options) {
    const JsonCursor format = experiment.at("format");
    if (format.string() != "risorius-experiment") format.fail("\"risorius-experiment\"");
    experiment.at("version").integer(1, 1);
    const std::string id = experiment.at("figure").string();
    const std::string name = experiment.at("kind").one_of(kinds());

    const auto kind = std::find_if(kind_table().begin(), kind_table().end(),
                                   [&](const NamedKind& k) { return k.name == name; });
    Outcome outcome;
    Measurements::check_lists(experiment);
    kind->run(experiment, options, outcome);

    FigureResult& figure = outcome.figure;
    figure.id = id;
    figure.title = experiment.has("title") ? experiment.at("title").string() : id;
    figure.tables.push_back(outcome.measured.table());
    figure.checks = outcome.measured.check(experiment);
    figure.claims = outcome.measured.claims(experiment);
    figure.watched = outcome.measured.watched(experiment);
    figure.record["experiment"] = experiment.json();
    return std::move(outcome.figure);
}

void check_experiment(const JsonCursor& experiment) {
    try {
        // The monitor stops the run at its first step, after everything has been read and built.
        run_figure(experiment,
                   {.threads = 1, .monitor = {.progress = {}, .stopped = [] { return true; }}});
    } catch (const Interrupted&) {
    }
}

}  // namespace risorius::figures
