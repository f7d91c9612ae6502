// SPDX-License-Identifier: MIT
/// \file
/// Loudness of a recording after EBU R 128 and ITU-R BS.1770-4, by libebur128.
///
///   LUFS   integrated loudness: K-weighted power of blocks of 0.4 s; blocks below -70 LUFS do not count, and then blocks
///          10 LU below the mean of the others do not count
///   dBTP   true peak: the maximum, also between the samples, by fourfold oversampling
#pragma once

#include "risorius/media/detail/sound.h"

namespace risorius::media {

/// The loudness of a whole recording.
struct Loudness {
    double integrated_lufs = 0;  ///< minus infinity for silence and for less than 0.4 s
    double true_peak_dbtp = 0;   ///< minus infinity for silence
};

/// Throws RunError for a number of channels or a rate that the standard does not cover.
Loudness loudness_of(const Sound& sound);

/// Does the same for the part of a recording that part_of() returns, without holding it in memory.
Loudness loudness_of(const Recording& recording, std::int64_t offset, std::int64_t length);

}  // namespace risorius::media
