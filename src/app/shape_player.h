// Scripts played by blend shapes instead of the simulation: what a script drives becomes weights, shapes and their correctives are
// added up, eyes, head and neck turn as in the simulated face.
//
// A face is built for what the weights follow from (shape_weights.h) and for its eyes and neck; it is not stepped.
#pragma once

#include <filesystem>
#include <string>

#include "app/rig_files.h"
#include "app/shape_goals.h"
#include "app/shape_weights.h"
#include "shapes/linear_rig.h"
#include "shapes/played_rig.h"
#include "sim/face.h"

namespace risorius::app {

/// Of a glTF file that `risorius shapes` has left.
struct ShapesOfFile {
    std::string set;
    std::vector<ShapeGoal> goals;  ///< what drives each shape, by the rig's tables
    shapes::LinearRig rig;         ///< on the vertices of the mesh
};

/// Throws Error when the file is none of `risorius shapes`, or of another mesh, or its shapes are not in the rig's tables.
ShapesOfFile read_shapes_of_file(const std::filesystem::path& file, const RigFiles& files,
                                 const rig::Head& head);

class ShapePlayer {
  public:
    /// Keeps a reference to the face and leaves it at rest.
    ShapePlayer(ShapesOfFile shapes, sim::Face& face, const track::ChannelTable& channels);

    /// Of a drive whose excitation is activation; microseconds.
    sim::FacePose pose(const track::Drive& drive) const;
    const ShapesOfFile& shapes() const { return shapes_; }

  private:
    ShapesOfFile shapes_;
    shapes::PlayedRig played_;
    const sim::Face& face_;
    ShapeWeights weights_;
};

}  // namespace risorius::app
