// SPDX-License-Identifier: MIT
// JSON: MediaPipe FaceLandmarker and ARKit.
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/rotations.h"
#include "risorius/core/text_lines.h"
#include "risorius/motion/detail/motion_readers.h"

namespace risorius::motion::detail {

namespace {

/// The value of the first key that is there and is not null.
std::optional<JsonCursor> any_of(const JsonCursor& json, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
        if (const auto found = json.find(key); found && !found->json().is_null()) return found;
    return std::nullopt;
}

/// Results of a file: one a line, a list, or a list in an object.
std::vector<JsonCursor> results_of(const std::filesystem::path& file,
                                   const std::vector<std::string>& lists) {
    const std::string text = read_text(file, kMotionFile);
    std::vector<JsonCursor> out;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    TextLines lines(text);
    std::string_view line;
    while (line.find_first_not_of(" \t") == std::string_view::npos && lines.next())
        line = lines.line();
    const bool by_line = first != std::string::npos && text[first] == '{' &&
                         json_or_null(line).is_object() && lines.next();
    if (by_line) {
        for (TextLines each(text); each.next();)
            if (each.line().find_first_not_of(" \t") != std::string_view::npos)
                out.push_back(
                    parse_json_text(std::string(each.line()),
                                    file.string() + ": line " + std::to_string(each.number())));
        return out;
    }
    const JsonCursor json = parse_json_text(text, file);
    if (json.is_array()) return json.items();
    if (const auto list = any_of(json, lists)) return list->items();
    return {json};
}

/// A 4 x 4 matrix by columns: a list of 16, or in "data".
std::optional<Mat3> turn_of_matrix(const JsonCursor& json) {
    const JsonCursor list = json.is_object() ? json.at("data") : json;
    const std::vector<JsonCursor> numbers = list.items();
    if (numbers.empty()) return std::nullopt;
    Eigen::Matrix4d matrix;
    // Some write columns as lists of their own.
    if (numbers.size() == 4)
        for (int c = 0; c < 4; ++c) {
            const std::vector<JsonCursor> column = numbers[static_cast<std::size_t>(c)].items();
            if (column.size() != 4) list.fail("columns of four numbers");
            for (int r = 0; r < 4; ++r) matrix(r, c) = column[static_cast<std::size_t>(r)].number();
        }
    else if (numbers.size() == 16)
        for (int i = 0; i < 16; ++i)
            matrix(i % 4, i / 4) = numbers[static_cast<std::size_t>(i)].number();
    else
        list.fail("16 numbers", std::to_string(numbers.size()));
    // The nearest rotation: the matrix may have a scale, and is skewed away from the centre of the picture.
    const NearestRotation nearest = nearest_rotation(matrix.topLeftCorner<3, 3>());
    if (!(nearest.stretch.z() >= 0)) list.fail("a rotation");
    return nearest.rotation;
}

}  // namespace

RecordedMotion read_mediapipe(const std::filesystem::path& file) {
    MotionBuilder out;
    for (const JsonCursor& result : results_of(file, {"frames", "results"})) {
        const auto time = any_of(result, {"timestampMs", "timestamp_ms", "timestamp"});
        if (!time) result.fail("the time \"timestampMs\"", "none");
        const auto faces = any_of(result, {"faceBlendshapes", "face_blendshapes"});
        const std::vector<JsonCursor> listed = faces ? faces->items() : std::vector<JsonCursor>{};
        out.begin(1e-3 * time->number(), !listed.empty());
        if (listed.empty()) continue;
        const JsonCursor categories = listed[0].is_array() ? listed[0] : listed[0].at("categories");
        for (const JsonCursor& category : categories.items()) {
            const auto name = any_of(category, {"categoryName", "category_name"});
            if (!name) category.fail("\"categoryName\"", "none");
            if (name->string() == "_neutral") continue;  // how likely it is that nothing happens
            if (const std::string shape = arkit_spelling(name->string()); !shape.empty())
                out.set(shape, category.at("score").number());
            else
                out.unmapped(name->string());
        }
        if (const auto matrices =
                any_of(result, {"facialTransformationMatrixes", "facial_transformation_matrixes"}))
            if (const std::vector<JsonCursor> each = matrices->items(); !each.empty())
                if (const auto turn = turn_of_matrix(each[0])) out.set_head(head_angles(*turn));
    }
    out.motion().notes.push_back(
        "MediaPipe hardly ever moves cheekPuff, eyeWide and noseSneer, and has no tongueOut");
    return out.finish(file.string(), "mediapipe", 0);
}

RecordedMotion read_arkit_json(const std::filesystem::path& file) {
    MotionBuilder out;
    for (const JsonCursor& frame : results_of(file, {"frames"})) {
        const auto time = any_of(frame, {"t", "time", "timestamp", "time_s"});
        if (!time) frame.fail("the time \"t\"", "none");
        const auto shapes = any_of(frame, {"blendShapes", "blendshapes", "weights"});
        out.begin(time->number(), shapes.has_value());
        if (!shapes) continue;
        for (const std::string& name : shapes->keys())
            if (const std::string shape = arkit_spelling(name); !shape.empty())
                out.set(shape, shapes->at(name).number());
            else
                out.unmapped(name);
        if (const auto transform = any_of(frame, {"transform"}))
            if (const auto turn = turn_of_matrix(*transform)) out.set_head(head_angles(*turn));
    }
    return out.finish(file.string(), "arkit", 0);
}

}  // namespace risorius::motion::detail
