// SPDX-License-Identifier: MIT
#include "risorius/render/detail/crease_normals.h"

namespace risorius::render {
namespace {

constexpr double kCosineOfCrease = 0.7071;

}  // namespace

std::vector<Vec3> crease_normals(const Points& positions, const Triangles& surface) {
    const auto faces = static_cast<std::size_t>(surface.rows());
    // Per triangle: normals of twice its area, and unit normals
    std::vector<Vec3> areas, directions;
    std::vector<std::vector<std::size_t>> around(static_cast<std::size_t>(positions.rows()));
    for (std::size_t f = 0; f < faces; ++f) {
        const auto corner = [&](int k) -> Vec3 {
            return positions.row(surface(static_cast<Eigen::Index>(f), k)).transpose();
        };
        areas.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)));
        directions.push_back(areas.back().normalized());
        for (int k = 0; k < 3; ++k)
            around[static_cast<std::size_t>(surface(static_cast<Eigen::Index>(f), k))].push_back(f);
    }
    std::vector<Vec3> normals;
    normals.reserve(3 * faces);
    for (std::size_t f = 0; f < faces; ++f)
        for (int k = 0; k < 3; ++k) {
            Vec3 sum = Vec3::Zero();
            for (const std::size_t g :
                 around[static_cast<std::size_t>(surface(static_cast<Eigen::Index>(f), k))])
                if (directions[g].dot(directions[f]) > kCosineOfCrease) sum += areas[g];
            normals.push_back(sum.normalized());
        }
    return normals;
}

}  // namespace risorius::render
