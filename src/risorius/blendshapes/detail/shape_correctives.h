// SPDX-License-Identifier: MIT
/// \file
/// Finds the errors of sums of blend shapes by simulating shapes together, and makes correctives for them.
#pragma once

#include <string>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

/// Options of find_correctives().
struct CorrectiveOptions {
    /// Maximum number of simulated pairs: those that move the same skin farthest
    int pairs = 48;
    /// Also simulate pairs with large errors at intermediate weights and on one side of the face
    bool bent_pairs = false;
    /// No corrective where the error of the sum is smaller everywhere
    double tolerance_m = 0.3e-3;
    double fade_m = 0.1e-3;  ///< smaller displacements of a corrective are removed
    /// Limit for all correctives; small displacements are dropped to meet it
    long budget_bytes = 800'000;
    /// Number of frames of a random FACS track that correctives are also fitted to
    int random_frames = 0;
};

/// Default options of a set of shapes. Action units are more numerous than ARKit's shapes, and occur in more combinations.
CorrectiveOptions correctives_of_set(const std::string& set);

/// A simulated pair of shapes, or a shape at weight 1/2.
struct TriedCorrective {
    std::string name;
    double max_m = 0, rms_m = 0;  ///< error of the sum
    bool at_rest = true;  ///< whether the simulation reached equilibrium; else the error is unknown
    bool corrected = false;  ///< whether there are correctives for it
};

struct Correctives {
    blendshapes::BlendShapeRig rig;  ///< the shapes and the resulting correctives
    std::vector<TriedCorrective> tried;
    long bytes = 0;
};

/// Frames with weights as they occur in use, without head rotation.
struct ScriptFrames {
    Eigen::MatrixXd weights = {};           ///< frames x shapes
    std::vector<long> simulated = {};       ///< frames that are simulated
    std::vector<track::Drive> drives = {};  ///< of the simulated frames
};

/// Simulates the pairs that move the same skin farthest, and those that occur together in the frames `played`. Correctives are
/// also fitted to the simulated frames (low_rank.h). Throws Interrupted.
Correctives find_correctives(const scene::RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const ScriptFrames& played = {}, const ProgressMonitor& monitor = {});

/// Errors of a blend shape rig compared with the simulation over the frames of a track.
struct TrackError {
    std::string name;
    int frames = 0;
    double rms_m = 0, max_m = 0;              ///< over all frames
    double plain_rms_m = 0, plain_max_m = 0;  ///< without correctives
    int worst = 0;                            ///< frame and vertex of max_m
    long worst_vertex = 0;
    std::vector<long> of_track = {};  ///< frame numbers within the track; empty: all frames
    long frame_of(int frame) const {
        return of_track.empty() ? frame : of_track[static_cast<std::size_t>(frame)];
    }
    double play_s = 0;  ///< CPU time of the blend shape rig per frame, s
};

/// The drive of a face that corresponds to weights of the shapes.
track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels);

/// For each frame, compares the equilibrium pose of the drive with the blend shape rig at the given weights. Throws Interrupted.
TrackError track_error(const std::string& name, const blendshapes::BlendShapeRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights,
                       const ProgressMonitor& monitor = {});

}  // namespace risorius::blendshapes
