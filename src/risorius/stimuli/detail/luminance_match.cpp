// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/luminance_match.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/catalogue.h"
#include "risorius/stimuli/detail/luminance_maps.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

namespace {

media::LuminanceSums before_of(const Json& record) {
    return sums_of(record.at("luminance").at("before"));
}

media::LuminanceSums after_of(const Json& record) {
    return sums_of(record.at("luminance").at("after"));
}

bool is_condition(const Json& record) { return record.at("control").get<std::string>().empty(); }

struct Together {
    media::LuminanceSums before, after;
    double cut_off = 0;  ///< clipped fraction, maximum over clips
};

/// Sums over the conditions. Controls are excluded, as in the measurement of luminance.
Together together(const std::vector<Json>& records) {
    Together out;
    for (const Json& record : records) {
        if (!is_condition(record)) continue;
        out.before.add(before_of(record));
        out.after.add(after_of(record));
        out.cut_off = std::max(out.cut_off, record.at("luminance").at("cut_off").get<double>());
    }
    return out;
}

std::string four_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", value);
    return text;
}

plot::Chart chart_of(const char* name, const char* label, const std::vector<Json>& records,
                     double (media::LuminanceSums::*quantity)() const) {
    plot::Chart chart;
    chart.name = name;
    chart.x.label = "clip";
    chart.y.label = label;
    plot::Series before{.label = "before", .mark = plot::Mark::kPoints};
    plot::Series after{.label = "after", .mark = plot::Mark::kPoints};
    for (std::size_t i = 0; i < records.size(); ++i) {
        const auto at = static_cast<double>(i + 1);
        before.x.push_back(at);
        before.y.push_back((before_of(records[i]).*quantity)());
        after.x.push_back(at);
        after.y.push_back((after_of(records[i]).*quantity)());
    }
    chart.series = {before, after};
    return chart;
}

}  // namespace

std::vector<std::size_t> unmeasured(const BatchPlan& plan, const fs::path& folder) {
    std::vector<std::size_t> out;
    const bool maps = plan.match.luminance && plan.match.luminance->has_maps();
    if (maps && all_made(plan, folder)) return out;
    const auto is_measured = [&](const ClipPlan& clip) {
        return maps ? find_unmatched_render(clip, folder).has_value()
                    : measured_luminance(clip, folder).has_value();
    };
    for (std::size_t i = 0; i < plan.clips.size(); ++i)
        if (plan.clips[i].luminance && !plan.clips[i].is_control() && !is_measured(plan.clips[i]))
            out.push_back(i);
    return out;
}

namespace {

using OneFor = design::LuminanceMatch::OneFor;

/// Conditions that get the same map.
struct Group {
    media::ColourSums colours;
    std::vector<std::pair<std::string, media::ColourSums>> clips;
    media::FittedTone fit;
};

/// The clip that a tone clips most, and how much.
std::pair<std::string, double> most_cut(const Group& group, const media::Tone& tone) {
    std::pair<std::string, double> worst{"", -1};
    for (const auto& [clip, colours] : group.clips)
        if (const double cut = colours.after(tone).cut; cut > worst.second) worst = {clip, cut};
    return worst;
}

/// The largest standard deviation for which no clip is clipped more than the limit.
double reachable_sd(const Group& group, double mean, double sd, double limit) {
    double low = 0, high = sd;
    for (int step = 0; step < 20; ++step) {
        const double middle = (low + high) / 2;
        if (most_cut(group, media::fitted_tone(group.colours, mean, middle).tone).second <= limit)
            low = middle;
        else
            high = middle;
    }
    return low;
}

std::string percent(double fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", 100 * fraction);
    return text;
}

/// Throws Error, or adds a note, when the map of a group clips too much.
void check_cut(const std::map<std::string, Group>& groups, double mean, double sd,
               BatchPlan& plan) {
    const design::LuminanceMatch& match = *plan.match.luminance;
    std::pair<std::string, double> worst{"", -1};
    double reachable = sd;
    for (const auto& [name, group] : groups) {
        const auto most = most_cut(group, group.fit.tone);
        if (most.second > worst.second) worst = most;
        if (most.second > match.cut_limit && !match.allow_clipping)
            reachable = std::min(reachable, reachable_sd(group, mean, sd, match.cut_limit));
    }
    if (worst.second <= match.cut_limit) return;
    const std::string found =
        percent(worst.second) + " of the values of " + worst.first + " clipped at black or white";
    if (!match.allow_clipping)
        throw Error(plan.place("match/luminance"),
                    percent(match.cut_limit) + " clipped at most, with this mean \"sd\": " +
                        format_number(std::floor(1000 * reachable) / 1000) +
                        " or less, or \"allow_clipping\": true",
                    found);
    plan.notes.push_back("match/luminance: " + found);
}

}  // namespace

void match_luminance(const fs::path& folder, BatchPlan& plan) {
    if (!plan.match.luminance) return;
    if (plan.match.luminance->has_maps()) {
        if (!all_made(plan, folder)) fit_maps(folder, plan);
        return;
    }
    const design::LuminanceMatch& match = *plan.match.luminance;
    media::LuminanceSums all;
    std::map<std::string, Group> groups;
    for (const ClipPlan& clip : plan.clips) {
        if (clip.is_control()) {
            // A neutral face has the map of its head also when each condition has its own.
            groups[map_group(clip, match.one_for)];
            continue;
        }
        const auto measured = measured_luminance(clip, folder);
        if (!measured) throw RunError(clip.condition.clip + ": its measured luminance is missing");
        all.add(measured->sums);
        Group& group = groups[map_group(clip, match.one_for)];
        group.colours.add(measured->colours);
        group.clips.emplace_back(clip.condition.clip, measured->colours);
    }
    if (match.one_for == OneFor::kClip)
        for (const ClipPlan& clip : plan.clips)
            if (const auto neutral = groups.find(clip.scene_sha256);
                !clip.is_control() && neutral != groups.end())
                neutral->second.colours.add(
                    groups.at(map_group(clip, match.one_for)).clips.front().second);
    if (!(all.sd() > 0)) throw RunError("the pictures have no contrast that could be matched");
    const double mean = match.mean.value_or(all.mean()), sd = match.sd.value_or(all.sd());
    for (auto& [name, group] : groups) group.fit = media::fitted_tone(group.colours, mean, sd);
    check_cut(groups, mean, sd, plan);
    for (ClipPlan& clip : plan.clips)
        clip.match(groups.at(map_group(clip, match.one_for)).fit.tone);
}

std::vector<plot::Chart> write_luminance_report(const BatchPlan& plan,
                                                const std::vector<Json>& records,
                                                const WriteFile& write) {
    const design::LuminanceMatch& match = *plan.match.luminance;
    const fs::path below = kLuminanceFolder;
    std::string table =
        "stim_id\tset\tcontrol\tmean_before\tsd_before\tmean_after\tsd_after\tgain\toffset\t"
        "cut_off";
    table += match.has_maps() ? "\thistogram_error\n" : "\n";
    for (const Json& record : records) {
        const media::LuminanceSums before = before_of(record), after = after_of(record);
        const std::string control = record.at("control").get<std::string>();
        table += record.at("stim_id").get<std::string>() + "\t" +
                 record.at("set").get<std::string>() + "\t" + (control.empty() ? "n/a" : control);
        for (const double value : {before.mean(), before.sd(), after.mean(), after.sd()})
            table += "\t" + four_digits(value);
        for (const char* key : {"gain", "offset", "cut_off"})
            table += "\t" + catalogue_cell(record.at("luminance").at(key));
        if (match.has_maps())
            table += "\t" + four_digits(record.at("luminance").at("histogram_error").get<double>());
        table += "\n";
    }
    const Together of = together(records);
    const auto described = [](const media::LuminanceSums& sums) {
        return json_object({{"mean", sums.mean()}, {"sd", sums.sd()}});
    };
    const auto wanted = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json();
    };
    const Json json = json_object(
        {{"within", match.within_face ? "face" : "picture"},
         {"one_for", match.one_for == OneFor::kAll        ? "all"
                     : match.one_for == OneFor::kIdentity ? "identity"
                                                          : "clip"},
         {"wanted", json_object({{"mean", wanted(match.mean)}, {"sd", wanted(match.sd)}})},
         {"before", described(of.before)},
         {"after", described(of.after)},
         {"greatest_cut_off", of.cut_off}});
    write(below / "luminance.tsv", table);
    if (match.spectrum) write(below / "spectrum.tsv", spectrum_table(records));
    write(below / "luminance.json", json_text(json, 2) + "\n");
    return {chart_of("mean", "mean of luminance", records, &media::LuminanceSums::mean),
            chart_of("sd", "standard deviation of luminance", records, &media::LuminanceSums::sd)};
}

std::string luminance_text(const std::vector<Json>& records) {
    const Together of = together(records);
    return "Luminance over all pixels that count: mean " + four_digits(of.before.mean()) +
           " before, " + four_digits(of.after.mean()) + " after; standard deviation " +
           four_digits(of.before.sd()) + " before, " + four_digits(of.after.sd()) +
           " after. Of the clip that loses most, " + four_digits(100 * of.cut_off) +
           " % of the values are cut off at black or white.";
}

}  // namespace risorius::stimuli
