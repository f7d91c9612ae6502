// SPDX-License-Identifier: MIT
/// \file
/// A drive as bars on a page: each muscle and channel in use has one value, or two values to compare.
#pragma once

#include <string>

#include "risorius/report/html_writer.h"
#include "risorius/track/channels.h"

namespace risorius::report {

/// Text for the style element of the page. The classes "by-table" and "by-fit" give the colours of first and second values.
std::string drive_bars_style();

/// Writes the bars. `second` may be null. A muscle with equal values on both sides has one bar.
void write_drive_bars(HtmlWriter& html, const track::Drive& first, const track::Drive* second,
                      const track::ChannelTable& channels);

}  // namespace risorius::report
