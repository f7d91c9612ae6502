// SPDX-License-Identifier: MIT
/// \file
/// Writes HTML element by element, so that every element is closed and text is escaped. html_page() adds the frame of a page,
/// with the style of this toolkit and without scripts or network resources.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace risorius::report {

/// Escapes text and values of attributes.
std::string html_escaped(const std::string& text);

class HtmlWriter {
  public:
    using Attributes = std::vector<std::pair<std::string, std::string>>;

    HtmlWriter& open(const std::string& tag, const Attributes& attributes = {});
    HtmlWriter& close();  ///< closes the element that was opened last
    HtmlWriter& text(const std::string& text);
    /// Writes an element without content, such as img or br.
    HtmlWriter& single(const std::string& tag, const Attributes& attributes = {});
    /// open(), text() and close() in one.
    HtmlWriter& element(const std::string& tag, const std::string& text,
                        const Attributes& attributes = {});

    /// Returns everything that was written. All elements must be closed.
    const std::string& html() const;

  private:
    void tag(const std::string& name, const Attributes& attributes);

    std::string html_;
    std::vector<std::string> open_;
};

/// Returns a complete HTML document.
std::string html_page(const std::string& title, const HtmlWriter& body);

}  // namespace risorius::report
