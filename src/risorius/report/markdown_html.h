// SPDX-License-Identifier: MIT
/// \file
/// Converts the subset of Markdown that the README files of this project use to HTML: headings, paragraphs, lists, tables, code,
/// **strong**, *emphasis*, `code` and [links](https://...). Everything else is written as text.
#pragma once

#include <string>

#include "risorius/report/html_writer.h"

namespace risorius::report {

/// Converts a text. Headings of level 1 get the level `first_heading` (1..6), and lower ones are shifted likewise. Links to files
/// become plain text, because the files are not next to the page.
void write_markdown(HtmlWriter& html, const std::string& markdown, int first_heading);

}  // namespace risorius::report
