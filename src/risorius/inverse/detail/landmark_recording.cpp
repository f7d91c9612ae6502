// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/landmark_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/known_names.h"
#include "risorius/core/read_file.h"
#include "risorius/inverse/detail/landmark_sets.h"
#include "risorius/motion/json_results.h"
#include "risorius/signal/recording.h"

namespace risorius::inverse {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kLandmarkFile{"recorded landmarks", 2000 * kMegabyte};
constexpr std::size_t kFewest = 4;

/// The numbers of one point over time; NaN where it is missing.
struct PointTrack {
    std::array<std::vector<double>, 3> xyz;  ///< z is empty when there is no depth
    std::vector<double> confidence;          ///< empty: 1
};

/// Puts numbers that are missing on a straight line between their neighbours in time. They have no confidence.
void bridge(const std::vector<double>& times_s, std::vector<double>& values) {
    std::optional<std::size_t> last;
    for (std::size_t t = 0; t <= values.size(); ++t) {
        if (t < values.size() && !std::isfinite(values[t])) continue;
        const std::size_t first = last ? *last + 1 : 0;
        for (std::size_t i = first; i < t; ++i)
            values[i] = !last && t == values.size() ? 0
                        : !last                     ? values[t]
                        : t == values.size()        ? values[*last]
                                                    : values[*last] + (values[t] - values[*last]) *
                                                                   (times_s[i] - times_s[*last]) /
                                                                   (times_s[t] - times_s[*last]);
        last = t;
    }
}

/// Landmarks of a rig from the points of a set.
LandmarkRecording of_set(const LandmarkSet& set, const std::vector<double>& times_s,
                         std::map<int, PointTrack> points, const std::vector<std::string>& ids,
                         const std::string& place) {
    LandmarkRecording out;
    out.set = set.name;
    out.times_s = times_s;
    out.flat = std::any_of(points.begin(), points.end(),
                           [](const auto& one) { return one.second.xyz[2].empty(); });
    for (auto& [number, track] : points) {
        if (track.confidence.empty()) track.confidence.assign(times_s.size(), 1);
        for (std::size_t t = 0; t < times_s.size(); ++t)
            if (!std::isfinite(track.xyz[0][t]) || !std::isfinite(track.xyz[1][t]) ||
                (!out.flat && !std::isfinite(track.xyz[2][t])) ||
                !std::isfinite(track.confidence[t]))
                track.confidence[t] = 0;
        for (std::vector<double>& values : track.xyz) bridge(times_s, values);
    }
    std::vector<const SetPoint*> used;
    for (const SetPoint& one : set.landmarks)
        if (points.count(one.points[0]) && points.count(one.points[1]) &&
            std::find(ids.begin(), ids.end(), one.landmark) != ids.end())
            used.push_back(&one);
    if (used.size() < kFewest)
        throw Error(place, "at least four points of " + out.set + " that are landmarks of the rig",
                    std::to_string(used.size()));
    out.at.assign(times_s.size(), Points::Zero(static_cast<long>(used.size()), 3));
    out.confidence.resize(static_cast<long>(used.size()), static_cast<long>(times_s.size()));
    for (std::size_t i = 0; i < used.size(); ++i) {
        const auto row = static_cast<long>(i);
        out.ids.emplace_back(used[i]->landmark);
        const PointTrack &a = points.at(used[i]->points[0]), &b = points.at(used[i]->points[1]);
        for (std::size_t t = 0; t < times_s.size(); ++t) {
            out.confidence(row, static_cast<long>(t)) =
                std::clamp(std::min(a.confidence[t], b.confidence[t]), 0.0, 1.0);
            for (std::size_t k = 0; k < (out.flat ? 2u : 3u); ++k)
                out.at[t](row, static_cast<long>(k)) = 0.5 * (a.xyz[k][t] + b.xyz[k][t]);
        }
    }
    return out;
}

void check_times(const std::vector<double>& times_s, const std::string& place) {
    for (std::size_t t = 1; t < times_s.size(); ++t)
        if (times_s[t] <= times_s[t - 1])
            throw Error(place, "times that rise from row to row",
                        format_number(times_s[t]) + " s after " + format_number(times_s[t - 1]));
}

class Table {
  public:
    explicit Table(const fs::path& file)
        : table_(signal::Recording::read_file(file)), place_(file.string()) {
        int time = table_.find("time_s");
        if (time < 0) time = table_.find("timestamp");
        if (time < 0) throw Error(place_, "a column time_s", "none");
        times_s_ = table_.samples(time);
        check_times(times_s_, place_);
        // For all points of a frame
        for (const char* name : {"confidence", "success"})
            if (const int column = table_.find(name); column >= 0) {
                const std::vector<double> values = table_.samples_or_nan(column);
                all_.resize(values.size(), 1);
                for (std::size_t t = 0; t < values.size(); ++t) all_[t] *= values[t];
            }
    }

    LandmarkRecording read(const std::vector<std::string>& ids) const {
        for (const LandmarkSet* set : {&mediapipe_points(), &face68_points()}) {
            std::map<int, PointTrack> points;
            for (const SetPoint& one : set->landmarks)
                for (const int number : one.points) add(*set, number, points);
            if (!points.empty() && !times_s_.empty())
                return of_set(*set, times_s_, std::move(points), ids, place_);
        }
        return of_rig(ids);
    }

  private:
    std::vector<double> confidence_of(const std::string& id) const {
        const int column = table_.find(id + ".confidence");
        if (column < 0) return all_;
        std::vector<double> out = table_.samples_or_nan(column);
        for (std::size_t t = 0; t < all_.size(); ++t) out[t] *= all_[t];
        return out;
    }

    /// Adds a point of a set if the table has it, under the name of the set or as OpenFace writes it.
    void add(const LandmarkSet& set, int number, std::map<int, PointTrack>& points) const {
        if (points.count(number)) return;
        const std::string digits = std::to_string(number),
                          id = std::string(set.name) + "_" + digits;
        std::vector<std::array<std::string, 3>> spellings{{id + ".x", id + ".y", id + ".z"}};
        if (set.count == face68_points().count) {
            spellings.push_back({"X_" + digits, "Y_" + digits, "Z_" + digits});
            spellings.push_back({"x_" + digits, "y_" + digits, ""});
        }
        for (const auto& names : spellings) {
            PointTrack track;
            int found = 0;
            for (std::size_t k = 0; k < 3; ++k)
                if (const int column = names[k].empty() ? -1 : table_.find(names[k]); column >= 0) {
                    track.xyz[k] = table_.samples_or_nan(column);
                    ++found;
                }
            if (found == 0) continue;
            if (track.xyz[0].empty() || track.xyz[1].empty())
                throw Error(place_, "the columns " + names[0] + " and " + names[1],
                            "only one of them");
            track.confidence = confidence_of(id);
            points.emplace(number, std::move(track));
            return;
        }
    }

    LandmarkRecording of_rig(const std::vector<std::string>& ids) const {
        LandmarkRecording out;
        out.set = "rig";
        out.times_s = times_s_;
        std::vector<std::array<std::vector<double>, 3>> numbers;
        std::vector<std::vector<double>> confidence;
        for (const std::string& id : ids) {
            std::array<int, 3> columns{};
            int found = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                columns[k] = table_.find(id + "." + "xyz"[k] + "_mm");
                found += columns[k] >= 0;
            }
            if (found == 0) continue;
            if (found < 3)
                throw Error(place_, "the columns " + id + ".x_mm, .y_mm and .z_mm",
                            "only some of them");
            out.ids.push_back(id);
            confidence.push_back(confidence_of(id));
            auto& of = numbers.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                signal::Recording::Bridged bridged = table_.bridged_samples(columns[k], times_s_);
                of[k] = std::move(bridged.samples);
                out.notes.insert(out.notes.end(), bridged.notes.begin(), bridged.notes.end());
            }
        }
        if (out.ids.size() < kFewest || times_s_.empty())
            throw Error(place_,
                        "rows of at least four landmarks, as prn.x_mm, prn.y_mm, prn.z_mm or "
                        "mediapipe_4.x, mediapipe_4.y, mediapipe_4.z",
                        times_s_.empty() ? "no rows" : std::to_string(out.ids.size()) + " of them");
        const auto count = static_cast<long>(out.ids.size());
        out.confidence = Eigen::MatrixXd::Ones(count, static_cast<long>(times_s_.size()));
        for (std::size_t t = 0; t < times_s_.size(); ++t) {
            Points& at = out.at.emplace_back(count, 3);
            for (std::size_t i = 0; i < out.ids.size(); ++i) {
                const auto row = static_cast<long>(i);
                for (std::size_t k = 0; k < 3; ++k)
                    at(row, static_cast<long>(k)) = 1e-3 * numbers[i][k][t];
                if (!confidence[i].empty())
                    out.confidence(row, static_cast<long>(t)) =
                        std::isfinite(confidence[i][t]) ? std::clamp(confidence[i][t], 0.0, 1.0)
                                                        : 0;
            }
        }
        return out;
    }

    signal::Recording table_;
    std::string place_;
    std::vector<double> times_s_, all_;
};

LandmarkRecording read_mediapipe_json(const fs::path& file, const std::vector<std::string>& ids,
                                      const std::array<int, 2>& picture_px) {
    const std::string place = file.string();
    const Vec3 size(picture_px[0], picture_px[1], picture_px[0]);
    std::map<int, PointTrack> points;
    std::vector<double> times_s;
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    const auto enlarge = [&](PointTrack& track) {
        for (std::vector<double>& values : track.xyz) values.resize(times_s.size(), kMissing);
        track.confidence.resize(times_s.size(), 1);
    };
    for (const JsonCursor& result :
         motion::json_results(file, kLandmarkFile, {"frames", "results"})) {
        const auto time = motion::any_key_of(result, {"timestampMs", "timestamp_ms", "timestamp"});
        if (!time) result.fail("the time \"timestampMs\"", "none");
        times_s.push_back(1e-3 * time->number());
        const auto faces = motion::any_key_of(result, {"faceLandmarks", "face_landmarks"});
        const std::vector<JsonCursor> listed = faces ? faces->items() : std::vector<JsonCursor>{};
        if (listed.empty()) continue;
        const std::vector<JsonCursor> face = listed[0].items();
        for (const SetPoint& one : mediapipe_points().landmarks)
            for (const int number : one.points) {
                if (static_cast<std::size_t>(number) >= face.size())
                    listed[0].fail("at least 468 points", std::to_string(face.size()));
                const JsonCursor& at = face[static_cast<std::size_t>(number)];
                PointTrack& track = points[number];
                enlarge(track);
                for (std::size_t k = 0; k < 3; ++k)
                    track.xyz[k].back() =
                        size[static_cast<long>(k)] * at.at(std::string(1, "xyz"[k])).number();
                // Face meshes write 0 for what they do not know.
                for (const char* key : {"visibility", "presence"})
                    if (const auto sure = at.find(key);
                        sure && !sure->json().is_null() && sure->number() > 0)
                        track.confidence.back() *= sure->number();
            }
    }
    // Told last, so that another file is not taken for one of MediaPipe that only lacks its size.
    if (picture_px[0] <= 0 || picture_px[1] <= 0)
        throw Error(option_name("picture"),
                    "the size of the picture, as 1280x720, since MediaPipe writes shares of its "
                    "width and height",
                    "none");
    check_times(times_s, place);
    for (auto& [number, track] : points) enlarge(track);
    return of_set(mediapipe_points(), times_s, std::move(points), ids, place);
}

}  // namespace

LandmarkRecording read_landmark_recording(const fs::path& file, const std::vector<std::string>& ids,
                                          const std::array<int, 2>& picture_px) {
    const std::string ending = file.extension().string();
    if (ending == ".json" || ending == ".jsonl") return read_mediapipe_json(file, ids, picture_px);
    return Table(file).read(ids);
}

}  // namespace risorius::inverse
