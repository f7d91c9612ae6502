// SPDX-License-Identifier: MIT
/// \file
/// Changes the strengths of a face that is already built, and evaluates variants of its rig. For the fit of a rig to measurements.
#pragma once

#include <memory>
#include <string>

#include "risorius/core/types.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::face {

class Face;
struct FaceImpl;

/// A view of a Face, from Face::calibration(). The changes hold from the next step or equilibrium on.
class Calibration {
  public:
    explicit Calibration(FaceImpl& face) : face_(&face) {}

    /// Multiplies the maximum force of every fibre of a muscle, both sides.
    void scale_muscle(const std::string& muscle, double factor);
    /// Replaces the numbers of the rig that drive the lips.
    void scale_lips(const rig::LipsDescription& lips);

  private:
    FaceImpl* face_;
};

/// The tissue of a face with other numbers of anatomy or material, on the same nodes. The two rigs may differ in the fibres and
/// in the tissue. Landmarks, thickness and jaw must be equal.
class Variant {
  public:
    /// Keeps a reference to the face.
    Variant(const Face& face, const rig::RigDescription& changed);
    ~Variant();

    /// Returns dE/dx without contact at given nodes, n x 3, N. Rows of fixed nodes are zero.
    Points gradient(const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace risorius::face
