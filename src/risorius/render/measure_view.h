// SPDX-License-Identifier: MIT
/// \file
/// Pictures for measurement: surfaces in given colours in parallel projection, with marks and lines. The colours are rendered in
/// software without OpenGL and are the same bytes on every machine.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

/// A surface with one colour per vertex.
struct ColouredSurface {
    Points positions;  ///< V x 3, m
    Triangles triangles;
    std::vector<Vec3> colours;  ///< V, sRGB 0..1
    /// 0..1. Below 1, only the front sides of triangles are drawn. They are blended over what is behind them, and marks and lines
    /// shine through.
    double opacity = 1;
};

/// A disc or a ring at a point.
struct Mark {
    Vec3 at;      ///< m
    Vec3 colour;  ///< sRGB 0..1
    double radius_px = 4;
    bool ring = false;  ///< a ring rather than a disc
};

/// A polyline.
struct MarkedLine {
    std::vector<Vec3> points;  ///< m
    Vec3 colour;
    double width_px = 2;
};

struct MeasureViewOptions {
    int width_px = 600, height_px = 800;
    /// Azimuth of the camera: 0 is in front of the face, positive on its left
    double azimuth_deg = 0;
    Vec3 centre = Vec3::Zero();
    double height_m = 0.3;  ///< height of the visible area
    /// Marks and lines show if they lie at most this far behind a surface
    double marks_above_m = 4e-3;
    Vec3 background{1, 1, 1};
};

/// Draws surfaces, then lines and marks. Throws Error for a size outside [1, 8192].
Image draw_measured(const std::vector<ColouredSurface>& surfaces, const std::vector<Mark>& marks,
                    const std::vector<MarkedLine>& lines, const MeasureViewOptions& options);

/// Colour map for 0..1, from dark blue over green to yellow, with evenly growing lightness. Returns sRGB 0..1. Values outside the
/// range are clamped. The colours are samples of the map viridis of matplotlib (S. van der Walt, N. Smith 2015, CC0).
Vec3 scale_colour(double fraction);

}  // namespace risorius::render
