// SPDX-License-Identifier: MIT
/// \file
/// What every pixel shows, from the mesh itself rather than from the picture: which part of the head, how far away, which way
/// it faces, and where it goes until another pose. For stimulus ground truth; drawn by itself, without OpenGL.
///
/// One sample at the centre of each pixel, nothing averaged: a pixel belongs to one part. Cornea and lashes are looked through. Same
/// bytes everywhere and for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// The value of a pixel in a picture of parts; left and right are the subject's own.
enum class Part : std::uint8_t {
    kBackground,
    kSkin,
    kLips,  ///< the vermilion, by the landmarks of its border
    kScleraLeft,
    kScleraRight,
    kIrisLeft,
    kIrisRight,
    kPupilLeft,
    kPupilRight,
    kEyeCorner,  ///< what lies between lids and eye
    kTeeth,
    kGums,
    kTongue,
    kMouth,  ///< its inside
    kHair,   ///< of the scalp, as far as it grows from what is seen
    kBrowLeft,
    kBrowRight,
};
/// "background", "skin", ... in the order of Part.
const std::vector<std::string>& part_names();

/// A pose as seen: per pixel, rows from the top, the nearest triangle and where in it.
struct SeenSurface {
    Points positions;                  ///< V x 3, m, world
    std::vector<int> triangle;         ///< -1: background
    std::vector<float> second, third;  ///< weights of its second and third corner, in space
    std::vector<float> nearness;  ///< depth in clip space, -1 near .. 1 far; 2 where nothing is
};

class HairArea;

class SurfacePasses {
  public:
    /// `clip_from_world` as OffscreenView has it.
    SurfacePasses(const Scene& scene, const Eigen::Matrix4d& clip_from_world, int width_px,
                  int height_px);

    SeenSurface look(const Points& positions) const;

    std::vector<std::uint16_t> parts(const SeenSurface& seen) const;  ///< values of Part
    /// Distance from the camera along its axis, m (from its near plane when it is orthographic); infinite where nothing is.
    std::vector<float> depth(const SeenSurface& seen) const;
    /// x, y, z per pixel: smooth normal in the world, of length 1; 0 where nothing is.
    std::vector<float> normals(const SeenSurface& seen) const;
    /// Three per pixel: px to the right, px down from one pose to the other, and 1 where the same place is seen there too, 0
    /// where it is hidden or outside. The background stays.
    std::vector<float> flow(const SeenSurface& from, const SeenSurface& to) const;

    /// Pixels to the right and down, and depth in clip space.
    Vec3 in_picture(const Vec3& world) const;
    /// Whether nothing is nearer than a place of in_picture() by more than so much; false outside.
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
