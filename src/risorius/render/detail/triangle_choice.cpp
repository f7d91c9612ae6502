// SPDX-License-Identifier: MIT
#include "risorius/render/detail/triangle_choice.h"

#include <algorithm>

namespace risorius::render {
namespace {

bool may_hide(const Batch& batch) {
    return batch.texture < 0 &&
           (batch.material == Material::kEye || batch.material == Material::kTeeth ||
            batch.material == Material::kGums || batch.material == Material::kTongue);
}

/// Replaces each cell of a square by the maximum over the cells up to `by` away.
void widen(int side, int by, std::vector<float>& cells) {
    std::vector<float> row(static_cast<std::size_t>(side));
    for (const int along : {1, side})  // steps to the next cell: in a row, then in a column
        for (int line = 0; line < side; ++line) {
            float* const first = cells.data() + line * (along == 1 ? side : 1);
            for (int i = 0; i < side; ++i) row[static_cast<std::size_t>(i)] = first[i * along];
            for (int i = 0; i < side; ++i)
                first[i * along] = *std::max_element(row.begin() + std::max(i - by, 0),
                                                     row.begin() + std::min(i + by + 1, side));
        }
}

}  // namespace

Eigen::Vector4f TriangleChoice::place_in(const Eigen::Matrix4f& clip_from_world,
                                         std::size_t vertex) const {
    const float* p = positions_.data() + 3 * vertex;
    return clip_from_world * Eigen::Vector4f(p[0], p[1], p[2], 1.0F);
}

void TriangleChoice::look_from(const Eigen::Matrix4f& clip_from_world) {
    if (looked_from_ && *looked_from_ == clip_from_world) return;
    looked_from_ = clip_from_world;
    const std::size_t vertices = positions_.size() / 3;
    clip_places_.resize(4 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Eigen::Vector4f clip = place_in(clip_from_world, v);
        clip_places_[4 * v] = clip.x() / clip.w();
        clip_places_[4 * v + 1] = clip.y() / clip.w();
        clip_places_[4 * v + 2] = clip.z() / clip.w();
        clip_places_[4 * v + 3] = clip.w();
    }
}

bool TriangleChoice::is_seen(const unsigned* face, bool cull_back) const {
    const float *a = clip_places_.data() + 4 * static_cast<std::size_t>(face[0]),
                *b = clip_places_.data() + 4 * static_cast<std::size_t>(face[1]),
                *c = clip_places_.data() + 4 * static_cast<std::size_t>(face[2]);
    if (a[3] <= 0 || b[3] <= 0 || c[3] <= 0) return true;
    for (std::size_t k = 0; k < 2; ++k)
        if ((a[k] < -1 && b[k] < -1 && c[k] < -1) || (a[k] > 1 && b[k] > 1 && c[k] > 1))
            return false;
    // The last thousandth of a pixel is left to the rasteriser.
    constexpr float kRounding = 1e-10F;
    return !cull_back || (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > -kRounding;
}

void TriangleChoice::choose(const Eigen::Matrix4f& clip_from_world, bool whole) {
    look_from(clip_from_world);
    choice_.clear();
    std::vector<Range>& chosen = ranges(Purpose::kSeen);
    chosen.assign(triangles_.batches().size(), {});
    for (std::size_t i = 0; i < triangles_.batches().size(); ++i) {
        const Batch& batch = triangles_.batches()[i];
        chosen[i].first = static_cast<int>(choice_.size());
        const bool apart = batch.material == Material::kSkin && !wrinkled_.empty();
        wrinkled_choice_.clear();
        const std::span<const unsigned> corners =
            triangles_.corners_of(batch, Purpose::kSeen, whole);
        for (std::size_t k = 0; k < corners.size(); k += 3) {
            const unsigned* face = corners.data() + k;
            // The texture coordinates of a textured batch are looked up by triangle number, so its triangles are all kept.
            if (batch.texture < 0 && !is_seen(face, batch.cull_back)) continue;
            if (!whole && !hidden_.empty() && hidden_[face[0]] && hidden_[face[1]] &&
                hidden_[face[2]])
                continue;
            const bool wrinkled =
                apart && (wrinkled_[face[0]] || wrinkled_[face[1]] || wrinkled_[face[2]]);
            std::vector<unsigned>& to = wrinkled ? wrinkled_choice_ : choice_;
            to.insert(to.end(), face, face + 3);
        }
        chosen[i].smooth = static_cast<int>(choice_.size()) - chosen[i].first;
        chosen[i].wrinkled = static_cast<int>(wrinkled_choice_.size());
        choice_.insert(choice_.end(), wrinkled_choice_.begin(), wrinkled_choice_.end());
    }
}

void TriangleChoice::choose_casters(const Eigen::Matrix4f& light_from_world,
                                    const Eigen::Matrix4f* clip_from_world) {
    // Visible surfaces in cells of the shadow map: their largest distance from the lamp
    constexpr int kCells = 64;
    // Cells added on each side, a thirtieth of a picture, for soft edges and hairs
    constexpr int kWider = 2;
    constexpr float kNowhere = -1e9F;
    const std::size_t vertices = positions_.size() / 3;
    lit_places_.resize(3 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Eigen::Vector4f at = place_in(light_from_world, v);
        for (std::size_t k = 0; k < 2; ++k)
            lit_places_[3 * v + k] =
                std::clamp((0.5F * at[static_cast<Eigen::Index>(k)] + 0.5F) * kCells,
                           -static_cast<float>(kWider), static_cast<float>(kCells) + 1.0F);
        lit_places_[3 * v + 2] = at.z();
    }
    struct Cells {
        int from_x = kCells + kWider, to_x = -kWider, from_y = kCells + kWider, to_y = -kWider;
        float nearest = 1e9F, farthest = kNowhere;
    };
    const auto cells_of = [&](const unsigned* face) {
        Cells cells;
        for (std::size_t k = 0; k < 3; ++k) {
            const float* p = lit_places_.data() + 3 * static_cast<std::size_t>(face[k]);
            // The offset makes the values positive, so that truncation rounds down.
            const int x = static_cast<int>(p[0] + kWider) - kWider,
                      y = static_cast<int>(p[1] + kWider) - kWider;
            cells.from_x = std::min(cells.from_x, x);
            cells.to_x = std::max(cells.to_x, x);
            cells.from_y = std::min(cells.from_y, y);
            cells.to_y = std::max(cells.to_y, y);
            cells.nearest = std::min(cells.nearest, p[2]);
            cells.farthest = std::max(cells.farthest, p[2]);
        }
        return cells;
    };
    if (clip_from_world) look_from(*clip_from_world);
    constexpr int kRow = kCells + 2 * kWider;  // cells including those beside the map
    farthest_lit_.assign(static_cast<std::size_t>(kRow) * kRow, kNowhere);
    const auto farthest_at = [&](int x, int y) -> float& {
        return farthest_lit_[static_cast<std::size_t>((y + kWider) * kRow + x + kWider)];
    };
    for (const Batch& batch : triangles_.batches()) {
        const std::span<const unsigned> corners =
            triangles_.corners_of(batch, Purpose::kShadow, /*whole=*/false);
        for (std::size_t k = 0; k < corners.size(); k += 3) {
            const unsigned* face = corners.data() + k;
            if (clip_from_world && !is_seen(face, batch.cull_back)) continue;
            const Cells cells = cells_of(face);
            for (int y = cells.from_y; y <= cells.to_y; ++y)
                for (int x = cells.from_x; x <= cells.to_x; ++x)
                    farthest_at(x, y) = std::max(farthest_at(x, y), cells.farthest);
        }
    }
    widen(kRow, kWider, farthest_lit_);

    choice_.clear();
    std::vector<Range>& chosen = ranges(Purpose::kShadow);
    chosen.assign(triangles_.batches().size(), {});
    for (std::size_t i = 0; i < triangles_.batches().size(); ++i) {
        const Batch& batch = triangles_.batches()[i];
        chosen[i].first = static_cast<int>(choice_.size());
        if (batch.material != Material::kSkin) continue;
        const std::span<const unsigned> corners =
            triangles_.corners_of(batch, Purpose::kShadow, /*whole=*/false);
        for (std::size_t k = 0; k < corners.size(); k += 3) {
            const unsigned* face = corners.data() + k;
            const Cells cells = cells_of(face);
            bool throws_any = false;
            for (int y = std::max(cells.from_y, 0);
                 y <= std::min(cells.to_y, kCells - 1) && !throws_any; ++y)
                for (int x = std::max(cells.from_x, 0);
                     x <= std::min(cells.to_x, kCells - 1) && !throws_any; ++x)
                    throws_any = cells.nearest <= farthest_at(x, y);
            if (throws_any) choice_.insert(choice_.end(), face, face + 3);
        }
        chosen[i].smooth = static_cast<int>(choice_.size()) - chosen[i].first;
    }
}

ClipBox TriangleChoice::box_of(const unsigned* face) const {
    ClipBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        const float* p = clip_places_.data() + 4 * static_cast<std::size_t>(face[k]);
        box.add(p[0], p[1], p[3]);
    }
    return box;
}

float TriangleChoice::nearest_depth(const unsigned* face) const {
    float nearest = 1e9F;
    for (std::size_t k = 0; k < 3; ++k)
        nearest = std::min(nearest, clip_places_[4 * static_cast<std::size_t>(face[k]) + 2]);
    return 0.5F * nearest + 0.5F;
}

template <typename Keep>
void TriangleChoice::keep_if(Keep keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles_.batches().size(); ++i) {
        Range& chosen = ranges(Purpose::kSeen)[i];
        auto from = static_cast<std::size_t>(chosen.first);
        chosen.first = static_cast<int>(kept);
        for (int* count : {&chosen.smooth, &chosen.wrinkled}) {
            const std::size_t end = from + static_cast<std::size_t>(*count), first = kept;
            for (; from < end; from += 3) {
                if (!keep(triangles_.batches()[i], choice_.data() + from)) continue;
                std::copy_n(choice_.begin() + static_cast<std::ptrdiff_t>(from), 3,
                            choice_.begin() + static_cast<std::ptrdiff_t>(kept));
                kept += 3;
            }
            *count = static_cast<int>(kept - first);
        }
    }
    choice_.resize(kept);
}

void TriangleChoice::leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                                      const std::function<void(PictureCells&)>& mark_others) {
    finish_drawing();
    // Things behind the skin
    ClipBox inner;
    for (std::size_t i = 0; i < triangles_.batches().size(); ++i) {
        if (!may_hide(triangles_.batches()[i])) continue;
        const Range& chosen = ranges(Purpose::kSeen)[i];
        for (int k = 0; k < chosen.smooth + chosen.wrinkled; k += 3)
            inner.add(box_of(choice_.data() + chosen.first + k));
    }
    const FarthestSkin& farthest = skin.farthest(inner);
    const auto is_hidden = [&](const unsigned* face) {
        const ClipBox box = box_of(face);
        if (box.behind) return false;
        const auto cell = [](float clip, float cells_, float by, int max) {
            return std::clamp(static_cast<int>((0.5F * clip + 0.5F) * cells_ + by), 0, max - 1);
        };
        // One more pixel on each side, because samples lie off the centre of their pixel.
        constexpr float kPixel = 1.0F / FarthestSkin::kCell;
        const int from_x = cell(box.left, farthest.width, -kPixel, farthest.columns),
                  to_x = cell(box.right, farthest.width, kPixel, farthest.columns),
                  from_y = cell(box.low, farthest.height, -kPixel, farthest.rows),
                  to_y = cell(box.high, farthest.height, kPixel, farthest.rows);
        const float near = nearest_depth(face);
        for (int y = from_y; y <= to_y; ++y)
            for (int x = from_x; x <= to_x; ++x)
                if (near <= farthest.depth[static_cast<std::size_t>(y * farthest.columns + x)])
                    return false;
        return true;
    };
    keep_if([&](const Batch& batch, const unsigned* face) {
        return !may_hide(batch) || !is_hidden(face);
    });

    // Skin where nothing else is visible
    keep_if([&](const Batch& batch, const unsigned* face) {
        if (batch.material == Material::kSkin)
            cells.touch(box_of(face));
        else
            cells.mark(box_of(face));
        return true;
    });
    mark_others(cells);
    cells.find_steps(skin.read(cells.touched()), skin.shaded());
    keep_if([&](const Batch& batch, const unsigned* face) {
        return batch.material != Material::kSkin || cells.needs_samples(box_of(face));
    });
}

}  // namespace risorius::render
