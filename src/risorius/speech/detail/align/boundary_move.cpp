// SPDX-License-Identifier: MIT
#include "risorius/speech/detail/align/boundary_move.h"

#include <algorithm>
#include <cmath>

namespace risorius::speech {

namespace {

constexpr double kShortestMoved_s = 0.010, kSearchStep_s = 0.002;
// What is compared: means over this time on both sides of a border, this far from it
constexpr double kSide_s = 0.012, kSideFrom_s = 0.003;
constexpr int kSideFrames = 4;
// A change at the end of the reach counts this much less than one where the border is.
constexpr double kFarLoss = 0.6;
// Bands above about 2.5 kHz
constexpr double kHighBands = 0.4;
// Bands below about 700 Hz, where the voice is
constexpr double kLowBands = 0.25;
// Smaller changes move nothing, dB.
constexpr double kLeastChange_db = 3;

enum class Change { kSofter, kLouder, kVoiceComes, kHighComes, kHighGoes, kAny };

Change change_between(const PhoneEntry& before, const PhoneEntry& after) {
    const auto silent = [](const PhoneEntry& one) {
        return one.kind == PhoneClass::kSilence || (one.is_stop() && !one.voiced);
    };
    const auto noisy = [](const PhoneEntry& one) {
        return one.manner == "fric" || one.manner == "fricative" || one.manner == "affricate" ||
               one.kind == PhoneClass::kSibilant || one.kind == PhoneClass::kSibilantRound;
    };
    if (silent(after)) return Change::kSofter;
    // A voiceless stop has its burst and breath until the voice comes.
    if (before.is_stop() && !before.voiced && after.voiced) return Change::kVoiceComes;
    if (before.kind == PhoneClass::kSilence || before.is_stop()) return Change::kLouder;
    if (noisy(after) && !noisy(before)) return Change::kHighComes;
    if (noisy(before) && !noisy(after)) return Change::kHighGoes;
    if (after.is_stop()) return Change::kSofter;
    return Change::kAny;
}

class Mover {
  public:
    Mover(std::span<const float> sound, int rate_hz)
        : spectra_(sound, rate_hz), rate_hz_(rate_hz) {}

    /// How much of a change there is at a sample, dB.
    double change(Change kind, std::int64_t at) {
        const Eigen::ArrayXd before = side(at, -1), after = side(at, 1);
        const long high = std::lround(kHighBands * static_cast<double>(before.size()));
        const long low = std::lround(kLowBands * static_cast<double>(before.size()));
        const auto loudness = [](const Eigen::ArrayXd& bands) { return bands.mean(); };
        const auto balance = [&](const Eigen::ArrayXd& bands) {
            return bands.tail(high).mean() - bands.head(bands.size() - high).mean();
        };
        switch (kind) {
            case Change::kSofter:
                return loudness(before) - loudness(after);
            case Change::kLouder:
                return loudness(after) - loudness(before);
            case Change::kVoiceComes:
                return after.head(low).mean() - before.head(low).mean();
            case Change::kHighComes:
                return balance(after) - balance(before);
            case Change::kHighGoes:
                return balance(before) - balance(after);
            default:
                return std::sqrt((after - before).square().mean());
        }
    }

    std::int64_t moved(std::int64_t border, Change kind, std::int64_t from, std::int64_t to) {
        const double reach = kBorderReach_s * rate_hz_;
        const auto step = std::max<std::int64_t>(1, std::llround(kSearchStep_s * rate_hz_));
        std::int64_t best = border;
        double most = kLeastChange_db;
        for (std::int64_t k = -std::llround(reach) / step; k * step <= reach; ++k) {
            const std::int64_t at = border + k * step;
            if (at < from || at > to) continue;
            const double far = std::abs(static_cast<double>(k * step)) / reach;
            const double value = change(kind, at) * (1 - kFarLoss * far * far);
            if (value <= most) continue;
            most = value;
            best = at;
        }
        return best;
    }

  private:
    Eigen::ArrayXd side(std::int64_t at, int direction) {
        Eigen::ArrayXd sum;
        for (int k = 0; k < kSideFrames; ++k) {
            const double away_s = kSideFrom_s + kSide_s * k / (kSideFrames - 1);
            const Eigen::ArrayXd& one = spectra_.at(
                std::max<std::int64_t>(0, at + direction * std::llround(away_s * rate_hz_)));
            sum = k == 0 ? one : Eigen::ArrayXd(sum + one);
        }
        return sum / kSideFrames;
    }

    ShortSpectra spectra_;
    int rate_hz_;
};

}  // namespace

void move_borders(std::vector<Phone>& phones, const PhoneTable& table, std::span<const float> sound,
                  int rate_hz) {
    Mover mover(sound, rate_hz);
    const std::int64_t shortest = std::llround(kShortestMoved_s * rate_hz);
    for (std::size_t i = 1; i < phones.size(); ++i) {
        const std::int64_t border = phones[i].start;
        const Change kind = change_between(table.phone(phones[i - 1].symbol, "alignment"),
                                           table.phone(phones[i].symbol, "alignment"));
        const std::int64_t from = std::min(border, phones[i - 1].start + shortest),
                           to = std::max(border, phones[i].end - shortest);
        phones[i - 1].end = phones[i].start = mover.moved(border, kind, from, to);
    }
}

}  // namespace risorius::speech
