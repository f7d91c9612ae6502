// SPDX-License-Identifier: MIT
/// \file
/// Dynamic time warping: which frame of one sound is which frame of another that says the same.
///
///   d(i, j)   distance of the features of frame i of the model and frame j of the recording
///   D(i, j)   least cost with i at j: min of D(i-1, j-1) + 2 d, D(i, j-1) + d + e, D(i-1, j) + d + e
///
/// e is a price for going off the diagonal. A recording may wait before some frames of the model, where it is silent.
/// Source: H. Sakoe & S. Chiba 1978, IEEE Trans. Acoust. Speech Signal Process. 26(1), 43-49.
#pragma once

#include <vector>

#include "risorius/speech/detail/align/mel_cepstra.h"

namespace risorius::speech {

struct WarpInput {
    const Features* model;
    const Features* recording;
    /// Whether the recording may wait before a frame of the model; one more than there are frames.
    std::vector<bool> may_wait;
    std::vector<bool> silent;  ///< whether a frame of the recording may be waited in
};

struct WarpPath {
    /// First and last frame of the recording at each frame of the model.
    std::vector<long> first, last;
    /// How many frames the recording waits before a frame of the model; one more than there are frames.
    std::vector<long> waits;
    std::vector<float> distance;  ///< mean d of each frame of the model
    double cost =
        0;  ///< of the path, per frame of the model and of the recording that is not waited in
};

/// The path lies within a corridor around the places that have the same share of the speech. Deterministic.
WarpPath warp(const WarpInput& input);

}  // namespace risorius::speech
