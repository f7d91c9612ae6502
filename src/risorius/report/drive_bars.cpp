// SPDX-License-Identifier: MIT
#include "risorius/report/drive_bars.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace risorius::report {

namespace {

constexpr const char* kBarsStyle = R"(
.bars { display: grid; grid-template-columns: repeat(auto-fill, minmax(330px, 1fr)); gap: .1rem 1.6rem; font-size: .84rem; margin-top: .4rem; }
.bars .bar { display: grid; grid-template-columns: 13.5rem 1fr 2.6rem; align-items: center; gap: .5rem; line-height: 1.25; }
.bars .bar i { display: block; height: .42rem; margin: 1px 0; border-radius: 1px; min-width: 1px; }
.bars .bar span:last-child { text-align: right; font-variant-numeric: tabular-nums; }
.by-table { background: #5a6675; } .by-fit { background: #d9822b; }
)";

struct DriveBar {
    std::string name;
    double first = 0, second = 0, max = 1;
};

std::vector<DriveBar> bars_of(const track::Drive& first, const track::Drive* second,
                              const track::ChannelTable& channels) {
    std::vector<DriveBar> out;
    const std::vector<std::string> names = channels.column_names();
    const auto add = [&](const std::string& name, double one, double other, double max) {
        if (one != 0 || other != 0) out.push_back({name, one, other, max});
    };
    for (std::size_t c = 0; c < names.size(); ++c) {
        const auto at = static_cast<long>(c);
        add(names[c], first.excitation[at], second ? second->excitation[at] : 0, 1);
    }
    for (std::size_t k = 0; k < first.kinematic.size(); ++k) {
        const track::KinematicChannel& channel = track::kinematic_channels()[k];
        add(std::string(channel.name), first.kinematic[k], second ? second->kinematic[k] : 0,
            std::max(std::abs(channel.min), std::abs(channel.max)));
    }
    std::vector<DriveBar> joined;
    for (const DriveBar& bar : out) {
        const bool pair = bar.name.ends_with(".r") && !joined.empty() &&
                          joined.back().name == bar.name.substr(0, bar.name.size() - 1) + "l" &&
                          joined.back().first == bar.first && joined.back().second == bar.second;
        if (pair)
            joined.back().name = bar.name.substr(0, bar.name.size() - 2);
        else
            joined.push_back(bar);
    }
    return joined;
}

std::string drive_text(double value, double max) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", max > 10 ? 0 : 2, value);
    return text;
}

std::string bar_width(double value, double max) {
    char text[48];
    std::snprintf(text, sizeof text, "width: %.1f%%", 100 * std::min(1.0, std::abs(value) / max));
    return text;
}

}  // namespace

std::string drive_bars_style() { return kBarsStyle; }

void write_drive_bars(HtmlWriter& html, const track::Drive& first, const track::Drive* second,
                      const track::ChannelTable& channels) {
    html.open("div", {{"class", "bars"}});
    for (const DriveBar& bar : bars_of(first, second, channels)) {
        html.open("div", {{"class", "bar"}}).element("span", bar.name).open("span");
        html.element("i", "", {{"class", "by-table"}, {"style", bar_width(bar.first, bar.max)}});
        if (second)
            html.element("i", "", {{"class", "by-fit"}, {"style", bar_width(bar.second, bar.max)}});
        html.close().open("span").text(drive_text(bar.first, bar.max));
        if (second) html.single("br").text(drive_text(bar.second, bar.max));
        html.close().close();
    }
    html.close();
}

}  // namespace risorius::report
