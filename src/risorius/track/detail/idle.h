// SPDX-License-Identifier: MIT
/// \file
/// Spontaneous movement of a face: blinks, small saccades, sway of the head and breathing. The movement is determined by a
/// seed.
///
/// Blinks have lognormal intervals with an SD of 0.6 of the mean, and are at least 0.3 s apart. Between saccades the gaze is
/// still. A saccade takes 22 ms + 2.3 ms per degree and follows a minimum-jerk curve. Its size is exponentially distributed.
/// Its direction has the distribution found in conversation, where horizontal and vertical directions are more frequent than
/// oblique ones. Both eyes turn alike. The sway of the head is a sum of sines between 0.05 and 1.5 Hz whose power falls as
/// f^-1.5. Sway and breathing fade in and out over one second.
///
/// Sources: Doughty 2002 and Bentivoglio et al. 1997 (rates and intervals of blinks); Bahill, Clark & Stark 1975 (main
/// sequence); Lee, Badler & Badler 2002, ACM Trans. Graph. 21(3) (sizes and directions of saccades). Sizes of the sway are
/// estimates.
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/channels.h"

namespace risorius::track {

/// The kinds and amounts of spontaneous movement. Field names are the keys of "idle" in a script. A rate or size of 0 switches
/// the movement off.
struct IdleOptions {
    double blinks_per_minute = 17;  ///< [0, 60]
    double partial_blinks = 0;      ///< fraction of blinks that do not close the lids, [0, 1]
    double saccade_deg = 2;         ///< mean eccentricity of the gaze, [0, 25]
    /// Mean duration of a fixation; each lasts 0.5 to 1.5 times as long, [0.1, 20]
    double fixation_s = 0.4;
    /// Factor of the SD of the head's sway; at 1, the SD is 0.8, 0.6, 0.4 deg (yaw, pitch, roll) and 1.5 mm, [0, 5]
    double sway = 1;
    double breaths_per_minute = 14;  ///< [0, 60]
};

struct IdleEvent {
    double start_s = 0, end_s = 0;
    IdleOptions options;
    int seed = 1;    ///< of the script
    int number = 0;  ///< index of the event among idle events, so that two events differ
};

IdleOptions read_idle_options(const JsonCursor& json);

struct IdleBlink {
    double start_s;
    double intensity;
};
/// Returns the blinks within the event.
std::vector<IdleBlink> idle_blinks(const IdleEvent& event);

struct IdleSaccade {
    double start_s, duration_s;
    Vec2 from_deg, to_deg;  ///< yaw, pitch
};

class IdleMotion {
  public:
    explicit IdleMotion(const IdleEvent& event);

    /// Returns gaze and head motion at t; zero outside the event.
    KinematicValues at(double t_s) const;
    const std::vector<IdleSaccade>& saccades() const { return saccades_; }

  private:
    struct Sine {
        double hz, amplitude, phase;
    };
    Vec2 gaze(double t_s) const;

    IdleEvent event_;
    std::vector<IdleSaccade> saccades_;
    std::vector<std::vector<Sine>> sway_;  // yaw, pitch, roll, side, up, forward
};

}  // namespace risorius::track
