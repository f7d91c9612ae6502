// SPDX-License-Identifier: MIT
/// \file
/// The ground truth of every frame as pictures, in a folder OUT.passes that appears whole or not at all:
///
///   segmentation_000000.png   8 bits, the number of the part of the head (render::Part; results.json names them)
///   depth_000000.exr          Y, 32-bit float: metres from the camera along its axis, infinite where there is no surface
///   normals_000000.exr        R G B = x y z of the skin's normal in the head frame's axes (left, up, forward)
///   flow_000000.exr           R, G: pixels to the right and down until the next frame; B: 1 where the point is visible there too.
///                             Computed from the motion of the mesh; there is none for the last frame
///   mask_face_000000.png      255 inside the oval from hairline to chin; mask_eyes_..., mask_mouth_...: 255 on their visible parts
///   results.json              camera, names of parts, list of files
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/render/surface_passes.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/scene/landmark_points.h"

namespace risorius::animate {

/// The names of the passes: "segmentation", "depth", "normals", "flow", "masks".
const std::vector<std::string>& pass_names();

class PassWriter {
  public:
    /// Throws Error when the folder exists and holds files that are not results.
    PassWriter(const std::filesystem::path& folder, const std::vector<std::string>& passes,
               const render::Scene& scene, const Eigen::Matrix4d& clip_from_world, int width_px,
               int height_px, const scene::LandmarkPoints& landmarks);

    /// Adds a frame, in order. `positions`: V x 3, m, in the order of the mesh.
    void add(int frame, const Points& positions);
    /// Gives the folder its final name. Throws RunError when it cannot be renamed.
    void commit();

    /// Returns the masks of the last frame: one value per pixel, not 0 inside. They are empty when "masks" is not among the
    /// passes.
    struct Masks {
        std::vector<std::uint16_t> face, eyes, mouth;
    };
    const Masks& masks() const { return masks_; }

  private:
    bool wanted(const char* pass) const;
    std::filesystem::path file_of(const char* what, int frame, const char* ending);
    void write_masks(int frame, const render::SeenSurface& seen,
                     const std::vector<std::uint16_t>& parts);

    std::vector<std::string> passes_, files_;
    report::AtomicFolder folder_;
    render::SurfacePasses surface_;
    Eigen::Matrix4d clip_from_world_;
    scene::LandmarkPoints landmarks_;
    std::optional<render::SeenSurface> before_;
    Masks masks_;
};

}  // namespace risorius::animate
