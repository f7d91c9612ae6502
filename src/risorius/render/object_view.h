// SPDX-License-Identifier: MIT
/// \file
/// Draws deformed objects off-screen like figures in papers. An object is a transparent shaded surface, its grid is drawn as
/// wires that grow paler with distance, and its fixed nodes are drawn as balls. The background is white and z is up. The camera
/// looks from diagonally above in mild perspective, and the picture contains every vertex.
///
/// Several objects stand in a row in the given order, at the same scale and height, so that they can be compared.
/// Deterministic: the same objects and options give the same bytes, for any number of threads.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

/// An object to draw.
struct Object {
    Points positions;   ///< V x 3, m, z up
    Triangles surface;  ///< F x 3, all with the same winding; may have no rows
    /// Pairs of vertices; wires inside a solid are drawn thinner
    std::vector<std::array<int, 2>> wires;
    std::vector<int> fixed;     ///< vertices that are drawn as balls
    std::vector<double> shade;  ///< empty, or per vertex: 0 blue, 0.5 pale, 1 orange; clamped
    /// 2S x 3, m: ends of thin pale lines, for instance the undeformed outline
    Points outline = {};
};

struct ObjectViewOptions {
    int width_px = 1200;
    int height_px = 900;
    double azimuth_deg = -58;   ///< azimuth of the camera about z: 0 looks from +x, -90 from -y
    double elevation_deg = 18;  ///< elevation of the camera above the horizontal, -90..90
    int supersampling = 3;      ///< samples along each side of a pixel, 1..4
    int threads = 0;            ///< as in ViewOptions
};

/// Draws the picture of a list of objects.
class ObjectView {
  public:
    /// Throws Error for an empty list, vertex indices out of range, positions that are not finite and options out of range, and
    /// RunError when no GL context is available.
    ObjectView(const std::vector<Object>& objects, const ObjectViewOptions& options);
    ~ObjectView();
    ObjectView(const ObjectView&) = delete;
    ObjectView& operator=(const ObjectView&) = delete;

    Image draw();

    /// Pixel position (x right, y down, from the top left corner) of a point of an object.
    Vec2 project(std::size_t object, const Vec3& point) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::render
