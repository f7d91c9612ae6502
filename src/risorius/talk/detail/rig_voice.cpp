// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/rig_voice.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/solve/nonnegative_least_squares.h"

namespace risorius::talk {

namespace {

// Weights of the measures, 1/mm, and of the others. Found by trying on the adult.
constexpr double kGapWeight = 1, kBoundWeight = 3, kWidthWeight = 0.46, kProtrusionWeight = 0.4,
                 kTeethWeight = 2, kEffortWeight = 0.05, kSumWeight = 60, kRidge = 0.005;
// Cost of a pose by its distance from the wanted mouth: near poses mix almost linearly, far ones do not.
constexpr double kFarCost = 0.06, kFarGap_mm = 1.5, kFarJaw_mm = 1.5, kFarWidth_mm = 3,
                 kFarProtrusion_mm = 2;
constexpr double kTeethOverGap = 0.8;
// On the way to the teeth the lip is as far from them as the gap is wider than in f.
constexpr double kGapAtTeeth_mm = 4;
enum Row { kGap, kWidth, kUpper, kLower, kTeeth, kEffort, kSum, kRows };

Json numbers(const Eigen::VectorXd& values) {
    Json out = Json::array();
    for (const double value : values) out.push_back(std::round(value * 1e5) / 1e5);
    return out;
}

constexpr const char* kMeasures[] = {"gap_middle",       "gap_side", "width", "upper_protrusion",
                                     "lower_protrusion", "jaw",      "teeth"};
std::array<double*, 7> measures_of(Mouth& mouth) {
    return {&mouth.gap_middle,       &mouth.gap_side, &mouth.width, &mouth.upper_protrusion,
            &mouth.lower_protrusion, &mouth.jaw,      &mouth.teeth};
}

}  // namespace

RigVoice::RigVoice(std::vector<MouthPose> poses, std::vector<double> jaw_travel_mm,
                   std::vector<std::string> columns)
    : poses_(std::move(poses)),
      jaw_travel_mm_(std::move(jaw_travel_mm)),
      columns_(std::move(columns)) {
    activations_.resize(static_cast<long>(columns_.size()), static_cast<long>(poses_.size()));
    effort_.resize(static_cast<long>(poses_.size()));
    for (std::size_t i = 0; i < poses_.size(); ++i) {
        activations_.col(static_cast<long>(i)) = poses_[i].activation;
        effort_[static_cast<long>(i)] = poses_[i].activation.cwiseAbs().sum();
    }
}

double RigVoice::jaw_open_of(double jaw_mm) const {
    if (jaw_travel_mm_.size() < 2) return 0;
    const double wanted = std::max(jaw_mm, jaw_travel_mm_.front());
    for (std::size_t i = 1; i < jaw_travel_mm_.size(); ++i) {
        const double a = jaw_travel_mm_[i - 1], b = jaw_travel_mm_[i];
        if (wanted <= b && b > a)
            return kJawStep * (static_cast<double>(i - 1) + (wanted - a) / (b - a));
    }
    return 1;
}

Eigen::VectorXd RigVoice::activation_for(const WantedMouth& wanted, Eigen::VectorXd& state) const {
    const auto n = static_cast<long>(poses_.size());
    Eigen::VectorXd weight(static_cast<long>(kRows));
    weight[kGap] = kGapWeight + kBoundWeight * wanted.bounded * (1 - wanted.labiodental);
    weight[kWidth] = kWidthWeight;
    weight[kUpper] = weight[kLower] = kProtrusionWeight;
    weight[kTeeth] = kTeethWeight * wanted.labiodental;
    // Where the lip is at the teeth, the gap is what the upper lip leaves free, and the lip is as far forward as the teeth.
    weight[kGap] *= 1 - kTeethOverGap * wanted.labiodental;
    weight[kLower] *= 1 - wanted.labiodental;
    weight[kEffort] = kEffortWeight;
    weight[kSum] = kSumWeight;
    Eigen::MatrixXd B(static_cast<long>(kRows), n);
    for (long i = 0; i < n; ++i) {
        const MouthPose& pose = poses_[static_cast<std::size_t>(i)];
        B(kGap, i) = pose.virtual_gap - kGapOfJaw * pose.mouth.jaw;
        B(kWidth, i) = pose.mouth.width;
        B(kUpper, i) = pose.mouth.upper_protrusion;
        B(kLower, i) = pose.mouth.lower_protrusion;
        B(kTeeth, i) = pose.mouth.teeth - kGapOfJaw * pose.mouth.jaw;
        B(kEffort, i) = effort_[i];
        B(kSum, i) = 1;
    }
    Eigen::VectorXd y(static_cast<long>(kRows));
    y[kGap] = wanted.gap - kGapOfJaw * wanted.jaw;
    y[kWidth] = wanted.width;
    y[kUpper] = y[kLower] = wanted.protrusion;
    const double wanted_teeth = std::max(0.0, wanted.gap - kGapAtTeeth_mm);
    y[kTeeth] = wanted_teeth - kGapOfJaw * wanted.jaw;
    y[kEffort] = 0;
    y[kSum] = 1;
    Eigen::VectorXd cost(n);
    const auto squared = [](double x) { return x * x; };
    for (long i = 0; i < n; ++i) {
        const MouthPose& pose = poses_[static_cast<std::size_t>(i)];
        // How hard a mouth is pressed matters less than whether it is shut.
        const double gap = std::max(pose.virtual_gap, -1.5),
                     wanted_gap = std::max(wanted.gap, -1.5);
        double far =
            squared((gap - wanted_gap) / kFarGap_mm) +
            squared((pose.mouth.jaw - wanted.jaw) / kFarJaw_mm) +
            squared((pose.mouth.width - wanted.width) / kFarWidth_mm) +
            squared((pose.mouth.upper_protrusion - wanted.protrusion) / kFarProtrusion_mm) +
            squared((pose.mouth.lower_protrusion - wanted.protrusion) / kFarProtrusion_mm);
        far += wanted.labiodental * squared((pose.mouth.teeth - wanted_teeth) / kFarGap_mm);
        cost[i] = 0.5 * kFarCost * far;
    }
    B = weight.asDiagonal() * B;
    y = weight.asDiagonal() * y;
    const Eigen::VectorXd w = solve::nonnegative_least_squares(B, y, cost, kRidge, state);
    const double sum = w.sum();
    Eigen::VectorXd out = activations_ * w;
    if (sum > 0) out /= sum;
    return out;
}

Json RigVoice::json(const std::string& hash) const {
    Json out = json_object({{"format", "risorius-voice"}, {"version", 1}, {"hash", hash}});
    out["columns"] = columns_;
    out["jaw_travel_mm"] = jaw_travel_mm_;
    out["poses"] = Json::array();
    for (MouthPose pose : poses_) {
        Json one;
        one["activation"] = numbers(pose.activation);
        one["jaw_open"] = pose.jaw_open;
        for (std::size_t k = 0; k < 7; ++k)
            one[kMeasures[k]] = std::round(*measures_of(pose.mouth)[k] * 1e4) / 1e4;
        one["virtual_gap"] = std::round(pose.virtual_gap * 1e4) / 1e4;
        out["poses"].push_back(std::move(one));
    }
    return out;
}

RigVoice RigVoice::read(const JsonCursor& json, const std::vector<std::string>& columns) {
    json.at("format").one_of({"risorius-voice"});
    json.allow_keys({"format", "version", "hash", "columns", "jaw_travel_mm", "poses"});
    const std::vector<JsonCursor> names = json.at("columns").items();
    bool same = names.size() == columns.size();
    for (std::size_t i = 0; same && i < names.size(); ++i) same = names[i].string() == columns[i];
    if (!same) json.at("columns").fail("the muscles of the rig", "others");
    std::vector<double> travel;
    for (const JsonCursor& item : json.at("jaw_travel_mm").items()) travel.push_back(item.number());
    std::vector<MouthPose> poses;
    for (const JsonCursor& item : json.at("poses").items()) {
        item.allow_keys({"activation", "jaw_open", "gap_middle", "gap_side", "width",
                         "upper_protrusion", "lower_protrusion", "jaw", "teeth", "virtual_gap"});
        MouthPose pose;
        const std::vector<JsonCursor> values = item.at("activation").items();
        if (values.size() != columns.size())
            item.at("activation").fail(std::to_string(columns.size()) + " numbers");
        pose.activation.resize(static_cast<long>(values.size()));
        for (std::size_t i = 0; i < values.size(); ++i)
            pose.activation[static_cast<long>(i)] = values[i].number({-1, 1});
        pose.jaw_open = item.at("jaw_open").number({0, 1});
        for (std::size_t k = 0; k < 7; ++k)
            *measures_of(pose.mouth)[k] = item.at(kMeasures[k]).number({-1000, 1000});
        pose.mouth.gap = std::max(pose.mouth.gap_middle, pose.mouth.gap_side);
        pose.virtual_gap = item.at("virtual_gap").number({-1000, 1000});
        poses.push_back(std::move(pose));
    }
    if (poses.empty()) json.at("poses").fail("at least one pose");
    return {std::move(poses), std::move(travel), columns};
}

}  // namespace risorius::talk
