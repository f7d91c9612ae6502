// SPDX-License-Identifier: MIT
/// \file
/// The state of a face as fields over its meshes: displacement, stress and contact of the tissue, and the state of its muscles, for
/// programs that draw or evaluate fields.
///
///   F    deformation gradient        J = det F    volume / rest volume        sigma   Cauchy stress, Pa
///   sigma = mu/J F (F^T F - I) F^T + (K (J - 1) + c K min(0, J - J_c)) I      tissue/tet_solid.h has mu, K, J_c and c
///
/// The stress of collagen, if the rig has any, is added (tissue/collagen_tets.h).
///
/// Positions and directions are in the world frame, m, like FacePose: they include the motion of the head.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/muscle_lines.h"

namespace risorius::face {

struct FaceImpl;

/// Symmetric tensors, one per row: xx, yy, zz, xy, yz, xz.
using Tensors = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
/// Hexahedra, C x 8 node indices, in the order of VTK: the lower face round, then the upper one.
using Hexahedra = Eigen::Matrix<int, Eigen::Dynamic, 8, Eigen::RowMajor>;

/// Soft tissue. N nodes, T tetrahedra.
struct TissueFields {
    Points rest, nodes;  ///< N x 3
    Tets tets;           ///< T x 4
    /// N, pressure with which bone, teeth, the other lip or the eyeball press on the node, Pa: the contact force over its area, with the
    /// contacts of the last step or equilibrium. 0 without contact.
    Eigen::VectorXd contact_pa;
    Eigen::VectorXd volume_ratio;  ///< T, J
    Tensors stress_pa;             ///< T x 6, without damping
    std::vector<int> superficial;  ///< T: 1 above the middle layer, 0 below
};

/// State of a segment of a fibre, or of a cell of a volume muscle.
struct FibreState {
    int column = 0;         ///< of the activation vector
    Vec3 direction;         ///< unit vector along the fibre, from origin to insertion
    double activation = 0;  ///< 0..1
    double stretch = 1;     ///< length / optimal length
    double tension_n =
        0;  ///< isometric tension of a fibre: at this length and activation, without the effect of velocity
};

/// Bundles of fibres as segments. P points, S segments.
struct FibreFields {
    Points rest, nodes;                        ///< P x 3
    std::vector<std::array<int, 2>> segments;  ///< S
    std::vector<FibreState> state;             ///< S
};

/// Volume muscles as cells. Q nodes, C cells. Stress is that of the matrix between the fibres.
struct SolidFields {
    Points rest, nodes;  ///< Q x 3
    /// C x 8; a tetrahedron a, b, c, d of a mesh is a, b, c, c, d, d, d, d
    Hexahedra cells;
    Eigen::VectorXd volume_ratio;   ///< C
    Tensors stress_pa;              ///< C x 6, at the centre of the cell
    std::vector<FibreState> state;  ///< C: mean over the four fibres at the edges of the cell
};

struct FaceFields {
    TissueFields tissue;
    FibreFields fibres;
    SolidFields solids;
};

/// Returns the von Mises stress of a tensor, one row of Tensors: sqrt(3/2) times the norm of its deviator.
double von_mises(const Eigen::Matrix<double, 1, 6>& stress);

/// A view of a Face, from Face::fields().
class Fields {
  public:
    explicit Fields(FaceImpl& face) : face_(&face) {}

    /// Returns the fields at the time t_s, s. Call it after Face::pose_at() with the same t_s.
    FaceFields at(double t_s) const;
    /// Returns the fields after the last step or equilibrium.
    FaceFields now() const;
    /// Returns the muscles at rest as lines of action, in the order of their columns.
    std::vector<MuscleLine> muscle_lines() const { return lines_of(*face_); }
    JawHinge jaw_hinge() const { return jaw_hinge_of(*face_); }

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
