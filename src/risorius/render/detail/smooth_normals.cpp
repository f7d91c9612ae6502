// SPDX-License-Identifier: MIT
#include "risorius/render/detail/smooth_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace risorius::render {
namespace {

void face_normals(const std::vector<int>& corners, const std::vector<float>& p,
                  std::vector<float>& normals) {
    const std::size_t faces = corners.size() / 3;
    for (std::size_t f = 0; f < faces; ++f) {
        const float* a = p.data() + 3 * static_cast<std::size_t>(corners[3 * f]);
        const float* b = p.data() + 3 * static_cast<std::size_t>(corners[3 * f + 1]);
        const float* c = p.data() + 3 * static_cast<std::size_t>(corners[3 * f + 2]);
        const float ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
        const float vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
        normals[3 * f] = uy * vz - uz * vy;
        normals[3 * f + 1] = uz * vx - ux * vz;
        normals[3 * f + 2] = ux * vy - uy * vx;
    }
}

}  // namespace

SmoothNormals::SmoothNormals(const Points& rest, const std::vector<const Triangles*>& surfaces) {
    const auto vertices = static_cast<std::size_t>(rest.rows());
    for (const Triangles* triangles : surfaces)
        corners_.insert(corners_.end(), triangles->data(), triangles->data() + triangles->size());
    const std::size_t faces = corners_.size() / 3;
    face_normals_.resize(3 * faces);

    // Triangles of each vertex alone
    std::vector<std::vector<int>> own(vertices);
    for (std::size_t i = 0; i < corners_.size(); ++i)
        own[static_cast<std::size_t>(corners_[i])].push_back(static_cast<int>(i / 3));
    std::vector<float> positions(3 * vertices);
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] = static_cast<float>(rest.data()[i]);
    face_normals(corners_, positions, face_normals_);
    std::vector<std::array<float, 3>> alone(vertices, {0, 0, 0});
    for (std::size_t v = 0; v < vertices; ++v)
        for (const int f : own[v])
            for (std::size_t k = 0; k < 3; ++k)
                alone[v][k] += face_normals_[3 * static_cast<std::size_t>(f) + k];

    // Then weld vertices with the same position and a similar normal.
    std::vector<int> order(vertices);
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](int v) {
        return std::array<double, 3>{rest(v, 0), rest(v, 1), rest(v, 2)};
    };
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const auto pa = place(a), pb = place(b);
        return pa != pb ? pa < pb : a < b;
    });
    std::vector<std::vector<int>> around = own;
    for (std::size_t i = 0; i < vertices;) {
        std::size_t end = i + 1;
        while (end < vertices && place(order[end]) == place(order[i])) ++end;
        for (std::size_t a = i; a < end; ++a)
            for (std::size_t b = i; b < end; ++b) {
                if (a == b) continue;
                const auto va = static_cast<std::size_t>(order[a]);
                const auto vb = static_cast<std::size_t>(order[b]);
                const float along = alone[va][0] * alone[vb][0] + alone[va][1] * alone[vb][1] +
                                    alone[va][2] * alone[vb][2];
                if (along > 0) around[va].insert(around[va].end(), own[vb].begin(), own[vb].end());
            }
        i = end;
    }
    around_begin_.resize(vertices + 1, 0);
    for (std::size_t v = 0; v < vertices; ++v) {
        // All members of a weld sum in the same order, so that their sums agree to the last bit.
        std::sort(around[v].begin(), around[v].end());
        around_.insert(around_.end(), around[v].begin(), around[v].end());
        around_begin_[v + 1] = static_cast<int>(around_.size());
    }
}

void SmoothNormals::compute(const std::vector<float>& positions, std::vector<float>& normals) {
    face_normals(corners_, positions, face_normals_);
    const std::size_t vertices = around_begin_.size() - 1;
    normals.resize(3 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        float x = 0, y = 0, z = 0;
        for (int i = around_begin_[v]; i < around_begin_[v + 1]; ++i) {
            const float* n = face_normals_.data() +
                             3 * static_cast<std::size_t>(around_[static_cast<std::size_t>(i)]);
            x += n[0];
            y += n[1];
            z += n[2];
        }
        const float length = std::sqrt(x * x + y * y + z * z);
        const float scale = length > 0 ? 1 / length : 0;
        normals[3 * v] = x * scale;
        normals[3 * v + 1] = y * scale;
        normals[3 * v + 2] = z * scale;
    }
}

}  // namespace risorius::render
