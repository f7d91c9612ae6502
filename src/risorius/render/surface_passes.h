// SPDX-License-Identifier: MIT
/// \file
/// Ground truth per pixel: the part of the head, the depth, the normal, and the motion to another pose. They are computed from
/// the mesh, not from the picture, by a rasterizer in software without OpenGL.
///
/// There is one sample at the centre of each pixel and no averaging: a pixel belongs to one part. Cornea and lashes count as
/// transparent, the locks of a style of hair do not. The bytes are the same on every machine and for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/scene.h"
#include "risorius/render/seen_surface.h"

namespace risorius::render {

/// The part of the head that a pixel shows. Left and right are those of the subject.
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
    kHair,   ///< locks of hair, and visible skin of the scalp on which hair is painted
    kBrowLeft,
    kBrowRight,
    kGarment,
};
/// "background", "skin", ... in the order of Part.
const std::vector<std::string>& part_names();

class HairArea;
class Neckline;
struct Hair;

/// Rasterizes poses of one scene for one camera.
class SurfacePasses {
  public:
    /// What of the scene there is.
    enum class Over { kSkinAlone, kLocksToo };

    /// `clip_from_world`: as of OffscreenView::clip_from_world().
    SurfacePasses(const Scene& scene, const Eigen::Matrix4d& clip_from_world, int width_px,
                  int height_px, Over over = Over::kLocksToo);

    /// Rasterizes a pose. `positions`: V x 3, m, world. Those of the locks come after them in the result.
    SeenSurface look(const Points& positions) const;

    std::vector<std::uint16_t> parts(const SeenSurface& seen) const;  ///< values of Part
    /// Whether a pixel shows a lock, and not the skin on which hair may be painted.
    bool shows_lock(const SeenSurface& seen, std::size_t pixel) const {
        return seen.triangle[pixel] >= first_lock_;
    }
    /// Returns the distance from the camera along its axis, m, one per pixel. An orthographic camera measures it from the near
    /// plane. The background is infinitely far away.
    std::vector<float> depth(const SeenSurface& seen) const;
    /// Returns x, y, z per pixel: the smooth normal of the surface, a unit vector in world axes; 0 for the background.
    std::vector<float> normals(const SeenSurface& seen) const;
    /// Returns three values per pixel of `from`: the motion of its point to the pose `to` in px to the right and px down, and 1
    /// where the point is also visible in `to`, or 0 where it is hidden or outside the picture. The background does not move.
    std::vector<float> flow(const SeenSurface& from, const SeenSurface& to) const;

    /// Returns the position of a world point in the picture: px to the right and px down from the top left corner, and depth in
    /// clip space.
    Vec3 in_picture(const Vec3& world) const;
    /// Returns whether a point is visible: no surface in `seen` is nearer to the camera than the point by more than `above_m`.
    /// `place`: its position from in_picture(). Returns false for a point outside the picture.
    bool is_seen(const SeenSurface& seen, const Vec3& place, double above_m) const;

    int width_px() const { return width_; }
    int height_px() const { return height_; }

  private:
    Vec3 at(const SeenSurface& seen, std::size_t pixel, const Points& positions) const;

    int width_, height_;
    Eigen::Matrix4d clip_from_world_;
    Triangles triangles_;  ///< of the scene, and from first_lock_ on of the locks
    int first_lock_ = 0;
    std::shared_ptr<const Hair> locks_;
    std::vector<Part> part_;  ///< per triangle; kScleraLeft or kScleraRight for the whole eye
    Points rest_;
    std::array<Eye, 2> eyes_;
    std::shared_ptr<const HairArea> hair_;
    std::shared_ptr<const Neckline> neckline_;  ///< null without a garment
};

}  // namespace risorius::render
