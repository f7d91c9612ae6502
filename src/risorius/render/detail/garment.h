// SPDX-License-Identifier: MIT
/// \file
/// A plain shirt: a copy of the skin below a neckline, some millimetres off it, with a collar. It is planned for any head whose
/// mesh has shoulders, and moves with the skin.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "risorius/render/scene.h"

namespace risorius::render {

/// The height of the border of the cloth around the neck. It follows the place where neck turns into shoulder.
class Neckline {
  public:
    /// Returns nothing for a head without the landmark gn, or without shoulders. `garment`: a name of garment_names().
    static std::optional<Neckline> of(const Scene& scene, const std::string& garment);

    /// How far a point of the skin at rest lies below the border, m; negative above it.
    double below_m(const Vec3& rest) const;

  private:
    static constexpr int kColumns = 48;
    double axis_z_ = 0;  ///< m; the axis of the neck is upright at x = 0
    std::array<double, kColumns> height_m_{};
};

struct GarmentVertex {
    std::array<int, 2> between{};  ///< vertices of the skin
    double share = 0;              ///< of the second
    double off_m = 0;              ///< from the skin
    double below_m = 0;            ///< from the border of the cloth
    double around = 0;             ///< rad about the upright axis of the head, 0 in front
};

struct Garment {
    std::vector<GarmentVertex> vertices;
    std::vector<unsigned> triangles;    ///< three vertices each
    std::vector<std::uint8_t> covered;  ///< per vertex of the scene: 1 for skin that is never seen
    bool empty() const { return triangles.empty(); }
};

/// Returns the garment that the appearance asks for; an empty one for "none" and where there is no neckline.
Garment plan_garment(const Scene& scene);

struct PosedGarment {
    Points positions, normals;
};
PosedGarment pose_garment(const Garment& garment, const Points& positions);

}  // namespace risorius::render
