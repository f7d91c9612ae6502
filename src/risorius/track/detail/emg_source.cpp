// SPDX-License-Identifier: MIT
#include "risorius/track/detail/emg_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "risorius/core/existing_file.h"
#include "risorius/signal/emg_envelope.h"
#include "risorius/signal/recording.h"

namespace risorius::track {

namespace {

using signal::EmgFilters;
using signal::Recording;

/// Reads a frequency below half the rate of the recording, Hz.
double frequency(const JsonCursor& json, double rate_hz) {
    const double hz = json.number();
    if (!(hz > 0 && hz < rate_hz / 2))
        json.fail("a frequency in (0, " + format_number(rate_hz / 2) +
                  ") Hz, half the rate at most");
    return hz;
}

EmgFilters read_filters(const JsonCursor& json, double rate_hz) {
    EmgFilters filters;
    if (const auto v = json.find("envelope"); v && v->boolean()) {
        for (const char* key : {"band_pass_hz", "notch_hz"})
            if (const auto given = json.find(key)) given->fail("no such key beside \"envelope\"");
        filters = {.band_pass_hz = {}, .notch_hz = {}, .low_pass_hz = {}, .rectify = false};
    } else if (const auto band = json.find("band_pass_hz")) {
        const std::vector<JsonCursor> edges = band->items();
        if (edges.size() != 2) band->fail("[lowest, highest]");
        filters.band_pass_hz = {{frequency(edges[0], rate_hz), frequency(edges[1], rate_hz)}};
        if (filters.band_pass_hz->front() >= filters.band_pass_hz->back())
            band->fail("[lowest, highest]");
    } else if (filters.band_pass_hz->back() >= rate_hz / 2) {
        json.fail("\"band_pass_hz\" below " + format_number(rate_hz / 2) + " Hz, half the rate",
                  "none, which means up to " + format_number(filters.band_pass_hz->back()) + " Hz");
    }
    if (const auto v = json.find("notch_hz")) {
        if (v->is_array())
            for (const JsonCursor& item : v->items())
                filters.notch_hz.push_back(frequency(item, rate_hz));
        else
            filters.notch_hz.push_back(frequency(*v, rate_hz));
    }
    if (const auto v = json.find("low_pass_hz")) filters.low_pass_hz = frequency(*v, rate_hz);
    if (const auto v = json.find("order")) {
        filters.order = v->integer(2, 8);
        if (filters.order % 2 != 0) v->fail("an even order");
    }
    return filters;
}

int column_named(const JsonCursor& json, const Recording& recording) {
    const std::string name = json.string();
    const int column = recording.find(name);
    if (column >= 0) return column;
    std::string expected = "a column of " + recording.file().string() + ":";
    for (const std::string& known : recording.columns()) expected += " \"" + known + "\"";
    json.fail(expected, "\"" + name + "\"");
}

/// When the samples of a recording were taken.
struct Clock {
    double rate_hz = 0;
    double start_s = 0;           ///< of the first sample in the script's time
    std::vector<double> times_s;  ///< of every sample
};

Clock read_clock(const JsonCursor& json, const Recording& recording) {
    const auto rate = json.find("rate_hz"), time = json.find("time_column");
    if (rate.has_value() == time.has_value())
        json.fail("either \"rate_hz\" or \"time_column\"", rate ? "both" : "neither");
    const auto origin = json.find("time_origin");
    const bool from_first_row = origin && origin->one_of({"clock", "first_row"}) == "first_row";
    if (rate) {
        if (origin) origin->fail("no such key beside \"rate_hz\"");
        Clock clock{.rate_hz = rate->number({1, 1e6}), .start_s = 0, .times_s = {}};
        for (std::size_t i = 0; i < recording.sample_count(); ++i)
            clock.times_s.push_back(static_cast<double>(i) / clock.rate_hz);
        return clock;
    }
    const int column = column_named(*time, recording);
    Clock clock{
        .rate_hz = recording.rate_hz(column), .start_s = 0, .times_s = recording.samples(column)};
    if (!from_first_row) clock.start_s = clock.times_s.front();
    return clock;
}

/// A time for messages, rounded to a microsecond.
std::string seconds(double time_s) { return format_number(std::round(1e6 * time_s) / 1e6) + " s"; }

/// Throws Error when no sample lies within the script. Adds a note when the recording goes on after its end.
void check_within_script(const JsonCursor& json, const Recording& recording, double first_s,
                         double last_s, double duration_s, std::vector<std::string>& notes) {
    const std::string file = recording.file().string();
    if (first_s > duration_s || last_s < 0)
        json.fail(
            "a recording with samples in the script, which lasts from 0 to " + seconds(duration_s),
            file + " from " + seconds(first_s) + " to " + seconds(last_s) +
                "; \"time_origin\": \"first_row\" lets its first row be at 0 s");
    const double step_s = 1e-6 + (last_s - first_s) / static_cast<double>(recording.sample_count());
    if (last_s > duration_s + step_s)
        notes.push_back(file + ": lasts until " + seconds(last_s) +
                        ", after the end of the script at " + seconds(duration_s));
}

}  // namespace

EmgTracks read_emg(const JsonCursor& json, const ChannelTable& channels, double duration_s) {
    json.allow_keys({"file", "rate_hz", "time_column", "time_origin", "channels", "envelope",
                     "band_pass_hz", "notch_hz", "low_pass_hz", "order", "maximum",
                     "maximum_percentile", "rest_percentile", "delay_s"});
    const Recording recording = Recording::read_file(existing_file(json.at("file")));
    const Clock clock = read_clock(json, recording);
    const double rate_hz = clock.rate_hz;
    const EmgFilters filters = read_filters(json, rate_hz);
    const std::size_t shortest = signal::padding_of(filters, rate_hz) + 1;
    if (recording.sample_count() < std::max<std::size_t>(shortest, 2))
        throw Error(recording.file().string(),
                    std::to_string(std::max<std::size_t>(shortest, 2)) +
                        " samples or more for these filters",
                    std::to_string(recording.sample_count()));

    const auto number = [&](const char* key, double otherwise, Range range) {
        const auto value = json.find(key);
        return value ? value->number(range) : otherwise;
    };
    const double delay_s = number("delay_s", 0, {-3600, 3600});
    const double maximum_percentile = number("maximum_percentile", 100, {50, 100});
    const double rest_percentile = number("rest_percentile", 0, {0, 50});
    const auto maxima = json.find("maximum");
    if (maxima)
        for (const std::string& column : maxima->keys())
            if (recording.find(column) < 0)
                maxima->at(column).fail("a column of " + recording.file().string(),
                                        "\"" + column + "\"");

    EmgTracks out;
    const double start_s = clock.start_s + delay_s;
    check_within_script(json, recording, start_s,
                        start_s + static_cast<double>(recording.sample_count() - 1) / rate_hz,
                        duration_s, out.notes);
    const JsonCursor table = json.at("channels");
    for (const std::string& muscle : table.keys()) {
        const JsonCursor named = table.at(muscle);
        const MuscleFraction fraction = muscle_named(named, muscle, channels);
        const double min = channels.find(fraction.muscle)->min;
        const int column = column_named(named, recording);
        Recording::Bridged bridged = recording.bridged_samples(column, clock.times_s);
        for (std::string& note : bridged.notes)
            if (std::find(out.notes.begin(), out.notes.end(), note) == out.notes.end())
                out.notes.push_back(std::move(note));
        std::vector<double> samples =
            signal::emg_envelope(std::move(bridged.samples), rate_hz, filters);
        if (!std::all_of(samples.begin(), samples.end(), [](double v) { return std::isfinite(v); }))
            json.fail("filters and values whose envelope is finite",
                      "others (a frequency near 0?)");

        const double rest =
            rest_percentile > 0 ? signal::percentile(samples, rest_percentile) : 0.0;
        const auto given = maxima ? maxima->find(named.string()) : std::nullopt;
        const double maximum =
            given ? given->number() : signal::percentile(samples, maximum_percentile);
        if (!(maximum > rest))
            (given ? *given : named)
                .fail("a maximum above the envelope at rest, " + format_number(rest),
                      format_number(maximum));
        for (double& value : samples)
            value = min + (1 - min) * std::clamp((value - rest) / (maximum - rest), 0.0, 1.0);
        out.tracks.push_back({muscle, SampledCurve(std::move(samples), rate_hz, start_s),
                              expand(fraction, channels)});
    }
    if (out.tracks.empty()) table.fail("at least one muscle");
    return out;
}

}  // namespace risorius::track
