// SPDX-License-Identifier: MIT
#include "risorius/speech/detail/labels/xml_tags.h"

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

std::string without_entities(std::string_view text) {
    static constexpr std::pair<std::string_view, char> kEntities[] = {
        {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};
    std::string out;
    while (!text.empty()) {
        const auto* found = std::find_if(std::begin(kEntities), std::end(kEntities),
                                         [&](const auto& e) { return text.starts_with(e.first); });
        const bool known = found != std::end(kEntities);
        out += known ? found->second : text[0];
        text.remove_prefix(known ? found->first.size() : 1);
    }
    return out;
}

constexpr std::string_view kSpace = " \t\r\n";

}  // namespace

std::string XmlTags::place() const { return line_place(name_, line_); }

bool XmlTags::next() {
    const auto go_to = [&](std::size_t to) {
        line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<long>(at_),
                                                     text_.begin() + static_cast<long>(to), '\n'));
        at_ = to;
    };
    for (;;) {
        const std::size_t begin = text_.find('<', at_);
        if (begin == std::string_view::npos) return false;
        before_ = without_entities(text_.substr(at_, begin - at_));
        go_to(begin);
        const bool comment = text_.substr(begin).starts_with("<!--");
        const std::string_view closing = comment ? "-->" : ">";
        const std::size_t end = text_.find(closing, begin);
        if (end == std::string_view::npos)
            throw Error(place(), "a tag that ends with \">\"", "the end of the file");
        const std::string_view inside = text_.substr(begin + 1, end - begin - 1);
        at_ = end + closing.size();
        line_ += static_cast<std::size_t>(std::count(inside.begin(), inside.end(), '\n'));
        if (comment || inside.starts_with('?') || inside.starts_with('!')) continue;
        const std::size_t name_end = std::min(inside.find_first_of(kSpace), inside.size());
        tag_ = std::string(inside.substr(0, name_end));
        if (tag_.size() > 1 && tag_.back() == '/') tag_.pop_back();
        read_attributes(inside.substr(name_end));
        return true;
    }
}

void XmlTags::read_attributes(std::string_view inside) {
    attributes_.clear();
    for (;;) {
        const std::size_t begin = inside.find_first_not_of(kSpace), equals = inside.find('=');
        if (begin == std::string_view::npos || equals == std::string_view::npos || equals < begin)
            return;
        const std::string key = trimmed(inside.substr(begin, equals - begin));
        const std::size_t open = inside.find_first_of("\"'", equals);
        if (open == std::string_view::npos) return;
        const std::size_t close = inside.find(inside[open], open + 1);
        if (close == std::string_view::npos)
            throw Error(place(), "a value of " + in_quotes(key) + " that ends with a quote",
                        "the end of the tag");
        attributes_[key] = without_entities(inside.substr(open + 1, close - open - 1));
        inside.remove_prefix(close + 1);
    }
}

const std::string& XmlTags::attribute(const std::string& key) const {
    const auto found = attributes_.find(key);
    if (found == attributes_.end())
        throw Error(place(), "the attribute " + in_quotes(key) + " of " + in_quotes(tag_), "none");
    return found->second;
}

std::string XmlTags::attribute_or(const std::string& key, const std::string& otherwise) const {
    const auto found = attributes_.find(key);
    return found == attributes_.end() ? otherwise : found->second;
}

}  // namespace risorius::speech
