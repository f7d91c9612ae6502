// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/random_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>

namespace risorius::blendshapes {

namespace {

class Dice {
  public:
    explicit Dice(unsigned seed) : random_(seed) {}
    double fraction() { return static_cast<double>(random_()) / 4294967296.0; }
    double between(double min, double max) { return min + (max - min) * fraction(); }
    std::size_t index(std::size_t count) {
        return static_cast<std::size_t>(fraction() * static_cast<double>(count));
    }

  private:
    std::mt19937 random_;
};

constexpr std::array kUnits{1,  2,  4,  5,  6,  7,  9,  10, 11, 12, 13, 14, 15, 16,
                            17, 18, 20, 22, 23, 24, 25, 26, 27, 28, 38, 39, 43};
constexpr double kEvery_s = 0.5;    // mean time between onsets
constexpr double kBothSides = 0.8;  // probability for units with two sides

// Units that exclude each other, because they are degrees or opposites of one action, share a number.
int alternatives(int unit) {
    switch (unit) {
        case 25:
        case 26:
        case 27:
            return 1;
        case 18:
        case 22:
        case 23:
        case 24:
        case 28:
            return 2;
        case 5:
        case 43:
            return 3;
        case 38:
        case 39:
            return 4;
        default:
            return 0;
    }
}

struct Event {
    int unit;
    double start_s, onset_s, hold_s, offset_s, intensity;
    bool left, right;

    double end_s() const { return start_s + onset_s + hold_s + offset_s; }
    double at(double t_s) const {
        const double rise = std::clamp((t_s - start_s) / onset_s, 0.0, 1.0),
                     fall = std::clamp((end_s() - t_s) / offset_s, 0.0, 1.0);
        const double way = std::min(rise, fall);
        return intensity * way * way * (3 - 2 * way);
    }
};

std::vector<Event> random_events(double duration_s, Dice& dice) {
    std::vector<Event> out;
    // The track starts before the first frame.
    for (double t_s = -2;;) {
        t_s -= kEvery_s * std::log(1 - dice.fraction());
        if (t_s > duration_s) return out;
        Event one;
        one.unit = kUnits[dice.index(kUnits.size())];
        one.start_s = t_s;
        one.onset_s = dice.between(0.25, 0.6);
        one.hold_s = dice.between(0.1, 0.6);
        one.offset_s = dice.between(0.3, 0.8);
        one.intensity = dice.between(0.1, 1);
        const double side = dice.fraction();
        one.left = side < (1 + kBothSides) / 2;
        one.right = side < kBothSides || !one.left;
        const int kind = alternatives(one.unit);
        if (std::none_of(out.begin(), out.end(), [&](const Event& other) {
                return other.end_s() > t_s &&
                       (other.unit == one.unit || (kind > 0 && alternatives(other.unit) == kind));
            }))
            out.push_back(one);
    }
}

}  // namespace

std::vector<Eigen::VectorXd> random_weights(const MadeShapes& shapes, int frames, unsigned seed) {
    Dice dice(seed);
    constexpr int kAtATime = 4;
    std::vector<Eigen::VectorXd> out;
    for (int f = 0; f < frames; ++f) {
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<long>(shapes.list.size()));
        for (int n = 0; n < kAtATime; ++n) {
            const std::size_t i = dice.index(shapes.list.size());
            const ShapeGoal& goal = shapes.list[i].goal;
            const double weight = shapes.list[i].solved_at * dice.fraction();
            // Faces are more often symmetric than not
            const bool both = dice.fraction() < 0.7;
            if (goal.sides == Sides::kOpposed && weights[goal.partner] != 0) continue;
            weights[static_cast<long>(i)] = weight;
            if (goal.sides == Sides::kHalves && both) weights[goal.partner] = weight;
            // A shape that closes the lips over an open jaw has the weight of the open jaw.
            if (goal.on_top_of >= 0)
                weights[goal.on_top_of] = std::max(weights[goal.on_top_of], weight);
        }
        out.push_back(std::move(weights));
    }
    return out;
}

std::vector<Eigen::VectorXd> random_facs_track(const MadeShapes& shapes, int frames,
                                               unsigned seed) {
    const auto named = [&](const std::string& name) -> std::optional<long> {
        for (std::size_t i = 0; i < shapes.list.size(); ++i)
            if (shapes.list[i].goal.name == name) return static_cast<long>(i);
        return std::nullopt;
    };
    if (!named("AU25")) return {};
    Dice dice(seed);
    const std::vector<Event> events = random_events(frames, dice);
    std::vector<Eigen::VectorXd> out;
    for (int f = 0; f < frames; ++f) {
        Eigen::VectorXd& weights =
            out.emplace_back(Eigen::VectorXd::Zero(static_cast<long>(shapes.list.size())));
        for (const Event& event : events) {
            const double weight = event.at(f);
            if (weight == 0) continue;
            const std::string name = "AU" + std::to_string(event.unit);
            if (const auto whole = named(name)) weights[*whole] = weight;
            if (const auto left = named(name + ".l"); left && event.left) weights[*left] = weight;
            if (const auto right = named(name + ".r"); right && event.right)
                weights[*right] = weight;
        }
    }
    return out;
}

}  // namespace risorius::blendshapes
