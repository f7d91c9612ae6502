// SPDX-License-Identifier: MIT
/// \file
/// Draws a scene off-screen into images: linear light, shadow, antialiasing, one shader program per material.
///
/// Deterministic: the same scene, pose and options give the same bytes, for any number of threads.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/detail/light.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Background of a picture.
struct Background {
    bool transparent = false;
    std::array<double, 3> rgb{0.5, 0.5, 0.5};  ///< sRGB 0..1
    bool operator==(const Background&) const = default;
};

/// What a picture shows.
enum class Show {
    kSkin,     ///< the face
    kMuscles,  ///< muscles coloured by activation under translucent skin, with a scale
    kSkull,    ///< skull, mandible and teeth under glassy skin
    // The following ones show the skin and what the caller adds: Pose::values, or lines and marks over the picture (overlays.h).
    kWire,          ///< the mesh's edges
    kStrain,        ///< principal strain of the skin
    kError,         ///< distance of the skin from the skin of another run
    kLandmarks,     ///< positions and names of the landmarks
    kArticulation,  ///< the mouth in section, instead of the face
};
/// The names of Show: "skin", "muscles", "skull", "wire", "strain", "error", "landmarks",
/// "articulation".
const std::vector<std::string>& show_names();
/// Throws Error naming `place` and the valid names for an unknown name.
Show show_named(const std::string& name, const std::string& place);

/// Lens and distance of the named camera. Fields that are not given are chosen so that the camera frames the head.
struct Lens {
    bool orthographic = false;
    std::optional<double> distance_m;      ///< from the camera to the middle of the head, 0.2..100
    std::optional<double> view_angle_deg;  ///< angle that the picture covers vertically, 0.5..90
    /// Diameter of the aperture, 0..100; 0: sharp at every distance. The front of the eyes is in focus.
    double aperture_mm = 0;
    bool operator==(const Lens&) const = default;
};

struct ViewOptions {
    int width_px = 1024;
    int height_px = 1024;
    /// Name of camera_names(): "front", "three_quarter", "profile" and their "_right" mirror images, "top", and close-ups.
    std::string camera = "front";
    Show show = Show::kSkin;
    bool deep = false;  ///< also make pictures with 16 bits per channel, without the colour scale
    Background background{};
    LightOptions light{};
    Lens lens{};
    /// Samples along each side of a pixel, 1..4. All samples are shaded, so the cost grows with the square of this number.
    int supersampling = 2;
    /// True: skin that is drawn fast, because it is lit at its vertices only, without pores and without wrinkles finer than the
    /// mesh
    bool draft = false;
    /// Number of worker threads of llvmpipe, the OpenGL driver on the CPU; 0: it draws on the calling thread. The driver reads
    /// the number once, so the first view of a process decides for all. Pictures do not depend on it.
    int threads = 0;
    bool hair =
        true;  ///< false: the scene has no locks on the scalp; whoever makes the scene leaves them out
    bool operator==(const ViewOptions&) const = default;
};

const std::vector<std::string>& camera_names();

/// Draws pictures of one scene.
class OffscreenView {
  public:
    /// Throws Error for a scene without skin or a size outside 16..8192, and RunError when no GL context is available.
    OffscreenView(const Scene& scene, const ViewOptions& options);
    /// Another view of the same scene with the same options, which draws the same pictures on another thread. It shares the baked
    /// data of `first`, which must not draw during the construction. The views may be destroyed in any order.
    OffscreenView(const Scene& scene, const OffscreenView& first);
    ~OffscreenView();
    OffscreenView(const OffscreenView&) = delete;
    OffscreenView& operator=(const OffscreenView&) = delete;

    /// Draws a pose; pose.positions must have as many rows as scene.rest. Any thread may call it, but only one at a time.
    Image draw(const Pose& pose);
    /// Draws several poses and returns their mean in linear light: the motion blur of a shutter that is open during all of them.
    Image draw(const std::vector<Pose>& poses);

    /// Draws the colours of the skin, without light, on the texture coordinates of its surfaces. Returns a square picture in
    /// sRGB. Lashes and brows are hair strands and are not included. The wall of the mouth is included where its texture
    /// coordinates do not overlap those of the skin. `scene`: the scene of this view. `side_px`: width and height of the picture.
    /// Throws Error for a skin without texture coordinates.
    Image skin_texture(const Scene& scene, int side_px) const;
    /// Does the same for the material kEye, kTeeth, kGums or kTongue. An iris is drawn as seen from straight ahead. Teeth have a
    /// warmer colour at the neck and are grey at the cutting edge. `crown_height`: one number per vertex of the scene, from 0 at
    /// the neck of its tooth to 1 at the cutting edge; it may be empty.
    Image part_texture(const Scene& scene, Material part, int side_px,
                       const std::vector<double>& crown_height = {}) const;

    /// Returns the CPU time in seconds that the process spent on reading back the last picture: from the end of the drawing until
    /// the picture was in memory.
    double read_back_s() const;

    /// From now on the CPU time of each pass of each picture is added up. Pictures take longer then.
    void time_passes();
    /// Names of the passes in the order of drawing, and their CPU time in all pictures since time_passes(), s.
    const std::vector<std::pair<std::string, double>>& passes_s() const;

    /// Returns the position of a world point in the picture, px: x to the right and y down from the top left corner.
    Vec2 project(const Vec3& world) const;
    /// Returns the matrix of the camera in the convention of OpenGL. A point is inside the picture where its clip coordinates x
    /// (to the right) and y (up) are within [-w, w].
    Eigen::Matrix4d clip_from_world() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::render
