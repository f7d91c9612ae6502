// SPDX-License-Identifier: MIT
#include "risorius/render/detail/coarser_faces.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace risorius::render {
namespace {

constexpr double kAroundEye = 1.6;     // times the radius of the eye: contains the lids
constexpr double kAroundMouth = 1.35;  // times half the width of the mouth

}  // namespace

std::vector<Face> coarser_faces(const Points& rest, const std::vector<Face>& faces, double error_m,
                                const std::function<bool(const Face&)>& stays) {
    std::vector<Face> out;
    std::vector<unsigned> indices;
    for (const Face& face : faces) {
        if (stays(face))
            out.push_back(face);
        else
            for (const int v : face) indices.push_back(static_cast<unsigned>(v));
    }
    if (indices.empty() || error_m <= 0) return faces;
    const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> places = rest.cast<float>();
    const auto vertices = static_cast<std::size_t>(places.rows());
    constexpr std::size_t kStride = 3 * sizeof(float);
    const float scale = meshopt_simplifyScale(places.data(), vertices, kStride);
    std::vector<unsigned> fewer(indices.size());
    fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), places.data(),
                                  vertices, kStride, 0, static_cast<float>(error_m) / scale,
                                  meshopt_SimplifyLockBorder, nullptr));
    for (std::size_t i = 0; i < fewer.size(); i += 3)
        out.push_back({static_cast<int>(fewer[i]), static_cast<int>(fewer[i + 1]),
                       static_cast<int>(fewer[i + 2])});
    return out;
}

std::function<bool(const Face&)> much_moved(const Scene& scene) {
    const auto left = scene.landmarks.find("ch_l"), right = scene.landmarks.find("ch_r");
    if (left == scene.landmarks.end() || right == scene.landmarks.end())
        return [](const Face&) { return true; };
    const Vec3 mouth = 0.5 * (left->second + right->second);
    const double reach = kAroundMouth * 0.5 * (left->second - right->second).norm();
    return [&scene, mouth, reach](const Face& face) {
        return std::any_of(face.begin(), face.end(), [&](int v) {
            const Vec3 p = scene.rest.row(v).transpose();
            return (p - mouth).norm() < reach ||
                   std::any_of(scene.eyes.begin(), scene.eyes.end(), [&](const Eye& eye) {
                       return (p - eye.centre).norm() < kAroundEye * eye.radius_m;
                   });
        });
    };
}

std::function<bool(const Face&)> may_fold(const Scene& scene, bool wanted) {
    if (!wanted || scene.fold_phase.rows() == 0) return [](const Face&) { return false; };
    return [&scene](const Face& face) {
        return std::any_of(face.begin(), face.end(),
                           [&](int v) { return !scene.fold_phase.row(v).isZero(0.0); });
    };
}

}  // namespace risorius::render
