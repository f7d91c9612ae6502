// What adding up blend shapes gets wrong, found by simulating them together, and the correctives that put it right.
#pragma once

#include <string>
#include <vector>

#include "app/make_shapes.h"
#include "shapes/linear_rig.h"

namespace risorius::app {

struct CorrectiveOptions {
    int pairs = 48;               ///< simulated at most: those that share most skin
    double tolerance_m = 0.7e-3;  ///< a sum that errs by less anywhere is left as it is
    double fade_m = 0.25e-3;      ///< of a corrective: what moves less does not move
    long budget_bytes = 800'000;  ///< of all correctives' numbers, the most useful ones first
};

/// The rule its weight follows, as files state it.
std::string weight_rule(const shapes::Corrective& corrective);

/// A pair, or half a shape, that was simulated.
struct TriedCorrective {
    std::string name;
    double greatest_m = 0, rms_m = 0;  ///< what the sum gets wrong
    bool at_rest = true;               ///< else what the sum gets wrong is not known
    bool kept = false;
};

struct Correctives {
    shapes::LinearRig rig;  ///< the shapes and what was kept
    std::vector<TriedCorrective> tried;
    long bytes = 0;
};

/// Frames that the rig will be played with, on a head that is not turned.
struct PlayedFrames {
    Eigen::MatrixXd weights = {};  ///< frames x shapes
    std::vector<track::Drive> drives = {};
};

/// Without frames: of the shapes that share most skin, by how much each is worth for its size. With frames: also of those that meet
/// in them, and first those that bring simulated frames nearest, one after the other; then others that do them no harm.
Correctives find_correctives(const RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const PlayedFrames& played = {}, const Watch& watch = {});

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

/// Weights drawn at random, a few shapes at a time, of `frames` frames: the same for the same names and seed.
std::vector<Eigen::VectorXd> random_weights(const MadeShapes& shapes, int frames, unsigned seed);

/// What a face with these weights is driven by.
track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels);

/// Each frame's drive in equilibrium against the linear rig at its weights.
TrackError track_error(const std::string& name, const shapes::LinearRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights, const Watch& watch = {});

}  // namespace risorius::app
