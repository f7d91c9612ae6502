// SPDX-License-Identifier: MIT
#include "risorius/render/detail/garment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "risorius/core/known_names.h"
#include "risorius/render/garments.h"

namespace risorius::render {
namespace {

constexpr double kPi = std::numbers::pi;
/// Radius of the skin about the axis of the neck, by azimuth and height.
class NeckRadius {
  public:
    static constexpr int kAround = 48, kRows = 64;
    static constexpr double kRow_m = 0.002;

    NeckRadius(const Scene& scene, double top_m, double axis_z)
        : top_m_(top_m), radius_(kAround * kRows, 0.0) {
        constexpr int kSteps = 10;
        for (const Surface& surface : scene.surfaces) {
            if (surface.material != Material::kSkin) continue;
            for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
                std::array<Vec3, 3> p;
                for (int k = 0; k < 3; ++k)
                    p[static_cast<std::size_t>(k)] =
                        scene.rest.row(surface.triangles(f, k)).transpose();
                if (std::min({p[0].y(), p[1].y(), p[2].y()}) > top_m) continue;
                for (int a = 0; a <= kSteps; ++a)
                    for (int b = 0; a + b <= kSteps; ++b)
                        add((a * p[0] + b * p[1] + (kSteps - a - b) * p[2]) / kSteps, axis_z);
            }
        }
    }

    /// The height at which the neck has become wider by `wider_m` than where it is thinnest; nothing if it does not.
    std::optional<double> shoulder_m(int column, double wider_m) const {
        double thinnest = std::numeric_limits<double>::infinity();
        for (int row = 0; row < kRows; ++row) {
            const double r = radius_[index(column, row)];
            if (r == 0) continue;
            thinnest = std::min(thinnest, r);
            if (r > thinnest + wider_m) return top_m_ - row * kRow_m;
        }
        return std::nullopt;
    }

  private:
    static std::size_t index(int column, int row) {
        return static_cast<std::size_t>(column * kRows + row);
    }
    void add(const Vec3& p, double axis_z) {
        const int row = static_cast<int>(std::floor((top_m_ - p.y()) / kRow_m));
        if (row < 0 || row >= kRows) return;
        const double turn = std::atan2(p.x(), p.z() - axis_z) / (2 * kPi);
        const int column =
            static_cast<int>(std::floor((turn - std::floor(turn)) * kAround)) % kAround;
        double& r = radius_[index(column, row)];
        r = std::max(r, std::hypot(p.x(), p.z() - axis_z));
    }
    double top_m_;
    std::vector<double> radius_;
};

/// Mean of z of the skin in a slab below the chin.
std::optional<double> neck_axis_z(const Scene& scene, double chin_m) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
            const Vec3 p = scene.rest.row(surface.triangles.data()[i]).transpose();
            if (p.y() > chin_m - 0.020 || p.y() < chin_m - 0.035 || std::abs(p.x()) > 0.02)
                continue;
            low = std::min(low, p.z());
            high = std::max(high, p.z());
        }
    }
    if (!(low < high)) return std::nullopt;
    return (low + high) / 2;
}

/// How far the cloth lies off the skin, m, by its distance from the border: a collar of 13 mm, a seam, the shirt.
constexpr std::array<std::pair<double, double>, 5> kSection{
    {{0.0, 0.0008}, {0.003, 0.0030}, {0.013, 0.0030}, {0.016, 0.0020}, {0.050, 0.0030}}};

double section_m(double below_m) {
    for (std::size_t k = 1; k < kSection.size(); ++k)
        if (below_m < kSection[k].first) {
            const auto& [from, low] = kSection[k - 1];
            const auto& [to, high] = kSection[k];
            return low + (high - low) * (below_m - from) / (to - from);
        }
    return kSection.back().second;
}

/// Cuts triangles of the skin along lines of equal distance from the border.
class Cutter {
  public:
    Cutter(const Scene& scene, const Neckline& line, Garment& garment)
        : scene_(scene), line_(line), garment_(garment) {}

    void add(const std::array<int, 3>& corner) {
        const double low = std::min({below(corner[0]), below(corner[1]), below(corner[2])}),
                     high = std::max({below(corner[0]), below(corner[1]), below(corner[2])});
        for (std::size_t k = 0; k < kSection.size(); ++k) {
            const double from = kSection[k].first,
                         to = k + 1 < kSection.size() ? kSection[k + 1].first
                                                      : std::numeric_limits<double>::infinity();
            if (high > from && low < to) add_band(corner, from, to);
        }
    }

  private:
    double below(int v) {
        const auto [found, is_new] = below_.try_emplace(v, 0.0);
        if (is_new) found->second = line_.below_m(scene_.rest.row(v).transpose());
        return found->second;
    }

    /// The vertex on an edge at a distance from the border; at an end of it where `level` is that end's own.
    unsigned on_edge(int a, int b, double level) {
        if (a > b) std::swap(a, b);
        return vertex(a, b, std::clamp((level - below(a)) / (below(b) - below(a)), 0.0, 1.0),
                      level);
    }

    unsigned vertex(int a, int b, double share, double level) {
        const auto key = std::make_tuple(a, b, level);
        if (const auto found = number_.find(key); found != number_.end()) return found->second;
        const auto number = static_cast<unsigned>(garment_.vertices.size());
        const Vec3 p = ((1 - share) * scene_.rest.row(a) + share * scene_.rest.row(b)).transpose();
        garment_.vertices.push_back(
            {{a, b}, share, section_m(level), level, std::atan2(p.x(), p.z())});
        return number_[key] = number;
    }

    void add_band(const std::array<int, 3>& corner, double from, double to) {
        std::vector<unsigned> polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = corner[k], b = corner[(k + 1) % 3];
            const double at = below(a), next = below(b);
            if (at >= from && at <= to) polygon.push_back(vertex(a, a, 0, at));
            // The lines in the order in which the edge crosses them
            for (const double level : {at < next ? from : to, at < next ? to : from})
                if ((at < level) != (next < level) && at != level && next != level)
                    polygon.push_back(on_edge(a, b, level));
        }
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
            garment_.triangles.insert(garment_.triangles.end(),
                                      {polygon[0], polygon[k], polygon[k + 1]});
    }

    const Scene& scene_;
    const Neckline& line_;
    Garment& garment_;
    std::map<int, double> below_;
    std::map<std::tuple<int, int, double>, unsigned> number_;
};

}  // namespace

std::optional<Neckline> Neckline::of(const Scene& scene, const std::string& garment) {
    constexpr double kWider_m = 0.012, kBelowChin_m = 0.020, kFront_m = 0.004, kDip_m = 0.030;
    const std::size_t which = index_of_name("garment", garment, garment_names());
    const auto chin = scene.landmarks.find("gn");
    if (which == 0 || chin == scene.landmarks.end()) return std::nullopt;
    const auto axis = neck_axis_z(scene, chin->second.y());
    if (!axis) return std::nullopt;
    Neckline line;
    line.axis_z_ = *axis;
    const NeckRadius radius(scene, chin->second.y() - kBelowChin_m, *axis);
    static_assert(kColumns == NeckRadius::kAround);
    std::array<std::optional<double>, kColumns> found;
    double lowest = std::numeric_limits<double>::infinity();
    int count = 0;
    for (int k = 0; k < kColumns; ++k) {
        found[static_cast<std::size_t>(k)] = radius.shoulder_m(k, kWider_m);
        if (!found[static_cast<std::size_t>(k)]) continue;
        lowest = std::min(lowest, *found[static_cast<std::size_t>(k)]);
        ++count;
    }
    if (2 * count < kColumns) return std::nullopt;
    // Both sides alike, and smooth
    std::array<double, kColumns> height;
    const auto at = [](int k) { return static_cast<std::size_t>((k + 2 * kColumns) % kColumns); };
    for (int k = 0; k < kColumns; ++k)
        height[at(k)] = (found[at(k)].value_or(lowest) + found[at(-1 - k)].value_or(lowest)) / 2;
    for (int pass = 0; pass < 8; ++pass) {
        const auto before = height;
        for (int k = 0; k < kColumns; ++k)
            height[at(k)] =
                0.25 * before[at(k - 1)] + 0.5 * before[at(k)] + 0.25 * before[at(k + 1)];
    }
    for (int k = 0; k < kColumns; ++k) {
        const double turn = std::abs(std::remainder((k + 0.5) / kColumns, 1.0));  // 0 in front
        const double dip = which == 2 ? kDip_m * std::max(0.0, 1 - turn / 0.16) : 0;
        line.height_m_[at(k)] = height[at(k)] - kFront_m * std::cos(2 * kPi * turn) - dip;
    }
    return line;
}

double Neckline::below_m(const Vec3& rest) const {
    const double turn = std::atan2(rest.x(), rest.z() - axis_z_) / (2 * kPi);
    const double column = (turn - std::floor(turn)) * kColumns - 0.5;
    const int first = static_cast<int>(std::floor(column));
    const double t = column - first;
    const auto at = [&](int k) {
        return height_m_[static_cast<std::size_t>((k + kColumns) % kColumns)];
    };
    return (1 - t) * at(first) + t * at(first + 1) - rest.y();
}

Garment plan_garment(const Scene& scene) {
    constexpr double kUnseen_m = 0.012;
    Garment garment;
    const auto line = Neckline::of(scene, scene.appearance.garment);
    if (!line) return garment;
    garment.covered.assign(static_cast<std::size_t>(scene.rest.rows()), 0);
    Cutter cutter(scene, *line, garment);
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            const std::array<int, 3> corner{surface.triangles(f, 0), surface.triangles(f, 1),
                                            surface.triangles(f, 2)};
            cutter.add(corner);
            for (const int v : corner)
                if (line->below_m(scene.rest.row(v).transpose()) > kUnseen_m)
                    garment.covered[static_cast<std::size_t>(v)] = 1;
        }
    }
    return garment;
}

PosedGarment pose_garment(const Garment& garment, const Points& positions) {
    const auto count = static_cast<Eigen::Index>(garment.vertices.size());
    PosedGarment posed{Points(count, 3), Points::Zero(count, 3)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const GarmentVertex& v = garment.vertices[static_cast<std::size_t>(i)];
        posed.positions.row(i) =
            (1 - v.share) * positions.row(v.between[0]) + v.share * positions.row(v.between[1]);
    }
    for (std::size_t t = 0; t < garment.triangles.size(); t += 3) {
        const auto row = [&](std::size_t k) {
            return static_cast<Eigen::Index>(garment.triangles[t + k]);
        };
        const Vec3 a = posed.positions.row(row(0)).transpose(),
                   b = posed.positions.row(row(1)).transpose(),
                   c = posed.positions.row(row(2)).transpose(), area = (b - a).cross(c - a);
        for (std::size_t k = 0; k < 3; ++k) posed.normals.row(row(k)) += area.transpose();
    }
    for (Eigen::Index i = 0; i < count; ++i) {
        posed.normals.row(i).normalize();
        posed.positions.row(i) +=
            garment.vertices[static_cast<std::size_t>(i)].off_m * posed.normals.row(i);
    }
    return posed;
}

}  // namespace risorius::render
