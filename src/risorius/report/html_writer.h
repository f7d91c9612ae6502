// Writes HTML by elements, so that nothing is left open and no text is taken for markup; and the page around it, in the
// look of this toolkit, without scripts or anything from the network.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace risorius::report {

/// For text and for the values of attributes.
std::string html_escaped(const std::string& text);

class HtmlWriter {
  public:
    using Attributes = std::vector<std::pair<std::string, std::string>>;

    HtmlWriter& open(const std::string& tag, const Attributes& attributes = {});
    HtmlWriter& close();  ///< what was opened last
    HtmlWriter& text(const std::string& text);
    /// One without content: img, br.
    HtmlWriter& single(const std::string& tag, const Attributes& attributes = {});
    /// open, text, close
    HtmlWriter& element(const std::string& tag, const std::string& text,
                        const Attributes& attributes = {});

    /// All that was written; everything must be closed.
    const std::string& html() const;

  private:
    void tag(const std::string& name, const Attributes& attributes);

    std::string html_;
    std::vector<std::string> open_;
};

/// A whole document.
std::string html_page(const std::string& title, const HtmlWriter& body);

}  // namespace risorius::report
