// SPDX-License-Identifier: MIT
// risorius evaluate RIG --shapes FILE [--fit] [-o DIR], evaluate RIG --like RIG, evaluate RIG --facs [-o DIR [--kit]]
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/inverse/code_agreement.h"
#include "risorius/inverse/compare_heads.h"
#include "risorius/inverse/evaluate.h"
#include "risorius/inverse/read_units.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct EvaluateArguments {
    Common common;
    inverse::EvaluateOptions options;
    std::filesystem::path like;
    bool facs = false;
    inverse::UnitOptions units;
    std::filesystem::path codes, key;
    bool no_pictures = false;
};

void print(const inverse::HeadComparison& comparison) {
    std::printf(
        "%s compared with %s: landmarks of brows, eyes, nose and lips, scaled by head size\n",
        comparison.rig.c_str(), comparison.like.c_str());
    std::printf("  %-20s %10s %7s %7s %6s  %s\n", "", "difference", "cosine", "length", "mm",
                "most at");
    for (const inverse::HeadDifference& one : comparison.expressions)
        std::printf("  %-20s %10.3f %7.3f %7.2f %6.2f  %s\n", one.expression.c_str(),
                    one.difference, one.cosine, one.length_ratio, one.landmark_mm,
                    one.worst.c_str());
    std::printf("  %-20s %10.3f\n", "mean", comparison.mean_difference());
}

void print_means(const char* what, const inverse::Evaluation& evaluation,
                 const std::vector<std::string>& names) {
    const inverse::ScoreMeans table = evaluation.means(names, false);
    const inverse::ScoreMeans fitted = evaluation.means(names, true);
    if (table.count == 0) return;
    std::printf("  %-20s %6.3f %6.3f %6.2f %6s %6.2f", what, table.cosine, table.relative,
                1e3 * table.rms_m, "", 1e3 * table.landmark_m);
    if (fitted.count > 0)
        std::printf("   | %6.3f %6.3f %6.2f %6s %6.2f   least cosine %.3f", fitted.cosine,
                    fitted.relative, 1e3 * fitted.rms_m, "", 1e3 * fitted.landmark_m,
                    fitted.min_cosine);
    std::printf("\n");
}

void print(const inverse::Evaluation& evaluation, const inverse::EvaluateOptions& options) {
    std::printf("%s, %d nodes, against %s\n", evaluation.rig.c_str(), evaluation.nodes,
                evaluation.shapes.c_str());
    std::printf(
        "  cos: cosine similarity, rel: relative error (1 without motion), rms, max, landmarks in "
        "mm\n");
    std::printf("  %-20s %6s %6s %6s %6s %6s%s\n", "by the rig's table", "cos", "rel", "rms", "max",
                "landm", options.fit ? "   | fitted: cos, rel, rms, max, landm" : "");
    const auto numbers = [](const scene::ExpressionScore& score) {
        std::printf("%6.3f %6.3f %6.2f %6.1f %6.2f", score.cosine, score.relative,
                    1e3 * score.rms_m, 1e3 * score.max_m, 1e3 * score.landmark_m);
    };
    for (const inverse::EvaluatedExpression& one : evaluation.expressions) {
        std::printf("  %-20s ", one.name.c_str());
        numbers(one.table.score);
        if (one.fitted) {
            std::printf("   | ");
            numbers(one.fitted->score);
        }
        if (one.table.inverted_tets > 0)
            std::printf("  %d tetrahedra inverted", one.table.inverted_tets);
        if (!one.table.converged) std::printf("  did not come to rest");
        std::printf("\n");
    }
    for (const inverse::ExpressionGroup& group : evaluation.groups())
        print_means(("mean of " + group.title).c_str(), evaluation, group.names);
    if (!options.out.empty())
        std::printf("report: %s\n", (options.out / "index.html").generic_string().c_str());
}

void compare(EvaluateArguments& arguments) {
    inverse::HeadComparison comparison;
    {
        ProgressBar bar(arguments.common);
        comparison = inverse::compare_heads(arguments.options.rig, arguments.like,
                                            arguments.options.only.empty()
                                                ? inverse::twenty_four_expressions()
                                                : arguments.options.only,
                                            arguments.options.quality, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(comparison.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(comparison);
}

void print(const inverse::UnitReadings& readings) {
    const scene::FaceMeasures& rest = readings.neutral;
    std::printf("%s, neutral: eye opening %.1f mm, mouth %.1f mm wide\n", readings.rig.c_str(),
                rest.lid_aperture, rest.mouth_width);
    std::printf("  %-6s %5s %5s %5s %5s %6s %6s %6s %6s %6s %6s %6s %6s  %s\n", "", "gain", ".25",
                ".5", ".75", "eye", "width", "gap", "corner", "fold", "frown", "brow", "touch",
                "landmarks: gain along the target");
    for (const scene::UnitReading& one : readings.units) {
        std::printf("  %-6s %5.2f", one.unit.c_str(), one.gain);
        for (const double share : one.response) std::printf(" %5.2f", share);
        if (one.response.empty()) std::printf(" %5s %5s %5s", "-", "-", "-");
        std::printf(" %+6.1f %+6.1f %+6.1f %+6.1f ", one.change.lid_aperture,
                    one.change.mouth_width, one.change.lip_gap, one.change.corner_height);
        std::printf("%+6.1f %+6.1f %+6.1f %+6.0f ", one.change.nasolabial_furrow,
                    one.change.glabellar_furrow, one.change.forehead_furrow,
                    one.change.lip_contact_mm2);
        for (const scene::LandmarkReading& mark : one.landmarks)
            std::printf(" %s %.2f", mark.landmark.c_str(), mark.gain);
        if (one.faults.inverted_tets > 0)
            std::printf("  %d tetrahedra inverted", one.faults.inverted_tets);
        std::printf("%s\n", one.in_equilibrium ? "" : "  did not come to rest");
    }
    std::printf(
        "  gain: 1 when the landmarks move as far as facs.json asks; .25, .5, .75: the part of the "
        "full way at\n  that intensity; eye, width, gap, corner: change of the eye opening, of the "
        "width of the mouth, of the gap\n  between the lips, and of the height of the corners, "
        "mm\n");
}

void print(const inverse::Agreement& agreement) {
    std::printf("%d clips; index of agreement %.2f\n", agreement.clips, agreement.index);
    std::printf("  %-6s %6s %6s %12s %6s %18s\n", "", "shown", "seen", "falsely seen", "kappa",
                "intensity within 1");
    for (const inverse::UnitAgreement& one : agreement.units) {
        std::printf("  AU%-4d %6d %6d %12d %6.2f ", one.unit, one.shown, one.seen, one.falsely_seen,
                    one.kappa);
        if (one.levels > 0) std::printf("%11d of %d", one.levels_within_1, one.levels);
        std::printf("\n");
    }
    std::printf(
        "  seen: clips that show the unit and in which it was coded; falsely seen: coded, but not "
        "shown; kappa: 0 by\n  chance, 1 at best; index: twice the agreed units / all units that "
        "were shown and coded\n");
}

void compare_codes(EvaluateArguments& arguments) {
    if (arguments.key.empty()) throw Error("evaluate", "--key FILE with --codes", "none");
    const inverse::Agreement agreement = inverse::code_agreement(arguments.codes, arguments.key);
    if (arguments.common.json)
        std::printf("%s\n", json_text(agreement.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(agreement);
}

void read_units(EvaluateArguments& arguments) {
    if (!arguments.codes.empty()) return compare_codes(arguments);
    inverse::UnitOptions& options = arguments.units;
    options.rig = arguments.options.rig;
    options.out = arguments.options.out;
    options.only = arguments.options.only;
    options.quality = arguments.options.quality;
    options.pictures = !arguments.no_pictures;
    inverse::UnitReadings readings;
    {
        ProgressBar bar(arguments.common);
        readings = inverse::read_units(options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(readings.json(), 2).c_str());
    else if (!arguments.common.quiet) {
        print(readings);
        if (!options.out.empty())
            std::printf("report: %s\n", (options.out / "index.html").generic_string().c_str());
    }
}

void run(EvaluateArguments& arguments) {
    const int kinds = !arguments.options.shapes.empty() + !arguments.like.empty() + arguments.facs;
    if (kinds != 1)
        throw Error("evaluate", "one of --shapes FILE, --like RIG and --facs",
                    kinds == 0 ? "none" : std::to_string(kinds));
    if (arguments.facs) return read_units(arguments);
    if (!arguments.like.empty()) return compare(arguments);
    arguments.options.pictures = !arguments.no_pictures;
    inverse::Evaluation evaluation;
    {
        ProgressBar bar(arguments.common);
        evaluation = inverse::evaluate(arguments.options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(evaluation.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(evaluation, arguments.options);
}

}  // namespace

void add_evaluate(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("evaluate", "Compare simulated expressions with measured ones");
    auto arguments = std::make_shared<EvaluateArguments>();
    inverse::EvaluateOptions& options = arguments->options;
    command->add_option("RIG", options.rig, "The rig whose expressions are evaluated")->required();
    command->add_option("--shapes", options.shapes,
                        "Measured displacements of the vertices of the rig's mesh: JSON with a "
                        "file of raw numbers, see docs/formats/measured-shapes.md");
    command->add_option("--like", arguments->like,
                        "Instead of --shapes: a rig to compare the expressions of RIG with");
    command->add_flag("--facs", arguments->facs,
                      "Instead of --shapes: measure the action units of RIG as a FACS coder would: "
                      "landmarks against the targets of its table, eye opening, mouth");
    command->add_flag("!--no-steps", arguments->units.steps,
                      "With --facs: measure each unit at full intensity only, not at .25, .5 and "
                      ".75, which takes a third of the time");
    command->add_flag("--kit", arguments->units.kit,
                      "With --facs and --out: also make a kit for coders, clips whose names do not "
                      "tell what they show, of units and combinations in a random order, a sheet "
                      "to fill in, and the "
                      "key to it");
    command
        ->add_option("--seed", arguments->units.seed, "The order of the clips of the kit, a number")
        ->capture_default_str();
    command->add_option("--codes", arguments->codes,
                        "With --facs: the sheet of a kit that a coder has filled in; prints how "
                        "well it agrees with what was shown");
    command->add_option("--key", arguments->key, "With --codes: the file key.tsv of the kit");
    command->add_option("-o,--out", options.out,
                        "The folder of the report: index.html, contact sheets, pictures, "
                        "results.json, scores.tsv. Without it, numbers are only printed");
    command
        ->add_option("--only", options.only,
                     "Names of expressions, separated by commas. Default: all")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_flag("--fit", options.fit,
                      "Also fit activations (0 to 1) to the measured expressions, starting from "
                      "those of the rig and using as few muscles as possible");
    command->add_flag("--apart", options.separate_sides,
                      "Evaluate the left and right sides (NAME_L, NAME_R) separately. Default: "
                      "their sum, as NAME");
    command
        ->add_option("--quality", options.quality,
                     "Quality of the simulation: \"preview\", \"video\" or \"fine\"")
        ->capture_default_str();
    command->add_flag("--no-pictures", arguments->no_pictures, "Write the report without pictures");
    add_common(*command, arguments->common);
    command->footer(
        "Cosine similarity says how alike the simulated and the measured displacement of the skin "
        "are in shape (1 at\nbest), the relative error how large their difference is (0 at best, 1 "
        "for a face that does not move).\n\n"
        "Examples:\n"
        "  risorius evaluate anna/rig.json --shapes anna/expressions.json -o out/anna\n"
        "  risorius evaluate anna/rig.json --shapes anna/expressions.json --fit --only "
        "mouthSmile,jawOpen -o out/fit\n"
        "  risorius evaluate anna/rig.json --like rigs/adult/rig.json\n"
        "  risorius evaluate anna/rig.json --facs --only AU6,AU12\n"
        "  risorius evaluate anna/rig.json --facs --kit -o out/units\n"
        "  risorius evaluate anna/rig.json --facs --codes sheet.tsv --key out/units/key.tsv");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
