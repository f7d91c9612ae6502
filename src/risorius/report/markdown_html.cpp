// SPDX-License-Identifier: MIT
#include "risorius/report/markdown_html.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace risorius::report {
namespace {

std::string trimmed(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos) return "";
    return line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
}

void write_inline(HtmlWriter& html, const std::string& text);

/// Writes a link [text](target) that starts at `at`, and moves `at` behind it; false if there is none.
bool write_link(HtmlWriter& html, const std::string& text, std::size_t& at) {
    const std::size_t middle = text.find("](", at);
    const std::size_t end = middle == std::string::npos ? middle : text.find(')', middle);
    if (end == std::string::npos || text.find('\n', at) < middle) return false;
    const std::string shown = text.substr(at + 1, middle - at - 1);
    const std::string target = text.substr(middle + 2, end - middle - 2);
    const bool web = target.starts_with("https://") || target.starts_with("http://");
    if (web) html.open("a", {{"href", target}});
    write_inline(html, shown);
    if (web) html.close();
    at = end + 1;
    return true;
}

/// Writes text between two equal marks that starts at `at`; false if there is none.
bool write_marked(HtmlWriter& html, const std::string& text, std::size_t& at,
                  const std::string& mark, const std::string& tag) {
    if (text.compare(at, mark.size(), mark) != 0) return false;
    const std::size_t begin = at + mark.size(), end = text.find(mark, begin);
    // "2 * 3" is a product, not emphasis
    if (end == std::string::npos || end == begin || text[begin] == ' ' || text[end - 1] == ' ')
        return false;
    html.open(tag);
    if (tag == "code")
        html.text(text.substr(begin, end - begin));
    else
        write_inline(html, text.substr(begin, end - begin));
    html.close();
    at = end + mark.size();
    return true;
}

void write_inline(HtmlWriter& html, const std::string& text) {
    std::string plain;
    const auto flush = [&] {
        html.text(plain);
        plain.clear();
    };
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c != '`' && c != '*' && c != '[' && c != '!') {
            plain += c;
            ++at;
            continue;
        }
        if (c == '!' && at + 1 < text.size() && text[at + 1] == '[') {
            ++at;  // a picture is replaced by its description
            continue;
        }
        flush();
        if (c == '`' && write_marked(html, text, at, "`", "code")) continue;
        if (c == '*' && write_marked(html, text, at, "**", "strong")) continue;
        if (c == '*' && write_marked(html, text, at, "*", "em")) continue;
        if (c == '[' && write_link(html, text, at)) continue;
        plain += c;
        ++at;
    }
    flush();
}

std::vector<std::string> cells_of(const std::string& row) {
    std::vector<std::string> cells;
    std::string cell;
    const std::string inside =
        row.substr(1, row.size() - (row.back() == '|' && row.size() > 1 ? 2 : 1));
    bool code = false;
    for (const char c : inside) {
        if (c == '`') code = !code;
        if (c == '|' && !code) {
            cells.push_back(trimmed(cell));
            cell.clear();
        } else {
            cell += c;
        }
    }
    cells.push_back(trimmed(cell));
    return cells;
}

bool is_rule(const std::string& row) {
    return row.find_first_not_of("|-: ") == std::string::npos && row.find('-') != std::string::npos;
}

/// Reads a document block by block.
class Blocks {
  public:
    Blocks(HtmlWriter& html, const std::string& markdown, int first_heading)
        : html_(html), first_heading_(first_heading) {
        std::istringstream stream(markdown);
        for (std::string line; std::getline(stream, line);) lines_.push_back(line);
    }

    void write() {
        while (at_ < lines_.size()) {
            const std::string line = trimmed(lines_[at_]);
            if (line.empty())
                ++at_;
            else if (heading_depth(line) > 0)
                write_heading(line);
            else if (line.starts_with("```"))
                write_fenced();
            else if (lines_[at_].starts_with("    "))
                write_indented();
            else if (line.starts_with("|"))
                write_table();
            else if (item_mark(lines_[at_]) > 0)
                write_list();
            else
                write_paragraph();
        }
    }

  private:
    static int heading_depth(const std::string& line) {
        const std::size_t depth = line.find_first_not_of('#');
        if (depth == 0 || depth == std::string::npos || depth > 6 || line[depth] != ' ') return 0;
        return static_cast<int>(depth);
    }

    /// The length of "- ", "* " or "1. " at the start of a line, or 0.
    static std::size_t item_mark(const std::string& line) {
        if (line.starts_with("- ") || line.starts_with("* ")) return 2;
        const std::size_t dot = line.find_first_not_of("0123456789");
        if (dot != 0 && dot != std::string::npos && line.compare(dot, 2, ". ") == 0) return dot + 2;
        return 0;
    }

    void write_heading(const std::string& line) {
        const int depth = heading_depth(line);
        const int shown = std::min(6, first_heading_ + depth - 1);
        html_.open("h" + std::to_string(shown));
        write_inline(html_, trimmed(line.substr(static_cast<std::size_t>(depth))));
        html_.close();
        ++at_;
    }

    void write_fenced() {
        std::string code;
        for (++at_; at_ < lines_.size() && !trimmed(lines_[at_]).starts_with("```"); ++at_)
            code += lines_[at_] + "\n";
        ++at_;
        html_.open("pre").element("code", code).close();
    }

    void write_indented() {
        std::string code;
        for (; at_ < lines_.size() && lines_[at_].starts_with("    "); ++at_)
            code += lines_[at_].substr(4) + "\n";
        html_.open("pre").element("code", code).close();
    }

    void write_table() {
        std::vector<std::vector<std::string>> rows;
        bool headed = false;
        for (; at_ < lines_.size() && trimmed(lines_[at_]).starts_with("|"); ++at_) {
            const std::string row = trimmed(lines_[at_]);
            if (is_rule(row))
                headed = headed || rows.size() == 1;
            else
                rows.push_back(cells_of(row));
        }
        html_.open("div", {{"class", "scroll"}}).open("table");
        for (std::size_t r = 0; r < rows.size(); ++r) {
            html_.open("tr");
            for (const std::string& cell : rows[r]) {
                html_.open(headed && r == 0 ? "th" : "td");
                write_inline(html_, cell);
                html_.close();
            }
            html_.close();
        }
        html_.close().close();
    }

    void write_list() {
        const bool numbered = lines_[at_].front() >= '0' && lines_[at_].front() <= '9';
        html_.open(numbered ? "ol" : "ul");
        while (at_ < lines_.size() && item_mark(lines_[at_]) > 0) {
            std::string item = lines_[at_].substr(item_mark(lines_[at_]));
            // Continuation lines
            for (++at_; at_ < lines_.size() && lines_[at_].starts_with("  "); ++at_)
                item += " " + trimmed(lines_[at_]);
            html_.open("li");
            write_inline(html_, item);
            html_.close();
        }
        html_.close();
    }

    void write_paragraph() {
        std::string paragraph;
        for (; at_ < lines_.size(); ++at_) {
            const std::string line = trimmed(lines_[at_]);
            const bool other = line.empty() || heading_depth(line) > 0 || line.starts_with("|") ||
                               line.starts_with("```") || item_mark(lines_[at_]) > 0;
            if (other && !paragraph.empty()) break;
            paragraph += (paragraph.empty() ? "" : " ") + line;
        }
        html_.open("p");
        write_inline(html_, paragraph);
        html_.close();
    }

    HtmlWriter& html_;
    int first_heading_;
    std::vector<std::string> lines_;
    std::size_t at_ = 0;
};

}  // namespace

void write_markdown(HtmlWriter& html, const std::string& markdown, int first_heading) {
    Blocks(html, markdown, first_heading).write();
}

}  // namespace risorius::report
