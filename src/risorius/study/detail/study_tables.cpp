// SPDX-License-Identifier: MIT
#include "risorius/study/detail/study_tables.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"

namespace risorius::study {

namespace {

/// A number with `decimals` digits, without "-0".
std::string digits(double value, int decimals) {
    if (!std::isfinite(value)) return "n/a";
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    const bool zero = std::string(text).find_first_of("123456789") == std::string::npos;
    return zero && text[0] == '-' ? text + 1 : text;
}

void describe(Json& columns, const std::string& name, const std::string& text,
              const std::string& unit = "") {
    columns[name] = json_object({{"Description", text}});
    if (!unit.empty()) columns[name]["Units"] = unit;
}

/// A table while it is made.
struct Draft {
    std::string name, text;
    Json columns = Json::object();

    StudyTable table() const { return {name, text, json_text(columns, 2) + "\n"}; }
};

constexpr const char* kSampleText = "Number of the face; 0 is the rig as it is";

StudyTable samples_table(const StudyDescription& study, const SampledRigs& rigs,
                         const StudyResults& results) {
    Draft out{"samples", "sample\tmatrix\trow", Json::object()};
    describe(out.columns, "sample", kSampleText);
    describe(out.columns, "matrix",
             "A, B: the two independent samples; the name of a parameter: A with this parameter "
             "from B; rig: the rig as it is");
    describe(out.columns, "row", "Row of A and B, from 0");
    for (const Parameter& parameter : study.parameters) {
        out.text += "\t" + parameter.name;
        describe(out.columns, parameter.name,
                 parameter.text() + ", of " + std::to_string(parameter.numbers.size()) +
                     (parameter.each ? " numbers, each with a value of its own; here their mean"
                                     : " numbers"));
    }
    describe(out.columns, "in_equilibrium", "Whether all poses of the face came to rest");
    out.text += "\tin_equilibrium\n";
    for (std::size_t r = 0; r < rigs.runs().size(); ++r) {
        const Run& run = rigs.runs()[r];
        out.text += std::to_string(r) + "\t" + rigs.matrix_name(run) + "\t" +
                    (run.matrix == Matrix::kNominal ? "n/a" : std::to_string(run.row));
        for (std::size_t p = 0; p < study.parameters.size(); ++p) {
            const double mean = rigs.values(run, p).mean();
            out.text += "\t" + (std::isfinite(mean) ? format_number(mean) : "n/a");
        }
        out.text +=
            results.in_equilibrium.row(static_cast<Eigen::Index>(r)).all() ? "\t1\n" : "\t0\n";
    }
    return out.table();
}

StudyTable displacements_table(const StudyDescription& study, const StudyResults& results) {
    Draft out{"displacements", "sample\tpose\tlandmark\tx_mm\ty_mm\tz_mm\n", Json::object()};
    describe(out.columns, "sample", std::string(kSampleText) + "; see samples.tsv");
    describe(out.columns, "pose", "Pose of the study");
    describe(out.columns, "landmark", "Landmark of the rig");
    describe(out.columns, "x_mm", "Displacement from the head at rest to the subject's left", "mm");
    describe(out.columns, "y_mm", "Displacement upwards", "mm");
    describe(out.columns, "z_mm", "Displacement forwards", "mm");
    for (Eigen::Index r = 0; r < results.moved_mm.rows(); ++r) {
        Eigen::Index column = 0;
        for (const Pose& pose : study.poses)
            for (const std::string& landmark : study.landmarks) {
                out.text += std::to_string(r) + "\t" + pose.name + "\t" + landmark;
                for (int k = 0; k < 3; ++k)
                    out.text += "\t" + digits(results.moved_mm(r, column++), 4);
                out.text += "\n";
            }
    }
    return out.table();
}

StudyTable spread_table(const StudyDescription& study, const StudyResults& results) {
    Draft out{"spread", "pose\tlandmark\trig_mm\tmean_mm\tsd_mm\tp5_mm\tp95_mm\taway_p95_mm\n",
              Json::object()};
    describe(out.columns, "pose", "Pose of the study");
    describe(out.columns, "landmark", "Landmark of the rig");
    describe(out.columns, "rig_mm", "Length of the displacement on the rig as it is", "mm");
    describe(out.columns, "mean_mm", "Mean length of the displacement over A and B", "mm");
    describe(out.columns, "sd_mm",
             "Root mean square distance of the displacement from its mean, in space", "mm");
    describe(out.columns, "p5_mm", "5 % of the lengths are below", "mm");
    describe(out.columns, "p95_mm", "95 % of the lengths are below", "mm");
    describe(out.columns, "away_p95_mm",
             "95 % of the displacements are within this distance of that of the rig as it is",
             "mm");
    for (const Output& output : results.landmarks) {
        out.text += study.poses[static_cast<std::size_t>(output.pose)].name + "\t" +
                    study.landmarks[static_cast<std::size_t>(output.landmark)];
        const Spread& s = output.spread;
        for (const double value : {s.rig, s.mean, s.deviation, s.low, s.high, s.away})
            out.text += "\t" + digits(value, 3);
        out.text += "\n";
    }
    return out.table();
}

StudyTable indices_table(const StudyDescription& study, const StudyResults& results) {
    Draft out{
        "indices",
        "pose\tlandmark\tparameter\tfirst\tfirst_low\tfirst_high\ttotal\ttotal_low\ttotal_high\n",
        Json::object()};
    describe(out.columns, "pose", "Pose of the study");
    describe(out.columns, "landmark", "Landmark of the rig; all: all landmarks together");
    describe(out.columns, "parameter", "Parameter of the study");
    describe(out.columns, "first",
             "First-order Sobol index: the part of the variance that would go away if the "
             "parameter were known");
    describe(out.columns, "total",
             "Total Sobol index: the part of the variance that would stay if all other parameters "
             "were known");
    for (const char* of : {"first", "total"}) {
        describe(out.columns, std::string(of) + "_low", "2.5 % of the bootstrap replicates");
        describe(out.columns, std::string(of) + "_high", "97.5 % of the bootstrap replicates");
    }
    const auto add = [&](const Output& output) {
        for (std::size_t p = 0; p < output.indices.size(); ++p) {
            out.text +=
                study.poses[static_cast<std::size_t>(output.pose)].name + "\t" +
                (output.landmark < 0 ? "all"
                                     : study.landmarks[static_cast<std::size_t>(output.landmark)]) +
                "\t" + study.parameters[p].name;
            for (const sensitivity::Estimate& estimate :
                 {output.indices[p].first, output.indices[p].total})
                for (const double value : {estimate.value, estimate.low, estimate.high})
                    out.text += "\t" + digits(value, 4);
            out.text += "\n";
        }
    };
    for (const Output& pose : results.poses) add(pose);
    for (const Output& landmark : results.landmarks) add(landmark);
    return out.table();
}

}  // namespace

std::vector<StudyTable> study_tables(const StudyDescription& study, const SampledRigs& rigs,
                                     const StudyResults& results) {
    std::vector<StudyTable> out{samples_table(study, rigs, results),
                                displacements_table(study, results), spread_table(study, results)};
    if (study.indices) out.push_back(indices_table(study, results));
    return out;
}

}  // namespace risorius::study
