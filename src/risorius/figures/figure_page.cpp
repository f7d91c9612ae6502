// SPDX-License-Identifier: MIT
#include "risorius/figures/figure_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/core/json_text.h"
#include "risorius/core/version.h"
#include "risorius/report/html_writer.h"
#include "risorius/report/markdown_html.h"

namespace risorius::figures {
namespace {

using figures::Check;
using figures::Claim;
using figures::FigureResult;
using figures::Verdict;

constexpr const char* kBeyondTitle = "Beyond the thesis";

int passed(const FigureResult& figure) {
    return static_cast<int>(std::count_if(figure.checks.begin(), figure.checks.end(),
                                          [](const Check& check) { return check.passes(); }));
}

std::string anchor(const FigureResult& figure) { return "figure-" + figure.id; }

std::string with_unit(const std::string& text, const std::string& unit) {
    return unit.empty() ? text : text + " " + unit;
}

/// Writes a symbol and a word, so that the meaning does not depend on colour.
void write_mark(report::HtmlWriter& html, const Check& check) {
    html.element("span", check.passes() ? "✓ inside" : "✗ outside",
                 {{"class", check.passes() ? "good" : "bad"}});
}

void write_verdict(report::HtmlWriter& html, const Claim& claim) {
    const char* symbol = claim.verdict == Verdict::kAgrees   ? "= "
                         : claim.verdict == Verdict::kMissed ? "≠ "
                                                             : "? ";
    const char* kind = claim.verdict == Verdict::kAgrees   ? "good"
                       : claim.verdict == Verdict::kMissed ? "bad"
                                                           : "soft";
    html.element("span", symbol + std::string(name_of(claim.verdict)), {{"class", kind}});
    if (!claim.holds())
        html.single("br").element("span", "✗ not what is measured", {{"class", "bad"}});
}

/// Where a range comes from, for a table.
std::string source_text(const Check& check) {
    if (check.range_from == "published") return "what was published";
    if (check.range_from == "law") return "a law";
    if (check.range_from == "demand") return "a demand";
    return "–";
}

/// Numbers of checks of all figures.
struct Counts {
    int all = 0, inside = 0, from_publication = 0, from_law = 0, demanded = 0;
    int watched = 0, changed = 0, claims = 0, missed = 0, unknown = 0;
};

void count(const FigureResult& figure, Counts& counts) {
    for (const Check& check : figure.checks) {
        ++counts.all;
        counts.inside += check.passes();
        counts.from_publication += check.range_from == "published";
        counts.from_law += check.range_from == "law";
        counts.demanded += check.range_from == "demand";
    }
    for (const Check& check : figure.watched) {
        ++counts.watched;
        counts.changed += !check.passes();
    }
    for (const Claim& claim : figure.claims) {
        ++counts.claims;
        counts.missed += claim.verdict == Verdict::kMissed;
        counts.unknown += claim.verdict == Verdict::kUnknown;
    }
}

/// Significant digits that distinguish the ends of the range and the measured value.
int digits_of(const Check& check) {
    constexpr int kFewest = 4, kMax = 10;
    constexpr double kOfWidth = 0.05;  ///< fraction of the width of the range
    const double width = check.high - check.low;
    if (!(width > 0) || std::isinf(width)) return kFewest;
    for (int digits = kFewest; digits < kMax; ++digits) {
        const auto moves = [&](double end) {
            char text[32];
            std::snprintf(text, sizeof text, "%.*g", digits, end);
            return std::abs(std::stod(text) - end) > kOfWidth * width;
        };
        if (!moves(check.low) && !moves(check.high)) return digits;
    }
    return kMax;
}

/// The band of a claim in the form of a check, for its texts.
Check band_of(const Claim& claim) {
    return {.name = claim.name,
            .unit = claim.unit,
            .measured = claim.value,
            .low = claim.low,
            .high = claim.high,
            .published = "",
            .note = ""};
}

/// The heading of a figure: "Figure 9b" for numbered ones, otherwise its name.
std::string heading(const FigureResult& figure) {
    const bool numbered =
        !figure.id.empty() && figure.id.front() >= '0' && figure.id.front() <= '9';
    return (numbered ? "Figure " : "") + figure.id + ": " + figure.title;
}

std::string count_text(const FigureResult& figure) {
    return std::to_string(passed(figure)) + " of " + std::to_string(figure.checks.size());
}

void write_summary(report::HtmlWriter& html, const std::vector<ShownFigure>& figures) {
    html.open("section");
    html.element("h2", "At a glance");
    html.open("div", {{"class", "scroll"}}).open("table").open("tr");
    for (const char* head : {"Figure", "What it shows", "Numbers inside their accepted range"})
        html.element("th", head);
    html.element("th", "Claims missed", {{"class", "number"}});
    html.element("th", "Takes about", {{"class", "number"}});
    html.close();
    bool beyond = false;
    for (const ShownFigure& figure : figures) {
        if (figure.origin == figures::Origin::kBeyond && !beyond) {
            html.open("tr").element("th", kBeyondTitle, {{"colspan", "5"}}).close();
            beyond = true;
        }
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
        Counts counts;
        count(figure.result, counts);
        html.element("td",
                     counts.claims == 0
                         ? "–"
                         : std::to_string(counts.missed) + " of " + std::to_string(counts.claims),
                     {{"class", "number"}});
        html.element("td", figure.run_time_s > 0 ? short_number(figure.run_time_s) + " s" : "",
                     {{"class", "number"}});
        html.close();
    }
    html.close().close();
    html.element("p", "Times are about those on two cores; figures that show one run share it.",
                 {{"class", "soft"}});
    html.close();
}

void write_claims(report::HtmlWriter& html, const FigureResult& figure) {
    if (figure.claims.empty()) return;
    html.element("h3", "What was published, and what is found here");
    html.open("div", {{"class", "scroll"}}).open("table").open("tr");
    html.element("th", "Published").element("th", "Found here").element("th", "Verdict");
    html.element("th", "Measured", {{"class", "number"}}).element("th", "The claim means").close();
    for (const Claim& claim : figure.claims) {
        html.open("tr");
        html.element("td", claim.says).element("td", claim.finds);
        html.open("td", {{"class", "mark"}});
        write_verdict(html, claim);
        html.close();
        const Check band = band_of(claim);
        html.element("td",
                     claim.measured
                         ? with_unit(short_number(claim.value, digits_of(band)), claim.unit)
                         : "–",
                     {{"class", "number"}});
        html.element("td", claim.measured ? range_text(band) : "–");
        html.close();
    }
    html.close().close();
}

/// `sourced`: the ranges have a source, as those of checks do.
void write_numbers(report::HtmlWriter& html, const std::vector<Check>& checks, bool sourced) {
    const bool noted = std::any_of(checks.begin(), checks.end(),
                                   [](const Check& check) { return !check.note.empty(); });
    html.open("div", {{"class", "scroll"}}).open("table").open("tr");
    html.element("th", "Number").element("th", "Measured", {{"class", "number"}});
    html.element("th", sourced ? "Accepted" : "Was about");
    if (sourced) html.element("th", "Range is from");
    html.element("th", "");
    if (noted) html.element("th", "Note");
    html.close();
    for (const Check& check : checks) {
        html.open("tr");
        html.element("td", check.name);
        html.element("td", with_unit(short_number(check.measured, digits_of(check)), check.unit),
                     {{"class", "number"}});
        html.element("td", range_text(check));
        if (sourced)
            html.element("td", check.published.empty()
                                   ? source_text(check)
                                   : source_text(check) + ": " + check.published);
        html.open("td", {{"class", "mark"}});
        write_mark(html, check);
        html.close();
        if (noted) html.element("td", check.note);
        html.close();
    }
    html.close().close();
}

void write_checks(report::HtmlWriter& html, const FigureResult& figure) {
    if (!figure.checks.empty()) {
        html.element("h3", "Checks");
        write_numbers(html, figure.checks, /*sourced=*/true);
    }
    if (figure.watched.empty()) return;
    html.element("h3", "Numbers that are watched");
    html.element("p",
                 "Their ranges lie around the values first measured here, so that a change is "
                 "noticed. They prove nothing.",
                 {{"class", "soft"}});
    write_numbers(html, figure.watched, /*sourced=*/false);
}

void write_image(report::HtmlWriter& html, const std::string& file,
                 const std::string& description) {
    html.open("a", {{"href", file}})
        .single("img", {{"src", file}, {"alt", description}, {"loading", "lazy"}})
        .close();
}

void write_legend(report::HtmlWriter& html, const FigurePicture& picture) {
    const bool shaded = !picture.shade_ends[0].empty();
    if (!picture.held && picture.outline_name.empty() && !shaded) return;
    html.open("span", {{"class", "legend"}});
    if (picture.held)
        html.open("span").element("i", "", {{"class", "held"}}).text("held nodes").close();
    if (!picture.outline_name.empty())
        html.open("span")
            .element("i", "", {{"class", "outline"}})
            .text(picture.outline_name)
            .close();
    if (shaded)
        html.open("span")
            .text(picture.shade_ends[0])
            .element("i", "", {{"class", "shade"}})
            .text(picture.shade_ends[1])
            .close();
    html.close();
}

void write_pictures(report::HtmlWriter& html, const ShownFigure& figure) {
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
        html.open("figure", picture.captions.size() > 2
                                ? report::HtmlWriter::Attributes{{"class", "wide"}}
                                : report::HtmlWriter::Attributes{});
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

void write_tables(report::HtmlWriter& html, const ShownFigure& figure) {
    html.open("p", {{"class", "soft"}});
    html.text("All numbers: ");
    for (const std::string& table : figure.files.tables)
        html.element("a", table, {{"href", figure.folder + table}}).text(" ");
    html.element("a", "results.json", {{"href", figure.folder + "results.json"}});
    html.text(" Run from: ");
    html.element("a", "experiment.json", {{"href", figure.folder + "experiment.json"}}).close();
}

/// Writes numbers and texts of the record as lines; nested values are collapsible.
void write_record(report::HtmlWriter& html, const FigureResult& figure) {
    if (figure.record.empty()) return;
    html.open("details");
    html.element("summary", "What was run: parameters, steps, costs");
    html.open("pre").element("code", json_text(figure.record, 2)).close();
    html.close();
}

/// Removes the title, because the section has its own heading.
std::string without_title(const std::string& markdown) {
    if (!markdown.starts_with("# ")) return markdown;
    const std::size_t end = markdown.find('\n');
    return end == std::string::npos ? "" : markdown.substr(end + 1);
}

void write_introduction(report::HtmlWriter& html, const std::vector<ShownFigure>& figures) {
    Counts n;
    for (const ShownFigure& figure : figures) count(figure.result, n);
    const auto text = [](int number) { return std::to_string(number); };
    const bool of_program = std::any_of(figures.begin(), figures.end(), [](const auto& figure) {
        return figure.origin != figures::Origin::kOwn;
    });
    if (of_program)
        html.element(
            "p",
            "\"The thesis\" is M. Dobsik, Computer Animation of Soft Tissues, summary of a "
            "Ph.D. thesis, Brno University of Technology, 2005. A is the thesis' finite "
            "differences, B are trilinear cells.");
    html.element("p", text(n.inside) + " of " + text(n.all) +
                          " checks pass. Their ranges come from a law or closed form for " +
                          text(n.from_law) + ", from what was published for " +
                          text(n.from_publication) + ", and are demands on the computation for " +
                          text(n.demanded) + ". " + text(n.watched) +
                          " further numbers are watched, so that a change is noticed; " +
                          text(n.changed) + " have changed.");
    if (n.claims > 0)
        html.element("p", "Of " + text(n.claims) + " published claims " +
                              text(n.claims - n.missed - n.unknown) +
                              " agree with what is "
                              "found here, " +
                              text(n.missed) + " are missed, and " + text(n.unknown) +
                              " cannot be known.");
    html.element(
        "p",
        "Every chart comes with its data and the script that draws it, every figure with the "
        "experiment file it was run from.");
}

void write_figure_section(report::HtmlWriter& html, const ShownFigure& figure) {
    const FigureResult& result = figure.result;
    html.open("section", {{"id", anchor(result)}});
    html.element("h2", heading(result));
    write_pictures(html, figure);
    write_claims(html, result);
    write_checks(html, result);
    report::write_markdown(html, without_title(figure.readme), 3);
    write_tables(html, figure);
    write_record(html, result);
    html.close();
}

}  // namespace

std::string short_number(double value, int digits) {
    if (std::isnan(value)) return "not a number";
    if (std::isinf(value)) return value > 0 ? "∞" : "-∞";
    char text[32];
    const double size = std::abs(value);
    // Integers are written in full up to a million.
    if (size < 1e6 && value == std::round(value))
        std::snprintf(text, sizeof text, "%.0f", value);
    else
        std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

std::string range_text(const Check& check) {
    if (std::isinf(check.low) && std::isinf(check.high)) return "any";
    const int digits = digits_of(check);
    const std::string low = short_number(check.low, digits),
                      high = short_number(check.high, digits);
    if (std::isinf(check.low)) return with_unit("at most " + high, check.unit);
    if (std::isinf(check.high)) return with_unit("at least " + low, check.unit);
    if (check.low == check.high) return with_unit("exactly " + low, check.unit);
    return with_unit(low + " to " + high, check.unit);
}

std::vector<std::string> failures_of(const FigureResult& figure) {
    std::vector<std::string> out;
    const auto found = [](const Check& check) {
        return ", found " + with_unit(short_number(check.measured), check.unit);
    };
    for (const auto* list : {&figure.checks, &figure.watched})
        for (const Check& check : *list)
            if (!check.passes())
                out.push_back(check.name + ": expected " + range_text(check) + found(check));
    for (const Claim& claim : figure.claims) {
        if (claim.holds()) continue;
        const Check band = band_of(claim);
        out.push_back("claim \"" + claim.says + "\": expected " +
                      (claim.inside() ? "agrees" : "missed") + " as the verdict, since " +
                      claim.name + " is " + with_unit(short_number(claim.value), claim.unit) +
                      " and the claim means " + range_text(band) + "; found " +
                      std::string(name_of(claim.verdict)));
    }
    return out;
}

std::string figure_page(const std::vector<ShownFigure>& figures) {
    const bool single = figures.size() == 1;
    const std::string title =
        single ? "Figure " + figures.front().result.id + ", published and measured"
               : "The figures, published and measured";
    report::HtmlWriter html;
    html.element("h1", title);
    write_introduction(html, figures);
    if (!single) write_summary(html, figures);
    bool beyond = single;
    for (const ShownFigure& figure : figures) {
        if (figure.origin == figures::Origin::kBeyond && !beyond) {
            html.element("h1", kBeyondTitle);
            beyond = true;
        }
        write_figure_section(html, figure);
    }
    html.open("p", {{"class", "soft"}});
    if (!single) {
        html.text("All checks as one file: ");
        html.element("a", "results.json", {{"href", "results.json"}}).text(". ");
    }
    html.text("Made by Risorius " + std::string(kVersion) +
              ". The same experiment file and build give the same bytes; how long it took is in ");
    html.element("a", "timing.json", {{"href", "timing.json"}}).text(".").close();
    return report::html_page(title, html);
}

}  // namespace risorius::figures
