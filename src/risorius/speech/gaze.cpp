// SPDX-License-Identifier: MIT
#include "risorius/speech/gaze.h"

#include <algorithm>

#include "risorius/core/counter_rng.h"

namespace risorius::speech {

namespace {

constexpr double kAwayLead_s = 0.1, kAway_s = 0.3, kLongEnough_s = 1;
constexpr double kAwayYaw_deg = 6, kMoreYaw_deg = 4, kAwayPitch_deg = 5;
constexpr double kRest_s = 0.7, kMoreRest_s = 1.3;
constexpr double kFaceYaw_deg = 1.6,
                 kFacePitch_deg = 1.2;  // eyes and mouth at the distance of a talk
constexpr double kBackAhead_s = 0.2;
constexpr std::uint64_t kGazeStream = 11;

class Looks {
  public:
    explicit Looks(double size) : size_(size) {}

    /// A jump at `t_s`, or as soon as the one before has ended.
    void jump(double t_s, double yaw_deg, double pitch_deg) {
        const Vec2 to = size_ * Vec2(yaw_deg, pitch_deg);
        if (!shifts_.empty())
            t_s = std::max(t_s, shifts_.back().start_s + shifts_.back().duration_s);
        shifts_.push_back({t_s, 0.022 + 0.0023 * (to - at_).norm(), to.x(), to.y()});
        at_ = to;
    }
    std::vector<GazeShift> take() { return std::move(shifts_); }

  private:
    double size_;
    Vec2 at_ = Vec2::Zero();
    std::vector<GazeShift> shifts_;
};

}  // namespace

std::vector<GazeShift> gaze_of(const Utterance& utterance, double size, std::uint64_t seed) {
    if (size <= 0) return {};
    std::vector<Span> sentences = utterance.sentences;
    if (sentences.empty()) sentences.push_back({"", 0, utterance.samples});
    Looks looks(size);
    double end_s = 0;
    for (std::size_t k = 0; k < sentences.size(); ++k) {
        const double from_s = utterance.seconds(sentences[k].start);
        end_s = utterance.seconds(sentences[k].end);
        std::uint64_t number = 0;
        const auto random = [&] {
            return CounterRng(seed).at(kGazeStream).at(k).at(number++).uniform();
        };
        double t_s = from_s;
        if (end_s - from_s >= kLongEnough_s) {
            const double side = random() < 0.5 ? -1 : 1;
            const double yaw_deg = side * (kAwayYaw_deg + kMoreYaw_deg * random()),
                         pitch_deg = kAwayPitch_deg * (2 * random() - 1);
            looks.jump(from_s - kAwayLead_s, yaw_deg, pitch_deg);
            t_s = from_s + kAway_s;
            looks.jump(t_s, 0, 0);
        }
        for (;;) {
            t_s += kRest_s + kMoreRest_s * random();
            if (t_s > end_s - kRest_s) break;
            const double yaw_deg = kFaceYaw_deg * (2 * random() - 1);
            looks.jump(t_s, yaw_deg, kFacePitch_deg * (2 * random() - 1));
        }
    }
    looks.jump(end_s + kBackAhead_s, 0, 0);
    return looks.take();
}

Vec2 gaze_at(const std::vector<GazeShift>& shifts, double t_s) {
    const auto next =
        std::upper_bound(shifts.begin(), shifts.end(), t_s,
                         [](double t, const GazeShift& shift) { return t < shift.start_s; });
    if (next == shifts.begin()) return Vec2::Zero();
    const GazeShift& shift = *(next - 1);
    const Vec2 to(shift.yaw_deg, shift.pitch_deg);
    Vec2 from = Vec2::Zero();
    if (next - 1 != shifts.begin()) from = Vec2((next - 2)->yaw_deg, (next - 2)->pitch_deg);
    const double s = std::clamp((t_s - shift.start_s) / shift.duration_s, 0.0, 1.0);
    return from + s * s * s * (10 + s * (6 * s - 15)) * (to - from);
}

}  // namespace risorius::speech
