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
    /// Maximum number of pairs to simulate; the pairs that move the same skin farthest are chosen
    int pairs = 48;
    /// True: pairs with large errors are also simulated at intermediate weights and on one side of the face
    bool bent_pairs = false;
    /// No corrective is made for a pose in which the error of the sum is smaller than this at every vertex
    double tolerance_m = 0.3e-3;
    double fade_m = 0.1e-3;  ///< smaller displacements of a corrective are removed
    /// Limit of the bytes of all correctives in a file; small displacements are dropped to meet it
    long budget_bytes = 700'000;
    /// Maximum number of low-rank correctives. three.js keeps every morph target of a part dense: with 18 of them and the 52 shapes of
    /// ARKit a head takes 25 MB, and more hardly help.
    int most = 18;
    /// True: each corrective follows one driver and has its name (one_of_each()); false: sums of drivers (low_rank()), which are ten
    /// times as accurate at the same size
    bool named = false;
    /// Number of frames of random_facs_track() to which correctives are also fitted
    int random_frames = 0;
};

/// Returns the default options for a set of shapes. They differ between sets, because there are more action units than shapes of
/// ARKit, and they occur in more combinations.
CorrectiveOptions correctives_of_set(const std::string& set);

/// A simulated pose for which a corrective was considered: a pair of shapes, or one shape at weight 1/2.
struct TriedCorrective {
    std::string name;
    double max_m = 0, rms_m = 0;  ///< error of the sum of the shapes
    /// Whether the simulation reached equilibrium; if not, the error is unknown
    bool at_rest = true;
    bool corrected = false;  ///< whether correctives were made for it
};

struct Correctives {
    blendshapes::BlendShapeRig rig;  ///< the shapes and the resulting correctives
    std::vector<TriedCorrective> tried;
    long bytes = 0;
};

/// Frames of a script: weights as they occur in use. The rotation of the head is left out.
struct ScriptFrames {
    Eigen::MatrixXd weights = {};           ///< frames x shapes
    std::vector<long> simulated = {};       ///< numbers of the frames that are simulated
    std::vector<track::Drive> drives = {};  ///< one per simulated frame
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
    double plain_rms_m = 0, plain_max_m = 0;  ///< the same without correctives
    /// Index of the frame of max_m; worst_vertex is its vertex
    int worst = 0;
    long worst_vertex = 0;
    std::vector<long> of_track = {};  ///< frame numbers within the track; empty: all frames
    long frame_of(int frame) const {
        return of_track.empty() ? frame : of_track[static_cast<std::size_t>(frame)];
    }
    double play_s = 0;  ///< CPU time of the blend shape rig per frame, s
};

/// Returns the drive of a face that corresponds to weights of the shapes.
track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels);

/// Compares the equilibrium of the face under the drive with the blend shape rig at the given weights, frame by frame. Throws
/// Interrupted when the monitor asks to stop.
TrackError track_error(const std::string& name, const blendshapes::BlendShapeRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights,
                       const ProgressMonitor& monitor = {});

}  // namespace risorius::blendshapes
