// SPDX-License-Identifier: MIT
#include "tools/bench/machine_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"
#include "risorius/core/version.h"

namespace risorius::bench {

namespace fs = std::filesystem;

namespace {

constexpr const char* kColumns = "date,version,benchmark,head,case,nodes,cores,quantity,value,unit";
constexpr const char* kPage = "page";
constexpr double kStep_ms = 1000 / 60.0, kFps = 30;
constexpr FileKind kBenchmarks{"a benchmark file", kMegabyte};

std::string size_of(const Json& picture) {
    return std::to_string(picture["width_px"].get<int>()) + " x " +
           std::to_string(picture["height_px"].get<int>());
}

/// Three digits at most, as a person reads them.
std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value < 10 ? "%.1f" : "%.0f", value);
    return text;
}

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
    return right ? blanks + text : text + blanks;
}

std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> out(1);
    for (const char c : line)
        if (c == ',')
            out.emplace_back();
        else
            out.back() += c;
    return out;
}

KnownMachine read_known_machine(const fs::path& file) {
    KnownMachine out{file.stem().string(), {}};
    const std::string text = read_text(file, kBenchmarks);
    for (TextLines lines(text); lines.next();) {
        const std::string place = file.string() + ":" + std::to_string(lines.number());
        if (lines.number() == 1) {
            if (lines.line() != kColumns)
                throw Error(place, std::string("the columns ") + kColumns,
                            "\"" + std::string(lines.line()) + "\"");
            continue;
        }
        const std::vector<std::string> cells = cells_of(lines.line());
        if (cells.size() != 10) throw Error(place, "10 columns", std::to_string(cells.size()));
        if (cells[2] != kPage) continue;
        char* end = nullptr;
        const double value = std::strtod(cells[8].c_str(), &end);
        if (cells[8].empty() || *end != 0 || !std::isfinite(value))
            throw Error(place, "a number in the column value", "\"" + cells[8] + "\"");
        out.rows.push_back({.label = "",
                            .head = cells[3],
                            .what = cells[4],
                            .quantity = cells[7],
                            .unit = cells[9],
                            .cores = std::atoi(cells[6].c_str()),
                            .value = value});
    }
    return out;
}

std::optional<double> value_of(const KnownMachine& machine, const PageRow& row) {
    for (const PageRow& known : machine.rows)
        if (known.head == row.head && known.what == row.what && known.quantity == row.quantity &&
            known.unit == row.unit)
            return known.value;
    return {};
}

/// The table: this machine in the first column, then those that know at least one of its numbers.
void add_table(const std::vector<PageRow>& rows, const std::vector<KnownMachine>& known,
               std::string& page) {
    std::size_t first = 0;
    for (const PageRow& row : rows) first = std::max(first, row.label.size());
    std::vector<const KnownMachine*> columns;
    for (const KnownMachine& machine : known)
        if (std::any_of(rows.begin(), rows.end(),
                        [&](const PageRow& row) { return value_of(machine, row).has_value(); }))
            columns.push_back(&machine);
    page += padded("", first, false) + "  " + padded("this machine", 14, true);
    for (const KnownMachine* machine : columns)
        page += "  " + padded(machine->name, std::max<std::size_t>(machine->name.size(), 8), true);
    page += "\n";
    for (const PageRow& row : rows) {
        page += padded(row.label, first, false) + "  " +
                padded(short_number(row.value) + " " + row.unit, 14, true);
        for (const KnownMachine* machine : columns) {
            const std::optional<double> value = value_of(*machine, row);
            page += "  " + padded(value ? short_number(*value) : "-",
                                  std::max<std::size_t>(machine->name.size(), 8), true);
        }
        page += "\n";
    }
}

/// Frames per second of a size, with or without a draft.
struct Speed {
    std::string size;
    double usual_fps = 0, draft_fps = 0;
    int pixels = 0;
};

std::vector<Speed> speeds_of(const Json& pictures) {
    std::vector<Speed> out;
    for (const Json& one : pictures) {
        const std::string size = size_of(one);
        auto at = std::find_if(out.begin(), out.end(),
                               [&](const Speed& speed) { return speed.size == size; });
        if (at == out.end())
            at = out.insert(at,
                            {size, 0, 0, one["width_px"].get<int>() * one["height_px"].get<int>()});
        (one["draft"].get<bool>() ? at->draft_fps : at->usual_fps) = one["fps"].get<double>();
    }
    std::sort(out.begin(), out.end(),
              [](const Speed& a, const Speed& b) { return a.pixels < b.pixels; });
    return out;
}

/// The largest size below `pixels` that reaches the rate; empty when none does.
std::string smaller_size(const std::vector<Speed>& speeds, int pixels, bool draft) {
    std::string found;
    for (const Speed& speed : speeds)
        if (speed.pixels < pixels && (draft ? speed.draft_fps : speed.usual_fps) >= kFps)
            found = speed.size;
    return found;
}

std::string as_option(const std::string& size) {
    std::string out = "--size ";
    for (const char c : size)
        if (c != ' ') out += c;
    return out;
}

/// What to change for videos of 30 frames per second.
void add_videos(const std::vector<Speed>& speeds, std::string& page) {
    page += "\nA video of 30 frames per second, as fast as it plays:\n";
    for (const Speed& speed : speeds) {
        page += "  " + padded(speed.size, 12, false);
        if (speed.usual_fps >= kFps) {
            page += "yes\n";
            continue;
        }
        page += "no, " + short_number(speed.usual_fps) + " frames per second";
        if (speed.draft_fps >= kFps) page += "; yes with --draft";
        const std::string usual = smaller_size(speeds, speed.pixels, false),
                          draft = smaller_size(speeds, speed.pixels, true);
        if (!usual.empty())
            page += "; yes with " + as_option(usual);
        else if (speed.draft_fps < kFps && !draft.empty())
            page += "; yes with " + as_option(draft) + " --draft";
        else if (speed.draft_fps < kFps)
            page += "; " + short_number(speed.draft_fps) + " with --draft";
        page += "\n";
    }
}

void add_stages(const Json& pictures, std::string& page) {
    const Json* found = nullptr;
    for (const Json& one : pictures)
        if (one["width_px"] == 1024 && !one["draft"].get<bool>()) found = &one;
    if (!found) return;
    const double drawing =
        (*found)["draw_ms"].get<double>() + (*found)["read_back_ms"].get<double>();
    const double all = drawing + (*found)["simulate_ms"].get<double>() +
                       (*found)["measure_ms"].get<double>() + (*found)["encode_ms"].get<double>();
    char text[160];
    std::snprintf(text, sizeof text,
                  "  Of a frame of 1024 x 1024, drawing takes %.0f %% of the processor time. A "
                  "graphics processor takes it over with --gl egl.\n",
                  100 * drawing / all);
    page += text;
}

/// Which qualities follow a hand in real time.
void add_steps(const Json& rig, std::string& page) {
    page += "\nA face that is moved live needs a step of 1/60 s in less than 16.7 ms:\n";
    for (const char* quality : {"preview", "video", "fine"}) {
        const double ms = rig[quality]["step_ms"].get<double>();
        page += "  " + padded(quality, 12, false) + (ms < kStep_ms ? "yes" : "no") + ", " +
                short_number(ms) + " ms\n";
    }
    if (rig["preview"]["step_ms"].get<double>() >= kStep_ms)
        page += "  Its rig is lighter with bundles of fibres in place of volume muscles.\n";
}

void add_sets(const Json& report, std::string& page) {
    const int cores = report["machine"]["cores"].get<int>();
    page += "\nSets of clips: --workers " + std::to_string(cores) +
            ", one for each core. A cluster shares them out with --engine slurm.\n";
}

}  // namespace

std::vector<PageRow> page_rows(const Json& report) {
    std::vector<PageRow> rows;
    const Json& rigs = report["rigs"];
    if (rigs.empty() || !rigs.front().contains("preview")) return rows;
    const Json& rig = rigs.front();
    const std::string head = rig["name"].get<std::string>();
    const int cores = report["machine"]["cores"].get<int>();
    const auto add = [&](const std::string& label, const std::string& what, const char* quantity,
                         const char* unit, int used_cores, double value) {
        rows.push_back({label, head, what, quantity, unit, used_cores, value});
    };
    for (const char* quality : {"preview", "video", "fine"})
        add(std::string("a step of 1/60 s, ") + quality + ", one core", quality, "step", "ms", 1,
            rig[quality]["step_ms"].get<double>());
    add("a frame of 52 blend shapes, one core", "blend shapes", "frame", "ms", 1,
        rig["blend_shapes"]["frame_ms"].get<double>());
    add("building the face", "preview", "build", "s", 1, rig["preview"]["build_s"].get<double>());
    for (const Json& one : rig["pictures"]) {
        const std::string what = size_of(one) + (one["draft"].get<bool>() ? " draft" : "");
        add("a video of " + what + ", all cores", what, "frames_per_second", "1/s", cores,
            one["fps"].get<double>());
    }
    return rows;
}

std::vector<KnownMachine> read_known_machines(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".csv") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<KnownMachine> out;
    for (const fs::path& file : files) out.push_back(read_known_machine(file));
    return out;
}

std::string machine_page(const Json& report, const std::vector<KnownMachine>& known) {
    const std::vector<PageRow> rows = page_rows(report);
    std::string page;
    if (rows.empty()) return page;
    const Json& rig = report["rigs"].front();
    page += report["machine"]["cpu"].get<std::string>() + ", " +
            std::to_string(report["machine"]["cores"].get<int>()) + " cores, with the head \"" +
            rig["name"].get<std::string>() + "\"\n\n";
    add_table(rows, known, page);
    add_videos(speeds_of(rig["pictures"]), page);
    add_stages(rig["pictures"], page);
    add_steps(rig, page);
    add_sets(report, page);
    return page;
}

std::string benchmark_file(const Json& report, const std::string& month) {
    std::string out = std::string(kColumns) + "\n";
    const std::vector<PageRow> rows = page_rows(report);
    for (const PageRow& row : rows)
        out += month + "," + kVersion + "," + kPage + "," + row.head + "," + row.what + ",," +
               std::to_string(row.cores) + "," + row.quantity + "," + short_number(row.value) +
               "," + row.unit + "\n";
    return out;
}

}  // namespace risorius::bench
