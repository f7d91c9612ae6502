// SPDX-License-Identifier: MIT
/// \file
/// Converts the part of Markdown that the README files of this project use to HTML: headings, paragraphs, lists, tables, code,
/// **strong**, *emphasis*, `code` and [links](https://...). Anything else stays text.
#pragma once

#include <string>

#include "risorius/report/html_writer.h"

namespace risorius::report {

/// Headings of level 1 become level `first_heading` (1..6), others follow. Links to files become their text, as the files are not
/// beside the page.
void write_markdown(HtmlWriter& html, const std::string& markdown, int first_heading);

}  // namespace risorius::report
