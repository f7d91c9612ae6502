// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_page.h"

#include <cmath>
#include <cstdio>

#include "risorius/report/html_writer.h"

namespace risorius::inverse {

namespace {

const std::string kUnitStyle = R"(
.faces { display: grid; grid-template-columns: repeat(3, minmax(120px, 1fr)); gap: .5rem; margin: .5rem 0; max-width: 60rem; }
.faces img { width: 100%; height: auto; } .faces figcaption { color: var(--soft); font-size: .85rem; }
figure { margin: 0; }
fieldset { border: 1px solid var(--line); margin: .6rem 0; padding: .4rem .8rem; } legend { color: var(--soft); }
fieldset label { margin-right: 1.2rem; } fieldset input[type=text] { width: 22rem; max-width: 100%; }
button { font: inherit; padding: .3rem .9rem; }
)";

// Without a sign before a zero
std::string number(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, std::abs(value) < 0.005 ? 0.0 : value);
    return text;
}

void write_numbers(report::HtmlWriter& html, const scene::UnitReading& one) {
    html.open("div", {{"class", "scroll"}}).open("table").open("tr");
    for (const char* head :
         {"gain", "at .25", "at .5", "at .75", "eye, mm", "mouth width, mm", "lip gap, mm",
          "corners, mm", "nasolabial furrow, mm", "glabellar furrow, mm", "forehead furrow, mm",
          "lip contact, mm²", "uneven, mm"})
        html.element("th", head, {{"class", "number"}});
    html.close().open("tr");
    const auto cell = [&](const char* format, double value) {
        html.element("td", number(format, value), {{"class", "number"}});
    };
    cell("%.2f", one.gain);
    for (const double share : one.response) cell("%.2f", share);
    for (std::size_t i = one.response.size(); i < 3; ++i)
        html.element("td", "-", {{"class", "number"}});
    for (const double change :
         {one.change.lid_aperture, one.change.mouth_width, one.change.lip_gap,
          one.change.corner_height, one.change.nasolabial_furrow, one.change.glabellar_furrow,
          one.change.forehead_furrow, one.change.lip_contact_mm2})
        cell("%+.1f", std::abs(change) < 0.05 ? 0.0 : change);
    cell("%.1f", one.uneven_mm);
    html.close().close().close();
    std::string marks = "Landmarks, gain along the target:";
    for (const scene::LandmarkReading& mark : one.landmarks)
        marks += " " + mark.landmark + number(" %.2f", mark.gain) + ";";
    marks.back() = '.';
    html.element("p", marks + (one.in_equilibrium ? "" : " The face did not come to rest."),
                 {{"class", "soft"}});
}

void write_boxes(report::HtmlWriter& html, const std::string& unit) {
    html.open("fieldset", {{"data-unit", unit}}).element("legend", "Your judgement of " + unit);
    for (const char* judgement : {"right", "weak", "wrong"}) {
        html.open("label").single("input",
                                  {{"type", "radio"}, {"name", unit}, {"value", judgement}});
        html.text(std::string(" ") + judgement).close();
    }
    html.open("label").text("What is wrong: ");
    html.single("input", {{"type", "text"}, {"name", unit + " note"}}).close().close();
}

}  // namespace

std::string unit_page(const UnitReadings& readings, const track::FacsTable& facs,
                      const std::string& name, const std::string& neutral,
                      const std::map<std::string, UnitPictures>& pictures) {
    report::HtmlWriter html;
    html.element("style", kUnitStyle);
    html.element("h1", "Action units of " + name);
    html.element("p",
                 "Each unit is shown at intensity 1, beside the neutral face and a map of how far "
                 "the skin moves. Look for the cues, and tick whether the unit is right, weak or "
                 "wrong. A gain of 1 means that the landmarks go as far as the table of the rig "
                 "asks; at intensity .25, .5 and .75 the same parts of the way should be seen.");
    html.element(
        "p",
        "Neutral: eye opening " + number("%.1f", readings.neutral.lid_aperture) + " mm, mouth " +
            number("%.1f", readings.neutral.mouth_width) + " mm wide, lips touch over " +
            number("%.0f", readings.neutral.lip_contact_mm2) +
            " mm². Eye, mouth, furrows and contact of a unit are changes from the neutral "
            "face, or from the units that it is seen with. Uneven is the largest difference "
            "between a landmark and the mirror image of its partner.",
        {{"class", "soft"}});
    html.open("p");
    html.element("button", "Save the answers as a table", {{"type", "button"}, {"id", "save"}});
    html.text(" ").element("span", "", {{"id", "count"}, {"aria-live", "polite"}}).close();
    for (const scene::UnitReading& one : readings.units) {
        html.open("section", {{"id", one.unit}}).element("h2", one.unit + " " + one.name);
        if (const track::ActionUnit* unit = facs.find(one.unit); unit && !unit->cues.empty())
            html.element("p", "Cues: " + unit->cues);
        if (const auto found = pictures.find(one.unit); found != pictures.end()) {
            html.open("div", {{"class", "faces"}});
            const auto figure = [&](const std::string& file, const std::string& caption) {
                html.open("figure").single(
                    "img",
                    {{"src", file}, {"alt", one.unit + ", " + caption}, {"loading", "lazy"}});
                html.element("figcaption", caption).close();
            };
            figure(neutral, "neutral");
            figure(found->second.shown, one.unit);
            figure(found->second.moved, "motion of the skin, 0 to 10 mm");
            html.close();
        }
        write_numbers(html, one);
        write_boxes(html, one.unit);
        html.close();
    }
    html.element("script", "", {{"src", "coder.js"}});
    return report::html_page("Action units of " + name, html);
}

const std::string& unit_page_script() {
    static const std::string kScript = R"js('use strict';
// Keeps each answer in the browser as soon as it is given, and saves all of them as a table.
const key = 'risorius-coder:' + document.title + ':' + location.pathname;
let answers = {};
try { answers = JSON.parse(localStorage.getItem(key)) || {}; } catch (error) { answers = {}; }
const sets = [...document.querySelectorAll('fieldset[data-unit]')];

function tell() {
  const judged = sets.filter(set => (answers[set.dataset.unit] || {}).judgement).length;
  document.getElementById('count').textContent = judged + ' of ' + sets.length + ' judged';
}

for (const set of sets) {
  const unit = set.dataset.unit, given = answers[unit] || {};
  for (const input of set.querySelectorAll('input')) {
    if (input.type === 'radio') input.checked = input.value === given.judgement;
    else input.value = given.note || '';
    input.addEventListener('input', () => {
      const answer = answers[unit] = answers[unit] || {};
      if (input.type === 'radio') answer.judgement = input.value;
      else answer.note = input.value;
      try { localStorage.setItem(key, JSON.stringify(answers)); } catch (error) { /* saving still works */ }
      tell();
    });
  }
}

document.getElementById('save').addEventListener('click', () => {
  const clean = text => (text || '').replace(/[\t\r\n]+/g, ' ');
  const rows = sets.map(set => {
    const answer = answers[set.dataset.unit] || {};
    return [set.dataset.unit, answer.judgement || '', clean(answer.note)].join('\t');
  });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(['unit\tjudgement\tnote\n' + rows.join('\n') + '\n'],
                                           {type: 'text/tab-separated-values'}));
  link.download = 'judgements.tsv';
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
});
tell();
)js";
    return kScript;
}

}  // namespace risorius::inverse
