// SPDX-License-Identifier: MIT
// JSON: MediaPipe FaceLandmarker and ARKit.
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/rotations.h"
#include "risorius/motion/detail/motion_readers.h"
#include "risorius/motion/json_results.h"

namespace risorius::motion::detail {

namespace {

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
    for (const JsonCursor& result : json_results(file, kMotionFile, {"frames", "results"})) {
        const auto time = any_key_of(result, {"timestampMs", "timestamp_ms", "timestamp"});
        if (!time) result.fail("the time \"timestampMs\"", "none");
        const auto faces = any_key_of(result, {"faceBlendshapes", "face_blendshapes"});
        const std::vector<JsonCursor> listed = faces ? faces->items() : std::vector<JsonCursor>{};
        out.begin(1e-3 * time->number(), !listed.empty());
        if (listed.empty()) continue;
        const JsonCursor categories = listed[0].is_array() ? listed[0] : listed[0].at("categories");
        for (const JsonCursor& category : categories.items()) {
            const auto name = any_key_of(category, {"categoryName", "category_name"});
            if (!name) category.fail("\"categoryName\"", "none");
            if (name->string() == "_neutral") continue;  // how likely it is that nothing happens
            if (const std::string shape = arkit_spelling(name->string()); !shape.empty())
                out.set(shape, category.at("score").number());
            else
                out.unmapped(name->string());
        }
        if (const auto matrices = any_key_of(
                result, {"facialTransformationMatrixes", "facial_transformation_matrixes"}))
            if (const std::vector<JsonCursor> each = matrices->items(); !each.empty())
                if (const auto turn = turn_of_matrix(each[0])) out.set_head(head_angles(*turn));
    }
    out.motion().notes.push_back(
        "MediaPipe hardly ever moves cheekPuff, eyeWide and noseSneer, and has no tongueOut");
    return out.finish(file.string(), "mediapipe", 0);
}

RecordedMotion read_arkit_json(const std::filesystem::path& file) {
    MotionBuilder out;
    for (const JsonCursor& frame : json_results(file, kMotionFile, {"frames"})) {
        const auto time = any_key_of(frame, {"t", "time", "timestamp", "time_s"});
        if (!time) frame.fail("the time \"t\"", "none");
        const auto shapes = any_key_of(frame, {"blendShapes", "blendshapes", "weights"});
        out.begin(time->number(), shapes.has_value());
        if (!shapes) continue;
        for (const std::string& name : shapes->keys())
            if (const std::string shape = arkit_spelling(name); !shape.empty())
                out.set(shape, shapes->at(name).number());
            else
                out.unmapped(name);
        if (const auto transform = any_key_of(frame, {"transform"}))
            if (const auto turn = turn_of_matrix(*transform)) out.set_head(head_angles(*turn));
    }
    return out.finish(file.string(), "arkit", 0);
}

}  // namespace risorius::motion::detail
