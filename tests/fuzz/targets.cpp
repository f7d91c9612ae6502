// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
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
#include "risorius/speech/labels.h"
#include "risorius/speech/phone_table.h"
#include "risorius/speech/utterance.h"
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

const speech::PhoneTable& phones() {
    static const speech::PhoneTable table =
        speech::PhoneTable::read_folder(fs::path(RISORIUS_SOURCE_DIR) / "rigs/standard");
    return table;
}

void read_labels_as(const std::string& format, const std::uint8_t* data, std::size_t size) {
    const speech::LabelFile labels =
        speech::parse_labels(text_of(data, size), format, "input", 48000);
    speech::utterance_of_labels(labels, {}, phones(), 48000, {}, "input");
}

void read_textgrid(const std::uint8_t* data, std::size_t size) {
    read_labels_as("textgrid", data, size);
}

/// As all other formats, one after another.
void read_labels(const std::uint8_t* data, std::size_t size) {
    for (const std::string& format : speech::label_formats()) try {
            if (format != "textgrid") read_labels_as(format, data, size);
        } catch (const Error&) {
        }
}

void read_utterance(const std::uint8_t* data, std::size_t size) {
    speech::utterance_text(
        speech::read_utterance(parse_json_text(text_of(data, size), "input.json"), phones()));
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
        {"sound", read_sound},
        {"textgrid", read_textgrid},
        {"labels", read_labels},
        {"utterance", read_utterance}};
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
