// SPDX-License-Identifier: MIT
/// \file
/// What a person wears over the skin: the hair of a style and a garment.
#pragma once

#include "risorius/render/detail/garment_layer.h"
#include "risorius/render/detail/lock_layer.h"
#include "risorius/render/detail/skin_layer.h"

namespace risorius::render {

class WornLayer {
  public:
    /// Plans what the appearance asks for. `bare`: nothing is worn. `constants`: those of Lights. `layer`: it is drawn into a skin
    /// layer (skin_layer.h) and looked up there. The context must be current.
    WornLayer(const Scene& scene, bool bare, const Vec3& paint_centre, const Camera& camera,
              const ShaderConstants& constants, bool layer);

    /// Per vertex of the scene: 1 for skin that is never seen; empty where all may be.
    std::vector<std::uint8_t> covered() const;
    void upload(const Pose& pose);
    /// The functions of the layers of the same names, for both.
    void draw() const;
    void touch(const Eigen::Matrix4f& clip_from_world, PictureCells& cells);
    /// Hair is looked up before the skin, which is then not looked up where it is hidden; the program of the layer has to be used anew
    /// then. The garment is looked up by the program that is in use.
    void look_up_hair(const PictureCells& cells, const SkinLayer& layer);
    void look_up_garment(const PictureCells& cells);
    const LockLayer& locks() const { return locks_; }  ///< what throws shadow

  private:
    LockLayer locks_;
    GarmentLayer garment_;
};

}  // namespace risorius::render
