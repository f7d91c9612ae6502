// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_drop.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/report/atomic_file.h"
#include "tools/risorius/studio_head.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kPieceHeader = 8;
constexpr std::uint32_t kPiece = 2;
constexpr int kMostBytes = 200'000'000;

bool can_be_dropped(const fs::path& name) {
    static const std::set<std::string> others{".json", ".mtl", ".png", ".jpg", ".jpeg", ".bin"};
    return is_mesh_file(name) || others.contains(name.extension().string());
}

}  // namespace

void StudioDrop::begin(const JsonCursor& message) {
    message.allow_keys({"type", "id", "name", "bytes", "replace"});
    bytes_ = 0;
    content_.clear();
    const JsonCursor name = message.at("name");
    const fs::path given = name.string();
    if (given != given.filename() || given.string().starts_with(".") || !can_be_dropped(given))
        name.fail("a script, a rig, a mesh or a picture, without folders");
    const int bytes = message.at("bytes").integer(1, kMostBytes);
    file_ = folder_ / given;
    const auto replace = message.find("replace");
    if (fs::exists(file_) && !(replace && replace->boolean()))
        message.fail("consent to replace " + in_quotes(given.string()), "none");
    bytes_ = static_cast<std::size_t>(bytes);
}

bool StudioDrop::is_piece(const std::string& bytes) {
    std::uint32_t kind = 0;
    if (bytes.size() >= kPieceHeader) std::memcpy(&kind, bytes.data(), sizeof kind);
    return kind == kPiece;
}

std::optional<fs::path> StudioDrop::add(const std::string& bytes) {
    if (bytes_ == 0) throw Error("piece of a file", "a file that has begun", "none");
    content_.append(bytes, kPieceHeader, std::string::npos);
    if (content_.size() > bytes_) {
        bytes_ = 0;
        content_.clear();
        throw Error(file_.filename().string(), "as many bytes as were announced", "more");
    }
    if (content_.size() < bytes_) return std::nullopt;
    bytes_ = 0;
    OutputSet outputs(file_.parent_path(), OutputSet::Then::kRunGoesOn);
    report::write_text(outputs.replacement(file_), content_);
    outputs.commit();
    content_.clear();
    content_.shrink_to_fit();
    return file_;
}

}  // namespace risorius::cli
