// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/solid_belly.h"

#include <utility>

#include "risorius/face/anatomy/detail/jaw_muscles.h"
#include "risorius/face/muscle/detail/grid_belly.h"
#include "risorius/face/muscle/detail/mesh_belly.h"

namespace risorius::face {

SolidBelly::SolidBelly(SolidPart place, const SolidPlacement& nodes) : place_(std::move(place)) {
    rest_.resize(static_cast<Eigen::Index>(place_.node.size()), 3);
    for (std::size_t i = 0; i < place_.node.size(); ++i)
        rest_.row(static_cast<Eigen::Index>(i)) =
            nodes.nodes[static_cast<std::size_t>(place_.node[i])].rest.transpose();
}

muscle::ZajacShape SolidBelly::curves(const rig::RigDescription& rig) const {
    muscle::ZajacShape shape;
    shape.passive_strain = place_.muscle->group == "mimetic" ? rig.tissue.fibre_passive_strain
                                                             : kJawVolumePassiveStrain;
    return shape;
}

tissue::AlongFibres::Moduli SolidBelly::along_moduli() const {
    const rig::SolidMuscle& solid = *place_.solid;
    return {solid.shear_along_pa - solid.shear_pa, solid.stretch_along_pa};
}

void add_blocks(const solve::SymmetricBlocks& blocks, const std::vector<int>& row,
                solve::HessianBuilder& hessian) {
    for (int column = 0; column < blocks.nodes(); ++column)
        for (int i = blocks.begin[static_cast<std::size_t>(column)];
             i < blocks.begin[static_cast<std::size_t>(column) + 1]; ++i)
            hessian.add(row[static_cast<std::size_t>(blocks.row[static_cast<std::size_t>(i)])],
                        row[static_cast<std::size_t>(column)],
                        blocks.value[static_cast<std::size_t>(i)]);
}

std::unique_ptr<SolidBelly> make_belly(const SolidPart& place, const SolidPlacement& nodes,
                                       const rig::RigDescription& rig) {
    if (place.is_mesh()) return std::make_unique<MeshBelly>(place, nodes, rig);
    return std::make_unique<GridBelly>(place, nodes, rig);
}

}  // namespace risorius::face
