// SPDX-License-Identifier: MIT
/// \file
/// Additions to the picture of a face: a quantity as colours on the skin, or lines and marks over it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/render/surface_passes.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"

namespace risorius::scene {

/// Signed principal strain of the skin per vertex, ratio: of the two principal strains the one with the larger magnitude,
/// averaged over the triangles of the vertex, weighted by rest area. Vertices outside the skin get NaN.
std::vector<double> principal_strain(const Triangles& skin, const Points& rest,
                                     const Points& positions);

/// The additions that a value of Show asks for.
class Visualization {
  public:
    Visualization(render::Show show, const render::Scene& scene, const rig::Head& head,
                  const geom::PolygonMesh& mesh, const render::OffscreenView& view, int width_px,
                  int height_px, const LandmarkPoints& landmarks, std::optional<double> scale = {});

    /// End of the colour scale: strain (ratio, in both directions from 0) or error (mm). Default: 0.4 and 5 mm.
    static double scale_end(render::Show show, std::optional<double> given);

    /// The quantity per vertex, or none. `reference`: positions in the run to compare with.
    std::optional<render::SkinValues> values(const Points& positions,
                                             const std::optional<Points>& reference) const;
    /// Draws lines and marks over a picture of the pose.
    void draw_over(const Points& positions, Image& image) const;

  private:
    render::Show show_;
    double scale_end_;
    Points rest_;
    Triangles skin_;
    std::vector<std::array<int, 2>> edges_;
    std::optional<render::SurfacePasses> surface_;
    LandmarkPoints landmarks_;
};

}  // namespace risorius::scene
