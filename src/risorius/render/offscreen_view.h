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
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/detail/light.h"
#include "risorius/render/scene.h"

namespace risorius::render {

struct Background {
    bool transparent = false;
    std::array<double, 3> rgb{0.5, 0.5, 0.5};  ///< sRGB 0..1
    bool operator==(const Background&) const = default;
};

/// The content of a picture.
enum class Show {
    kSkin,     ///< the face as it is seen
    kMuscles,  ///< the muscles coloured by activation, under translucent skin, with a scale
    kSkull,    ///< skull, mandible and teeth under skin as clear as glass
    // The skin, with something that the caller adds: values of a pose, or lines and marks over the picture
    kWire,       ///< the mesh's edges
    kStrain,     ///< principal strain of the skin
    kError,      ///< distance of the skin from that in another run
    kLandmarks,  ///< their places and names
};
/// "skin", "muscles", "skull", "wire", "strain", "error", "landmarks"
const std::vector<std::string>& show_names();
/// Throws Error naming `place` and the names for an unknown one.
Show show_named(const std::string& name, const std::string& place);

/// The lens and place of the named camera; what is not given frames the head as the camera's name says.
struct Lens {
    bool orthographic = false;
    std::optional<double> distance_m;      ///< of the camera from the middle of the head, 0.2..100
    std::optional<double> view_angle_deg;  ///< that the height of the picture subtends, 0.5..90
    double aperture_mm =
        0;  ///< diameter of the aperture, 0..100; 0: sharp at every distance. In focus: the front of the eyes
    bool operator==(const Lens&) const = default;
};

struct ViewOptions {
    int width_px = 1024;
    int height_px = 1024;
    std::string camera =
        "front";  ///< "front", "three_quarter", "profile" and their "_right" mirrors, "top", and close-ups; see camera_names()
    Show show = Show::kSkin;
    bool deep = false;  ///< pictures with 16 bits besides, without the scale of values
    Background background{};
    LightOptions light{};
    Lens lens{};
    int supersampling =
        2;  ///< samples per pixel side, 1..4; all are shaded, so cost grows with its square
    bool draft =
        false;  ///< skin lit at its vertices, without pores and wrinkles finer than the mesh
    int threads =
        0;  ///< llvmpipe worker threads; 0 = draw on the calling thread. The driver reads it once: the
            ///< first view of a process decides for all. Pictures do not depend on it.
    bool operator==(const ViewOptions&) const = default;
};

const std::vector<std::string>& camera_names();

class OffscreenView {
  public:
    /// Throws Error for a scene without skin or a size outside 16..8192, RunError when no GL context is available.
    OffscreenView(const Scene& scene, const ViewOptions& options);
    /// Another view of the same scene with the same options, to draw at the same time on another thread: the same pictures. Shares
    /// what `first` has baked, which must not be drawing meanwhile; they may go away in any order.
    OffscreenView(const Scene& scene, const OffscreenView& first);
    ~OffscreenView();
    OffscreenView(const OffscreenView&) = delete;
    OffscreenView& operator=(const OffscreenView&) = delete;

    /// pose.positions must have as many rows as scene.rest. May be called from one thread at a time, any thread.
    Image draw(const Pose& pose);
    /// Mean of several moments in linear light: a shutter that was open for all of them.
    Image draw(const std::vector<Pose>& poses);

    /// The colours of the skin without light, on the texture coordinates of its surfaces: a square picture, sRGB. Lashes and brows,
    /// which are strands, are not in it. `scene` is the view's. Throws Error for a skin without texture coordinates.
    /// The wall of the mouth is, where it has texture coordinates that the skin leaves free.
    Image skin_texture(const Scene& scene, int side_px) const;
    /// Likewise the colours of kEye, kTeeth, kGums or kTongue: an iris as it is seen from straight ahead, teeth warmer at the neck and
    /// grey at the edge. `crown_height`: of each vertex of the scene, 0 at the neck of its tooth to 1 at the edge; or nothing.
    Image part_texture(const Scene& scene, Material part, int side_px,
                       const std::vector<double>& crown_height = {}) const;

    /// Processor time of the process, s, from when the last picture was drawn until it was in memory.
    double read_back_s() const;

    /// Pixel position (x right, y down, from the top left corner) of a world point.
    Vec2 project(const Vec3& world) const;
    /// The camera as OpenGL has it: x right and y up in [-w, w] in the picture.
    Eigen::Matrix4d clip_from_world() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::render
