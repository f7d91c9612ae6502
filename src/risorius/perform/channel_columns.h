// SPDX-License-Identifier: MIT
/// \file
/// How a rig looks to the face network: what each channel does to the points that it sees. A face in a picture is then explained
/// as a sum of channels (detail/curve_fit.h), in which the habits of the network cancel. Lids are told by how far the eyes are open.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/perform/detail/face_shape.h"
#include "risorius/scene/rig_files.h"

namespace risorius::perform {

/// A channel that a camera may see, and how well this rig shows it.
struct CameraChannel {
    std::string name;  ///< "AU12.l"
    /// On pictures of the rig with its head turned a little: the error where this channel is at 0.75, and the root mean square of
    /// what is found where another one is
    double error = 0, false_rms = 0;
    /// Both are below the limits, on both sides of a face, and it is not one of those that mixed poses confuse: AU1 looks like AU2,
    /// and AU15, AU18 and AU20 like smiles and jaws. These only explain what is seen.
    bool reliable = false;
};
inline constexpr double kReliable = 0.3, kReliableElsewhere = 0.2;

struct Columns {
    std::vector<Vec3> rest;  ///< the points of the rig at rest
    std::vector<CameraChannel> channels;
    /// x and y of the moving points x 2 channels: at one half, and at one. The last channels are turns of the head, which the
    /// network takes for a change of the shape in part.
    Eigen::MatrixXd moved;
    double closed = 1;  ///< of a closed eye: ShapeChange::left_open
};

/// Draws the face of a rig. A channel that is not named is 0.
class RigPictures {
  public:
    /// Builds a face and a view, which takes a second or two.
    explicit RigPictures(std::shared_ptr<const scene::RigFiles> rig);
    ~RigPictures();
    RigPictures(const RigPictures&) = delete;
    RigPictures& operator=(const RigPictures&) = delete;

    /// The face in equilibrium, from the front. `values`: pairs of channel and value.
    Image draw(const std::vector<std::pair<std::string, double>>& values);
    const scene::RigFiles& rig() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Shows each channel to the network, and measures how well it is found again. Throws Error when no face is seen.
Columns channel_columns(RigPictures& pictures, const landmarks::FaceNetwork& network,
                        const ProgressMonitor& monitor = {});

/// The values of the channels of a face, in their order. Lids are told by how far the eyes are open.
std::vector<double> fitted_channels(const Columns& columns, const ShapeChange& change);

}  // namespace risorius::perform
