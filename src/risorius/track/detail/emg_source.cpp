// SPDX-License-Identifier: MIT
#include "risorius/track/detail/emg_source.h"

#include <algorithm>
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

/// Reads the rate, Hz, and the start of the recording, s.
std::pair<double, double> read_clock(const JsonCursor& json, const Recording& recording) {
    const auto rate = json.find("rate_hz"), time = json.find("time_column");
    if (rate.has_value() == time.has_value())
        json.fail("either \"rate_hz\" or \"time_column\"", rate ? "both" : "neither");
    if (rate) return {rate->number({1, 1e6}), 0};
    const int column = column_named(*time, recording);
    const double rate_hz = recording.rate_hz(column);
    return {rate_hz, recording.samples(column).front()};
}

}  // namespace

std::vector<EmgTrack> read_emg(const JsonCursor& json, const ChannelTable& channels) {
    json.allow_keys({"file", "rate_hz", "time_column", "channels", "envelope", "band_pass_hz",
                     "notch_hz", "low_pass_hz", "order", "maximum", "maximum_percentile",
                     "rest_percentile", "delay_s"});
    const Recording recording = Recording::read_file(existing_file(json.at("file")));
    const auto [rate_hz, start_s] = read_clock(json, recording);
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

    std::vector<EmgTrack> tracks;
    const JsonCursor table = json.at("channels");
    for (const std::string& muscle : table.keys()) {
        const JsonCursor named = table.at(muscle);
        const MuscleFraction fraction = muscle_named(named, muscle, channels);
        const double min = channels.find(fraction.muscle)->min;
        const int column = column_named(named, recording);
        std::vector<double> samples =
            signal::emg_envelope(recording.samples(column), rate_hz, filters);

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
        tracks.push_back({muscle, SampledCurve(std::move(samples), rate_hz, start_s + delay_s),
                          expand(fraction, channels)});
    }
    if (tracks.empty()) table.fail("at least one muscle");
    return tracks;
}

}  // namespace risorius::track
