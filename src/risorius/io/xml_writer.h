// SPDX-License-Identifier: MIT
/// \file
/// Writes XML of elements without mixed content, one element a line, indented by tabs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace risorius::io {

/// `text` with &, <, > and quotes as XML has them.
std::string xml_text(std::string_view text);

class XmlWriter {
  public:
    /// Begins an element; `attributes` are written behind its name as they are: " version=\"4.0\"".
    void open(const std::string& tag, const std::string& attributes = "");
    void close();  ///< the element that was opened last
    void value(const std::string& tag, std::string_view text);
    void value(const std::string& tag, double number);
    /// A whole line, as it is.
    void line(std::string_view text);
    const std::string& text() const { return out_; }

  private:
    std::string out_;
    std::vector<std::string> tags_;
};

/// " name=\"text\"", the attribute of open()
std::string xml_attribute(const std::string& name, std::string_view text);

}  // namespace risorius::io
