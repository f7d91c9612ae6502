// SPDX-License-Identifier: MIT
// risorius bench [--rig RIG]... [--solids | --steps | --poses | --pictures | --shapes [FILE] | --stress STEPS] [-o FILE]
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/output_paths.h"
#include "tools/bench/bench_machine.h"
#include "tools/bench/machine_page.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct BenchArguments {
    Common common;
    bench::BenchOptions options;
    std::filesystem::path out;
    bool only_solids = false;
    std::filesystem::path csv;
    std::string month;
};

void print_solids(const Json& report) {
    std::printf("solids of cells, hanging cube, psi_c = %g: steps of 1/60 s within %g %%\n",
                report["psi_n_per_m5"].get<double>(), 100 * report["accuracy"].get<double>());
    std::printf(
        "    nodes  iterations  ms, median    min  error, median    max  converged  growth\n");
    for (std::size_t i = 0; i < report["cases"].size(); ++i) {
        const Json& one = report["cases"][i];
        std::printf("  %7d  %10d  %10.2f  %5.1f  %11.2f %%  %4.2f %%  %6.0f ms",
                    one["nodes"].get<int>(), one["iterations"].get<int>(),
                    one["step_ms"].get<double>(), one["least_step_ms"].get<double>(),
                    100 * one["median_error"].get<double>(), 100 * one["worst_error"].get<double>(),
                    one["converged_step_ms"].get<double>());
        if (i > 0) std::printf("  n^%.2f", report["growth_exponents"][i - 1].get<double>());
        std::printf("\n");
        if (!one["newton_step_ms"].is_null())
            std::printf("           by Newton's method with a direct solver, converged: %.0f ms\n",
                        one["newton_step_ms"].get<double>());
    }
}

void print_stress(const Json& one) {
    std::printf("%s, %s, seed %d: %d steps of random drive, %.1f ms each\n",
                one["rig"].get<std::string>().c_str(), one["quality"].get<std::string>().c_str(),
                one["seed"].get<int>(), one["steps"].get<int>(), one["step_ms"].get<double>());
    std::printf("  %d broken; of %d tets at most %d inverted, %.2f on average\n",
                one["broken_steps"].get<int>(), one["tets"].get<int>(),
                one["most_inverted_tets"].get<int>(), one["mean_inverted_tets"].get<double>());
    std::printf(
        "  maximum motion of the skin %.1f mm; back at rest %d inverted, residual %.3f mm\n",
        one["furthest_mm"].get<double>(), one["inverted_at_rest"].get<int>(),
        one["left_at_rest_mm"].get<double>());
    const Json &usual = one["usual_penetration_mm"], &deepest = one["deepest_penetration_mm"];
    std::printf(
        "  penetration, 99 of 100 steps (all): lips %.2f (%.2f), bone %.2f (%.2f), eyeball "
        "%.2f (%.2f) mm\n",
        usual["lips"].get<double>(), deepest["lips"].get<double>(), usual["bone"].get<double>(),
        deepest["bone"].get<double>(), usual["eyeball"].get<double>(),
        deepest["eyeball"].get<double>());
}

void print_steps(const Json& cases) {
    std::printf(
        "  steps of 1/60 s: smile, sneer, jaw, pucker every half second; error of the skin\n"
        "                                nodes  iterations  ms, median   mean    min of 3  RMS mm  "
        "    max mm  inverted\n");
    for (const Json& one : cases)
        std::printf("    %-26s %6d  %10.1f  %10.2f  %5.2f  %10.2f  %6.3f  %10.2f  %8d\n",
                    one["quality"].get<std::string>().c_str(), one["nodes"].get<int>(),
                    one["iterations"].get<double>(), one["step_ms"].get<double>(),
                    one["mean_step_ms"].get<double>(), one["least_step_ms"].get<double>(),
                    one["rms_mm"].get<double>(), one["largest_mm"].get<double>(),
                    one["most_inverted_tets"].get<int>());
}

void print_poses(const Json& shells) {
    std::printf(
        "  equilibria: iterations and seconds of one core; left: maximum motion of a node when the "
        "equilibrium is solved again\n"
        "  with a tolerance 100 times smaller\n"
        "                      nodes  iterations  seconds  at rest  inverted  left mm\n");
    for (const Json& shell : shells)
        for (const Json& one : shell["poses"])
            std::printf("    %-16s %7d  %10d  %7.2f  %7s  %8d  %7.4f\n",
                        one["name"].get<std::string>().c_str(), shell["nodes"].get<int>(),
                        one["iterations"].get<int>(), one["seconds"].get<double>(),
                        one["at_rest"].get<bool>() ? "yes" : "no", one["inverted"].get<int>(),
                        one["left_mm"].get<double>());
}

void print_pictures(const Json& cases) {
    std::printf(
        "  pictures: frames per second of wall time on all cores, simulated, drawn and encoded; "
        "then "
        "processor time of a frame,\n"
        "  medians in ms:                       simulation  drawing  reading back  measuring  "
        "encoding\n");
    for (const Json& one : cases)
        std::printf("    %4d x %-4d %-8s %6.1f fps  %11.1f %8.1f %13.1f %10.1f %9.1f\n",
                    one["width_px"].get<int>(), one["height_px"].get<int>(),
                    one["draft"].get<bool>() ? "draft" : "", one["fps"].get<double>(),
                    one["simulate_ms"].get<double>(), one["draw_ms"].get<double>(),
                    one["read_back_ms"].get<double>(), one["measure_ms"].get<double>(),
                    one["encode_ms"].get<double>());
    std::printf("  passes of the drawing, ms of processor time:\n");
    for (const Json& one : cases) {
        std::printf("    %4d x %-4d %-6s", one["width_px"].get<int>(), one["height_px"].get<int>(),
                    one["draft"].get<bool>() ? "draft" : "");
        for (const auto& [name, ms] : one["passes_ms"].items())
            std::printf("  %s %.1f", name.c_str(), ms.get<double>());
        std::printf("\n");
    }
}

void print_shapes(const Json& one) {
    std::printf(
        "  a frame of %d blend shapes and %d correctives on %d vertices: %.2f ms, weights %.2f of "
        "it; maximum %.2f ms\n",
        one["shapes"].get<int>(), one["correctives"].get<int>(), one["vertices"].get<int>(),
        one["frame_ms"].get<double>(), one["weights_ms"].get<double>(),
        one["slowest_frame_ms"].get<double>());
}

void print_growth(const Json& growth) {
    std::printf(
        "  processor time of all threads, and most memory; exponent e: as (size / size "
        "before)^e\n");
    for (const Json& one : growth) {
        std::printf("  %s\n", one["series"].get<std::string>().c_str());
        for (std::size_t i = 0; i < one["cases"].size(); ++i) {
            const Json& at = one["cases"][i];
            std::printf("    %8.0f %-8s %10.4f s %7.0f MB", at["size"].get<double>(),
                        one["size"].get<std::string>().c_str(), at["seconds"].get<double>(),
                        at["megabytes"].get<double>());
            if (i > 0) std::printf("  e = %.2f", one["exponents"][i - 1].get<double>());
            std::printf("\n");
        }
    }
}

void print(const Json& report) {
    std::printf("%s, %d cores\n", report["machine"]["cpu"].get<std::string>().c_str(),
                report["machine"]["cores"].get<int>());
    if (report.contains("stress")) {
        for (const Json& one : report["stress"]) print_stress(one);
        return;
    }
    if (report.contains("growth")) {
        print_growth(report["growth"]);
        return;
    }
    for (const Json& solids : report["solids"]) print_solids(solids);
    for (const Json& rig : report["rigs"]) {
        std::printf("%s\n", rig["rig"].get<std::string>().c_str());
        if (rig.contains("steps")) print_steps(rig["steps"]);
        if (rig.contains("poses")) print_poses(rig["poses"]);
        if (rig.contains("pictures")) print_pictures(rig["pictures"]);
        if (rig.contains("blend_shapes")) print_shapes(rig["blend_shapes"]);
        if (!rig.contains("preview")) continue;
        for (const char* quality : {"preview", "video", "fine"})
            std::printf("  %-8s %6d nodes  %7.2f ms per step of 1/60 s  (built in %.2f s)\n",
                        quality, rig[quality]["nodes"].get<int>(),
                        rig[quality]["step_ms"].get<double>(),
                        rig[quality]["build_s"].get<double>());
        std::printf("  in all   %7.2f x real time from script to video, %.0f MB at most\n",
                    rig["whole_way"]["real_time_factor"].get<double>(),
                    rig["peak_memory_mb"].get<double>());
    }
}

/// One page when everything was measured; else, or when they are asked for, the tables.
void show(const Json& report, bool tables) {
    const std::string page = bench::machine_page(
        report, bench::read_known_machines(data_folder() / "docs/performance/benchmarks"));
    std::printf("%s", page.c_str());
    if (page.empty() || tables) print(report);
}

void check_month(const std::string& month) {
    const auto digit = [&](std::size_t i) { return month[i] >= '0' && month[i] <= '9'; };
    if (month.size() != 7 || !digit(0) || !digit(1) || !digit(2) || !digit(3) || month[4] != '-' ||
        !digit(5) || !digit(6))
        throw Error(option_name("month"), "a month, for instance 2026-11", "\"" + month + "\"");
}

void run(const BenchArguments& arguments) {
    if (!arguments.csv.empty()) {
        check_month(arguments.month);
        if (std::filesystem::exists(arguments.csv))
            throw Error(arguments.csv.string(), "no file", "one");
    }
    if (!arguments.out.empty())
        report::check_overwritten(arguments.out, {"risorius-bench"},
                                  "no file, or an earlier report");
    Json report;
    bench::BenchOptions options = arguments.options;
    options.faces = !arguments.only_solids;
    {
        ProgressBar bar(arguments.common);
        report = bench::bench_machine(options, bar.monitor());
    }
    const std::string text = json_text(report, 2) + "\n";
    if (!arguments.out.empty()) report::write_text(arguments.out, text);
    if (!arguments.csv.empty())
        report::write_text(arguments.csv, bench::benchmark_file(report, arguments.month));
    if (arguments.common.json)
        std::printf("%s", text.c_str());
    else if (!arguments.common.quiet)
        show(report, arguments.options.tables);
}

}  // namespace

void add_bench(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure how fast this machine is");
    auto arguments = std::make_shared<BenchArguments>();
    command->add_option("--rig", arguments->options.rigs,
                        "A rig to measure; repeat for several. Default: rigs/adult");
    command
        ->add_flag("--solids", arguments->only_solids,
                   "Measure only deformable solids of 13^3, 22^3 and 46^3 nodes, without a face")
        ->excludes("--rig");
    command
        ->add_flag("--steps", arguments->options.only_steps,
                   "Measure only the time and the error of the rigs' time steps")
        ->excludes("--solids");
    command
        ->add_flag("--poses", arguments->options.only_poses,
                   "Measure only how fast equilibria are found, on meshes of 2,000 to 20,000 "
                   "nodes; takes minutes")
        ->excludes("--solids")
        ->excludes("--steps");
    command
        ->add_flag("--pictures", arguments->options.only_pictures,
                   "Measure only the frames per second that are simulated, drawn and encoded, at "
                   "512 x 512, 1024 x 1024 and 1920 x 1080, with and without --draft")
        ->excludes("--solids")
        ->excludes("--steps")
        ->excludes("--poses");
    command
        ->add_option_function<std::string>(
            "--shapes",
            [arguments](const std::string& file) {
                arguments->options.only_shapes = true;
                arguments->options.shapes = file;
            },
            "Measure only the time for a frame of blend shapes; with a shapes.glb of risorius "
            "shapes, of those and their correctives")
        ->expected(0, 1)
        ->type_name("[FILE]")
        ->excludes("--solids")
        ->excludes("--steps")
        ->excludes("--poses")
        ->excludes("--pictures");
    command
        ->add_option_function<std::string>(
            "--growth",
            [arguments](const std::string& folder) {
                arguments->options.only_growth = true;
                arguments->options.growth_chart = folder;
            },
            "Measure only how processor time and memory grow with nodes, vertices, frames, clips "
            "and threads; takes minutes. With a folder, a chart is written there")
        ->expected(0, 1)
        ->type_name("[FOLDER]")
        ->excludes("--solids")
        ->excludes("--steps")
        ->excludes("--poses")
        ->excludes("--pictures")
        ->excludes("--shapes");
    command
        ->add_option("--stress", arguments->options.stress_steps,
                     "Only move the face at random for this many steps; report inverted tetrahedra "
                     "and penetration")
        ->check(CLI::Range(1, 1000000))
        ->excludes("--solids")
        ->excludes("--poses");
    command->add_option("--seed", arguments->options.seed, "Seed of --stress")->needs("--stress");
    command->add_option("--quality", arguments->options.quality, "Quality of --stress")
        ->check(CLI::IsMember({"preview", "video", "fine"}))
        ->needs("--stress");
    command->add_option("-o,--out", arguments->out, "The report to write, JSON");
    command
        ->add_option("--csv", arguments->csv,
                     "A benchmark file to write, for the table of known machines; a complete run "
                     "measures what it holds")
        ->excludes("--solids")
        ->excludes("--steps")
        ->excludes("--poses")
        ->excludes("--pictures")
        ->excludes("--shapes")
        ->excludes("--growth")
        ->excludes("--stress");
    command->add_option("--month", arguments->month, "The month in --csv, for instance 2026-11")
        ->needs("--csv");
    command->get_option("--csv")->needs("--month");
    command->add_flag(
        "--tables", arguments->options.tables,
        "Measure and print more than the page about this machine shows: solids, and errors of "
        "steps. Takes a quarter of an hour");
    add_common(*command, arguments->common);
    command->footer("Example:\n  risorius bench --rig rigs/adult/rig.json -o bench.json");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
