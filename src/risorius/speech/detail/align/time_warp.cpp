// SPDX-License-Identifier: MIT
#include "risorius/speech/detail/align/time_warp.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace risorius::speech {

namespace {

constexpr float kNoPath = std::numeric_limits<float>::infinity();
// Half of the corridor: 2 s and a fifth of the recording
constexpr double kCorridor_s = 2, kCorridorShare = 0.2;
// The price of going off the diagonal and of waiting, as parts of the mean distance of frames
constexpr float kOffDiagonal = 0.20F, kWaiting = 0.25F;

enum Move : std::uint8_t { kDiagonal, kRecordingGoes, kModelGoes, kAfterWait, kNone };
constexpr std::uint8_t kWaitsOn = 8;  // of W: the recording has waited before, too

class Warper {
  public:
    explicit Warper(const WarpInput& input)
        : model_(*input.model),
          recording_(*input.recording),
          input_(input),
          n_(model_.cols()),
          m_(recording_.cols()) {
        place_corridor();
        const float usual = usual_distance();
        off_ = kOffDiagonal * usual;
        wait_ = kWaiting * usual;
    }

    WarpPath solve() {
        forward();
        return back();
    }

  private:
    float distance(long i, long j) const { return (model_.col(i) - recording_.col(j)).norm(); }

    /// Mean distance of frames that have nothing to do with each other.
    float usual_distance() const {
        double sum = 0;
        long count = 0;
        for (long i = 0; i < n_; i += 7)
            for (long j = (i * 3) % 11; j < m_; j += 11) {
                if (input_.silent[static_cast<std::size_t>(j)]) continue;
                sum += distance(i, j);
                ++count;
            }
        return count ? static_cast<float>(sum / static_cast<double>(count)) : 1;
    }

    /// The middle of the corridor goes through the frames with the same share of what is not silent.
    void place_corridor() {
        std::vector<long> spoken(static_cast<std::size_t>(m_) + 1, 0);
        for (long j = 0; j < m_; ++j)
            spoken[static_cast<std::size_t>(j) + 1] =
                spoken[static_cast<std::size_t>(j)] + !input_.silent[static_cast<std::size_t>(j)];
        const long half =
            std::lround(kCorridor_s / kCepstraHop_s + kCorridorShare * static_cast<double>(m_));
        width_ = std::min(m_, 2 * half + 1);
        const auto all = static_cast<double>(spoken.back());
        long j = 0;
        for (long i = 0; i <= n_; ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(n_) * all;
            while (j < m_ && static_cast<double>(spoken[static_cast<std::size_t>(j)]) < share) ++j;
            long from = std::clamp(j - half, 0L, m_ - width_);
            if (i == 0) from = 0;
            if (i >= n_ - 1) from = m_ - width_;
            from_.push_back(from);
        }
    }

    bool inside(long i, long j) const {
        return j >= from_[static_cast<std::size_t>(i)] &&
               j < from_[static_cast<std::size_t>(i)] + width_;
    }

    /// Row i holds D(i, .) and W(i, .): the recording waits before frame i, and has waited in frame j.
    void forward() {
        moves_.assign(static_cast<std::size_t>((n_ + 1) * width_), kNone);
        std::vector<float> before(static_cast<std::size_t>(m_), kNoPath), now, wait;
        for (long i = 0; i <= n_; ++i) {
            now.assign(static_cast<std::size_t>(m_), kNoPath);
            wait.assign(static_cast<std::size_t>(m_), kNoPath);
            const bool may_wait = input_.may_wait[static_cast<std::size_t>(i)];
            const long from = from_[static_cast<std::size_t>(i)];
            for (long j = from; j < from + width_; ++j) {
                const auto J = static_cast<std::size_t>(j);
                std::uint8_t move = 0;
                const float diagonal =
                    i == 0 ? (j == 0 ? 0 : kNoPath) : (j > 0 ? before[J - 1] : kNoPath);
                const float waited = j > 0 ? wait[J - 1] : kNoPath;
                if (may_wait && input_.silent[J]) {
                    const bool goes_on = waited <= diagonal;
                    wait[J] = std::min(waited, diagonal) + wait_;
                    if (goes_on) move |= kWaitsOn;
                }
                if (i < n_) {
                    const float d = distance(i, j);
                    float best = diagonal + 2 * d;
                    std::uint8_t by = kDiagonal;
                    const auto take = [&](float cost, std::uint8_t one) {
                        if (cost >= best) return;
                        best = cost;
                        by = one;
                    };
                    take(waited + 2 * d, kAfterWait);
                    if (j > from) take(now[J - 1] + d + off_, kRecordingGoes);
                    if (i > 0) take(before[J] + d + off_, kModelGoes);
                    now[J] = best;
                    if (best < kNoPath)
                        move |= by;
                    else
                        move |= kNone;
                } else {
                    move |= kNone;
                }
                moves_[static_cast<std::size_t>(i * width_ + j - from)] = move;
            }
            if (i == n_) {
                end_wait_ = wait.back();
                end_ = before.back();
            }
            std::swap(before, now);
        }
    }

    std::uint8_t move(long i, long j) const {
        return moves_[static_cast<std::size_t>(i * width_ + j -
                                               from_[static_cast<std::size_t>(i)])];
    }

    WarpPath back() const {
        WarpPath out;
        out.first.assign(static_cast<std::size_t>(n_), -1);
        out.last = out.first;
        out.waits.assign(static_cast<std::size_t>(n_) + 1, 0);
        out.distance.assign(static_cast<std::size_t>(n_), 0);
        std::vector<int> counts(static_cast<std::size_t>(n_), 0);
        long i = n_ - 1, j = m_ - 1;
        long waiting = end_wait_ < end_ ? n_ : -1;  // before which frame
        while (i >= 0 || waiting >= 0) {
            if (waiting >= 0) {
                ++out.waits[static_cast<std::size_t>(waiting)];
                const bool goes_on = move(waiting, j) & kWaitsOn;
                --j;
                if (goes_on) continue;
                i = waiting - 1;
                waiting = -1;
                if (i < 0) break;
                continue;
            }
            const auto I = static_cast<std::size_t>(i);
            out.first[I] = j;
            if (out.last[I] < 0) out.last[I] = j;
            out.distance[I] += distance(i, j);
            ++counts[I];
            switch (move(i, j) & 7) {
                case kDiagonal:
                    --i;
                    --j;
                    break;
                case kAfterWait:
                    waiting = i;
                    --j;
                    break;
                case kRecordingGoes:
                    --j;
                    break;
                default:
                    --i;
                    break;
            }
            if (j < 0) break;
        }
        long waited = 0;
        for (const long one : out.waits) waited += one;
        for (std::size_t k = 0; k < counts.size(); ++k)
            if (counts[k]) out.distance[k] /= static_cast<float>(counts[k]);
        const double cost = std::min(end_, end_wait_) - wait_ * static_cast<double>(waited);
        out.cost = cost / static_cast<double>(n_ + m_ - waited);
        return out;
    }

    const Features &model_, &recording_;
    const WarpInput& input_;
    long n_, m_, width_ = 0;
    std::vector<long> from_;
    std::vector<std::uint8_t> moves_;
    float off_ = 0, wait_ = 0, end_ = kNoPath, end_wait_ = kNoPath;
};

}  // namespace

WarpPath warp(const WarpInput& input) { return Warper(input).solve(); }

}  // namespace risorius::speech
