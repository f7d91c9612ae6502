// SPDX-License-Identifier: MIT
/// \file
/// Gestures and blinks of speech as parts of a script.
#pragma once

#include <memory>
#include <vector>

#include "risorius/rig/rig_description.h"
#include "risorius/speech/prosody.h"
#include "risorius/track/drive_source.h"
#include "risorius/track/script.h"

namespace risorius::talk {

/// Brows by AU1 and AU2 of the rig's table, the head by its channel. Null when there is nothing to move.
std::shared_ptr<const track::DriveSource> gesture_drive(const speech::Prosody& prosody,
                                                        const rig::RigDescription& rig,
                                                        double start_s);

/// The blinks, as events of a script; none for a rig without AU45.
std::vector<track::BlinkEvent> blinks_of(const speech::Prosody& prosody,
                                         const rig::RigDescription& rig, double start_s);

}  // namespace risorius::talk
