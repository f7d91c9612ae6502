// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/design/conditions.h"
#include "risorius/design/design.h"
#include "risorius/design/detail/arithmetic.h"
#include "risorius/design/detail/table.h"
#include "risorius/io/mesh_message.h"
#include "risorius/io/morph_model.h"
#include "risorius/io/read_mesh.h"
#include "risorius/media/detail/sound.h"
#include "risorius/media/hdr_file.h"
#include "risorius/media/picture_file.h"
#include "risorius/signal/recording.h"
#include "risorius/track/script.h"
#include "temporary_folder.h"
#include "track/standard_tables.h"

namespace risorius::fuzz {

namespace {

namespace fs = std::filesystem;

/// The bytes as a file with this name. The folder is made once in a process.
fs::path file_of(const char* name, const std::uint8_t* data, std::size_t size) {
    static const TemporaryFolder folder;
    fs::path file = folder / name;
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file;
}

std::string text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

void walk(const JsonCursor& value) {
    if (value.is_object())
        for (const std::string& key : value.keys()) walk(value.at(key));
    else if (value.is_array())
        for (const JsonCursor& item : value.items()) walk(item);
}

void read_json(const std::uint8_t* data, std::size_t size) {
    const JsonCursor json = parse_json_text(text_of(data, size), "input.json");
    json_text(json.json());
    walk(json);
}

void read_script(const std::uint8_t* data, std::size_t size) {
    const track::StandardTables& tables = track::StandardTables::get();
    track::read_script(parse_json_text(text_of(data, size), "input.json"), tables.channels,
                       tables.facs, tables.expressions);
}

void read_design(const std::uint8_t* data, std::size_t size) {
    design::conditions_of(design::read_design(file_of("design.json", data, size)));
}

void read_arithmetic(const std::uint8_t* data, std::size_t size) {
    design::arithmetic(text_of(data, size), "formula", [](const std::string&) { return 2.0; });
}

void read_message(const std::uint8_t* data, std::size_t size) {
    io::MeshProblem problem;
    io::read_mesh_message(
        [&](void* to, std::size_t count) {
            if (count > size) return false;
            std::memcpy(to, data, count);
            data += count;
            size -= count;
            return true;
        },
        problem);
}

void read_sound(const std::uint8_t* data, std::size_t size) {
    const media::Recording recording = media::open_recording(file_of("input.wav", data, size));
    media::part_of(recording, -10, 1000);
}

void read_picture(const std::uint8_t* data, std::size_t size) {
    media::read_picture({data, data + size}, "input.png");
}

}  // namespace

const std::vector<Target>& targets() {
    static const std::vector<Target> list{
        {"json", read_json},
        {"script", read_script},
        {"design", read_design},
        {"arithmetic", read_arithmetic},
        {"table",
         [](auto* data, auto size) { design::read_table(file_of("table.tsv", data, size)); }},
        {"recording",
         [](auto* data, auto size) {
             signal::Recording::read_file(file_of("recording.tsv", data, size));
         }},
        {"obj", [](auto* data, auto size) { io::read_mesh(file_of("input.obj", data, size)); }},
        {"glb", [](auto* data, auto size) { io::read_mesh(file_of("input.glb", data, size)); }},
        {"gltf", [](auto* data, auto size) { io::read_mesh(file_of("input.gltf", data, size)); }},
        {"shapes", [](auto* data, auto size) { io::read_glb(file_of("shapes.glb", data, size)); }},
        {"mesh_message", read_message},
        {"hdr", [](auto* data, auto size) { media::read_hdr(file_of("light.hdr", data, size)); }},
        {"picture", read_picture},
        {"sound", read_sound}};
    return list;
}

void run(const Target& target, const std::uint8_t* data, std::size_t size) {
    try {
        target.read(data, size);
    } catch (const Error&) {
    } catch (const RunError&) {
    }
}

}  // namespace risorius::fuzz
