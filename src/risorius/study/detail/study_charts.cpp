// SPDX-License-Identifier: MIT
#include "risorius/study/detail/study_charts.h"

#include <algorithm>
#include <cmath>

namespace risorius::study {

namespace {

constexpr std::size_t kShownLandmarks = 16;
constexpr double kBeside =
    0.16;  ///< of first-order and total index around the place of the parameter

plot::Axis named_axis(const std::vector<std::string>& names) {
    plot::Axis axis;
    for (std::size_t i = 0; i < names.size(); ++i)
        axis.names.emplace_back(static_cast<double>(i), names[i]);
    axis.range = {-0.6, static_cast<double>(names.size()) - 0.4};
    return axis;
}

/// Points, each with a line from low to high; lines are one series with gaps.
void add_intervals(plot::Chart& chart, const std::string& label, int colour,
                   const std::vector<double>& x, const std::vector<sensitivity::Estimate>& values) {
    plot::Series points{label, x, {}, plot::Mark::kPoints, colour};
    plot::Series lines{"", {}, {}, plot::Mark::kLine, colour};
    for (std::size_t i = 0; i < x.size(); ++i) {
        points.y.push_back(values[i].value);
        for (const double y : {values[i].low, values[i].high, std::nan("")}) {
            lines.x.push_back(x[i]);
            lines.y.push_back(y);
        }
    }
    chart.series.push_back(std::move(points));
    chart.series.push_back(std::move(lines));
}

plot::Chart indices_chart(const StudyDescription& study, const Output& pose) {
    const std::string& name = study.poses[static_cast<std::size_t>(pose.pose)].name;
    plot::Chart chart;
    chart.name = "indices_" + name;
    chart.title = name + ": where the variance of the landmarks comes from";
    std::vector<std::string> names;
    std::vector<double> left, right;
    std::vector<sensitivity::Estimate> first, total;
    for (std::size_t p = 0; p < study.parameters.size(); ++p) {
        names.push_back(study.parameters[p].name);
        left.push_back(static_cast<double>(p) - kBeside);
        right.push_back(static_cast<double>(p) + kBeside);
        first.push_back(pose.indices[p].first);
        total.push_back(pose.indices[p].total);
    }
    chart.x = named_axis(names);
    chart.y.label = "Sobol index (part of the variance)";
    add_intervals(chart, "first order", 0, left, first);
    add_intervals(chart, "total", 1, right, total);
    return chart;
}

plot::Chart spread_chart(const StudyDescription& study, const StudyResults& results, int pose) {
    const std::string& name = study.poses[static_cast<std::size_t>(pose)].name;
    plot::Chart chart;
    chart.name = "spread_" + name;
    chart.title = name + ": displacement of the landmarks that move most";
    std::vector<std::string> names;
    std::vector<double> x, rig;
    std::vector<sensitivity::Estimate> spread;
    for (const Output* output : shown_landmarks(study, results, pose, kShownLandmarks)) {
        x.push_back(static_cast<double>(names.size()));
        names.push_back(study.landmarks[static_cast<std::size_t>(output->landmark)]);
        rig.push_back(output->spread.rig);
        spread.push_back({output->spread.mean, output->spread.low, output->spread.high});
    }
    chart.x = named_axis(names);
    chart.x.label = "landmark";
    chart.y.label = "displacement (mm)";
    add_intervals(chart, "mean, 5 to 95 %", 0, x, spread);
    chart.series.push_back({"the rig as it is", x, rig, plot::Mark::kPoints, 1});
    return chart;
}

bool has_partner(const StudyDescription& study, const std::string& landmark) {
    if (!landmark.ends_with("_r")) return false;
    const std::string partner = landmark.substr(0, landmark.size() - 1) + "l";
    return std::count(study.landmarks.begin(), study.landmarks.end(), partner) > 0;
}

/// Whether any parameter changes anything in the pose, so that it has indices.
bool varies(const Output& pose) {
    return !pose.indices.empty() && std::isfinite(pose.indices.front().total.value);
}

}  // namespace

std::vector<const Output*> shown_landmarks(const StudyDescription& study,
                                           const StudyResults& results, int pose,
                                           std::size_t most) {
    std::vector<const Output*> out;
    for (const Output& output : results.landmarks)
        if (output.pose == pose &&
            !has_partner(study, study.landmarks[static_cast<std::size_t>(output.landmark)]))
            out.push_back(&output);
    std::stable_sort(out.begin(), out.end(), [](const Output* a, const Output* b) {
        return a->spread.rig > b->spread.rig;
    });
    if (out.size() > most) out.resize(most);
    return out;
}

std::vector<plot::Chart> study_charts(const StudyDescription& study, const StudyResults& results) {
    std::vector<plot::Chart> out;
    for (const Output& pose : results.poses) {
        if (varies(pose)) out.push_back(indices_chart(study, pose));
        out.push_back(spread_chart(study, results, pose.pose));
    }
    return out;
}

}  // namespace risorius::study
