// SPDX-License-Identifier: MIT
// Calibrates the standard anatomy on measured expressions of one head. This tool is for authors of the tables, not for their
// users.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "risorius/core/error.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/inverse/evaluate.h"
#include "risorius/rig/head.h"
#include "risorius/scene/landmark_displacements.h"
#include "risorius/scene/rig_files.h"
#include "tools/calibrate/calibration.h"
#include "tools/calibrate/tables.h"
#include "tools/calibrate/unit_weights.h"

namespace {

using namespace risorius;

// Mean fibre length of each muscle when it alone is fully active.
std::map<std::string, double> stretches(const scene::RigFiles& files,
                                        const rig::RigDescription& rig,
                                        const std::string& quality) {
    face::Face face(rig, files.mesh, face::quality_named(quality), files.place());
    const track::ChannelTable channels = rig.channels();
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(channels.column_count());
    std::map<std::string, double> out;
    for (const rig::MuscleBand& band : rig.atlas.bands) {
        if (out.count(band.muscle)) continue;
        Eigen::VectorXd activation = rest.excitation;
        for (const Side side : {Side::kLeft, Side::kRight})
            activation[channels.column(band.muscle, side)] = 1;
        face.start([&](double) { return rest; });
        face.solve_equilibrium(activation, rest);
        out[band.muscle] = face.diagnostics().mean_stretch(band.muscle);
    }
    return out;
}

// Writes the displacement of the landmarks in every standard expression of the calibrated head.
void write_ways(const std::filesystem::path& rig_file, const std::string& quality,
                const std::filesystem::path& standard) {
    const scene::RigFiles files = scene::read_rig_files(rig_file);
    face::Face face(files.rig, files.mesh, face::quality_named(quality), files.place());
    scene::LandmarkDisplacements ways(face, files.rig, files.place());
    scene::DisplacementTable table;
    // Expressions of lids and jaw give no information on the strength of muscles.
    const std::set<std::string> others{"eyeBlink", "eyeWide", "jawForward", "jawOpen"};
    for (const std::string& name : inverse::twenty_four_expressions()) {
        if (others.count(name)) continue;
        const Points moved = ways.solve_equilibrium(ways.drive(name));
        for (std::size_t i = 0; i < ways.landmarks().size(); ++i)
            table[name][ways.landmarks()[i]] = moved.row(static_cast<long>(i)).transpose();
    }
    calibrate::write_ways(table, standard);
}

void print_changes(const std::vector<calibrate::Parameter>& parameters,
                   const Eigen::VectorXd& values) {
    std::printf("\nparameters that moved by more than half their spread:\n");
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        const double off = values[static_cast<long>(p)] / parameters[p].spread;
        if (std::abs(off) > 0.5)
            std::printf("  %-60s %+8.3f  (%+.1f)\n", parameters[p].name.c_str(),
                        values[static_cast<long>(p)], off);
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Calibrates the standard anatomy on measured expressions.", "calibrate");
    std::filesystem::path rig_file, shapes_file, standard, goals;
    std::vector<std::filesystem::path> also;
    std::vector<std::string> only, free;
    calibrate::Options options;
    double min = 0.05;
    bool shapes_too = false, ways_only = false, unit_gains = false;
    app.add_option("RIG", rig_file, "A rig of the measured head, with the tables to improve")
        ->required();
    app.add_option("--shapes", shapes_file, "Measured displacements");
    app.add_option("--only", only, "Expressions to calibrate on")->delimiter(',');
    app.add_option("--free", free,
                   "Only parameters whose names begin with one of these may change, such as "
                   "slide,lift for the attachments. Default: all")
        ->delimiter(',');
    app.add_option("--standard", standard, "Folder of tables to write into");
    app.add_option("--unit-goals", goals,
                   "Instead of --shapes: goals of action units for landmarks, see unit_weights.h. "
                   "Prints weights; --only names units");
    app.add_flag("--unit-gains", unit_gains,
                 "Only measure the gains of the action units with the strengths that RIG has, and "
                 "write them into it");
    app.add_option("--also", also, "Further rigs for --unit-goals");
    app.add_option("--rounds", options.rounds)->capture_default_str();
    app.add_option("--keep", options.keep)->capture_default_str();
    app.add_option("--stay", options.stay)->capture_default_str();
    app.add_option("--price", options.l1_weight)->capture_default_str();
    app.add_option("--quality", options.quality)->capture_default_str();
    app.add_flag("--write-shapes", shapes_too, "Write the activations found into facs.json, too");
    app.add_flag("--ways-only", ways_only,
                 "Only write how the landmarks of RIG go in every expression, landmark_ways.json: "
                 "after a fit of RIG with the tables written before");
    CLI11_PARSE(app, argc, argv);
    try {
        if (unit_gains) {
            calibrate::write_unit_gains(rig_file);
            return 0;
        }
        if (!goals.empty()) {
            also.insert(also.begin(), rig_file);
            calibrate::find_unit_weights(also, goals, only, options.keep);
            return 0;
        }
        if (standard.empty()) throw Error("calibrate", "--standard FOLDER", "none");
        if (ways_only) {
            write_ways(rig_file, "video", standard);
            return 0;
        }
        if (shapes_file.empty() || only.empty())
            throw Error("calibrate", "--shapes and --only, or --ways-only", "neither");
        const scene::RigFiles files = scene::read_rig_files(rig_file);
        const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
        const std::vector<inverse::MeasuredShape> shapes =
            inverse::read_measured_shapes(shapes_file, {.only = only}, files.rig, head);
        std::vector<calibrate::Parameter> parameters = calibrate::anatomy_parameters(files.rig);
        std::erase_if(parameters, [&](const calibrate::Parameter& parameter) {
            return !free.empty() && std::none_of(free.begin(), free.end(), [&](const auto& begin) {
                return parameter.name.starts_with(begin);
            });
        });
        std::printf("%zu parameters, %zu expressions\n", parameters.size(), shapes.size());
        const calibrate::Result result =
            calibrate::calibrate(files, shapes, parameters, options, [](const std::string& line) {
                std::printf("%s\n", line.c_str());
                std::fflush(stdout);
            });
        print_changes(parameters, result.parameters);
        const rig::RigDescription found =
            calibrate::changed(files.rig, parameters, result.parameters);
        std::printf(
            "\ntissue: deep %.0f superficial %.0f bulk %.0f lid %.3f lip %.3f modiolus %.2f "
            "passive %.3f\n",
            found.tissue.deep_shear_pa, found.tissue.superficial_shear_pa, found.tissue.bulk_pa,
            found.tissue.lid_shear_ratio, found.tissue.lip_shear_ratio,
            found.tissue.modiolus_shear_ratio, found.tissue.fibre_passive_strain);
        std::printf("skin: membrane %.2f bending %.3g lid %.4f\n", found.skin.membrane_n_per_m,
                    found.skin.bending_n_m, found.skin.lid_membrane_ratio);
        for (std::size_t e = 0; e < shapes.size(); ++e) {
            std::printf("%-16s relative error %.3f -> %.3f :", shapes[e].name.c_str(),
                        result.relative_before[e], result.relative_after[e]);
            for (std::size_t i = 0; i < result.unknowns[e].size(); ++i)
                if (std::abs(result.activations[e][static_cast<long>(i)]) >= min)
                    std::printf(" %s %.2f", result.unknowns[e][i].name.c_str(),
                                result.activations[e][static_cast<long>(i)]);
            std::printf("\n");
        }
        calibrate::write_tables(found, stretches(files, found, options.quality), standard);
        if (shapes_too) calibrate::write_shapes(shapes, result, files.rig, min, standard);
    } catch (const Error& error) {
        std::fprintf(stderr, "calibrate: %s\n", error.what());
        return 2;
    }
    return 0;
}
