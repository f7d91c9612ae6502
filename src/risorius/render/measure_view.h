// SPDX-License-Identifier: MIT
/// \file
/// Pictures for measurement: surfaces in given colours in parallel projection along an axis, with marks and lines. Rendered in software
/// without OpenGL, without perspective or light that changes a colour; the same bytes on every machine.
#pragma once

#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"

namespace risorius::render {

struct ColouredSurface {
    Points positions;  ///< V x 3, m
    Triangles triangles;
    std::vector<Vec3> colours;  ///< V, sRGB 0..1
    double opacity =
        1;  ///< below 1: laid over what is behind it, front faces only, marks and lines shine through
};

struct Mark {
    Vec3 at;      ///< m
    Vec3 colour;  ///< sRGB 0..1
    double radius_px = 4;
    bool ring = false;  ///< a ring rather than a disc
};

struct MarkedLine {
    std::vector<Vec3> points;  ///< m
    Vec3 colour;
    double width_px = 2;
};

struct MeasureViewOptions {
    int width_px = 600, height_px = 800;
    double azimuth_deg = 0;  ///< from straight ahead of the face towards its left
    Vec3 centre = Vec3::Zero();
    double height_m = 0.3;        ///< of what is seen
    double marks_above_m = 4e-3;  ///< marks and lines this far behind a surface still show
    Vec3 background{1, 1, 1};
};

/// Throws Error for a size outside of [1, 8192].
Image draw_measured(const std::vector<ColouredSurface>& surfaces, const std::vector<Mark>& marks,
                    const std::vector<MarkedLine>& lines, const MeasureViewOptions& options);

/// Dark blue over green to yellow, lightness growing evenly, for 0..1; beyond as its ends. Samples of matplotlib's viridis
/// (S. van der Walt, N. Smith 2015, CC0).
Vec3 scale_colour(double fraction);

}  // namespace risorius::render
