// How loud a recording is: EBU R 128 by libebur128, which ITU-R BS.1770-4 defines.
//
//   LUFS   integrated loudness: K-weighted power of blocks of 0.4 s, without those below -70 LUFS and then without those
//          10 LU below the mean of the rest
//   dBTP   true peak: the highest value between the samples too, four times oversampled
#pragma once

#include "risorius/media/detail/sound.h"

namespace risorius::media {

struct Loudness {
    double integrated_lufs = 0;  ///< minus infinity for silence and for less than 0.4 s
    double true_peak_dbtp = 0;   ///< minus infinity for silence
};

/// Throws RunError for more channels or another rate than the standard knows.
Loudness loudness_of(const Sound& sound);

/// What is heard of a recording in so long a video whose first frame is `offset` samples before its first: with silence where
/// there is none of it. `length` in samples of its own rate.
Sound heard(const Sound& sound, std::int64_t offset, std::int64_t length);

/// Louder by so many decibels, or softer.
Sound amplified(Sound sound, double gain_db);

}  // namespace risorius::media
