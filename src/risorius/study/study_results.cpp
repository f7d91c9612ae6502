// SPDX-License-Identifier: MIT
#include "risorius/study/study_results.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"

namespace risorius::study {

namespace {

/// Rounded to a digit that a reader may believe; null where there is none.
Json rounded(double value, double per_unit) {
    if (!std::isfinite(value)) return nullptr;
    return std::round(value * per_unit) / per_unit + 0.0;
}

/// The columns of some landmarks in the rows of A, B and AB.
sensitivity::SampledResults rows_of(const StudyDescription& study, const std::vector<Run>& runs,
                                    const Eigen::MatrixXd& moved_mm, Eigen::Index column,
                                    Eigen::Index columns) {
    sensitivity::SampledResults out;
    out.a.resize(study.count, columns);
    out.b.resize(study.indices ? study.count : 0, columns);
    out.ab.assign(study.indices ? study.parameters.size() : 0,
                  Eigen::MatrixXd(study.count, columns));
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const Run& run = runs[r];
        if (run.matrix == Matrix::kNominal) continue;
        Eigen::MatrixXd& matrix = run.matrix == Matrix::kA ? out.a
                                  : run.matrix == Matrix::kB
                                      ? out.b
                                      : out.ab[static_cast<std::size_t>(run.parameter)];
        matrix.row(run.row) = moved_mm.block(static_cast<Eigen::Index>(r), column, 1, columns);
    }
    return out;
}

Spread spread_of(const sensitivity::SampledResults& results, const Eigen::RowVector3d& rig) {
    Eigen::MatrixXd all(results.a.rows() + results.b.rows(), 3);
    all << results.a, results.b;
    std::vector<double> lengths, distances;
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
        lengths.push_back(all.row(i).norm());
        distances.push_back((all.row(i) - rig).norm());
    }
    const Eigen::RowVector3d mean = all.colwise().mean();
    Spread out;
    out.rig = rig.norm();
    out.mean = all.rowwise().norm().mean();
    out.low = sensitivity::quantile_of(lengths, 0.05);
    out.high = sensitivity::quantile_of(lengths, 0.95);
    out.deviation = std::sqrt((all.rowwise() - mean).rowwise().squaredNorm().mean());
    out.away = sensitivity::quantile_of(distances, 0.95);
    return out;
}

Json estimate_json(const sensitivity::Estimate& estimate) {
    return {rounded(estimate.value, 1e4), rounded(estimate.low, 1e4), rounded(estimate.high, 1e4)};
}

Json indices_json(const StudyDescription& study, const Output& output) {
    Json out = Json::object();
    for (std::size_t p = 0; p < output.indices.size(); ++p)
        out[study.parameters[p].name] =
            json_object({{"first", estimate_json(output.indices[p].first)},
                         {"total", estimate_json(output.indices[p].total)}});
    return out;
}

}  // namespace

void analyse(const StudyDescription& study, const std::vector<Run>& runs, StudyResults& results) {
    const auto landmarks = static_cast<Eigen::Index>(study.landmarks.size());
    const sensitivity::IndexOptions options{.replicates = study.replicates, .seed = study.seed};
    results.landmarks.clear();
    results.poses.clear();
    for (std::size_t p = 0; p < study.poses.size(); ++p) {
        const Eigen::Index first = static_cast<Eigen::Index>(p) * 3 * landmarks;
        for (Eigen::Index l = 0; l < landmarks; ++l) {
            const Eigen::Index column = first + 3 * l;
            const auto rows = rows_of(study, runs, results.moved_mm, column, 3);
            Output output{static_cast<int>(p), static_cast<int>(l), {}, {}};
            output.spread = spread_of(rows, results.moved_mm.block<1, 3>(0, column));
            if (study.indices) output.indices = sensitivity::sobol_indices(rows, options);
            results.landmarks.push_back(std::move(output));
        }
        Output all{static_cast<int>(p), -1, {}, {}};
        if (study.indices)
            all.indices = sensitivity::sobol_indices(
                rows_of(study, runs, results.moved_mm, first, 3 * landmarks), options);
        results.poses.push_back(std::move(all));
    }
}

Json results_json(const StudyDescription& study, const StudyResults& results) {
    Json parameters = Json::object(), poses = Json::object();
    for (const Parameter& parameter : study.parameters)
        parameters[parameter.name] = json_object({{"of", parameter.of},
                                                  {"numbers", parameter.numbers.size()},
                                                  {"each", parameter.each},
                                                  {"varied", parameter.text()}});
    for (const Output& pose : results.poses) {
        Json landmarks = Json::object();
        for (const Output& output : results.landmarks) {
            if (output.pose != pose.pose) continue;
            const Spread& s = output.spread;
            Json entry = json_object({{"rig_mm", rounded(s.rig, 1e3)},
                                      {"mean_mm", rounded(s.mean, 1e3)},
                                      {"p5_mm", rounded(s.low, 1e3)},
                                      {"p95_mm", rounded(s.high, 1e3)},
                                      {"sd_mm", rounded(s.deviation, 1e3)},
                                      {"away_p95_mm", rounded(s.away, 1e3)}});
            if (study.indices) entry["indices"] = indices_json(study, output);
            landmarks[study.landmarks[static_cast<std::size_t>(output.landmark)]] = entry;
        }
        Json entry = json_object({{"landmarks", landmarks}});
        if (study.indices) entry["indices"] = indices_json(study, pose);
        poses[study.poses[static_cast<std::size_t>(pose.pose)].name] = entry;
    }
    return json_object({{"format", "risorius-study-results"},
                        {"version", 1},
                        {"name", study.name},
                        {"study", study.file.generic_string()},
                        {"rig", study.rig.generic_string()},
                        {"quality", study.quality},
                        {"count", study.count},
                        {"seed", study.seed},
                        {"faces", study.runs()},
                        {"unsettled", results.unsettled()},
                        {"parameters", parameters},
                        {"poses", poses}});
}

}  // namespace risorius::study
