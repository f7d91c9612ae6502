// SPDX-License-Identifier: MIT
/// \file
/// Moves borders between phones to where the sound changes: into a pause or a closure it gets softer, out of them louder; at a
/// fricative the high frequencies come or go; at others the spectrum changes most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "risorius/speech/detail/align/mel_cepstra.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

/// Moves the borders by at most kBorderReach_s. Phones stay in order and keep at least 10 ms, or what they have.
void move_borders(std::vector<Phone>& phones, const PhoneTable& table, std::span<const float> sound,
                  int rate_hz);

inline constexpr double kBorderReach_s = 0.03;

}  // namespace risorius::speech
