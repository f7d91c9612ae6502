// SPDX-License-Identifier: MIT
/// \file
/// Finds the errors of sums of blend shapes by simulating shapes together, and makes correctives for them.
#pragma once

#include <string>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

struct CorrectiveOptions {
    int pairs =
        48;  ///< largest number of pairs that are simulated: those that move the same skin farthest
    bool bent_pairs =
        false;  ///< pairs with large errors are also simulated half way and on one side of the face
    double tolerance_m = 0.3e-3;  ///< sums with a smaller error everywhere get no corrective
    double fade_m = 0.1e-3;       ///< smaller displacements of a corrective are removed
    long budget_bytes =
        800'000;  ///< size of all correctives; they leave out small displacements to fit
    int random_frames =
        0;  ///< number of frames of a random FACS track that correctives are fitted to
};

/// The options for a set of shapes. Action units are more numerous, and are combined in more ways, than ARKit's shapes.
CorrectiveOptions correctives_of_set(const std::string& set);

/// A pair of shapes, or a half shape, that was simulated.
struct TriedCorrective {
    std::string name;
    double max_m = 0, rms_m = 0;  ///< error of the sum
    bool at_rest = true;     ///< the simulation reached equilibrium; else the error is not known
    bool put_right = false;  ///< there are correctives for it
};

struct Correctives {
    blendshapes::BlendShapeRig rig;  ///< the shapes and what was kept
    std::vector<TriedCorrective> tried;
    long bytes = 0;
};

/// Frames with weights as they occur in use, with the head not turned.
struct ScriptFrames {
    Eigen::MatrixXd weights = {};           ///< frames x shapes
    std::vector<long> simulated = {};       ///< frames that are simulated
    std::vector<track::Drive> drives = {};  ///< of those
};

/// Simulates the pairs that move the same skin farthest, and those that occur together in the frames. Correctives are fitted to the simulated
/// frames too (low_rank.h).
Correctives find_correctives(const scene::RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const ScriptFrames& played = {}, const ProgressMonitor& monitor = {});

/// Errors of a blend shape rig against the simulation over the frames of a track.
struct TrackError {
    std::string name;
    int frames = 0;
    double rms_m = 0, max_m = 0;                   ///< of all frames
    double plain_rms_m = 0, plain_greatest_m = 0;  ///< without correctives
    int worst = 0;                                 ///< frame and vertex of max_m
    long worst_vertex = 0;
    std::vector<long> of_track = {};  ///< which frames of the track they are; empty: all
    long frame_of(int frame) const {
        return of_track.empty() ? frame : of_track[static_cast<std::size_t>(frame)];
    }
    double play_s = 0;  ///< processor time of the blend shape rig per frame, s
};

/// The drive of a face for these weights.
track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels);

/// Compares, for each frame, the pose in equilibrium with its drive and the blend shape rig at its weights.
TrackError track_error(const std::string& name, const blendshapes::BlendShapeRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights,
                       const ProgressMonitor& monitor = {});

}  // namespace risorius::blendshapes
