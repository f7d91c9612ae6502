// SPDX-License-Identifier: MIT
/// \file
/// Makes what some kinds of pictures (render::Show) add to a face: a quantity as colours on the skin, or lines and marks over it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/render/surface_passes.h"
#include "risorius/scene/detail/articulation_view.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"

namespace risorius::scene {

/// Returns the signed principal strain of the skin at each vertex, a ratio. In each triangle it is the one of the two principal
/// strains that has the larger magnitude; a vertex gets the mean over its triangles, weighted by their area at rest. Vertices
/// outside the skin get NaN.
std::vector<double> principal_strain(const Triangles& skin, const Points& rest,
                                     const Points& positions);

/// Both principal strains of the skin at each vertex, means as above.
struct StrainRange {
    std::vector<double> least, greatest;
};
StrainRange strain_range(const Triangles& skin, const Points& rest, const Points& positions);

/// The additions for one value of render::Show.
class Visualization {
  public:
    Visualization(render::Show show, const render::Scene& scene, const rig::Head& head,
                  const geom::PolygonMesh& mesh, const render::OffscreenView& view, int width_px,
                  int height_px, const LandmarkPoints& landmarks, std::optional<double> scale = {});

    /// Returns the end of the colour scale: `given`, or else 0.4 for strain (ratio; the scale goes from -0.4 to 0.4) and 5 mm for
    /// error.
    static double scale_end(render::Show show, std::optional<double> given);

    /// Returns the quantity at each vertex, or nothing if the picture shows none. `reference`: positions in the run to compare
    /// with, V x 3, m.
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
    std::optional<ArticulationView> articulation_;
};

}  // namespace risorius::scene
