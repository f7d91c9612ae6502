// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/evaluation_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>

#include "risorius/core/version.h"
#include "risorius/render/value_colour.h"
#include "risorius/report/drive_bars.h"
#include "risorius/report/html_writer.h"

namespace risorius::inverse {

namespace {

// Rows of a table that are reordered when another order is selected; bars of activations side by side.
const std::string kEvaluationStyle = R"(
.orders input { position: absolute; opacity: 0; }
.orders label { display: inline-block; padding: .1rem .6rem; margin: .15rem .3rem .15rem 0; border: 1px solid var(--line); border-radius: 1rem; cursor: pointer; font-size: .87rem; }
.orders input:checked + label { background: var(--link); border-color: var(--link); color: #fff; }
.orders input:focus-visible + label { outline: 2px solid var(--ink); }
.rows { display: flex; flex-direction: column; min-width: max-content; margin-top: .6rem; }
.rows .row { display: grid; padding: .22rem 0; border-bottom: 1px solid var(--line); font-size: .9rem; font-variant-numeric: tabular-nums; }
.rows .row b { font-weight: 600; color: var(--soft); }
.rows .row span, .rows .row b { text-align: right; padding-right: .7rem; }
.rows .row :first-child { text-align: left; }
.faces { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: .5rem; margin: .5rem 0; }
.key i { display: inline-block; width: 1.4rem; height: .5rem; margin: 0 .35rem 0 .9rem; }
.key i:first-child { margin-left: 0; }
.scale { display: inline-block; width: 9rem; height: .7rem; margin: 0 .4rem; vertical-align: middle; border: 1px solid var(--line); }
)";

std::string fixed(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// A measure by which expressions are judged.
struct Column {
    const char* name;
    const char* tsv;
    double (*of)(const scene::ExpressionScore&);
    int decimals;
    bool more_is_better;
};

const std::vector<Column>& columns() {
    static const std::vector<Column> kColumns{
        {"cosine", "cosine", [](const scene::ExpressionScore& s) { return s.cosine; }, 3, true},
        {"relative error", "relative_error",
         [](const scene::ExpressionScore& s) { return s.relative; }, 3, false},
        {"RMS, mm", "rms_mm", [](const scene::ExpressionScore& s) { return 1e3 * s.rms_m; }, 2,
         false},
        {"largest, mm", "max_mm", [](const scene::ExpressionScore& s) { return 1e3 * s.max_m; }, 1,
         false},
        {"landmarks, mm", "landmark_mm",
         [](const scene::ExpressionScore& s) { return 1e3 * s.landmark_m; }, 2, false}};
    return kColumns;
}

bool has_fit(const Evaluation& evaluation) {
    return std::any_of(evaluation.expressions.begin(), evaluation.expressions.end(),
                       [](const EvaluatedExpression& one) { return one.fitted.has_value(); });
}

std::string anchor(std::size_t expression) { return "expression-" + std::to_string(expression); }

void write_means(report::HtmlWriter& html, const Evaluation& evaluation) {
    html.open("section").element("h2", "At a glance");
    html.open("div", {{"class", "scroll"}}).open("table");
    const bool fit = has_fit(evaluation);
    html.open("tr").element("th", "Mean over");
    html.element("th", "activations", {{"class", "number"}});
    for (const char* head :
         {"cosine", "least cosine", "relative error", "RMS, mm", "landmarks, mm"})
        html.element("th", head, {{"class", "number"}});
    html.close();
    const auto row = [&](const std::string& name, const char* how, const ScoreMeans& means) {
        html.open("tr").element("td", name);
        html.element("td", how, {{"class", "number"}});
        for (const std::string& text :
             {fixed(means.cosine, 3), fixed(means.min_cosine, 3), fixed(means.relative, 3),
              fixed(1e3 * means.rms_m, 2), fixed(1e3 * means.landmark_m, 2)})
            html.element("td", text, {{"class", "number"}});
        html.close();
    };
    for (const ExpressionGroup& group : evaluation.groups()) {
        const ScoreMeans table = evaluation.means(group.names, false);
        row(group.title + " (" + std::to_string(table.count) + ")", "the rig's table", table);
        if (fit) row("", "fitted", evaluation.means(group.names, true));
    }
    html.close().close();
    html.element(
        "p",
        "Simulated displacement u and measured displacement g of the skin, every vertex weighted "
        "by "
        "the area around it. Cosine: how alike the two fields are in shape, 1 at best. Relative "
        "error: |u - g| / |g|, 0 at best, 1 for a face that does not move. RMS and largest: of "
        "u - g. Landmarks: mean of |u - g| at those of brows, eyes, nose and lips.",
        {{"class", "soft"}});
    if (!evaluation.calibrated_on.empty())
        html.element("p",
                     "The numbers of this rig's anatomy were tuned with the expressions it was "
                     "calibrated on; the others test them.",
                     {{"class", "soft"}});
    html.close();
}

/// Ranks of the expressions, best first; those without a value come last.
std::vector<std::size_t> ranks(const Evaluation& evaluation,
                               const std::function<double(const EvaluatedExpression&)>& worse) {
    std::vector<std::size_t> order(evaluation.expressions.size()), rank(order.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return worse(evaluation.expressions[a]) < worse(evaluation.expressions[b]);
    });
    for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
    return rank;
}

struct Order {
    std::string label;
    std::vector<std::size_t> rank;
};

std::vector<Order> orders_of(const Evaluation& evaluation) {
    std::vector<Order> out;
    out.push_back({"as in the file", ranks(evaluation, [](const auto&) { return 0.0; })});
    std::vector<std::size_t> by_name(evaluation.expressions.size());
    for (std::size_t e = 0; e < by_name.size(); ++e)
        by_name[e] = static_cast<std::size_t>(std::count_if(
            evaluation.expressions.begin(), evaluation.expressions.end(),
            [&](const auto& other) { return other.name < evaluation.expressions[e].name; }));
    out.push_back({"by name", by_name});
    for (const bool fit : {false, true}) {
        if (fit && !has_fit(evaluation)) continue;
        for (const Column& column : columns()) {
            const auto worse = [&](const EvaluatedExpression& one) {
                if (fit && !one.fitted) return kInfinity;
                const double value = column.of(fit ? one.fitted->score : one.table.score);
                return column.more_is_better ? -value : value;
            };
            out.push_back(
                {std::string(column.name) + (fit ? ", fitted" : ""), ranks(evaluation, worse)});
        }
    }
    return out;
}

void write_table(report::HtmlWriter& html, const Evaluation& evaluation) {
    const bool fit = has_fit(evaluation);
    const std::vector<Order> orders = orders_of(evaluation);
    std::string style = ".rows .row { grid-template-columns: 11rem repeat(" +
                        std::to_string(columns().size() * (fit ? 2 : 1)) + ", 6.4rem) 4.5rem; }\n";
    for (std::size_t o = 0; o < orders.size(); ++o)
        style += "#order-" + std::to_string(o) + ":checked ~ .scroll .row { order: var(--o" +
                 std::to_string(o) + "); }\n";
    html.open("section").element("h2", "Every expression");
    html.element("style", style);
    html.open("div", {{"class", "orders"}});
    html.element("p", "Order, the best first:", {{"class", "soft"}});
    for (std::size_t o = 0; o < orders.size(); ++o) {
        const std::string id = "order-" + std::to_string(o);
        report::HtmlWriter::Attributes attributes{{"type", "radio"}, {"name", "order"}, {"id", id}};
        if (o == 0) attributes.push_back({"checked", "checked"});
        html.single("input", attributes).element("label", orders[o].label, {{"for", id}});
    }
    html.open("div", {{"class", "scroll"}}).open("div", {{"class", "rows"}, {"role", "table"}});
    html.open("div", {{"class", "row"}, {"role", "row"}, {"style", "order: -1"}});
    html.element("b", "expression", {{"role", "columnheader"}});
    for (const bool fitted : {false, true}) {
        if (fitted && !fit) continue;
        for (const Column& column : columns())
            html.element("b", std::string(column.name) + (fitted ? ", fitted" : ""),
                         {{"role", "columnheader"}});
    }
    html.element("b", "", {{"role", "columnheader"}}).close();
    for (std::size_t e = 0; e < evaluation.expressions.size(); ++e) {
        const EvaluatedExpression& one = evaluation.expressions[e];
        std::string places;
        for (std::size_t o = 0; o < orders.size(); ++o)
            places += " --o" + std::to_string(o) + ":" + std::to_string(orders[o].rank[e]) + ";";
        html.open("div", {{"class", "row"}, {"role", "row"}, {"style", places}});
        html.open("span", {{"role", "cell"}})
            .element("a", one.name, {{"href", "#" + anchor(e)}})
            .close();
        for (const bool fitted : {false, true}) {
            if (fitted && !fit) continue;
            for (const Column& column : columns())
                html.element("span",
                             fitted && !one.fitted
                                 ? "–"
                                 : fixed(column.of(fitted ? one.fitted->score : one.table.score),
                                         column.decimals),
                             {{"role", "cell"}});
        }
        html.element("span", evaluation.is_calibrated_on(one.name) ? "tuned" : "",
                     {{"role", "cell"}, {"class", "soft"}});
        html.close();
    }
    html.close().close().close().close();
}

void write_scale(report::HtmlWriter& html) {
    std::string gradient = "background: linear-gradient(90deg";
    constexpr int kStops = 12;
    for (int i = 0; i <= kStops; ++i) {
        const Vec3 rgb =
            255 * render::srgb_of(render::value_colour(static_cast<double>(i) / kStops, 0, 1));
        gradient +=
            ", rgb(" + fixed(rgb.x(), 0) + "," + fixed(rgb.y(), 0) + "," + fixed(rgb.z(), 0) + ")";
    }
    html.open("p", {{"class", "soft"}})
        .text("Error, on the measured face: 0")
        .element("i", "", {{"class", "scale"}, {"style", gradient + ")"}})
        .text(fixed(kErrorScale_mm, 0) + " mm and more; grey where the skin is not simulated.")
        .close();
}

void write_face(report::HtmlWriter& html, const std::string& file, const std::string& description) {
    html.open("a", {{"href", file}})
        .single("img", {{"src", file},
                        {"alt", description},
                        {"loading", "lazy"},
                        {"width", std::to_string(EvaluationPictures::kWidth_px)},
                        {"height", std::to_string(EvaluationPictures::kHeight_px)}})
        .close();
}

void write_faces(report::HtmlWriter& html, const std::string& name,
                 const EvaluationPictures::Kinds& pictures, const std::string& camera) {
    struct Shown {
        const char* kind;
        const char* caption;
    };
    html.open("div", {{"class", "faces"}});
    for (const Shown& shown : {Shown{"table", "by the rig's table"}, Shown{"fitted", "fitted"},
                               Shown{"measured", "measured"}, Shown{"table_error", "error"},
                               Shown{"fitted_error", "error, fitted"}}) {
        const auto file = pictures.find(shown.kind);
        if (file == pictures.end()) continue;
        html.open("figure");
        write_face(html, file->second, name + ", " + shown.caption + ", " + camera);
        html.element("figcaption", shown.caption).close();
    }
    html.close();
}

void write_bars(report::HtmlWriter& html, const EvaluatedExpression& one,
                const track::ChannelTable& channels) {
    html.open("p", {{"class", "soft key"}}).element("i", "", {{"class", "by-table"}});
    html.text("by the rig's table");
    if (one.fitted) html.element("i", "", {{"class", "by-fit"}}).text("fitted");
    html.text(". Both sides alike unless .l or .r says which.").close();
    report::write_drive_bars(html, one.table.drive, one.fitted ? &one.fitted->drive : nullptr,
                             channels);
}

void write_expression(report::HtmlWriter& html, const Evaluation& evaluation, std::size_t index,
                      const EvaluationPictures* pictures) {
    const EvaluatedExpression& one = evaluation.expressions[index];
    html.open("section", {{"id", anchor(index)}}).element("h2", one.name);
    if (!evaluation.calibrated_on.empty())
        html.element("p",
                     evaluation.is_calibrated_on(one.name)
                         ? "The rig's anatomy was calibrated on this expression, among others."
                         : "Not used in calibrating the rig's anatomy.",
                     {{"class", "soft"}});
    html.open("div", {{"class", "scroll"}}).open("table").open("tr").element("th", "");
    for (const Column& column : columns()) html.element("th", column.name, {{"class", "number"}});
    html.element("th", "peak, mm", {{"class", "number"}}).element("th", "").close();
    const auto row = [&](const char* name, const Attempt& attempt) {
        html.open("tr").element("td", name);
        for (const Column& column : columns())
            html.element("td", fixed(column.of(attempt.score), column.decimals),
                         {{"class", "number"}});
        html.element("td",
                     fixed(1e3 * attempt.score.simulated_peak_m, 1) + " of " +
                         fixed(1e3 * attempt.score.peak_m, 1),
                     {{"class", "number"}});
        std::string remarks;
        if (!attempt.converged) remarks = "did not come to rest";
        if (attempt.inverted_tets > 0)
            remarks += (remarks.empty() ? "" : ", ") + std::to_string(attempt.inverted_tets) +
                       " tetrahedra inverted";
        html.element("td", remarks, {{"class", "bad"}}).close();
    };
    row("by the rig's table", one.table);
    if (one.fitted) row("fitted", *one.fitted);
    html.close().close();
    if (pictures)
        for (const std::string& camera : evaluation_cameras())
            write_faces(html, one.name, pictures->expressions[index].at(camera), camera);
    write_bars(html, one, evaluation.channels);
    html.close();
}

}  // namespace

std::string evaluation_page(const Evaluation& evaluation, const EvaluationPictures* pictures) {
    const std::string title = evaluation.name + ": simulated against measured expressions";
    report::HtmlWriter html;
    html.element("style", kEvaluationStyle + report::drive_bars_style()).element("h1", title);
    html.element("p",
                 "Rig " + evaluation.rig + " (" + std::to_string(evaluation.nodes) +
                     " nodes), measured shapes " + evaluation.shapes + ", " +
                     std::to_string(evaluation.expressions.size()) + " expressions.",
                 {{"class", "soft"}});
    write_means(html, evaluation);
    if (pictures && !pictures->sheets.empty()) {
        html.open("section").element("h2", "Contact sheets");
        write_scale(html);
        html.open("div", {{"class", "pictures"}});
        for (const std::string& camera : evaluation_cameras()) {
            const std::string& file = pictures->sheets.at(camera);
            html.open("figure").open("a", {{"href", file}});
            html.single("img", {{"src", file}, {"alt", "contact sheet, " + camera}}).close();
            html.element("figcaption", camera == "front" ? "From the front" : "Three-quarter view")
                .close();
        }
        html.close().close();
    }
    write_table(html, evaluation);
    for (std::size_t e = 0; e < evaluation.expressions.size(); ++e)
        write_expression(html, evaluation, e, pictures);
    html.open("p", {{"class", "soft"}}).text("Numbers for other programs: ");
    html.element("a", "results.json", {{"href", "results.json"}}).text(", ");
    html.element("a", "scores.tsv", {{"href", "scores.tsv"}});
    html.text(". Made by Risorius " + std::string(kVersion) + ".").close();
    return report::html_page(title, html);
}

std::string evaluation_table(const Evaluation& evaluation) {
    const bool fit = has_fit(evaluation);
    std::string out = "expression\tcalibrated_on";
    for (const Column& column : columns()) out += std::string("\t") + column.tsv;
    if (fit)
        for (const Column& column : columns()) out += std::string("\tfitted_") + column.tsv;
    out += "\n";
    for (const EvaluatedExpression& one : evaluation.expressions) {
        out += one.name + (evaluation.is_calibrated_on(one.name) ? "\t1" : "\t0");
        for (const Column& column : columns()) out += "\t" + fixed(column.of(one.table.score), 4);
        for (const Column& column : columns())
            if (one.fitted) out += "\t" + fixed(column.of(one.fitted->score), 4);
        out += "\n";
    }
    return out;
}

}  // namespace risorius::inverse
