// SPDX-License-Identifier: MIT
/// \file
/// Changes the muscle strengths of a face that is already built, and evaluates variants of its rig. Both are used to fit a rig to
/// measurements.
#pragma once

#include <memory>
#include <string>

#include "risorius/core/types.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::face {

class Face;
struct FaceImpl;

/// A view of a Face, from Face::calibration(). The changes take effect from the next step or equilibrium on.
class Calibration {
  public:
    explicit Calibration(FaceImpl& face) : face_(&face) {}

    /// Sets the maximum isometric force of every fibre of a muscle, on both sides, to `factor` times that of the face as it was built.
    void set_strength(const std::string& muscle, double factor);
    /// Returns the factor of the last set_strength() of a muscle, 1 at first.
    double strength(const std::string& muscle) const;
    /// Replaces the numbers of the rig that say how far orbicularis oris turns and pushes the lips.
    void scale_lips(const rig::LipsDescription& lips);

  private:
    FaceImpl* face_;
};

/// A face with another rig, on the same nodes: it gives the gradient of the static energy that this rig would have, and its skin.
class Variant {
  public:
    /// `changed` may have other fibres, also more or fewer of them, and other numbers for the tissue. The list of the muscles, the
    /// landmarks, thickness and jaw must be those of the rig of `face`. Keeps a reference to the face.
    Variant(const Face& face, const rig::RigDescription& changed);
    ~Variant();

    /// Returns the gradient of the static energy, n x 3, N, at `nodes` (n x 3, m, rows of Statics::nodes()), `activation` (per
    /// column, 0..1) and drive. Contact is left out. Rows of fixed nodes are zero.
    Points gradient(const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive);
    /// Returns the vertices of the mesh at the same arguments, V x 3, m: with the skin over the tissue that `changed` has. The first call
    /// prepares that skin.
    Points vertices(const Points& nodes, const Eigen::VectorXd& activation,
                    const track::Drive& drive);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace risorius::face
