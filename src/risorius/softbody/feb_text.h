// SPDX-License-Identifier: MIT
/// \file
/// A soft body from a mesh as a model of FEBio: nodes, tetrahedra, materials with the same laws, fixed nodes and weight.
///
///   law here        material of FEBio                 constants
///   neo-Hookean     Mooney-Rivlin                     c1 = c10, c2 = 0, k = B
///   Mooney-Rivlin   Mooney-Rivlin                     c1 = c10, c2 = c01, k = B
///   Ogden           Ogden, six terms at most          ci = m_p a_p, mi = a_p, k = B; W = sum ci / mi^2 (..)
///   fibres          trans iso Mooney-Rivlin           c1, c2, c3, c4, c5, lam_max = l*, k = B, fiber
///
/// The pressure is K (J - 1) in all of them (pressure_model 2, "Abaqus"). Sources: FEBio User's Manual 4, chapters 3 and 4; S. A. Maas et al.
/// 2012, J. Biomech. Eng. 134(1), 011005.
#pragma once

#include <string>

#include "risorius/softbody/mesh_body.h"

namespace risorius::softbody {

/// Reads the mesh and returns the model, format 4.0. Throws the errors of build_mesh_body(), and Error for an Ogden material with more terms
/// than FEBio has.
std::string feb_text(const MeshBodyDescription& description);

}  // namespace risorius::softbody
