#include "app/figure_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/html_writer.h"
#include "app/markdown_html.h"
#include "app/version.h"

namespace risorius::app {
namespace {

using experiment::Check;
using experiment::FigureResult;

int passed(const FigureResult& figure) {
    return static_cast<int>(std::count_if(figure.checks.begin(), figure.checks.end(),
                                          [](const Check& check) { return check.passes(); }));
}

std::string anchor(const FigureResult& figure) { return "figure-" + figure.id; }

std::string with_unit(const std::string& text, const std::string& unit) {
    return unit.empty() ? text : text + " " + unit;
}

/// Mark and word, so that it does not hang on the colour.
void write_mark(HtmlWriter& html, bool passes) {
    html.element("span", passes ? "✓ inside" : "✗ outside", {{"class", passes ? "good" : "bad"}});
}

std::string count_text(const FigureResult& figure) {
    return std::to_string(passed(figure)) + " of " + std::to_string(figure.checks.size());
}

void write_summary(HtmlWriter& html, const std::vector<ShownFigure>& figures) {
    html.open("section");
    html.element("h2", "At a glance");
    html.open("div", {{"class", "scroll"}}).open("table").open("tr");
    for (const char* head : {"Figure", "What it shows", "Numbers inside their accepted range"})
        html.element("th", head);
    html.element("th", "Takes about", {{"class", "number"}});
    html.close();
    for (const ShownFigure& figure : figures) {
        html.open("tr");
        html.open("td")
            .element("a", figure.result.id,
                     {{"href", std::string("#").append(anchor(figure.result))}})
            .close();
        html.element("td", figure.result.title);
        if (figure.result.checks.empty())
            html.element("td", "none given", {{"class", "soft"}});
        else
            html.element("td", count_text(figure.result) + (figure.result.passes() ? " ✓" : " ✗"),
                         {{"class", figure.result.passes() ? "good" : "bad"}});
        html.element("td", figure.run_time_s > 0 ? short_number(figure.run_time_s) + " s" : "",
                     {{"class", "number"}});
        html.close();
    }
    html.close().close().close();
}

void write_checks(HtmlWriter& html, const FigureResult& figure) {
    if (figure.checks.empty()) return;
    const bool noted = std::any_of(figure.checks.begin(), figure.checks.end(),
                                   [](const Check& check) { return !check.note.empty(); });
    html.element("h3", "Published and measured");
    html.open("div", {{"class", "scroll"}}).open("table").open("tr");
    html.element("th", "Number").element("th", "Published");
    html.element("th", "Measured", {{"class", "number"}})
        .element("th", "Accepted")
        .element("th", "");
    if (noted) html.element("th", "Why it differs");
    html.close();
    for (const Check& check : figure.checks) {
        html.open("tr");
        html.element("td", check.name);
        html.element("td", check.published.empty() ? "–" : check.published);
        html.element("td", with_unit(short_number(check.measured), check.unit),
                     {{"class", "number"}});
        html.element("td", range_text(check));
        html.open("td", {{"class", "mark"}});
        write_mark(html, check.passes());
        html.close();
        if (noted) html.element("td", check.note);
        html.close();
    }
    html.close().close();
}

void write_image(HtmlWriter& html, const std::string& file, const std::string& description) {
    html.open("a", {{"href", file}})
        .single("img", {{"src", file}, {"alt", description}, {"loading", "lazy"}})
        .close();
}

void write_legend(HtmlWriter& html, const FigurePicture& picture) {
    const bool shaded = !picture.shade_ends[0].empty();
    if (!picture.held && !picture.outlined && !shaded) return;
    html.open("span", {{"class", "legend"}});
    if (picture.held)
        html.open("span").element("i", "", {{"class", "held"}}).text("held nodes").close();
    if (picture.outlined)
        html.open("span").element("i", "", {{"class", "outline"}}).text("outline at rest").close();
    if (shaded)
        html.open("span")
            .text(picture.shade_ends[0])
            .element("i", "", {{"class", "shade"}})
            .text(picture.shade_ends[1])
            .close();
    html.close();
}

void write_pictures(HtmlWriter& html, const ShownFigure& figure) {
    if (figure.published.empty() && figure.files.charts.empty() && figure.files.pictures.empty())
        return;
    html.open("div", {{"class", "pictures"}});
    if (!figure.published.empty()) {
        html.open("figure");
        write_image(html, figure.folder + figure.published, "the figure as published");
        html.element("figcaption", "As published").close();
    }
    for (const FigurePicture& picture : figure.files.pictures) {
        std::string caption;
        for (const std::string& text : picture.captions)
            caption += (caption.empty() || text.empty() ? "" : " | ") + text;
        html.open("figure", picture.captions.size() > 2 ? HtmlWriter::Attributes{{"class", "wide"}}
                                                        : HtmlWriter::Attributes{});
        write_image(html, figure.folder + picture.file,
                    caption.empty() ? figure.result.title : caption);
        html.open("figcaption").text(caption);
        write_legend(html, picture);
        html.close().close();
    }
    for (std::size_t i = 0; i < figure.files.charts.size(); ++i) {
        const std::string file = figure.folder + figure.files.charts[i];
        html.open("figure");
        write_image(html, file + ".svg", figure.result.charts[i].title);
        html.open("figcaption");
        html.text("Draw it again: ");
        for (const char* ending : {".svg", ".png", ".gp", ".data.csv"})
            html.element("a", ending + 1, {{"href", file + ending}}).text(" ");
        html.close().close();
    }
    html.close();
}

void write_tables(HtmlWriter& html, const ShownFigure& figure) {
    html.open("p", {{"class", "soft"}});
    html.text("All numbers: ");
    for (const std::string& table : figure.files.tables)
        html.element("a", table, {{"href", figure.folder + table}}).text(" ");
    html.element("a", "results.json", {{"href", figure.folder + "results.json"}}).close();
}

/// Numbers and words of the record in lines; what is deeper is folded away.
void write_record(HtmlWriter& html, const FigureResult& figure) {
    if (figure.record.empty()) return;
    html.open("details");
    html.element("summary", "What was run: parameters, steps, costs");
    html.open("pre").element("code", figure.record.dump(2)).close();
    html.close();
}

/// The section has its own.
std::string without_title(const std::string& markdown) {
    if (!markdown.starts_with("# ")) return markdown;
    const std::size_t end = markdown.find('\n');
    return end == std::string::npos ? "" : markdown.substr(end + 1);
}

void write_figure_section(HtmlWriter& html, const ShownFigure& figure) {
    const FigureResult& result = figure.result;
    html.open("section", {{"id", anchor(result)}});
    html.element("h2", "Figure " + result.id + ": " + result.title);
    write_pictures(html, figure);
    write_checks(html, result);
    write_markdown(html, without_title(figure.readme), 3);
    write_tables(html, figure);
    write_record(html, result);
    html.close();
}

}  // namespace

std::string short_number(double value) {
    if (std::isnan(value)) return "not a number";
    if (std::isinf(value)) return value > 0 ? "∞" : "-∞";
    char text[32];
    const double size = std::abs(value);
    // Whole numbers stay whole up to a million
    if (size < 1e6 && value == std::round(value))
        std::snprintf(text, sizeof text, "%.0f", value);
    else
        std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string range_text(const Check& check) {
    if (std::isinf(check.low) && std::isinf(check.high)) return "any";
    if (std::isinf(check.low)) return with_unit("at most " + short_number(check.high), check.unit);
    if (std::isinf(check.high)) return with_unit("at least " + short_number(check.low), check.unit);
    if (check.low == check.high) return with_unit("exactly " + short_number(check.low), check.unit);
    return with_unit(short_number(check.low) + " to " + short_number(check.high), check.unit);
}

std::string figure_page(const std::vector<ShownFigure>& figures) {
    const bool single = figures.size() == 1;
    const std::string title =
        single ? "Figure " + figures.front().result.id + ", published and measured"
               : "The figures, published and measured";
    int numbers = 0, inside = 0;
    for (const ShownFigure& figure : figures) {
        numbers += static_cast<int>(figure.result.checks.size());
        inside += passed(figure.result);
    }
    HtmlWriter html;
    html.element("h1", title);
    html.open("p");
    html.text(
        std::to_string(inside) + " of " + std::to_string(numbers) +
        " numbers lie inside their accepted range. Every chart comes with its data and the script "
        "that draws it, every figure with the experiment file it was run from.");
    html.close();
    if (!single) write_summary(html, figures);
    for (const ShownFigure& figure : figures) write_figure_section(html, figure);
    html.open("p", {{"class", "soft"}});
    html.text("Made by Risorius " + std::string(kVersion) +
              ". The same experiment file and build give the same bytes; how long it took is in ");
    html.element("a", "timing.json", {{"href", "timing.json"}}).text(".").close();
    return html_page(title, html);
}

}  // namespace risorius::app
