// What a picture shows besides the face itself: a quantity as colour on the skin, or lines and marks over it.
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

/// Of the skin of a head per vertex, signed: that principal strain which is greater in size, ratio; mean of the triangles at a
/// vertex by their area at rest. Not a number off the skin.
std::vector<double> principal_strain(const Triangles& skin, const Points& rest,
                                     const Points& positions);

class Visualization {
  public:
    Visualization(render::Show show, const render::Scene& scene, const rig::Head& head,
                  const geom::PolygonMesh& mesh, const render::OffscreenView& view, int width_px,
                  int height_px, const LandmarkPoints& landmarks, std::optional<double> scale = {});

    /// Where the colours of strain (both ways from 0) and error end: 0.4 and 5 mm when it is not given.
    static double scale_end(render::Show show, std::optional<double> given);

    /// Colours for the pose; `reference` is where the vertices are in the other run.
    std::optional<render::SkinValues> values(const Points& positions,
                                             const std::optional<Points>& reference) const;
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
