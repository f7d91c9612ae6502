// SPDX-License-Identifier: MIT
/// \file
/// A head made of spheres: skin with two eyes let into it, and teeth behind it. Small, closed and known to the last vertex.
#pragma once

#include <cmath>
#include <numbers>

#include "risorius/render/scene.h"

namespace risorius::render {

constexpr double kHeadRadius_m = 0.1;

class RoundHead {
  public:
    RoundHead() {
        add_sphere(Material::kSkin, Vec3::Zero(), kHeadRadius_m, 48, -1);
        for (const int side : {0, 1}) {
            const Vec3 centre((side == 0 ? 1 : -1) * 0.03, 0.02, 0.088);
            scene.eyes[static_cast<std::size_t>(side)] = {.centre = centre, .radius_m = 0.012};
            add_sphere(Material::kEye, centre, 0.012, 24, side);
        }
        add_sphere(Material::kTeeth, Vec3(0, -0.045, 0.06), 0.012, 12, -1);
        place_marks();
        pose.positions = scene.rest;
    }

    /// Where the ray from straight ahead meets the skin.
    static Vec3 on_skin(double x, double y) {
        return {x, y, std::sqrt(kHeadRadius_m * kHeadRadius_m - x * x - y * y)};
    }

    Scene scene;
    Pose pose;

  private:
    void add_sphere(Material material, const Vec3& centre, double radius, int rings, int eye) {
        const auto first = static_cast<int>(scene.rest.rows());
        const int segments = 2 * rings;
        const auto ring_size = static_cast<Eigen::Index>(segments);
        scene.rest.conservativeResize(first + (rings - 1) * ring_size + 2, 3);
        Eigen::Index row = first;
        scene.rest.row(row++) = (centre + Vec3(0, radius, 0)).transpose();
        for (int i = 1; i < rings; ++i)
            for (int j = 0; j < segments; ++j) {
                const double polar = std::numbers::pi * i / rings;
                const double turn = 2 * std::numbers::pi * j / segments;
                scene.rest.row(row++) =
                    (centre + radius * Vec3(std::sin(polar) * std::sin(turn), std::cos(polar),
                                            std::sin(polar) * std::cos(turn)))
                        .transpose();
            }
        const int last = static_cast<int>(row);
        scene.rest.row(row) = (centre - Vec3(0, radius, 0)).transpose();

        Surface surface;
        surface.material = material;
        surface.eye = eye;
        surface.triangles.resize(2 * segments * (rings - 1), 3);
        Eigen::Index face = 0;
        const auto at = [&](int i, int j) { return first + 1 + (i - 1) * segments + j % segments; };
        for (int j = 0; j < segments; ++j) {
            surface.triangles.row(face++) << first, at(1, j), at(1, j + 1);
            surface.triangles.row(face++) << last, at(rings - 1, j + 1), at(rings - 1, j);
        }
        for (int i = 1; i + 1 < rings; ++i)
            for (int j = 0; j < segments; ++j) {
                surface.triangles.row(face++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
                surface.triangles.row(face++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
            }
        scene.surfaces.push_back(surface);
    }

    void place_marks() {
        auto& marks = scene.landmarks;
        marks["v"] = Vec3(0, kHeadRadius_m, 0);
        marks["me"] = Vec3(0, -kHeadRadius_m, 0);
        marks["t_l"] = Vec3(kHeadRadius_m, 0, 0);
        marks["t_r"] = Vec3(-kHeadRadius_m, 0, 0);
        marks["prn"] = on_skin(0, -0.015);
        marks["ls"] = on_skin(0, -0.038);
        marks["li"] = on_skin(0, -0.056);
        const auto pair = [&](const char* id, double x, double y) {
            marks[std::string(id) + "_l"] = on_skin(x, y);
            marks[std::string(id) + "_r"] = on_skin(-x, y);
        };
        pair("cph", 0.006, -0.037);
        pair("ulc", 0.015, -0.041);
        pair("ch", 0.025, -0.046);
        pair("llc", 0.015, -0.053);
        pair("ma", 0.045, -0.010);
    }
};

}  // namespace risorius::render
