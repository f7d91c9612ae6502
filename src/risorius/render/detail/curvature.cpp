// SPDX-License-Identifier: MIT
#include "risorius/render/detail/curvature.h"

#include <algorithm>
#include <numeric>

namespace risorius::render {
namespace {

constexpr int kSmoothings = 2;

/// For each vertex, the first vertex at the same position.
std::vector<std::size_t> firsts(const Points& rest) {
    const auto vertices = static_cast<std::size_t>(rest.rows());
    const auto row = [&](std::size_t v) { return rest.row(static_cast<Eigen::Index>(v)); };
    const auto before = [&](std::size_t a, std::size_t b) {
        for (int k = 0; k < 3; ++k)
            if (row(a)[k] != row(b)[k]) return row(a)[k] < row(b)[k];
        return a < b;
    };
    std::vector<std::size_t> order(vertices), first(vertices);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), before);
    for (std::size_t i = 0; i < vertices; ++i)
        first[order[i]] =
            i > 0 && row(order[i]) == row(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

}  // namespace

std::vector<float> curvature(const Points& rest, const std::vector<unsigned>& triangles) {
    const auto vertices = static_cast<std::size_t>(rest.rows());
    const std::vector<std::size_t> first = firsts(rest);
    std::vector<Vec3> normal(vertices, Vec3::Zero());
    const auto at = [&](std::size_t v) -> Vec3 {
        return rest.row(static_cast<Eigen::Index>(v)).transpose();
    };
    const auto corner = [&](std::size_t i) { return first[triangles[i]]; };
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const Vec3 n = (at(corner(i + 1)) - at(corner(i))).cross(at(corner(i + 2)) - at(corner(i)));
        for (std::size_t k = 0; k < 3; ++k) normal[corner(i + k)] += n;
    }
    for (Vec3& n : normal)
        if (n.norm() > 0) n.normalize();

    std::vector<double> bend(vertices, 0.0), weight(vertices, 0.0);
    const auto each_edge = [&](const auto& visit) {
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t a = corner(i + k), b = corner(i + (k + 1) % 3);
                if ((at(a) - at(b)).norm() > 1e-9) visit(a, b);
            }
    };
    each_edge([&](std::size_t a, std::size_t b) {
        const double turn = (normal[a] - normal[b]).norm(), length = (at(a) - at(b)).norm();
        for (const std::size_t v : {a, b}) {
            bend[v] += turn;
            weight[v] += length;
        }
    });
    for (std::size_t v = 0; v < vertices; ++v) bend[v] = weight[v] > 0 ? bend[v] / weight[v] : 0;
    for (int i = 0; i < kSmoothings; ++i) {
        std::vector<double> sum = bend;
        std::vector<double> count(vertices, 1.0);
        each_edge([&](std::size_t a, std::size_t b) {
            sum[a] += bend[b];
            sum[b] += bend[a];
            count[a] += 1;
            count[b] += 1;
        });
        for (std::size_t v = 0; v < vertices; ++v) bend[v] = sum[v] / count[v];
    }
    std::vector<float> out(vertices);
    for (std::size_t v = 0; v < vertices; ++v) out[v] = static_cast<float>(bend[first[v]]);
    return out;
}

}  // namespace risorius::render
