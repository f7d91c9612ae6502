// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/tragus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace risorius::landmarks {

namespace {

constexpr double kEarStep_m = 0.5e-3;                    // between rays
constexpr double kInFront_m = 18e-3, kBehind_m = 24e-3;  // of the guess: what is looked at
constexpr double kOver_m = 26e-3, kUnder_m = 22e-3;      // the same
constexpr double kBesideEar_m = 40e-3;                   // where rays start
constexpr double kNearSummit_m = 14e-3;     // of the guess: where summits are looked for
constexpr double kSummitRadius_m = 1.5e-3;  // around a summit, nothing is higher
constexpr double kIntoEar_m = 8e-3;         // how far back the step behind a tragus is looked for
constexpr double kLeastStep_m = 3.5e-3,
                 kGreatStep_m = 10e-3;  // of a tragus; more than the latter says no more
constexpr double kPriceOfAway =
    0.25;                           // of a summit: lost step per distance from where it is expected
constexpr double kRise_m = 0.5e-3;  // of a ridge behind a notch
// A notch is sharp where the ridge falls into it and rises out of it by this, within this length of its bottom
constexpr double kSharpRise_m = 1e-3, kSharpLength_m = 1.5e-3;
constexpr double kNotchAbove_m =
    8e-3;                          // of where a third of the step is left: where it is looked for
constexpr double kAside_m = 1e-3;  // of a ridge from row to row
// Measured on ICT-FaceKit, MakeHuman and the adult: docs/decisions/0091
constexpr double kStepLeft = 0.5, kStepAtNotch = 1.0 / 3, kBehindRidge_m = 1.2e-3;
constexpr double kSummitBelow_m = 4e-3, kSummitInFront_m = 1e-3;  // of a summit from the tragion

int cells(double length_m) { return static_cast<int>(std::lround(length_m / kEarStep_m)); }

/// How far out the skin lies, seen from the side. Rows from above, columns from the front.
class SideView {
  public:
    SideView(const ShownHead& head, double side, const Vec3& guess)
        : rows_(cells(kOver_m + kUnder_m) + 1),
          columns_(cells(kInFront_m + kBehind_m) + 1),
          side_(side),
          top_(guess.y() + kOver_m),
          front_(guess.z() + kInFront_m) {
        for (int i = 0; i < rows_; ++i)
            for (int j = 0; j < columns_; ++j) {
                const Vec3 from(guess.x() + side * kBesideEar_m, y_of(i), z_of(j));
                const auto hit = head.tree.cast(from, Vec3(-side, 0, 0));
                const bool skin =
                    hit && head.part[static_cast<std::size_t>(hit->triangle)] == ShownPart::kSkin;
                out_.push_back(skin ? side * hit->point.x()
                                    : -std::numeric_limits<double>::infinity());
            }
    }

    int rows() const { return rows_; }
    int columns() const { return columns_; }
    int row_of(double y) const { return cells(top_ - y); }
    int column_of(double z) const { return cells(front_ - z); }
    double y_of(double row) const { return top_ - row * kEarStep_m; }
    double z_of(double column) const { return front_ - column * kEarStep_m; }
    /// m, along the side; -infinity where there is no skin.
    double out(int row, int column) const {
        return out_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
    }
    Vec3 point(double row, double column, double out) const {
        return {side_ * out, y_of(row), z_of(column)};
    }

    /// The steps from a place down into the ear behind it, and to the skin in front of it, m.
    double step_behind(int row, int column) const {
        return step(row, column, column, column + cells(kIntoEar_m));
    }
    double step_in_front(int row, int column) const {
        return step(row, column, column - cells(kIntoEar_m), column);
    }
    bool is_summit(int row, int column) const {
        const int around = cells(kSummitRadius_m);
        if (row < around || column < around || row + around >= rows_ ||
            column + around >= columns_ || !std::isfinite(out(row, column)))
            return false;
        for (int i = row - around; i <= row + around; ++i)
            for (int j = column - around; j <= column + around; ++j)
                if (out(i, j) > out(row, column)) return false;
        return true;
    }

  private:
    double step(int row, int column, int first, int last) const {
        double lowest = out(row, column);
        for (int j = std::max(0, first); j <= std::min(columns_ - 1, last); ++j)
            if (std::isfinite(out(row, j))) lowest = std::min(lowest, out(row, j));
        return out(row, column) - lowest;
    }

    int rows_, columns_;
    double side_, top_, front_;
    std::vector<double> out_;
};

struct RidgePlace {
    int row, column;
};

/// The summit of the tragus. The helix has summits, too: the front root has a small step behind it, the rim a great one in front.
std::optional<RidgePlace> tragus_summit(const SideView& view, const Vec3& guess) {
    const Vec3 near = guess + Vec3(0, -kSummitBelow_m, kSummitInFront_m);
    std::optional<RidgePlace> out;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < view.rows(); ++i)
        for (int j = 0; j < view.columns(); ++j) {
            const double away = std::hypot(view.y_of(i) - near.y(), view.z_of(j) - near.z());
            if (away > kNearSummit_m || !view.is_summit(i, j)) continue;
            const double step = view.step_behind(i, j);
            const double now =
                std::min(step, kGreatStep_m) - view.step_in_front(i, j) - kPriceOfAway * away;
            if (step < kLeastStep_m || now <= most) continue;
            most = now;
            out = RidgePlace{i, j};
        }
    return out;
}

/// The ridge from a summit up to the front root of the helix, a place for each row.
std::vector<RidgePlace> ridge_above(const SideView& view, const RidgePlace& summit) {
    std::vector<RidgePlace> out{summit};
    for (int row = summit.row - 1; row >= 0; --row) {
        const int aside = cells(kAside_m), column = out.back().column;
        RidgePlace next{row, std::max(0, column - aside)};
        for (int j = next.column; j <= std::min(view.columns() - 1, column + aside); ++j)
            if (view.out(row, j) > view.out(row, next.column)) next.column = j;
        if (!std::isfinite(view.out(next.row, next.column))) break;
        out.push_back(next);
    }
    return out;
}

/// The bottom of a sharp notch of a ridge, from its place `first` on upwards; nothing where the ridge rises gently.
std::optional<std::size_t> sharp_notch(const SideView& view, const std::vector<RidgePlace>& ridge,
                                       std::size_t first) {
    const auto out_at = [&](std::size_t i) { return view.out(ridge[i].row, ridge[i].column); };
    const auto near = static_cast<std::size_t>(cells(kSharpLength_m));
    const std::size_t end =
        std::min(ridge.size(), first + static_cast<std::size_t>(cells(kNotchAbove_m)));
    std::size_t lowest = first;
    for (std::size_t i = first; i < end; ++i) {
        if (out_at(i) < out_at(lowest)) lowest = i;
        if (i <= lowest + near && out_at(i) > out_at(lowest) + kSharpRise_m) return lowest;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Tragion> tragion_near(const ShownHead& head, double side, const Vec3& guess) {
    const SideView view(head, side, guess);
    const auto summit = tragus_summit(view, guess);
    if (!summit) return std::nullopt;
    const std::vector<RidgePlace> ridge = ridge_above(view, *summit);
    const auto point_at = [&](std::size_t i) {
        return view.point(ridge[i].row, ridge[i].column, view.out(ridge[i].row, ridge[i].column));
    };
    const auto on_skin = [&](const Vec3& p) {
        return head.skin_tree.closest(p - Vec3(0, 0, kBehindRidge_m))->point;
    };
    double greatest = 0, before = 0;
    std::size_t lowest = 0;
    Vec3 end = Vec3::Zero();  // where the tragus ends if no notch ends it
    bool ended = false;
    for (std::size_t i = 0; i < ridge.size(); ++i) {
        const double step = view.step_behind(ridge[i].row, ridge[i].column);
        greatest = std::max(greatest, step);
        if (!ended && step <= kStepLeft * greatest) {
            // Between two rows
            const double share = (before - kStepLeft * greatest) / (before - step);
            end = (1 - share) * point_at(i - 1) + share * point_at(i);
            ended = true;
        }
        if (step <= kStepAtNotch * greatest) {
            const auto notch = sharp_notch(view, ridge, i);
            return Tragion{on_skin(notch ? point_at(*notch) : end), notch.has_value()};
        }
        // At the notch, the ridge begins to rise to the helix.
        const auto out_at = [&](std::size_t k) { return view.out(ridge[k].row, ridge[k].column); };
        if (out_at(i) < out_at(lowest)) lowest = i;
        if (out_at(i) > out_at(lowest) + kRise_m) return Tragion{on_skin(point_at(lowest)), false};
        before = step;
    }
    return std::nullopt;
}

}  // namespace risorius::landmarks
