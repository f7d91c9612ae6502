// SPDX-License-Identifier: MIT
/// \file
/// Ground truth per pixel from the mesh instead of the picture: the part of the head, depth, normal, and motion to another pose.
/// Rasterized in software without OpenGL.
///
/// There is one sample at the centre of each pixel and no averaging: a pixel belongs to one part. Cornea and lashes count as
/// transparent. The bytes are the same on every machine and for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// The value of a pixel in a picture of parts. Left and right are the subject's.
enum class Part : std::uint8_t {
    kBackground,
    kSkin,
    kLips,  ///< the vermilion, bounded by landmarks
    kScleraLeft,
    kScleraRight,
    kIrisLeft,
    kIrisRight,
    kPupilLeft,
    kPupilRight,
    kEyeCorner,  ///< tissue between lids and eye
    kTeeth,
    kGums,
    kTongue,
    kMouth,  ///< the inside of the mouth
    kHair,   ///< hair of the scalp where it grows on visible skin
    kBrowLeft,
    kBrowRight,
};
/// "background", "skin", ... in the order of Part.
const std::vector<std::string>& part_names();

/// A rasterized pose: per pixel, rows from the top, the nearest triangle and the point on it.
struct SeenSurface {
    Points positions;                  ///< V x 3, m, world
    std::vector<int> triangle;         ///< -1: background
    std::vector<float> second, third;  ///< barycentric weights of its second and third corner
    /// Depth in clip space, from -1 near to 1 far; 2 for the background
    std::vector<float> nearness;
};

class HairArea;

/// Rasterizes poses of one scene for one camera.
class SurfacePasses {
  public:
    /// `clip_from_world`: as of OffscreenView::clip_from_world().
    SurfacePasses(const Scene& scene, const Eigen::Matrix4d& clip_from_world, int width_px,
                  int height_px);

    /// Rasterizes a pose.
    SeenSurface look(const Points& positions) const;

    std::vector<std::uint16_t> parts(const SeenSurface& seen) const;  ///< values of Part
    /// Distance from the camera along its axis, m (from the near plane for an orthographic camera); infinite for the background.
    std::vector<float> depth(const SeenSurface& seen) const;
    /// x, y, z per pixel: unit smooth normal in the world; 0 for the background.
    std::vector<float> normals(const SeenSurface& seen) const;
    /// Three values per pixel: motion to the other pose in px to the right and px down, and 1 where the same point is visible
    /// there too, 0 where it is hidden or outside the picture. The background does not move.
    std::vector<float> flow(const SeenSurface& from, const SeenSurface& to) const;

    /// Position in the picture: px to the right, px down, and depth in clip space.
    Vec3 in_picture(const Vec3& world) const;
    /// Whether no surface is nearer than a position of in_picture() by more than `above_m`; false outside the picture.
    bool is_seen(const SeenSurface& seen, const Vec3& place, double above_m) const;

    int width_px() const { return width_; }
    int height_px() const { return height_; }

  private:
    Vec3 at(const SeenSurface& seen, std::size_t pixel, const Points& positions) const;

    int width_, height_;
    Eigen::Matrix4d clip_from_world_;
    Triangles triangles_;
    std::vector<Part> part_;  ///< per triangle; kScleraLeft or kScleraRight for the whole eye
    Points rest_;
    std::array<Eye, 2> eyes_;
    std::shared_ptr<const HairArea> hair_;
};

}  // namespace risorius::render
