// SPDX-License-Identifier: MIT
#include "risorius/io/xml_writer.h"

#include "risorius/core/json_cursor.h"

namespace risorius::io {

std::string xml_text(std::string_view text) {
    std::string out;
    for (const char c : text)
        out += c == '&'   ? "&amp;"
               : c == '<' ? "&lt;"
               : c == '>' ? "&gt;"
               : c == '"' ? "&quot;"
                          : std::string(1, c);
    return out;
}

std::string xml_attribute(const std::string& name, std::string_view text) {
    return " " + name + "=\"" + xml_text(text) + "\"";
}

void XmlWriter::open(const std::string& tag, const std::string& attributes) {
    line("<" + tag + attributes + ">");
    tags_.push_back(tag);
}

void XmlWriter::close() {
    const std::string tag = tags_.back();
    tags_.pop_back();
    line("</" + tag + ">");
}

void XmlWriter::value(const std::string& tag, std::string_view text) {
    line("<" + tag + ">" + xml_text(text) + "</" + tag + ">");
}

void XmlWriter::value(const std::string& tag, double number) { value(tag, format_number(number)); }

void XmlWriter::line(std::string_view text) {
    out_ += std::string(tags_.size(), '\t') + std::string(text) + "\n";
}

}  // namespace risorius::io
