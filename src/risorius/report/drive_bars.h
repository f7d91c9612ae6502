// What drives a face, as bars on a page: every muscle and channel in use, one value or two beside each other.
#pragma once

#include <string>

#include "risorius/report/html_writer.h"
#include "risorius/track/channels.h"

namespace risorius::report {

/// For the page's style element; the classes "by-table" and "by-fit" are the colours of first and second values.
std::string drive_bars_style();

/// `second` may be null. A muscle that does on the right what it does on the left gets one bar.
void write_drive_bars(HtmlWriter& html, const track::Drive& first, const track::Drive* second,
                      const track::ChannelTable& channels);

}  // namespace risorius::report
