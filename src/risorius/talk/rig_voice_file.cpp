// SPDX-License-Identifier: MIT
#include "risorius/talk/rig_voice_file.h"

#include <mutex>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/result_cache.h"
#include "risorius/core/sha256.h"
#include "risorius/face/quality.h"

namespace risorius::talk {

namespace fs = std::filesystem;

namespace {

/// Changes when poses are chosen, simulated or measured in another way.
constexpr const char* kRecipe = "voice 8";

/// The rig file without what leaves the poses of a voice right: names, looks, and how units and expressions use the muscles.
std::string what_moves(const fs::path& rig_file) {
    Json rig = JsonCursor::read_file(rig_file).json();
    for (const char* key :
         {"name", "appearance", "look", "facs", "unit_gains", "expressions", "calibrated_on"})
        rig.erase(key);
    return json_text(rig);
}

/// Hash of everything that makes the poses of a voice wrong. Visemes and action units only choose which mouths are simulated, so a
/// voice stays right, and is kept, when their table or their gains change. Expressions and wrinkles have no part in it.
std::string hash_of(const scene::RigFiles& files) {
    Sha256 hash;
    const auto add = [&](const std::string& text) { hash.add(text.data(), text.size()); };
    add(kRecipe);
    add(what_moves(files.file));
    add(sha256_of_file(files.rig.mesh_file));
    for (const fs::path& table : files.rig.table_files) {
        const std::string name = table.filename().string();
        if (name == "expressions.json" || name == "facs.json" || name == "wrinkles.json") continue;
        add(sha256_of_file(table));
    }
    return hash.finish();
}

/// Empty when there is no place for it.
fs::path cache_file(const std::string& hash) {
    const fs::path cache = cache_folder();
    return cache.empty() ? cache : cache / "voices" / (hash + ".json");
}

/// The poses in a file, when it is there and was made of this rig.
std::optional<RigVoice> read_matching(const fs::path& file, const std::string& hash,
                                      const std::vector<std::string>& columns) {
    std::error_code ignored;
    if (file.empty() || !fs::is_regular_file(file, ignored)) return std::nullopt;
    const JsonCursor json = JsonCursor::read_file(file);
    if (!json.has("hash") || json.at("hash").string() != hash) return std::nullopt;
    return RigVoice::read(json, columns);
}

RigVoice simulate(const scene::RigFiles& files, const std::function<void(double)>& report) {
    face::Face face(files.rig, files.mesh, face::quality_named("video"), files.place());
    return fit_voice(
        face, files.rig, report ? report : [](double) {});
}

void write(const RigVoice& voice, const std::string& hash, const fs::path& file) {
    const Json json = voice.json(hash);
    std::string text = "{\n";
    for (auto entry = json.begin(); entry != json.end(); ++entry) {
        text += (entry == json.begin() ? " " : ",\n ") + json_text(entry.key()) + ": ";
        if (entry.key() != "poses") {
            text += json_text(*entry);
            continue;
        }
        for (std::size_t i = 0; i < entry->size(); ++i)
            text += (i ? ",\n  " : "[\n  ") + json_text((*entry)[i]);
        text += "]";
    }
    write_file(file, text + "\n}\n");
}

}  // namespace

fs::path voice_file_of(const fs::path& rig_file) {
    return fs::path(rig_file).replace_extension(".voice.json");
}

std::optional<RigVoice> known_voice_of_rig(const scene::RigFiles& files) {
    const std::string hash = hash_of(files);
    const std::vector<std::string> columns = files.rig.channels().column_names();
    if (auto known = read_matching(voice_file_of(files.file), hash, columns)) return known;
    return read_matching(cache_file(hash), hash, columns);
}

RigVoice voice_of_rig(const scene::RigFiles& files, const std::function<void(double)>& report) {
    // Threads that want the same mouths wait for the first of them, and find its file.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    if (auto known = known_voice_of_rig(files)) return *known;
    RigVoice voice = simulate(files, report);
    const std::string hash = hash_of(files);
    const fs::path file = cache_file(hash);
    if (file.empty()) return voice;
    try {
        write(voice, hash, file);
    } catch (const std::exception&) {
        // A cache that cannot be written costs time only.
    }
    return voice;
}

fs::path write_voice_of_rig(const scene::RigFiles& files,
                            const std::function<void(double)>& report) {
    const fs::path file = voice_file_of(files.file);
    write(simulate(files, report), hash_of(files), file);
    return file;
}

}  // namespace risorius::talk
