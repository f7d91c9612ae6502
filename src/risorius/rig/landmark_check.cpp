// SPDX-License-Identifier: MIT
#include "risorius/rig/landmark_check.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/dense_algebra.h"
#include "risorius/rig/detail/head_frame.h"

namespace risorius::rig {

namespace {

constexpr double kScatter_m = 4e-4;  // s: 2 mm at a distance of 10 mm from the neighbours
// D of a landmark that coincides with another: the precision of placing a landmark
constexpr double kNoise_m = 1e-3;
// Usual distance of a landmark from the mirror image of its partner
constexpr double kAsymmetry_m = 3e-3;

// X of the middle of most pairs.
double middle_plane(const std::map<std::string, Vec3>& in_head) {
    std::vector<double> middles;
    for (const auto& [id, left] : in_head) {
        const auto right = in_head.find(mirrored_landmark(id));
        if (id.ends_with("_l") && right != in_head.end())
            middles.push_back(0.5 * (left.x() + right->second.x()));
    }
    if (middles.empty()) return 0;
    std::nth_element(middles.begin(), middles.begin() + static_cast<long>(middles.size() / 2),
                     middles.end());
    return middles[middles.size() / 2];
}

}  // namespace

std::vector<LandmarkPrediction> predict_each(const std::map<std::string, Vec3>& in_head,
                                             const Atlas& atlas, double size) {
    const long n = static_cast<long>(in_head.size());
    Points from(n, 3), to(n, 3);
    std::vector<std::string> ids;
    for (const auto& [id, p] : in_head) {
        const long row = static_cast<long>(ids.size());
        from.row(row) = size * atlas.landmark(id)->position.transpose();
        to.row(row) = p.transpose();
        ids.push_back(id);
    }
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
    for (long i = 0; i < n; ++i) {
        for (long j = 0; j < n; ++j) system(i, j) = -(from.row(i) - from.row(j)).norm();
        system(i, i) += kNoise_m;
        system(i, n) = system(n, i) = 1.0;
        for (int k = 0; k < 3; ++k) system(i, n + 1 + k) = system(n + 1 + k, i) = from(i, k);
    }
    const Eigen::MatrixXd inverse = inverse_of(system);
    const Points weights = inverse.topLeftCorner(n, n) * to;
    const double middle = middle_plane(in_head);
    std::vector<LandmarkPrediction> out;
    for (long i = 0; i < n; ++i) {
        LandmarkPrediction p;
        p.id = ids[static_cast<std::size_t>(i)];
        p.found = to.row(i).transpose();
        // A landmark cannot be judged when the others alone lie in a plane, or nearly so.
        const double open = 1.0 / std::max(inverse(i, i), 1.0);
        Vec3 precision = Vec3::Constant(1.0 / (kScatter_m * size * open));
        Vec3 sum = precision.cwiseProduct(p.found - open * weights.row(i).transpose());
        const auto partner = in_head.find(mirrored_landmark(p.id));
        if (partner != in_head.end()) {
            // A landmark on the midline is its own partner, which gives no information on height and depth.
            const bool midline = partner->first == p.id;
            const Vec3 by_mirror =
                std::pow(kAsymmetry_m * size, -2) * (midline ? Vec3(Vec3::UnitX()) : Vec3::Ones());
            const double x = midline ? middle : 2 * middle - partner->second.x();
            const Vec3 image(x, partner->second.y(), partner->second.z());
            sum += by_mirror.cwiseProduct(image);
            p.mirror_ratio = (p.found - image).cwiseProduct(by_mirror.cwiseSqrt()).norm();
            precision += by_mirror;
        }
        p.expected = sum.cwiseQuotient(precision);
        p.off_m = (p.found - p.expected).norm();
        p.ratio = (p.found - p.expected).cwiseProduct(precision.cwiseSqrt()).norm();
        out.push_back(p);
    }
    return out;
}

std::vector<LandmarkPrediction> doubtful_landmarks(std::map<std::string, Vec3> in_head,
                                                   const Atlas& atlas, double size,
                                                   const LandmarkLimits& limits) {
    constexpr std::size_t kFewest = 12;  // with fewer landmarks a single one cannot be judged
    std::vector<std::string> aside;
    std::map<std::string, Vec3> rest = in_head;
    while (rest.size() > kFewest) {
        const std::vector<LandmarkPrediction> all = predict_each(rest, atlas, size);
        auto worst = std::max_element(
            all.begin(), all.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
        // Two close neighbours make each other suspect. Their partners tell which of them is wrong.
        constexpr double kAlike = 0.6;
        const double min = kAlike * worst->ratio;
        for (auto p = all.begin(); p != all.end(); ++p)
            if (p->ratio > min && p->ratio >= limits.ratio && p->off_m >= limits.off_m * size &&
                p->mirror_ratio > 2 * worst->mirror_ratio)
                worst = p;
        if (worst->ratio < limits.ratio || worst->off_m < limits.off_m * size) break;
        aside.push_back(worst->id);
        rest.erase(worst->id);
    }
    // Predictions of the removed landmarks from the trusted ones.
    std::vector<LandmarkPrediction> out;
    for (const std::string& id : aside) {
        std::map<std::string, Vec3> with = rest;
        with[id] = in_head.at(id);
        for (const LandmarkPrediction& p : predict_each(with, atlas, size))
            if (p.id == id && p.ratio >= limits.ratio && p.off_m >= limits.off_m * size)
                out.push_back(p);
    }
    return out;
}

std::vector<std::string> exchanged_pairs(const std::map<std::string, Vec3>& landmarks,
                                         const Atlas& atlas) {
    // The left direction: the sum of the directions of all pairs, each as long as on the atlas.
    std::vector<std::pair<std::string, Vec3>> across;
    for (const auto& [id, left] : landmarks) {
        const auto right = landmarks.find(mirrored_landmark(id));
        if (!id.ends_with("_l") || right == landmarks.end() || !atlas.landmark(id)) continue;
        across.push_back({id, left - right->second});
    }
    // The frame is fitted to the midline and the middles of all pairs, which do not change when a pair is exchanged.
    std::map<std::string, Vec3> sides = landmarks, swapped = landmarks;
    std::vector<std::string> out;
    for (int round = 0; round < 4; ++round) {
        const Mat3 rotation = find_head_frame(sides, atlas, 1.0).rotation;
        std::vector<std::string> now;
        for (const auto& [id, direction] : across)
            if ((rotation * direction).x() < 0) now.push_back(id);
        if (now == out) break;
        out = now;
        sides = landmarks;
        for (const std::string& id : out) std::swap(sides[id], sides[mirrored_landmark(id)]);
    }
    return out;
}

}  // namespace risorius::rig
