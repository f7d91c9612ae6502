// SPDX-License-Identifier: MIT
/// \file
/// Curves of a mouth as a drive of the muscles of a rig.
///
/// Activation follows excitation with the law of Thelen (muscle/activation.h), whose inverse is
///
///   u = a + a' t_act (0.5 + 1.5 a)     while a rises
///   u = a + a' t_deact / (0.5 + 1.5 a) while a falls
///
/// held in [0, 1]: a muscle cannot let go faster than its activation decays. The tissue follows activation after some
/// milliseconds, so excitations are sent ahead by that time. The jaw is placed, and needs no lead.
#pragma once

#include <memory>

#include "risorius/speech/trajectory.h"
#include "risorius/talk/detail/rig_voice.h"
#include "risorius/track/drive_source.h"

namespace risorius::talk {

/// Time from activation until the tissue has moved half way, s; measured on the adult by switching between two visemes.
inline constexpr double kTissueLead_s = 0.014;

/// How much the activation that is wanted and the one that the muscles can follow differ.
struct InversionReport {
    double rms = 0, max = 0;  ///< of the activation, ratio
    double cut_fraction =
        0;  ///< part of the time of all active muscles in which the excitation is held at a limit
};

/// Makes the drive of an utterance whose first sample is at `start_s` of the script.
std::shared_ptr<const track::DriveSource> drive_of(const speech::ArticulationCurves& curves,
                                                   const RigVoice& voice,
                                                   const rig::RigDescription& rig, double start_s,
                                                   InversionReport* report = nullptr);

}  // namespace risorius::talk
