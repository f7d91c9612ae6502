// SPDX-License-Identifier: MIT
#include "risorius/core/text_lines.h"

#include <algorithm>

#include "risorius/core/error.h"

namespace risorius {

using namespace std::string_view_literals;

std::string text_of_bytes(std::string bytes, const std::string& name) {
    constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF"sv;
    const std::string_view text = bytes;
    if (text.starts_with(kUtf8Mark)) return bytes.substr(kUtf8Mark.size());
    const bool utf32 = text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv);
    if (utf32 || text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv))
        throw Error(name, "text in UTF-8", utf32 ? "text in UTF-32" : "text in UTF-16");
    return bytes;
}

std::string read_text(const std::filesystem::path& file, const FileKind& kind) {
    return text_of_bytes(read_file(file, kind), file.string());
}

bool TextLines::next() {
    if (next_ >= text_.size()) return false;
    begin_ = next_;
    end_ = std::min(text_.find_first_of("\r\n"sv, begin_), text_.size());
    next_ = end_ + 1;
    if (end_ + 1 < text_.size() && text_[end_] == '\r' && text_[end_ + 1] == '\n') ++next_;
    ++number_;
    return true;
}

}  // namespace risorius
