// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/wrinkles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/geom/polyline.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::face {

namespace {

constexpr double kRounding =
    0.2;  // rounding of the valleys; shader_skin.cpp draws the same profile
constexpr double kLineVariation = 0.4,
                 kUnlikeTurn = 2.4;     // variation between lines, as in shader_skin.cpp
constexpr double kSteepestFold = 0.45;  // depth / span: folds steeper than this close
// Edges per wavelength at which vertices start to carry the fold, and at which they carry all of it
constexpr double kFirstResolved = 6, kResolved = 10;
constexpr double kStays = 0.09;  // compression of the permanent lines of skin aged 80
constexpr int kSamples = 64;
constexpr double kStripPiece = 0.25;  // length of a piece of a strip / averaging length of a crease

double profile_slope(double phase) {
    const double s = std::sin(std::numbers::pi * phase), c = std::cos(std::numbers::pi * phase);
    return std::numbers::pi * s * c / std::sqrt(s * s + kRounding * kRounding);
}

// How far ridges stand above the mean of the profile, so that folds neither add nor take volume on the whole.
double ridge() {
    static const double over_mean = [] {
        double sum = 0;
        for (int i = 0; i < kSamples; ++i) sum += fold_profile((i + 0.5) / kSamples);
        return fold_profile(0.5) - sum / kSamples;
    }();
    return over_mean;
}

// Tabulates depth over the square root of the excess, in which it is almost linear.
struct DepthTable {
    static constexpr double kLongest = 1.2;  // root of the excess
    std::array<double, kSamples + 1> ratio;
    DepthTable() {
        for (int i = 0; i <= kSamples; ++i) {
            const double wanted = std::pow(kLongest * i / kSamples, 2);
            double low = 0, high = 4;
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = 0.5 * (low + high);
                (fold_excess(middle) < wanted ? low : high) = middle;
            }
            ratio[i] = i == 0 ? 0 : 0.5 * (low + high);
        }
    }
};

}  // namespace

double fold_profile(double phase) {
    const double s = std::sin(std::numbers::pi * phase);
    return std::sqrt(s * s + kRounding * kRounding);
}

double fold_height(double phase) {
    const double of_line = 1 + kLineVariation * std::sin(kUnlikeTurn * std::round(phase));
    return ridge() - of_line * (fold_profile(0.5) - fold_profile(phase));
}

double fold_excess(double depth_ratio) {
    double sum = 0;
    for (int i = 0; i < kSamples; ++i)
        sum += std::hypot(1.0, depth_ratio * profile_slope((i + 0.5) / kSamples));
    return sum / kSamples - 1;
}

double fold_depth_ratio(double excess) {
    static const DepthTable table;
    if (excess <= 0) return 0;
    const double place = std::min(std::sqrt(excess) / DepthTable::kLongest, 1.0 - 1e-12) * kSamples;
    const auto i = static_cast<std::size_t>(place);
    return table.ratio[i] +
           (place - static_cast<double>(i)) * (table.ratio[i + 1] - table.ratio[i]);
}

double folded_fraction(double compression, const FoldOnset& onset) {
    const double over = compression - onset.at, softness = onset.softness;
    if (over <= -softness) return 0;
    if (over >= softness) return over;
    // Depth varies with the square root of e. So e starts with a fourth power, which lets wrinkles appear smoothly
    const double t = (over + softness) / (2 * softness);
    return softness * t * t * t * t * (3 - 2 * t);
}

Wrinkles::Wrinkles(const WrinkleLines& lines, const Triangles& skin, const Points& rest,
                   const WrinkleOptions& options)
    : options_(options) {
    // Vertices and triangles of the skin that have lines
    std::vector<int> own(static_cast<std::size_t>(rest.rows()), -1);
    std::vector<long> faces;
    for (long f = 0; f < skin.rows(); ++f) {
        bool touched = false;
        for (int k = 0; k < 3; ++k)
            touched = touched || lines.window.row(skin(f, k)).maxCoeff() > 0;
        if (!touched) continue;
        faces.push_back(f);
        for (int k = 0; k < 3; ++k)
            if (own[skin(f, k)] < 0) {
                own[skin(f, k)] = static_cast<int>(vertex_.size());
                vertex_.push_back(skin(f, k));
            }
    }
    const auto count = static_cast<long>(vertex_.size());
    if (count == 0) return;
    triangles_.resize(static_cast<long>(faces.size()), 3);
    phase_.resize(count, 3);
    window_.resize(count, 3);
    wavelength_.resize(count, 3);
    stays_.setZero(count, 3);
    later_.setZero(count, 3);
    for (long i = 0; i < count; ++i) {
        phase_.row(i) = lines.phase.row(vertex_[i]);
        window_.row(i) = lines.window.row(vertex_[i]);
        wavelength_.row(i) = lines.wavelength.row(vertex_[i]);
        if (lines.at_rest.size() > 0) stays_.row(i) = kStays * lines.at_rest.row(vertex_[i]);
        if (lines.later.size() > 0) later_.row(i) = lines.later.row(vertex_[i]);
    }

    // Strain gauges across the lines, and the operator of the local mean
    const auto at = [&](int v) { return Vec3(rest.row(v).transpose()); };
    Points gauged = Points::Zero(count, 3);
    area_ = Eigen::VectorXd::Zero(count);
    Eigen::VectorXd edges = Eigen::VectorXd::Zero(count), edge_count = edges;
    solve::MetricBuilder mean(static_cast<int>(count));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const long f = faces[i];
        const Vec3 a = at(skin(f, 0)), b = at(skin(f, 1)), c = at(skin(f, 2));
        const Vec3 twice = (b - a).cross(c - a);
        const double area = 0.5 * twice.norm();
        int corner[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = triangles_(static_cast<long>(i), k) = own[skin(f, k)];
        if (area < 1e-12) continue;
        const Vec3 normal = twice / (2 * area);
        const Vec3 gradient[3] = {normal.cross(c - b) / (2 * area),
                                  normal.cross(a - c) / (2 * area),
                                  normal.cross(b - a) / (2 * area)};
        double block[9];
        for (int k = 0; k < 3; ++k) {
            area_[corner[k]] += area / 3;
            edges[corner[k]] += std::sqrt(2 * area);
            edge_count[corner[k]] += 1;
            for (int j = 0; j < 3; ++j)
                block[3 * k + j] =
                    area * options.mean_over_m * options.mean_over_m * gradient[k].dot(gradient[j]);
        }
        mean.add_block(corner, block, 3);
        for (int slot = 0; slot < kWrinkleSlots; ++slot) {
            Vec3 across = Vec3::Zero();
            double window = 0;
            for (int k = 0; k < 3; ++k) {
                across += phase_(corner[k], slot) * gradient[k];
                window = std::max(window, window_(corner[k], slot));
            }
            if (window == 0 || across.squaredNorm() == 0) continue;
            across.normalize();
            Gauge gauge{{corner[0], corner[1], corner[2]}, slot, {}, area};
            for (int k = 0; k < 3; ++k) {
                gauge.weight[k] = gradient[k].dot(across);
                gauged(corner[k], slot) += area;
            }
            gauges_.push_back(gauge);
        }
    }
    inverse_area_ = gauged.unaryExpr([](double sum) { return sum > 0 ? 1 / sum : 0.0; });
    for (long i = 0; i < count; ++i) mean.add_diagonal(static_cast<int>(i), area_[i] + 1e-15);
    mean_.emplace(mean.build({}));

    creased_.setZero(count, kWrinkleSlots);
    for (const Crease& crease : lines.creases) mean_along(crease, own);

    resolved_ = Points::Zero(count, 3);
    for (long i = 0; i < count; ++i)
        for (int slot = 0; slot < kWrinkleSlots; ++slot) {
            if (window_(i, slot) == 0) continue;
            const double per_wave =
                wavelength_(i, slot) * edge_count[i] / std::max(edges[i], 1e-12);
            resolved_(i, slot) = geom::smoothstep(kFirstResolved, kResolved, per_wave);
            any_resolved_ = any_resolved_ || resolved_(i, slot) > 0;
        }
}

// Averages over the pieces of the strip, weighted by a kernel and the area of skin in each.
void Wrinkles::mean_along(const Crease& crease, const std::vector<int>& own) {
    Strip strip{.slot = crease.slot, .row = {}, .place = {}, .mean = {}};
    const double piece = kStripPiece * options_.mean_along_crease_m;
    double last = 0;
    for (std::size_t i = 0; i < crease.vertex.size(); ++i) {
        const int row = own[static_cast<std::size_t>(crease.vertex[i])];
        if (row < 0) continue;
        strip.row.push_back(row);
        creased_(row, crease.slot) = 1;
        strip.place.push_back(crease.place_m[i] / piece);
        last = std::max(last, strip.place.back());
    }
    if (strip.row.empty()) return;
    const auto count = static_cast<long>(std::floor(last)) + 2;
    Eigen::VectorXd skin = Eigen::VectorXd::Zero(count);
    for (std::size_t i = 0; i < strip.row.size(); ++i) {
        const auto k = static_cast<long>(strip.place[i]);
        const double t = strip.place[i] - static_cast<double>(k);
        skin[k] += (1 - t) * area_[strip.row[i]];
        skin[k + 1] += t * area_[strip.row[i]];
    }
    strip.mean.resize(count, count);
    for (long a = 0; a < count; ++a) {
        double sum = 0;
        for (long b = 0; b < count; ++b) {
            const double away = static_cast<double>(a - b) * kStripPiece;
            strip.mean(a, b) = std::exp(-0.5 * away * away);
            sum += strip.mean(a, b) * skin[b];
        }
        strip.mean.row(a) /= sum;
    }
    strips_.push_back(std::move(strip));
}

const Points& Wrinkles::compression(const Points& vertices) const {
    const auto count = static_cast<long>(vertex_.size());
    at_.resize(count, 3);
    for (long i = 0; i < count; ++i) at_.row(i) = vertices.row(vertex_[i]);
    compression_.setZero(count, 3);
    if (count == 0) return compression_;
    for (const Gauge& gauge : gauges_) {
        const Vec3 across = (gauge.weight[0] * at_.row(gauge.corner[0]) +
                             gauge.weight[1] * at_.row(gauge.corner[1]) +
                             gauge.weight[2] * at_.row(gauge.corner[2]))
                                .transpose();
        const double shortened = gauge.area * (1 - across.norm());
        for (int k = 0; k < 3; ++k) compression_(gauge.corner[k], gauge.slot) += shortened;
    }
    compression_.array() *= inverse_area_.array();
    for (long i = 0; i < count; ++i) compression_.row(i) *= area_[i];
    mean_->solve(compression_, compression_);
    for (const Strip& strip : strips_) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(strip.mean.rows());
        const auto fraction = [&](std::size_t i) {
            const auto k = static_cast<long>(strip.place[i]);
            return std::pair(k, strip.place[i] - static_cast<double>(k));
        };
        for (std::size_t i = 0; i < strip.row.size(); ++i) {
            const auto [k, t] = fraction(i);
            const double c = area_[strip.row[i]] * compression_(strip.row[i], strip.slot);
            sum[k] += (1 - t) * c;
            sum[k + 1] += t * c;
        }
        const Eigen::VectorXd mean = strip.mean * sum;
        for (std::size_t i = 0; i < strip.row.size(); ++i) {
            const auto [k, t] = fraction(i);
            compression_(strip.row[i], strip.slot) = (1 - t) * mean[k] + t * mean[k + 1];
        }
    }
    return compression_;
}

double Wrinkles::depth_m(long row, int slot, double compression) const {
    const double c = std::min(compression, 0.6);
    const double fraction = folded_fraction(c, creased_(row, slot) ? kCreasedSkin : kSmoothSkin);
    if (fraction == 0) return 0;
    const double ratio =
        std::min(fold_depth_ratio(options_.strength * fraction / (1 - c)), kSteepestFold);
    return window_(row, slot) * ratio * (1 - c) * wavelength_(row, slot);
}

void Wrinkles::fold(Points& vertices, Points& depth) const {
    if (vertex_.empty() || options_.strength == 0) return;
    compression(vertices);
    if (any_resolved_) geom::vertex_normals(at_, triangles_, normals_);
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
        const auto row = static_cast<long>(i);
        double out = 0;
        for (int slot = 0; slot < kWrinkleSlots; ++slot) {
            if (window_(row, slot) == 0) continue;
            const double c = compression_(row, slot), stays = stays_(row, slot);
            const double in_place = depth_m(row, slot, c - later_(row, slot));
            depth(vertex_[i], slot) += (1 - resolved_(row, slot)) * in_place;
            // What is there at rest does not begin later
            if (stays > 0)
                depth(vertex_[i], slot) += depth_m(row, slot, c + stays) - depth_m(row, slot, c);
            if (resolved_(row, slot) > 0)
                out += resolved_(row, slot) * in_place * fold_height(phase_(row, slot));
        }
        if (out != 0) vertices.row(vertex_[i]) += out * normals_.row(row);
    }
}

}  // namespace risorius::face
