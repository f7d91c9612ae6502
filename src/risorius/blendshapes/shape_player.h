// SPDX-License-Identifier: MIT
/// \file
/// Plays scripts with blend shapes instead of the simulation: the drive becomes weights, shapes and correctives are added, and eyes, head and
/// neck move as in the simulated face.
///
/// A face is built for the conversion to weights (shape_weights.h) and for eyes and neck; it is not stepped.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/packed_shapes.h"
#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/blendshapes/detail/shape_weights.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Data of a glTF file that `risorius shapes` wrote.
struct ShapesOfFile {
    std::string set;
    std::vector<ShapeGoal> goals;    ///< drive of each shape, from the rig's tables
    blendshapes::BlendShapeRig rig;  ///< on the vertices of the mesh
};

/// Throws Error when the file was not written by `risorius shapes`, is of another mesh, or has shapes that the rig's tables do not know.
ShapesOfFile read_shapes_of_file(const std::filesystem::path& file, const scene::RigFiles& files,
                                 const rig::Head& head);

class ShapePlayer {
  public:
    /// Keeps a reference to the face and leaves it at rest.
    ShapePlayer(ShapesOfFile shapes, face::Face& face, const track::ChannelTable& channels);

    /// For a drive whose excitation is taken as activation; takes microseconds.
    face::FacePose pose(const track::Drive& drive) const;
    const ShapesOfFile& shapes() const { return shapes_; }

  private:
    ShapesOfFile shapes_;
    PackedShapes packed_;
    const face::Face& face_;
    ShapeWeights weights_;
};

}  // namespace risorius::blendshapes
