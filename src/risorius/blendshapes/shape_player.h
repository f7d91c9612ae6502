// SPDX-License-Identifier: MIT
/// \file
/// Plays scripts with blend shapes instead of the simulation. The drive is converted to weights, and the displacements of shapes
/// and correctives are added to the mesh at rest. Eyes, head and neck move as in the simulated face.
///
/// A face::Face is built, because the conversion to weights (shape_weights.h) and the motion of eyes and neck need it. It is not
/// simulated.
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

/// The content of a glTF file that `risorius shapes` has written.
struct ShapesOfFile {
    std::string set;
    std::vector<ShapeGoal> goals;    ///< the drive of each shape comes from the tables of the rig
    blendshapes::BlendShapeRig rig;  ///< on the vertices of the mesh
};

/// Reads such a file. Throws Error when the file is not one that `risorius shapes` has written, when it belongs to another mesh,
/// or when it has shapes that the tables of the rig do not have.
ShapesOfFile read_shapes_of_file(const std::filesystem::path& file, const scene::RigFiles& files,
                                 const rig::Head& head);

class ShapePlayer {
  public:
    /// Keeps a reference to the face and leaves it at rest.
    ShapePlayer(ShapesOfFile shapes, face::Face& face, const track::ChannelTable& channels);

    /// The pose for a drive; its excitation is used as activation. Takes microseconds.
    face::FacePose pose(const track::Drive& drive) const;
    const ShapesOfFile& shapes() const { return shapes_; }

  private:
    ShapesOfFile shapes_;
    PackedShapes packed_;
    const face::Face& face_;
    ShapeWeights weights_;
};

}  // namespace risorius::blendshapes
