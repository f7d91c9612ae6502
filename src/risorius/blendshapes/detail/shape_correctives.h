// What adding up blend shapes gets wrong, found by simulating them together, and the correctives that put it right.
#pragma once

#include <string>
#include <vector>

#include "risorius/blendshapes/detail/blend_shape_rig.h"
#include "risorius/blendshapes/detail/make_shapes.h"

namespace risorius::blendshapes {

struct CorrectiveOptions {
    int pairs = 48;               ///< simulated at most: those that move the same skin farthest
    bool bent_pairs = false;      ///< those that err much also half way and on one side of the face
    double tolerance_m = 0.3e-3;  ///< a sum that errs by less everywhere is left as it is
    double fade_m = 0.1e-3;       ///< of a corrective: what moves less does not move
    long budget_bytes =
        800'000;  ///< of all correctives, which leave out the finer the less room there is
    int random_frames = 0;  ///< of a random FACS track, fitted to
};

/// Of a set: action units are more, and meet in more ways, than the shapes of a game's face.
CorrectiveOptions correctives_of_set(const std::string& set);

/// A pair, or half a shape, that was simulated.
struct TriedCorrective {
    std::string name;
    double greatest_m = 0, rms_m = 0;  ///< what the sum gets wrong
    bool at_rest = true;               ///< else what the sum gets wrong is not known
    bool put_right = false;            ///< by correctives
};

struct Correctives {
    blendshapes::BlendShapeRig rig;  ///< the shapes and what was kept
    std::vector<TriedCorrective> tried;
    long bytes = 0;
};

/// Frames that are like those that the rig will be played with, on a head that is not turned.
struct ScriptFrames {
    Eigen::MatrixXd weights = {};           ///< frames x shapes
    std::vector<long> simulated = {};       ///< frames that are simulated
    std::vector<track::Drive> drives = {};  ///< of those
};

/// Pairs are those that move the same skin farthest, and those that meet in the frames; of those frames that are simulated correctives take
/// what can be taken off (blendshapes/detail/low_rank.h).
Correctives find_correctives(const scene::RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const ScriptFrames& played = {}, const ProgressMonitor& monitor = {});

/// Errors of a linear rig against the simulation over the frames of a track.
struct TrackError {
    std::string name;
    int frames = 0;
    double rms_m = 0, greatest_m = 0;              ///< of all frames
    double plain_rms_m = 0, plain_greatest_m = 0;  ///< without correctives
    int worst = 0;                                 ///< frame, and vertex, of greatest_m
    long worst_vertex = 0;
    std::vector<long> of_track = {};  ///< which frames of the track they are; empty: all
    long frame_of(int frame) const {
        return of_track.empty() ? frame : of_track[static_cast<std::size_t>(frame)];
    }
    double play_s = 0;  ///< time on the core that the linear rig takes for a frame
};

/// What a face with these weights is driven by.
track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels);

/// Each frame's drive in equilibrium against the linear rig at its weights.
TrackError track_error(const std::string& name, const blendshapes::BlendShapeRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights,
                       const ProgressMonitor& monitor = {});

}  // namespace risorius::blendshapes
