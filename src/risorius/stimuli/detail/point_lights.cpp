// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/point_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace risorius::stimuli {

namespace {

/// From the tip of the nose, each time the landmark of the adult at rest that is farthest in the front view from those before, and its
/// partner on the other side.
constexpr std::array kFarthestFirst{
    "prn",   "tr",    "me",     "bl_l",   "bl_r",  "go_l",  "go_r",  "g",     "ma_l",  "ma_r",
    "llc_l", "llc_r", "fml_l",  "fml_r",  "ulm_l", "ulm_r", "ram_l", "ram_r", "mn",    "bc_l",
    "bc_r",  "nl2_l", "nl2_r",  "pjm_l",  "pjm_r", "zy_l",  "zy_r",  "mef",   "fht_l", "fht_r",
    "ls",    "ex_l",  "ex_r",   "sl",     "or_l",  "or_r",  "al_l",  "al_r",  "mmb_l", "mmb_r",
    "n",     "mc_l",  "mc_r",   "mar_l",  "mar_r", "bp_l",  "bp_r",  "sn",    "nl3_l", "nl3_r",
    "pi_l",  "pi_r",  "ulc_l",  "ulc_r",  "ucr_l", "ucr_r", "lor_l", "lor_r", "bm_l",  "bm_r",
    "ft_l",  "ft_r",  "sbal_l", "sbal_r", "ch_l",  "ch_r",  "pg",    "rhi",   "li",    "stoi",
    "lli_l", "lli_r", "en_l",   "en_r",   "ant_l", "ant_r", "llm_l", "llm_r", "ull_l", "ull_r",
    "mp",    "cph_l", "cph_r",  "lll_l",  "lll_r", "ps_l",  "ps_r",  "nl1_l", "nl1_r", "ac_l",
    "ac_r",  "c",     "gn"};

}  // namespace

PointLights::PointLights(const animate::FrameRows& rows, int count, double radius_px,
                         bool scattered, unsigned seed)
    : rows_(rows), radius_px_(radius_px) {
    for (const char* id : kFarthestFirst)
        if (const int column = rows.column(id + std::string(".u_px"));
            column >= 0 && this->count() < count)
            columns_.push_back(column);
    moved_.assign(columns_.size(), Vec2::Zero());
    if (!scattered) return;
    Vec2 low = Vec2::Constant(1e9), high = -low;
    for (const int column : columns_) {
        const Vec2 at(rows.number(0, column), rows.number(0, column + 1));
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < columns_.size(); ++i)
        for (int k = 0; k < 2; ++k) {
            const double to = low[k] + (high[k] - low[k]) * (random() * 0x1p-32);
            moved_[i][k] = to - rows.number(0, columns_[i] + k);
        }
}

std::vector<float> PointLights::covered(int frame, int width_px, int height_px) const {
    std::vector<float> out(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
                           0.0F);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const double u = rows_.number(frame, columns_[i]) + moved_[i][0],
                     v = rows_.number(frame, columns_[i] + 1) + moved_[i][1];
        const double reach = radius_px_ + 1;
        for (int y = std::max(0, static_cast<int>(v - reach));
             y < std::min<double>(height_px, v + reach); ++y)
            for (int x = std::max(0, static_cast<int>(u - reach));
                 x < std::min<double>(width_px, u + reach); ++x) {
                // The centre of a pixel lies half a pixel from its corner.
                const double away = std::hypot(x + 0.5 - u, y + 0.5 - v);
                const auto share =
                    static_cast<float>(std::clamp(radius_px_ + 0.5 - away, 0.0, 1.0));
                float& pixel =
                    out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                        static_cast<std::size_t>(x)];
                pixel = std::max(pixel, share);
            }
    }
    return out;
}

}  // namespace risorius::stimuli
