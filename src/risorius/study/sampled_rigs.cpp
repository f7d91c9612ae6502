// SPDX-License-Identifier: MIT
#include "risorius/study/sampled_rigs.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"

namespace risorius::study {

namespace {

constexpr std::uint64_t kSeedOfGroups = 0x67726f757073;  // so that groups and single numbers differ

}  // namespace

SampledRigs::SampledRigs(const StudyDescription& study) : study_(study) {
    const std::size_t count = study.parameters.size();
    // Numbers with a parameter of their own take the good coordinates of the sequence; the many of a group are random.
    int singles = 0;
    for (const Parameter& parameter : study.parameters) singles += parameter.each ? 0 : 1;
    const Eigen::MatrixXd points = sensitivity::unit_sample(
        study.sampling, study.count, study.indices ? 2 * singles : singles, study.seed);
    int next = 0, group = 0;
    for (const Parameter& parameter : study.parameters) {
        if (!parameter.each) {
            a_.emplace_back(points.col(next));
            b_.emplace_back(points.col(study.indices ? singles + next : next));
            ++next;
            continue;
        }
        for (std::vector<Eigen::MatrixXd>* part : {&a_, &b_})
            part->push_back(sensitivity::unit_sample(
                study.sampling == sensitivity::Sampling::kSobol ? sensitivity::Sampling::kRandom
                                                                : study.sampling,
                study.count, parameter.columns(),
                study.seed ^ (kSeedOfGroups + static_cast<std::uint64_t>(group++))));
    }
    runs_.push_back({});
    for (int row = 0; row < study.count; ++row) {
        runs_.push_back({Matrix::kA, row, 0});
        if (!study.indices) continue;
        runs_.push_back({Matrix::kB, row, 0});
        for (std::size_t p = 0; p < count; ++p)
            runs_.push_back({Matrix::kAB, row, static_cast<int>(p)});
    }
    for (std::size_t p = 0; p < count; ++p) {
        const Parameter& parameter = study.parameters[p];
        for (const double u : {std::min(a_[p].minCoeff(), b_[p].minCoeff()),
                               std::max(a_[p].maxCoeff(), b_[p].maxCoeff())}) {
            const double value = parameter.distribution.quantile(u);
            Json changed = *study.rig_json;
            apply(changed, p, Eigen::VectorXd::Constant(parameter.columns(), value));
            try {
                read(changed);
            } catch (const Error& error) {
                throw Error(parameter.place, "values that the rig may have",
                            format_number(value) + ": " + error.what());
            }
        }
    }
}

std::string SampledRigs::matrix_name(const Run& run) const {
    switch (run.matrix) {
        case Matrix::kNominal:
            return "rig";
        case Matrix::kA:
            return "A";
        case Matrix::kB:
            return "B";
        case Matrix::kAB:
            return study_.parameters[static_cast<std::size_t>(run.parameter)].name;
    }
    return "";
}

Eigen::VectorXd SampledRigs::unit_values(const Run& run, std::size_t parameter) const {
    const bool from_b = run.matrix == Matrix::kB ||
                        (run.matrix == Matrix::kAB && run.parameter == static_cast<int>(parameter));
    return (from_b ? b_ : a_)[parameter].row(run.row);
}

Eigen::VectorXd SampledRigs::values(const Run& run, std::size_t parameter) const {
    const Parameter& varied = study_.parameters[parameter];
    if (run.matrix == Matrix::kNominal)
        return Eigen::VectorXd::Constant(varied.columns(),
                                         varied.how == Parameter::How::kFactor ? 1.0
                                         : varied.how == Parameter::How::kAdd
                                             ? 0.0
                                             : std::numeric_limits<double>::quiet_NaN());
    Eigen::VectorXd out = unit_values(run, parameter);
    for (double& value : out) value = varied.distribution.quantile(value);
    return out;
}

void SampledRigs::apply(Json& rig, std::size_t parameter, const Eigen::VectorXd& values) const {
    const Parameter& varied = study_.parameters[parameter];
    for (std::size_t n = 0; n < varied.numbers.size(); ++n) {
        Json& number = rig[Json::json_pointer(varied.numbers[n])];
        const double value = values[varied.each ? static_cast<Eigen::Index>(n) : 0];
        const double before = number.get<double>();
        number = varied.how == Parameter::How::kFactor ? before * value
                 : varied.how == Parameter::How::kAdd  ? before + value
                                                       : value;
    }
}

rig::RigDescription SampledRigs::read(const Json& rig) const {
    return rig::read_rig(JsonCursor::from_json(rig, study_.rig.string()));
}

rig::RigDescription SampledRigs::rig(const Run& run) const {
    Json changed = *study_.rig_json;
    if (run.matrix != Matrix::kNominal)
        for (std::size_t p = 0; p < study_.parameters.size(); ++p)
            apply(changed, p, values(run, p));
    return read(changed);
}

}  // namespace risorius::study
