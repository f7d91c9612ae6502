// SPDX-License-Identifier: MIT
#include "risorius/report/html_writer.h"

#include <algorithm>
#include <cassert>

namespace risorius::report {
namespace {

// The page can be printed; wide tables scroll instead of widening the page.
constexpr const char* kStyle = R"(
:root { --ink: #1d2530; --soft: #5a6675; --line: #d9dee5; --back: #f6f7f9; --good: #00704f; --bad: #b33c00; --link: #00598c; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--back); color: var(--ink); font: 16px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: .6rem 0 .4rem; }
h2 { font-size: 1.3rem; line-height: 1.3; margin: 0 0 .7rem; }
h3 { font-size: 1.02rem; margin: 1.5rem 0 .5rem; }
h4, h5, h6 { font-size: .95rem; margin: 1.1rem 0 .4rem; }
p { margin: .5rem 0; max-width: 80ch; }
a { color: var(--link); }
section { background: #fff; border: 1px solid var(--line); border-radius: 8px; padding: 1.3rem 1.5rem; margin: 1.5rem 0; }
.soft { color: var(--soft); font-size: .9rem; }
.good { color: var(--good); } .bad { color: var(--bad); font-weight: 600; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(460px, 100%), 1fr)); gap: 1rem; }
.pictures .wide { grid-column: 1 / -1; }
figure { margin: 0; }
figure img { width: 100%; height: auto; display: block; border: 1px solid var(--line); border-radius: 4px; background: #fff; }
figcaption { font-size: .87rem; color: var(--soft); margin-top: .35rem; }
.legend { display: flex; flex-wrap: wrap; gap: .1rem 1.3rem; margin-top: .2rem; }
.legend i { display: inline-block; margin: 0 .4rem .1rem 0; vertical-align: middle; }
.legend .held { width: .7rem; height: .7rem; border-radius: 50%; background: #ce4a24; }
.legend .outline { width: 1.6rem; border-top: 2px solid #b8bbbf; }
.legend .shade { width: 5rem; height: .7rem; margin-left: .4rem; background: linear-gradient(90deg, #82b5f0, #e6e8e4, #f3a56e); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; min-width: 60%; }
th, td { text-align: left; vertical-align: top; padding: .35rem .8rem .35rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--soft); white-space: nowrap; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.mark { text-align: center; white-space: nowrap; }
code, pre { font: .86rem/1.45 "DejaVu Sans Mono", Consolas, monospace; background: var(--back); border-radius: 3px; }
code { padding: .05rem .25rem; } pre { padding: .7rem .9rem; overflow-x: auto; } pre code { padding: 0; }
details { margin-top: .8rem; } summary { cursor: pointer; color: var(--soft); }
@media print { body { background: #fff; } section { border: 0; padding: 0; break-inside: avoid-page; } }
)";

bool is_inline(const std::string& tag) {
    static const std::vector<std::string> tags = {"a",      "b",    "em",   "i",
                                                  "strong", "code", "span", "br"};
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

}  // namespace

std::string html_escaped(const std::string& text) {
    std::string out;
    for (const char c : text) switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    return out;
}

void HtmlWriter::tag(const std::string& name, const Attributes& attributes) {
    html_ += "<" + name;
    for (const auto& [key, value] : attributes)
        html_ += " " + key + "=\"" + html_escaped(value) + "\"";
    html_ += ">";
}

HtmlWriter& HtmlWriter::open(const std::string& name, const Attributes& attributes) {
    tag(name, attributes);
    open_.push_back(name);
    return *this;
}

HtmlWriter& HtmlWriter::close() {
    assert(!open_.empty());
    html_ += "</" + open_.back() + ">";
    // Line breaks are written only where they do not show.
    if (!is_inline(open_.back())) html_ += "\n";
    open_.pop_back();
    return *this;
}

HtmlWriter& HtmlWriter::text(const std::string& text) {
    html_ += html_escaped(text);
    return *this;
}

HtmlWriter& HtmlWriter::single(const std::string& name, const Attributes& attributes) {
    tag(name, attributes);
    return *this;
}

HtmlWriter& HtmlWriter::element(const std::string& name, const std::string& content,
                                const Attributes& attributes) {
    return open(name, attributes).text(content).close();
}

const std::string& HtmlWriter::html() const {
    assert(open_.empty());
    return html_;
}

std::string html_page(const std::string& title, const HtmlWriter& body) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           html_escaped(title) + "</title>\n<style>" + kStyle +
           "</style>\n</head>\n<body>\n<main>\n" + body.html() + "</main>\n</body>\n</html>\n";
}

}  // namespace risorius::report
