// Scripts played by blend shapes instead of the simulation: what a script drives becomes weights, shapes and their correctives are
// added up, eyes, head and neck turn as in the simulated face.
//
// A face is built for what the weights follow from (shape_weights.h) and for its eyes and neck; it is not stepped.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/blendshapes/detail/blend_shape_player.h"
#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/blendshapes/detail/shape_weights.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Of a glTF file that `risorius shapes` has left.
struct ShapesOfFile {
    std::string set;
    std::vector<ShapeGoal> goals;    ///< what drives each shape, by the rig's tables
    blendshapes::BlendShapeRig rig;  ///< on the vertices of the mesh
};

/// Throws Error when the file is none of `risorius shapes`, or of another mesh, or its shapes are not in the rig's tables.
ShapesOfFile read_shapes_of_file(const std::filesystem::path& file, const scene::RigFiles& files,
                                 const rig::Head& head);

class ShapePlayer {
  public:
    /// Keeps a reference to the face and leaves it at rest.
    ShapePlayer(ShapesOfFile shapes, face::Face& face, const track::ChannelTable& channels);

    /// Of a drive whose excitation is activation; microseconds.
    face::FacePose pose(const track::Drive& drive) const;
    const ShapesOfFile& shapes() const { return shapes_; }

  private:
    ShapesOfFile shapes_;
    blendshapes::BlendShapePlayer played_;
    const face::Face& face_;
    ShapeWeights weights_;
};

}  // namespace risorius::blendshapes
