// SPDX-License-Identifier: MIT
#include "risorius/render/detail/strands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "risorius/render/detail/complexion.h"
#include "risorius/render/detail/paint_strokes.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/strand_texture.h"

namespace risorius::render {
namespace {

using Shape = std::array<Vec3, kStrandPoints>;

Vec3 row(const Points& points, int v) { return points.row(v).transpose(); }

/// Barycentric coordinates of p in a triangle of the plane, if it lies inside.
std::optional<Vec3> fractions(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a, w = p - a;
    const double area = u.x() * v.y() - u.y() * v.x();
    if (std::abs(area) < 1e-16) return std::nullopt;
    const double s = (w.x() * v.y() - w.y() * v.x()) / area;
    const double t = (u.x() * w.y() - u.y() * w.x()) / area;
    if (s < 0 || t < 0 || s + t > 1) return std::nullopt;
    return Vec3(1 - s - t, s, t);
}

/// Finds the outermost skin at places of the paint map near a line.
class SkinMap {
  public:
    SkinMap(const Scene& scene, const Vec3& centre, const std::vector<unsigned>& skin,
            const std::vector<Vec3>& line)
        : scene_(scene), centre_(centre) {
        constexpr double kReach_m = 0.022;
        for (std::size_t i = 0; i + 2 < skin.size(); i += 3) {
            Cell cell;
            for (std::size_t k = 0; k < 3; ++k) {
                cell.corner[k] = static_cast<int>(skin[i + k]);
                cell.place[k] = paint_place(row(scene.rest, cell.corner[k]), centre);
            }
            const Vec3 p = row(scene.rest, cell.corner[0]);
            for (const Vec3& q : line)
                if ((p - q).norm() < kReach_m) {
                    cells_.push_back(cell);
                    break;
                }
        }
    }
    std::optional<SkinPlace> at(const Vec2& place) const {
        std::optional<SkinPlace> best;
        double farthest = 0;
        for (const Cell& cell : cells_) {
            const auto s = fractions(place, cell.place[0], cell.place[1], cell.place[2]);
            if (!s) continue;
            const SkinPlace found{cell.corner, *s};
            const double out = (found.on(scene_.rest) - centre_).norm();
            if (out > farthest) {
                farthest = out;
                best = found;
            }
        }
        return best;
    }

  private:
    struct Cell {
        std::array<int, 3> corner;
        std::array<Vec2, 3> place;
    };
    const Scene& scene_;
    Vec3 centre_;
    std::vector<Cell> cells_;
};

/// The frontmost surface around an eye, on a grid of x and y.
class FrontOfEye {
  public:
    static constexpr double kCell_m = 1e-4;

    FrontOfEye(const Scene& scene, int eye, const Vec2& low, const Vec2& high)
        : low_(low),
          width_(static_cast<int>((high.x() - low.x()) / kCell_m) + 1),
          height_(static_cast<int>((high.y() - low.y()) / kCell_m) + 1),
          cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
        const Eye& globe = scene.eyes[static_cast<std::size_t>(eye)];
        for (const Surface& surface : scene.surfaces) {
            const bool of_eye = surface.material == Material::kEye;
            if (of_eye ? surface.eye != eye : surface.material != Material::kSkin) continue;
            for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
                SkinPlace place;
                std::array<Vec3, 3> p;
                bool ahead = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    place.corner[k] = surface.triangles(f, static_cast<Eigen::Index>(k));
                    p[k] = row(scene.rest, place.corner[k]);
                    ahead &= p[k].z() > globe.centre.z();
                }
                if (ahead) fill(p, place, of_eye);
            }
        }
    }

    struct Cell {
        double depth = -1e9;
        bool eye = false;
        SkinPlace place;
    };
    const Cell* at(const Vec2& p) const {
        const int x = static_cast<int>(std::floor((p.x() - low_.x()) / kCell_m));
        const int y = static_cast<int>(std::floor((p.y() - low_.y()) / kCell_m));
        return x < 0 || y < 0 || x >= width_ || y >= height_ ? nullptr : &cells_[index(x, y)];
    }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    void fill(const std::array<Vec3, 3>& p, SkinPlace place, bool of_eye) {
        const auto cell = [&](double v, double low) {
            return static_cast<int>(std::floor((v - low) / kCell_m));
        };
        const auto [x0, x1] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
        const auto [y0, y1] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
        for (int y = std::max(0, cell(y0, low_.y()));
             y <= std::min(height_ - 1, cell(y1, low_.y())); ++y)
            for (int x = std::max(0, cell(x0, low_.x()));
                 x <= std::min(width_ - 1, cell(x1, low_.x())); ++x) {
                const Vec2 middle(low_.x() + (x + 0.5) * kCell_m, low_.y() + (y + 0.5) * kCell_m);
                const auto s = fractions(middle, p[0].head<2>(), p[1].head<2>(), p[2].head<2>());
                if (!s) continue;
                const double depth = s->dot(Vec3(p[0].z(), p[1].z(), p[2].z()));
                Cell& there = cells_[index(x, y)];
                if (depth <= there.depth) continue;
                place.fraction = *s;
                there = {depth, of_eye, place};
            }
    }
    Vec2 low_;
    int width_, height_;
    std::vector<Cell> cells_;
};

/// The corners of an eye, inner first.
std::optional<std::array<Vec3, 2>> eye_corners(const Scene& scene, int eye) {
    std::array<Vec3, 2> corner;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto mark =
            scene.landmarks.find((k == 0 ? "en" : "ex") + std::string(eye == 0 ? "_l" : "_r"));
        if (mark == scene.landmarks.end()) return std::nullopt;
        corner[k] = mark->second;
    }
    if (std::abs((corner[1] - corner[0]).x()) < 0.005) return std::nullopt;
    return corner;
}

FrontOfEye front_between(const Scene& scene, int eye, const std::array<Vec3, 2>& corner) {
    constexpr double kHeight_m = 0.016;
    return {scene,
            eye,
            {std::min(corner[0].x(), corner[1].x()),
             std::min(corner[0].y(), corner[1].y()) - kHeight_m},
            {std::max(corner[0].x(), corner[1].x()),
             std::max(corner[0].y(), corner[1].y()) + kHeight_m}};
}

constexpr double kOntoLid_m = 0.0003;  ///< lash roots are moved onto the lid by this distance

/// The end of a lid in one column of the grid: the first skin above (or below) the eye, moved a little onto the lid.
std::optional<SkinPlace> lid_end(const FrontOfEye& front, const Vec2& middle, double up,
                                 double onto_m = kOntoLid_m) {
    constexpr double kSearch_m = 0.007;
    // The middle line may lie on a lid; then the eye is a little above or below it.
    double start = 0;
    bool found = false;
    for (double off = 0; off < kSearch_m && !found; off += FrontOfEye::kCell_m)
        for (const double side : {-1.0, 1.0}) {
            const FrontOfEye::Cell* cell = front.at(middle + Vec2(0, side * off));
            if (cell && cell->eye) {
                start = side * off;
                found = true;
                break;
            }
        }
    if (!found) return std::nullopt;
    for (double off = 0; off < 2 * kSearch_m; off += FrontOfEye::kCell_m) {
        const FrontOfEye::Cell* cell = front.at(middle + Vec2(0, start + up * off));
        if (!cell) return std::nullopt;
        if (cell->eye) continue;
        const FrontOfEye::Cell* onto = front.at(middle + Vec2(0, start + up * (off + onto_m)));
        return onto && !onto->eye ? onto->place : cell->place;
    }
    return std::nullopt;
}

/// A lash grows up and away from the eye; `aside` fans the lashes out, `curl` bends them.
Shape lash_shape(double length_m, double aside, bool upper) {
    Shape shape;
    for (std::size_t i = 0; i < kStrandPoints; ++i) {
        const double u = static_cast<double>(i) / (kStrandPoints - 1);
        const double rise = upper ? -0.34 * u + 0.78 * u * u : -0.42 * u - 0.10 * u * u;
        const double out = upper ? 0.95 * u - 0.30 * u * u : 0.72 * u - 0.15 * u * u;
        shape[i] = length_m * Vec3(aside * (0.35 * u + 0.65 * u * u), rise, out);
    }
    return shape;
}

}  // namespace

Mat3 skin_frame(const SkinPlace& place, const Points& positions) {
    const Vec3 a = row(positions, place.corner[0]), along = row(positions, place.corner[1]) - a;
    const Vec3 out = along.cross(row(positions, place.corner[2]) - a).normalized();
    Mat3 frame;
    frame.col(0) = along.normalized();
    frame.col(2) = out;
    frame.col(1) = out.cross(frame.col(0));
    return frame;
}

Mat3 lid_frame(int eye, const Vec3& root, const Vec3& eye_centre, const Vec3& inner,
               const Vec3& outer) {
    const Vec3 out = (root - eye_centre).normalized();
    Vec3 aside = outer - inner;
    aside = (aside - out * out.dot(aside)).normalized();
    const Vec3 up = eye == 0 ? out.cross(aside) : aside.cross(out);
    Mat3 frame;
    frame << aside, up, out;
    return frame;
}

std::vector<Strand> plan_brows(const Scene& scene, const SkinPlan& plan, const Vec3& paint_centre,
                               const std::vector<unsigned>& skin) {
    const int hairs = brow_hairs(scene.appearance, 430);
    // Each hair of a grey brow is white or dark; as factors of the tone that both have together
    const double whites = white_share_of_brows(scene.appearance);
    const auto light = [](const Vec3& srgb) { return linear_from_srgb(srgb).mean(); };
    const double mean = light(hair_tone_at(scene.appearance)), white = light(kWhiteHair) / mean,
                 dark = light(dark_hair_tone(scene.appearance)) / mean;
    std::vector<Strand> strands;
    for (std::size_t side = 0; side < 2; ++side) {
        const std::vector<Vec3>& line = plan.brows[side];
        if (line.size() < 3) continue;
        RandomSequence random(scene.appearance.seed * 31U +
                              5U);  // the same seed for both: brows are mirror images
        const SkinMap map(scene, paint_centre, skin, line);
        for (int i = 0; i < hairs; ++i) {
            const BrowHair hair =
                next_brow_hair(line, scene.appearance.brow_width, paint_centre, random);
            const double lift = 0.10 + 0.14 * random.next(), shade = 0.55 + 0.75 * random.next();
            const auto root = map.at(hair.root), ahead = map.at(hair.root + hair.step);
            if (!root || !ahead) continue;
            Strand strand;
            strand.root = *root;
            strand.width_m = (0.000085 + 0.00003 * random.next()) * (0.45 + 0.55 * hair.density);
            strand.shade = shade * (is_white_hair(shade, whites) ? white : dark);
            const Mat3 frame = skin_frame(*root, scene.rest);
            Vec3 along = (ahead->on(scene.rest) - root->on(scene.rest)).normalized();
            Vec3 out = frame.col(2);
            if (out.dot(root->on(scene.rest) - paint_centre) < 0) out = -out;
            along = (along - out * out.dot(along)).normalized();
            for (std::size_t k = 0; k < kStrandPoints; ++k) {
                const double u = static_cast<double>(k) / (kStrandPoints - 1);
                // The hair rises from its follicle and lies down again, while the skin below bends away.
                const double height = 0.00012 + hair.length_m * (lift * u - 0.75 * lift * u * u);
                strand.offset[k] = frame.transpose() * (hair.length_m * u * along + height * out);
            }
            strands.push_back(strand);
        }
    }
    return strands;
}

std::vector<Strand> plan_lashes(const Scene& scene, int eye) {
    std::vector<Strand> strands;
    const auto corner = eye_corners(scene, eye);
    if (!corner) return strands;
    const Vec3 across = (*corner)[1] - (*corner)[0];
    const FrontOfEye front = front_between(scene, eye, *corner);
    const double lashes = complexion_of(scene.appearance).lashes;

    for (const bool upper : {true, false}) {
        // The same seed for both eyes, which are mirror images
        RandomSequence random(scene.appearance.seed * 131U + (upper ? 1U : 2U));
        // Counts of lashes; none grow near the inner corner (textbooks: 90-160 upper and 75-80 lower lashes in several rows).
        const int count = upper ? 126 : 66;
        const double first = upper ? 0.12 : 0.22, last = 0.985;
        double tuft = 0;
        for (int i = 0; i < count; ++i) {
            if (i % 4 == 0) tuft = 0.30 * (random.next() - 0.5);
            const double s = first + (last - first) * (i + 0.2 + 0.6 * random.next()) / count;
            const double jitter = random.next(), long_ = random.next(), shade = random.next();
            const Vec2 middle = ((*corner)[0] + s * across).head<2>();
            const auto root = lid_end(front, middle, upper ? 1 : -1);
            if (!root) continue;
            Strand strand;
            strand.root = *root;
            strand.eye = eye;
            // Lashes are longest a little lateral of the middle; the tips of a tuft converge.
            const double bow = std::sin(std::numbers::pi * std::pow(s, 1.25));
            const double length = upper ? 0.0045 + 0.0042 * bow : 0.0024 + 0.0020 * bow;
            const double aside =
                1.15 * (s - 0.46) + 0.5 * tuft + 0.024 * (1.5 - i % 4) + 0.08 * (jitter - 0.5);
            strand.offset = lash_shape(length * (0.60 + 0.40 * long_), aside, upper);
            strand.width_m = lashes * (upper ? 0.00017 : 0.00009);
            strand.shade = 0.20 + 0.2 * shade;
            strands.push_back(strand);
        }
    }
    return strands;
}

std::vector<SkinPlace> plan_tear_line(const Scene& scene, int eye) {
    constexpr int kColumns = 40;
    std::vector<SkinPlace> places;
    const auto corner = eye_corners(scene, eye);
    if (!corner) return places;
    const FrontOfEye front = front_between(scene, eye, *corner);
    for (int i = 0; i <= kColumns; ++i) {
        const double s = 0.05 + 0.92 * i / kColumns;
        const Vec2 middle = ((1 - s) * (*corner)[0] + s * (*corner)[1]).head<2>();
        if (const auto end = lid_end(front, middle, -1, 0)) places.push_back(*end);
    }
    return places;
}

}  // namespace risorius::render
