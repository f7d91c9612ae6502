// SPDX-License-Identifier: MIT
/// \file
/// Converts raw surface electromyograms to their linear envelope: band-pass, rectification and low-pass, all without delay.
///
/// The default band is that of surface electrodes, 20 to 450 Hz (C. J. De Luca et al. 2010, J. Biomech. 43(8), 1573-1579). The
/// default low-pass is 6 Hz, as usual for envelopes that drive muscle models (T. S. Buchanan et al. 2004, J. Appl. Biomech.
/// 20(4), 367-395: 3 to 10 Hz). For facial muscles, a lower edge of 15 to 25 Hz is better (A. van Boxtel 2001, Psychophysiology
/// 38(1), 22-34).
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace risorius::signal {

/// Settings of the filters. Field names are keys of "emg" in a script.
struct EmgFilters {
    std::optional<std::array<double, 2>> band_pass_hz = {{20, 450}};  ///< none: no band-pass
    std::vector<double> notch_hz;  ///< mains frequency and its harmonics; each notch is 4 Hz wide
    std::optional<double> low_pass_hz = 6;
    int order = 2;  ///< order of the filters in each of the two passes, forwards and backwards
    bool rectify = true;
};

/// Returns the number of samples by which filter_both_ways() extends the ends: two periods of the filter of lowest frequency. A
/// recording must be longer than that.
std::size_t padding_of(const EmgFilters& filters, double rate_hz);

/// Returns the envelope in the unit of the samples; it is never negative. Every frequency must be below rate_hz / 2.
std::vector<double> emg_envelope(std::vector<double> samples, double rate_hz,
                                 const EmgFilters& filters);

/// Returns the value below which `percent` per cent of the samples lie, interpolated linearly between neighbouring samples. 100
/// gives the maximum.
double percentile(std::vector<double> samples, double percent);

}  // namespace risorius::signal
