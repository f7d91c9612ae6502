// The part of Markdown that the README files here are written in, as HTML: headings, paragraphs, lists, tables, code,
// **strong**, *emphasis*, `code` and [links](https://...). What it does not know stays text.
#pragma once

#include <string>

#include "risorius/report/html_writer.h"

namespace risorius::report {

/// Headings become `first_heading` (1..6) and below. Links to other places than web pages become their text, as the file's
/// neighbours are not beside the page.
void write_markdown(HtmlWriter& html, const std::string& markdown, int first_heading);

}  // namespace risorius::report
