// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/aois.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/scene/face_oval.h"
#include "risorius/stimuli/detail/clip_pictures.h"
#include "risorius/stimuli/detail/mirrored_rows.h"

namespace risorius::stimuli {

namespace {

constexpr double kBrow = 0.03;        // half of the band, of the width of the face
constexpr double kMitre = 2;          // longest way of a corner / margin
constexpr double kKeyFrame_px = 0.5;  // a smaller way needs no key frame
constexpr std::array kColours{"#e6194b", "#3cb44b", "#4363d8", "#f58231",
                              "#911eb4", "#008080", "#808000"};

using Polygon = std::vector<Vec2>;

/// Positive for corners that go clockwise as seen: v points down.
double signed_area(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += a.x() * b.y() - b.x() * a.y();
    }
    return sum / 2;
}

/// The landmarks of an area, clockwise in a picture of the front; of the left side for eyes and brows.
std::vector<std::string> ids_of(const std::string& name) {
    std::vector<std::string> ids;
    const auto words = [&](const char* text) {
        std::istringstream in(text);
        for (std::string id; in >> id;) ids.push_back(id);
    };
    if (name == "nose") words("n al_l ac_l sbal_l sn sbal_r ac_r al_r");
    if (name == "mouth") words("ch_r ulc_r cph_r ls cph_l ulc_l ch_l llc_l li llc_r");
    if (name.starts_with("eye")) words("en_l ulm_l ps_l ull_l ex_l lll_l pi_l llm_l");
    if (name.starts_with("brow")) words("bm_l bc_l bp_l bl_l");
    if (name.ends_with("_r")) {
        std::reverse(ids.begin(), ids.end());
        for (std::string& id : ids) id = other_side(id);
    }
    return ids;
}

Polygon ungrown(const animate::FrameRows& rows, int frame, const std::string& name,
                double face_px) {
    Polygon points;
    const bool face = name == "face";
    for (const std::string& id : face ? scene::FaceOval::landmarks() : ids_of(name)) {
        const int column = rows.column(id + ".u_px");
        if (column >= 0)
            points.emplace_back(rows.number(frame, column), rows.number(frame, column + 1));
    }
    if (face) {
        points = scene::FaceOval(std::move(points)).border();
        if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
    }
    if (name.starts_with("brow")) {
        const std::size_t count = points.size();
        const Vec2 up(0, -kBrow * face_px);
        for (std::size_t i = count; i-- > 0;) points.push_back(points[i] - up);
        for (std::size_t i = 0; i < count; ++i) points[i] += up;
    }
    return points;
}

double distance_to_edge(const Vec2& point, const Vec2& a, const Vec2& b) {
    const double length = (b - a).squaredNorm();
    const double t = length > 0 ? std::clamp((point - a).dot(b - a) / length, 0.0, 1.0) : 0;
    return (point - a - t * (b - a)).norm();
}

double distance_between(const Polygon& one, const Polygon& other) {
    double least = 1e9;
    const auto corners_of = [&](const Polygon& from, const Polygon& to) {
        for (const Vec2& corner : from)
            for (std::size_t i = 0; i < to.size(); ++i)
                least = std::min(least, distance_to_edge(corner, to[i], to[(i + 1) % to.size()]));
    };
    corners_of(one, other);
    corners_of(other, one);
    return least;
}

/// Moves all edges outwards; a sharp corner moves by kMitre times the margin at most.
Polygon grown(const Polygon& polygon, double margin_px) {
    Polygon out;
    const std::size_t n = polygon.size();
    const auto outwards = [](const Vec2& a, const Vec2& b) {
        return Vec2(b.y() - a.y(), a.x() - b.x()).normalized();  // of a clockwise polygon
    };
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 before = outwards(polygon[(i + n - 1) % n], polygon[i]),
                   after = outwards(polygon[i], polygon[(i + 1) % n]);
        const Vec2 between = before + after;
        const double half = between.norm() / 2;  // cosine of half of the turn
        const Vec2 way =
            half > 1e-6 ? Vec2(between.normalized() / std::max(half, 1 / kMitre)) : after;
        out.push_back(polygon[i] + margin_px * way);
    }
    return out;
}

bool is_in_picture(const Polygon& polygon, int width_px, int height_px) {
    Vec2 low = polygon.front(), high = low;
    for (const Vec2& corner : polygon) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
    }
    return high.x() > 0 && high.y() > 0 && low.x() < width_px && low.y() < height_px;
}

std::string two_decimals(double value) {
    char text[48];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

double in_hundredths(double value) { return std::round(100 * value) / 100; }

/// Whether a key frame is needed after `before`.
bool has_moved(const Aoi& before, const Aoi& now) {
    if (before.polygon.size() != now.polygon.size()) return true;
    for (std::size_t i = 0; i < now.polygon.size(); ++i)
        if ((now.polygon[i] - before.polygon[i]).norm() > kKeyFrame_px) return true;
    return false;
}

Json key_frame(const Aoi& aoi, long long time_us) {
    Json vertices = Json::array();
    for (const Vec2& corner : aoi.polygon)
        vertices.push_back(
            json_object({{"x", in_hundredths(corner.x())}, {"y", in_hundredths(corner.y())}}));
    return json_object(
        {{"is_active", !aoi.polygon.empty()}, {"time", time_us}, {"vertices", vertices}});
}

std::string columns_text() {
    return json_text(
               json_object(
                   {{"onset", json_object({{"Description", "Time of the frame from the first one"},
                                           {"Units", "s"}})},
                    {"duration",
                     json_object({{"Description", "Duration of the frame"}, {"Units", "s"}})},
                    {"frame",
                     json_object({{"Description", "Number of the frame as it is shown, from 0"}})},
                    {"aoi", json_object({{"Description",
                                          "Area of interest; _l is the left side of the person"}})},
                    {"visible",
                     json_object({{"Description",
                                   "0 where the area looks away or is outside the picture"}})},
                    {"area_px", json_object({{"Description", "Area"}, {"Units", "px^2"}})},
                    {"polygon",
                     json_object(
                         {{"Description",
                           "Corners x,y from the upper left corner of the picture, clockwise"},
                          {"Units", "px"}})}}),
               1) +
           "\n";
}

long long milliseconds(double time_s) { return std::llround(1000 * time_s); }

/// A line of an .ias file: an area from one key frame to the next. None where it is not visible.
std::string ias_line(const Aoi& aoi, std::size_t number, long long start_ms, long long end_ms,
                     bool still) {
    if (aoi.polygon.empty() || end_ms <= start_ms) return {};
    std::string out;
    if (!still) out = "-" + std::to_string(start_ms) + " -" + std::to_string(end_ms - 1) + " ";
    out += "FREEHAND " + std::to_string(number + 1);
    for (const Vec2& corner : aoi.polygon)
        out += " " + std::to_string(std::lround(corner.x())) + "," +
               std::to_string(std::lround(corner.y()));
    return out + " " + aoi.name + "\n";
}

}  // namespace

std::vector<Aoi> aois_of(const animate::FrameRows& rows, int frame,
                         const std::vector<std::string>& names, double face_px, double margin_px,
                         int width_px, int height_px) {
    std::vector<Aoi> out;
    for (const std::string& name : names) {
        Polygon polygon = ungrown(rows, frame, name, face_px);
        if (polygon.size() < 3 || signed_area(polygon) <= 0 ||
            !is_in_picture(polygon, width_px, height_px))
            polygon.clear();
        out.push_back({name, std::move(polygon)});
    }
    std::vector<double> margins(out.size(), margin_px);
    for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t k = 0; k < out.size(); ++k)
            if (i != k && out[i].name != "face" && out[k].name != "face")
                margins[i] =
                    std::min(margins[i], distance_between(out[i].polygon, out[k].polygon) / 2);
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (out[i].polygon.empty()) continue;
        out[i].polygon = grown(out[i].polygon, margins[i]);
        out[i].area_px = signed_area(out[i].polygon);
    }
    return out;
}

void draw_aois(const std::string& table, const ClipPlan& plan, report::HtmlWriter& html) {
    html.open("svg", {{"viewBox", "0 0 " + std::to_string(strip_frames(plan) * plan.width_px) +
                                      " " + std::to_string(plan.height_px)},
                      {"preserveAspectRatio", "none"},
                      {"style", "position: absolute; left: 0; top: 0; width: 100%; height: 100%"}});
    const animate::FrameRows rows = animate::frame_rows(table);
    const int names = static_cast<int>(plan.clips.aois.size());
    for (int i = 0; i < strip_frames(plan); ++i) {
        const int frame = strip_frame(i, plan.frames);
        for (int k = 0; k < names; ++k) {
            const std::vector<std::string>& cells =
                rows.cells[static_cast<std::size_t>(frame * names + k)];
            if (cells[4] != "1") continue;
            // In an SVG picture every element needs an end, or the next one is taken for its child.
            html.open("polygon",
                      {{"points", cells[6]},
                       {"transform", "translate(" + std::to_string(i * plan.width_px) + " 0)"},
                       {"fill", "none"},
                       {"stroke", kColours[static_cast<std::size_t>(k) % kColours.size()]},
                       {"stroke-width", "1"},
                       {"vector-effect", "non-scaling-stroke"}});
            html.close();
        }
    }
    html.close();
}

AoiFiles aoi_files(const animate::FrameRows& source, const std::vector<int>& order,
                   const ClipPlan& plan) {
    const design::ControlKind kind = plan.condition.control.kind;
    const animate::FrameRows rows =
        kind == design::ControlKind::kMirrored ? mirrored(source, plan.width_px) : source;
    const double face_px = width_of_face(source, plan.condition.clip);
    AoiFiles out;
    out.table = "onset\tduration\tframe\taoi\tvisible\tarea_px\tpolygon\n";
    out.columns = columns_text();
    Json aois = Json::array();
    std::vector<Aoi> keyed;
    std::vector<double> keyed_s;
    const double end_s = plan.duration_s(),
                 frame_s = plan.clips.pictures() ? end_s : 1.0 / plan.fps;
    for (std::size_t t = 0; t < order.size(); ++t) {
        std::vector<Aoi> now =
            aois_of(rows, order[t], plan.clips.aois, face_px, plan.clips.aoi_margin * face_px,
                    plan.width_px, plan.height_px);
        const double start_s = static_cast<double>(t) / plan.fps;
        for (std::size_t i = 0; i < now.size(); ++i) {
            Aoi& aoi = now[i];
            if (kind == design::ControlKind::kUpsideDown)
                for (Vec2& corner : aoi.polygon)
                    corner = Vec2(plan.width_px, plan.height_px) - corner;
            char times[64];
            std::snprintf(times, sizeof times, "%.6f\t%.6f\t", start_s, frame_s);
            out.table +=
                times + std::to_string(t) + "\t" + aoi.name +
                (aoi.polygon.empty() ? "\t0\t0\tn/a" : "\t1\t" + two_decimals(aoi.area_px) + "\t");
            for (std::size_t c = 0; c < aoi.polygon.size(); ++c)
                out.table += (c > 0 ? " " : "") + two_decimals(aoi.polygon[c].x()) + "," +
                             two_decimals(aoi.polygon[c].y());
            out.table += "\n";
            if (t == 0) {
                aois.push_back(json_object({{"name", aoi.name},
                                            {"color", kColours[i % kColours.size()]},
                                            {"key_frames", Json::array()},
                                            {"tags", Json::array()}}));
                keyed.push_back({});
                keyed_s.push_back(0);
            }
            if (t == 0 || has_moved(keyed[i], aoi)) {
                if (t > 0)
                    out.ias += ias_line(keyed[i], i, milliseconds(keyed_s[i]),
                                        milliseconds(start_s), false);
                keyed_s[i] = start_s;
                aois[i]["key_frames"].push_back(key_frame(aoi, std::llround(1e6 * start_s)));
                keyed[i] = aoi;
            }
        }
    }
    for (std::size_t i = 0; i < keyed.size(); ++i)
        out.ias += ias_line(keyed[i], i, milliseconds(keyed_s[i]), milliseconds(end_s),
                            aois[i]["key_frames"].size() == 1);
    out.key_frames = json_text(json_object({{"operation", "AddAois"},
                                            {"media_id", "stim-" + plan.condition.clip},
                                            {"merge_mode", "replace_aois"},
                                            {"aois", aois}}),
                               1) +
                     "\n";
    return out;
}

}  // namespace risorius::stimuli
