// SPDX-License-Identifier: MIT
// Finds the format of a recording, and calls its reader.
#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/core/file_reader.h"
#include "risorius/core/known_names.h"
#include "risorius/motion/detail/motion_readers.h"
#include "risorius/motion/detail/recorded_motion.h"

namespace risorius::motion {

namespace {

/// The format by the first bytes of a file; empty when none is recognised.
std::string format_of(const std::filesystem::path& file) {
    std::string head(1 << 16, '\0');
    FileReader reader(file, detail::kMotionFile);
    if (!reader.is_regular())
        throw Error(file.string(), "a regular file, or its format by " + option_name("as"),
                    "a pipe");
    head.resize(reader.read(head.data(), head.size()));
    if (head.starts_with("\xEF\xBB\xBF")) head.erase(0, 3);
    const std::size_t begin = std::min(head.find_first_not_of(" \t\r\n"), head.size());
    const std::string_view text = std::string_view(head).substr(begin);
    const std::string line = detail::lower_case(text.substr(0, text.find_first_of("\r\n")));
    const auto has = [&](std::string_view word) {
        return text.find(word) != std::string_view::npos;
    };
    if (text.starts_with("glTF")) return "gltf";
    if (text.starts_with("HIERARCHY")) return "bvh";
    if (has("\nendheader")) return "storage";
    if (text.starts_with("{") || text.starts_with("[")) {
        if (has("aceBlendshapes") || has("face_blendshapes")) return "mediapipe";
        if (has("\"asset\"") && has("\"accessors\"")) return "gltf";
        if (has("\"blendShapes\"") || has("\"blendshapes\"") || has("\"weights\"")) return "arkit";
        return {};
    }
    if (line.find("timecode") != std::string::npos && line.find("jawopen") != std::string::npos)
        return "livelink";
    if (line.find("au01_r") != std::string::npos && line.find("timestamp") != std::string::npos)
        return "openface";
    if (line.find("au01") != std::string::npos && line.find("frame") != std::string::npos)
        return "pyfeat";
    // "0.000 2f564d43...": the bytes of "/VMC"; or a bundle.
    const std::size_t space = line.find(' ');
    if (space != std::string::npos && (line.compare(space + 1, 8, "2f564d43") == 0 ||
                                       line.compare(space + 1, 8, "2362756e") == 0))
        return "vmc";
    return {};
}

}  // namespace

const std::vector<std::string>& motion_formats() {
    static const std::vector<std::string> kNames{
        "livelink", "mediapipe", "openface", "pyfeat", "arkit", "gltf", "vmc", "bvh", "storage"};
    return kNames;
}

RecordedMotion read_motion(const std::filesystem::path& file, const ReadMotionOptions& options) {
    std::string as = options.as;
    if (as.empty()) as = format_of(file);
    if (as.empty())
        throw Error(file.string(),
                    "recorded motion of a format that " + option_name("as") + " lists",
                    "another kind of file");
    index_of_name(option_name("as"), as, motion_formats());
    if (as == "livelink") return detail::read_live_link(file, options.fps);
    if (as == "mediapipe") return detail::read_mediapipe(file);
    if (as == "openface") return detail::read_openface(file);
    if (as == "pyfeat") return detail::read_pyfeat(file, options.fps);
    if (as == "arkit") return detail::read_arkit_json(file);
    if (as == "gltf") return detail::read_gltf_motion(file, options.fps);
    if (as == "vmc") return detail::read_vmc(file);
    if (as == "storage") return detail::read_storage(file, options.fps);
    return detail::read_bvh(file);
}

}  // namespace risorius::motion
