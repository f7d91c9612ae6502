// SPDX-License-Identifier: MIT
/// \file
/// Goes through the tags of an XML file. For files whose labels are in attributes and short texts; it knows no entities beyond
/// the five of XML and numbers, no namespaces and no document types.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace risorius::speech {

class XmlTags {
  public:
    /// `name` is the place in messages. The text must outlive this object.
    XmlTags(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

    /// Goes to the next tag. Returns false at the end. Throws Error for a tag that does not end.
    bool next();
    const std::string& tag() const { return tag_; }        ///< "TIER", or "/TIER" at the end
    const std::string& before() const { return before_; }  ///< the text before this tag
    std::string place() const;                             ///< "file:12"
    /// The value of an attribute. Throws Error when the tag does not have it.
    const std::string& attribute(const std::string& key) const;
    std::string attribute_or(const std::string& key, const std::string& otherwise) const;

  private:
    void read_attributes(std::string_view inside);
    std::string_view text_;
    std::string name_, tag_, before_;
    std::map<std::string, std::string> attributes_;
    std::size_t at_ = 0, line_ = 1;
};

}  // namespace risorius::speech
