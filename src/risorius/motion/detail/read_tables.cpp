// SPDX-License-Identifier: MIT
// Tables: Live Link Face, OpenFace 2, py-feat.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/text_lines.h"
#include "risorius/motion/detail/motion_readers.h"

namespace risorius::motion::detail {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '"')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '"')) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> out;
    for (std::size_t begin = 0;;) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        out.push_back(trimmed(line.substr(begin, end - begin)));
        if (end == line.size()) return out;
        begin = end + 1;
    }
}

/// A table with commas. Columns are found by name, without regard to case.
class Table {
  public:
    explicit Table(const std::filesystem::path& file)
        : file_(file.string()), text_(read_text(file, kMotionFile)) {
        for (TextLines lines(text_); lines.next();) {
            if (trimmed(lines.line()).empty()) continue;
            std::vector<std::string_view> cells = cells_of(lines.line());
            if (names_.empty()) {
                for (const std::string_view cell : cells) names_.emplace_back(cell);
                for (std::size_t i = 0; i < names_.size(); ++i)
                    column_.try_emplace(lower_case(names_[i]), i);
                continue;
            }
            // A recording that was stopped may end within a line.
            if (cells.size() != names_.size()) {
                if (cells.size() > names_.size() || has_short_line_)
                    throw Error(file_ + ": line " + std::to_string(lines.number()),
                                std::to_string(names_.size()) + " cells, as the header has",
                                std::to_string(cells.size()));
                has_short_line_ = true;
                continue;
            }
            if (has_short_line_)
                throw Error(file_ + ": line " + std::to_string(lines.number() - 1),
                            std::to_string(names_.size()) + " cells, as the header has", "fewer");
            rows_.push_back(std::move(cells));
            numbers_.push_back(lines.number());
        }
    }
    std::size_t size() const { return rows_.size(); }
    bool has_short_line() const { return has_short_line_; }
    const std::vector<std::string>& names() const { return names_; }
    bool has(const std::string& name) const { return column_.contains(lower_case(name)); }
    std::string place(std::size_t row, const std::string& name) const {
        return file_ + ": line " + std::to_string(numbers_[row]) + ", column " + name;
    }
    std::string_view text(std::size_t row, const std::string& name) const {
        const auto found = column_.find(lower_case(name));
        return found == column_.end() ? std::string_view() : rows_[row][found->second];
    }
    /// The number in a cell; NaN for an empty one and for a missing column.
    double at(std::size_t row, const std::string& name) const {
        const std::string_view cell = text(row, name);
        if (cell.empty() || lower_case(cell) == "nan") return kNone;
        double value = 0;
        const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (problem != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
            throw Error(place(row, name), "a number", in_quotes(std::string(cell)));
        return value;
    }

  private:
    std::string file_, text_;
    std::vector<std::string> names_;
    std::map<std::string, std::size_t> column_;
    std::vector<std::vector<std::string_view>> rows_;
    std::vector<std::size_t> numbers_;
    bool has_short_line_ = false;
};

/// A timecode HH:MM:SS:FF.fff, or a plain number.
struct Timecode {
    int hours = 0, minutes = 0, seconds = 0;
    double frames = 0;
    bool is_plain = false, drops = false;
    double plain = 0;
};

Timecode read_timecode(const Table& table, std::size_t row) {
    const std::string cell(table.text(row, "Timecode"));
    Timecode out;
    out.drops = cell.find(';') != std::string::npos;
    std::vector<double> parts;
    const char* at = cell.data();
    const char* const end = at + cell.size();
    while (at != end) {
        double value = 0;
        const auto [after, problem] = std::from_chars(at, end, value);
        if (problem != std::errc() || !(value >= 0) ||
            (after != end && *after != ':' && *after != ';'))
            break;
        parts.push_back(value);
        at = after == end ? end : after + 1;
    }
    if (at == end && parts.size() == 1) {
        out.is_plain = true;
        out.plain = parts[0];
        return out;
    }
    // Hours, minutes, seconds, frames
    constexpr double kMost[] = {24, 60, 60, 1000};
    bool whole = at == end && parts.size() == 4;
    for (std::size_t i = 0; whole && i < 4; ++i) whole = parts[i] < kMost[i];
    if (!whole)
        throw Error(table.place(row, "Timecode"), "a time HH:MM:SS:FF.fff, or a number",
                    in_quotes(cell));
    out.hours = static_cast<int>(parts[0]);
    out.minutes = static_cast<int>(parts[1]);
    out.seconds = static_cast<int>(parts[2]);
    out.frames = parts[3];
    return out;
}

/// The number of a frame since midnight. Drop-frame codes skip 2 numbers (4 at 59.94) at each minute that ten does not divide.
double frame_of(const Timecode& code, int whole_rate) {
    const int minutes = 60 * code.hours + code.minutes;
    double frame = (60.0 * minutes + code.seconds) * whole_rate + code.frames;
    if (code.drops) frame -= (whole_rate == 60 ? 4 : 2) * (minutes - minutes / 10);
    return frame;
}

/// Times of rows from their timecodes; `fps` becomes the rate. Frames that repeat their timecode keep their order.
std::vector<double> times_of(const Table& table, double& fps, RecordedMotion& motion) {
    std::vector<Timecode> codes;
    double largest = 0;
    for (std::size_t row = 0; row < table.size(); ++row) {
        codes.push_back(read_timecode(table, row));
        largest = std::max(largest, codes.back().frames);
    }
    std::vector<double> out;
    if (!codes.empty() && codes.front().is_plain) {
        // Numbers of frames rise by about one, times in milliseconds by more.
        double step = kInfinity;
        for (std::size_t i = 1; i < codes.size(); ++i)
            step = std::min(step, codes[i].plain - codes[i - 1].plain);
        const bool is_ms = codes.size() > 1 && step > 4;
        if (fps <= 0) fps = is_ms ? 0 : 60;
        motion.notes.push_back(is_ms ? "the times are taken as milliseconds"
                                     : "the times are taken as numbers of frames, " +
                                           format_number(fps) + " of them a second");
        for (const Timecode& code : codes)
            out.push_back(is_ms ? 1e-3 * code.plain : code.plain / fps);
        return out;
    }
    constexpr double kRates[] = {24, 25, 30, 50, 60, 120, 240};
    if (fps <= 0) {
        for (const double rate : kRates)
            if (fps <= 0 && largest < rate) fps = rate;
        // Drop-frame codes exist for these rates alone.
        if (!codes.empty() && codes.front().drops) fps = largest < 30 ? 30 / 1.001 : 60 / 1.001;
        motion.notes.push_back("the file does not say its rate; taken from its frame numbers: " +
                               format_number(std::round(1e3 * fps) / 1e3) + " frames a second");
    }
    const int whole_rate = static_cast<int>(std::lround(fps));
    const double day_frames = 24.0 * 3600 * whole_rate;
    // The fraction of a frame does not run evenly, so that whole frames are the better times. Only where several samples have
    // the same frame is it needed.
    bool whole = true;
    for (std::size_t i = 1; i < codes.size(); ++i)
        whole = whole && std::floor(frame_of(codes[i], whole_rate)) !=
                             std::floor(frame_of(codes[i - 1], whole_rate));
    double before = -1, days = 0;
    for (const Timecode& code : codes) {
        double frame = frame_of(code, whole_rate) + days;
        if (whole) frame = std::floor(frame);
        if (frame < before - day_frames / 2) {  // past midnight
            days += day_frames;
            frame += day_frames;
        }
        out.push_back(frame / fps);
        before = frame;
    }
    return out;
}

std::string unit_of(const std::string& digits) {
    return "AU" + std::to_string(std::atoi(digits.c_str()));
}

}  // namespace

RecordedMotion read_live_link(const std::filesystem::path& file, double fps) {
    const Table table(file);
    MotionBuilder out;
    const std::vector<double> times = times_of(table, fps, out.motion());
    constexpr std::pair<const char*, const char*> kAngles[] = {
        {"HeadYaw", "head_yaw_deg"},          {"HeadPitch", "head_pitch_deg"},
        {"HeadRoll", "head_roll_deg"},        {"LeftEyeYaw", "gaze_yaw_deg.l"},
        {"LeftEyePitch", "gaze_pitch_deg.l"}, {"RightEyeYaw", "gaze_yaw_deg.r"},
        {"RightEyePitch", "gaze_pitch_deg.r"}};
    std::vector<std::pair<std::string, std::string>> shapes;
    for (const std::string& name : table.names()) {
        const std::string folded = lower_case(name);
        if (folded == "timecode" || folded == "blendshapecount" || folded.ends_with("eyeroll"))
            continue;
        if (const std::string shape = arkit_spelling(name); !shape.empty())
            shapes.emplace_back(name, shape);
        else if (std::none_of(std::begin(kAngles), std::end(kAngles),
                              [&](const auto& angle) { return lower_case(angle.first) == folded; }))
            out.unmapped(name);
    }
    for (std::size_t row = 0; row < table.size(); ++row) {
        // Some programs leave the cells empty where there was no face.
        const bool seen = std::all_of(shapes.begin(), shapes.end(), [&](const auto& shape) {
            return !std::isnan(table.at(row, shape.first));
        });
        out.begin(times[row], seen);
        if (!seen) continue;
        for (const auto& [column, shape] : shapes) out.set(shape, table.at(row, column));
        for (const auto& [column, channel] : kAngles)
            if (const double angle = table.at(row, column); !std::isnan(angle))
                out.set(channel, kDegree * angle);
    }
    if (table.has_short_line())
        out.motion().notes.push_back("the last line is cut off and left out");
    return out.finish(file.string(), "livelink", fps);
}

RecordedMotion read_openface(const std::filesystem::path& file) {
    const Table table(file);
    MotionBuilder out;
    struct Unit {
        std::string intensity, presence, channel;
    };
    std::vector<Unit> units;
    for (const std::string& name : table.names())
        if (name.size() == 6 && name.starts_with("AU") && name.ends_with("_r"))
            units.push_back({name, name.substr(0, 5) + "c", unit_of(name.substr(2, 2))});
        else if (name == "AU28_c")  // has a presence alone
            units.push_back({"", name, "AU28"});
    const double face = table.size() > 0 ? table.at(0, "face_id") : 0;
    bool others = false;
    for (std::size_t row = 0; row < table.size(); ++row) {
        if (table.has("face_id") && table.at(row, "face_id") != face) {
            others = true;
            continue;
        }
        const bool seen = !table.has("success") || table.at(row, "success") == 1;
        out.begin(table.at(row, "timestamp"), seen);
        if (!seen) continue;
        for (const Unit& unit : units) {
            const double there = table.at(row, unit.presence);
            const double value = unit.intensity.empty() ? there : table.at(row, unit.intensity) / 5;
            if (!std::isnan(value)) out.set(unit.channel, there == 0 ? 0.0 : value);
        }
        std::array<double, 3> head{};
        if (table.has("pose_Rx")) {
            // The camera has x to the right, y down and z away.
            head = {-kDegree * table.at(row, "pose_Ry"), -kDegree * table.at(row, "pose_Rx"),
                    kDegree * table.at(row, "pose_Rz")};
            out.set_head(head);
        }
        if (table.has("gaze_angle_x")) {
            // Gaze is seen from the camera. Down is positive.
            const double yaw = kDegree * table.at(row, "gaze_angle_x") - head[0],
                         pitch = -kDegree * table.at(row, "gaze_angle_y") - head[1];
            for (const char* side : {".l", ".r"}) {
                out.set(std::string("gaze_yaw_deg") + side, yaw);
                out.set(std::string("gaze_pitch_deg") + side, pitch);
            }
        }
    }
    if (others) out.motion().notes.push_back("the first face is taken; the file has others");
    out.motion().notes.push_back("action units have no sides in this format");
    return out.finish(file.string(), "openface", 0);
}

RecordedMotion read_pyfeat(const std::filesystem::path& file, double fps) {
    const Table table(file);
    MotionBuilder out;
    if (fps <= 0) {
        fps = 30;
        out.motion().notes.push_back(
            "the file has no times; taken as 30 frames of the film a second");
    }
    std::vector<std::pair<std::string, std::string>> units;
    for (const std::string& name : table.names())
        if (name.size() == 4 && name.starts_with("AU"))
            units.emplace_back(name, unit_of(name.substr(2)));
    if (units.empty()) throw Error(file.string(), "columns of action units, as AU01", "none");
    for (std::size_t row = 0; row < table.size(); ++row) {
        const double frame = table.at(row, "frame");
        // Several faces in one frame: the first is taken.
        if (out.size() > 0 && frame / fps == out.motion().times_s.back()) continue;
        bool seen = false;
        for (const auto& [column, unit] : units) seen |= !std::isnan(table.at(row, column));
        out.begin(table.has("frame") ? frame / fps : static_cast<double>(row) / fps, seen);
        if (!seen) continue;
        for (const auto& [column, unit] : units)
            if (const double value = table.at(row, column); !std::isnan(value))
                out.set(unit, value);
        std::array<double, 3> head{};
        constexpr const char* kTurns[] = {"Yaw", "Pitch", "Roll"};
        for (std::size_t k = 0; k < 3; ++k)
            if (const double turn = table.at(row, kTurns[k]); !std::isnan(turn)) head[k] = turn;
        out.set_head(head);
    }
    out.motion().notes.push_back("action units have no sides in this format");
    return out.finish(file.string(), "pyfeat", 0);
}

}  // namespace risorius::motion::detail
