// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/design/conditions.h"
#include "risorius/design/design.h"
#include "risorius/design/detail/arithmetic.h"
#include "risorius/design/table.h"
#include "risorius/headmodel/detail/identity.h"
#include "risorius/headmodel/detail/tables.h"
#include "risorius/inverse/measured_shapes.h"
#include "risorius/io/mesh_message.h"
#include "risorius/io/morph_model.h"
#include "risorius/io/read_mesh.h"
#include "risorius/io/tet_mesh.h"
#include "risorius/media/detail/sound.h"
#include "risorius/media/hdr_file.h"
#include "risorius/media/picture_file.h"
#include "risorius/motion/detail/recorded_motion.h"
#include "risorius/rig/rig_description.h"
#include "risorius/signal/recording.h"
#include "risorius/speech/labels.h"
#include "risorius/speech/phone_table.h"
#include "risorius/speech/utterance.h"
#include "risorius/track/script.h"
#include "risorius/view/document.h"
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

/// A file that others name. It is made once in a process.
void make_beside(const char* name, const std::string& bytes) {
    file_of(name, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

void walk(const JsonCursor& value) {
    if (value.is_object())
        for (const std::string& key : value.keys()) walk(value.at(key));
    else if (value.is_array())
        for (const JsonCursor& item : value.items()) walk(item);
}

void read_json(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const JsonCursor json = parse_json_text(text_of(data, size), "input.json");
    digest.add(json_text(json.json()));
    walk(json);
}

void read_script(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const track::StandardTables& tables = track::StandardTables::get();
    const track::ScriptDescription script =
        track::read_script(parse_json_text(text_of(data, size), "input.json"), tables.channels,
                           tables.facs, tables.expressions);
    digest.add(script.header.duration_s);
    for (const track::ChannelTrack& channel : script.channels) {
        digest.add(channel.name);
        for (const track::Key& key : channel.keys) digest.add(key.value);
    }
    for (const track::ExpressionEvent& event : script.expressions) digest.add(event.expression);
    digest.add(script.blinks.size());
    for (const std::string& note : script.notes) digest.add(note);
}

void read_design(const std::uint8_t* data, std::size_t size, Digest& digest) {
    for (const design::Condition& one :
         design::conditions_of(design::read_design(file_of("design.json", data, size)))) {
        digest.add(one.clip);
        digest.add(json_text(one.script));
    }
}

void read_arithmetic(const std::uint8_t* data, std::size_t size, Digest& digest) {
    digest.add(
        design::arithmetic(text_of(data, size), "formula", [](const std::string&) { return 2.0; }));
}

void read_table(const std::uint8_t* data, std::size_t size, Digest& digest) {
    for (const auto& row : design::read_table(file_of("table.tsv", data, size)))
        for (const design::Given& given : row) {
            digest.add(given.name);
            digest.add(json_text(given.value.json()));
        }
}

void read_recording(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const signal::Recording table =
        signal::Recording::read_file(file_of("recording.tsv", data, size));
    for (std::size_t column = 0; column < table.columns().size(); ++column) {
        digest.add(table.columns()[column]);
        try {
            digest.add(table.samples(static_cast<int>(column)));
        } catch (const Error&) {
            digest.add("no numbers");
        }
    }
}

void add_mesh(const geom::PolygonMesh& mesh, Digest& digest) {
    digest.add(mesh.positions);
    digest.add(mesh.face_begin);
    digest.add(mesh.corner_vertex);
    digest.add(mesh.corner_texcoord);
    digest.add(mesh.face_group);
    digest.add(mesh.face_texture);
    digest.add(mesh.face_material);
    for (const std::string& name : mesh.group_names) digest.add(name);
    for (const std::string& name : mesh.material_names) digest.add(name);
    for (const geom::Texture& texture : mesh.textures) {
        digest.add(texture.file.string());
        digest.add(texture.embedded);
    }
    for (const std::string& note : mesh.notes) digest.add(note);
}

/// Reads a mesh in a file of this name. "beside.mtl" is a file of materials that it can name.
template <const char* name>
void read_mesh(const std::uint8_t* data, std::size_t size, Digest& digest) {
    static const bool made = (make_beside("beside.mtl", "newmtl skin\nmap_Kd skin.png\n"), true);
    if (made) add_mesh(io::read_mesh(file_of(name, data, size)), digest);
}

/// A mesh of tetrahedra in the format that its first letters are of.
void read_tets(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const std::string text = text_of(data, size);
    const char* const name = text.starts_with('$')   ? "input.msh"
                             : text.starts_with('#') ? "input.vtk"
                             : text.starts_with('<') ? "input.vtu"
                             : text.find('\0') < 4   ? "input.meshb"
                                                     : "input.mesh";
    const io::TetMesh mesh = io::read_tet_mesh(file_of(name, data, size));
    digest.add(mesh.positions);
    digest.add(mesh.tets);
    digest.add(mesh.tags);
    for (const auto& [group, tag] : mesh.names) digest.add(group);
}

void read_materials(const std::uint8_t* data, std::size_t size, Digest& digest) {
    static const bool made = (make_beside("painted.obj",
                                          "mtllib painted.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                          "vt 0 0\nusemtl skin\nf 1/1 2/1 3/1\n"),
                              true);
    if (!made) return;
    const fs::path materials = file_of("painted.mtl", data, size);
    add_mesh(io::read_mesh(materials.parent_path() / "painted.obj"), digest);
}

void read_shapes(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const io::MorphModel model = io::read_glb(file_of("shapes.glb", data, size));
    digest.add(model.name);
    digest.add(model.vertices);
    digest.add(model.stands_for);
    for (const io::MorphPart& part : model.parts) digest.add(part.triangles);
    for (const io::MorphTarget& target : model.targets) {
        digest.add(target.name);
        digest.add(target.vertex);
        digest.add(target.delta);
    }
    for (const io::MorphAnimation& animation : model.animations) digest.add(animation.weights);
    digest.add(json_text(model.extras));
}

void read_message(const std::uint8_t* data, std::size_t size, Digest& digest) {
    io::MeshProblem problem;
    const auto mesh = io::read_mesh_message(
        [&](void* to, std::size_t count) {
            if (count > size) return false;
            std::memcpy(to, data, count);
            data += count;
            size -= count;
            return true;
        },
        problem);
    if (mesh) add_mesh(*mesh, digest);
    digest.add(problem.expected);
}

void read_light(const std::uint8_t* data, std::size_t size, Digest& digest) {
    digest.add(media::read_hdr(file_of("light.hdr", data, size)).rgb);
}

void read_sound(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const media::Recording recording = media::open_recording(file_of("input.wav", data, size));
    digest.add(media::part_of(recording, -10, 1000).samples);
}

const speech::PhoneTable& phones() {
    static const speech::PhoneTable table =
        speech::PhoneTable::read_folder(fs::path(RISORIUS_SOURCE_DIR) / "rigs/standard");
    return table;
}

void add_utterance(const speech::Utterance& utterance, Digest& digest) {
    digest.add(utterance.samples);
    for (const speech::Phone& phone : utterance.phones) {
        digest.add(phone.text());
        digest.add(phone.stress);
        digest.add(phone.start);
        digest.add(phone.end);
        for (const auto& moment : {phone.closure, phone.release, phone.voice_onset})
            digest.add(moment.value_or(-1));
    }
    for (const auto& spans : {utterance.words, utterance.sentences})
        for (const speech::Span& span : spans) {
            digest.add(span.text);
            digest.add(span.start);
            digest.add(span.end);
        }
}

void read_labels_as(const std::string& format, const std::uint8_t* data, std::size_t size,
                    Digest& digest) {
    const speech::LabelFile labels =
        speech::parse_labels(text_of(data, size), format, "input", 48000);
    add_utterance(speech::utterance_of_labels(labels, {}, phones(), 48000, {}, "input"), digest);
}

void read_textgrid(const std::uint8_t* data, std::size_t size, Digest& digest) {
    read_labels_as("textgrid", data, size, digest);
}

/// As all other formats, one after another.
void read_labels(const std::uint8_t* data, std::size_t size, Digest& digest) {
    for (const std::string& format : speech::label_formats()) try {
            if (format != "textgrid") read_labels_as(format, data, size, digest);
        } catch (const Error&) {
        }
}

void read_utterance(const std::uint8_t* data, std::size_t size, Digest& digest) {
    add_utterance(
        speech::read_utterance(parse_json_text(text_of(data, size), "input.json"), phones()),
        digest);
}

void read_picture(const std::uint8_t* data, std::size_t size, Digest& digest) {
    digest.add(media::read_picture({data, data + size}, "input.png").rgba);
}

void read_landmarks(const std::uint8_t* data, std::size_t size, Digest& digest) {
    for (const auto& [id, landmark] : rig::read_landmarks(file_of("landmarks.json", data, size))) {
        digest.add(id);
        digest.add(landmark.vertex);
        if (landmark.vertex < 0) digest.add(landmark.xyz);
    }
}

void read_identity(const std::uint8_t* data, std::size_t size, Digest& digest) {
    static const headmodel::DesignTables tables =
        headmodel::read_design_tables(headmodel::models_folder() / "adult/design");
    const headmodel::Identity identity =
        headmodel::read_identity(file_of("identity.json", data, size), tables);
    for (const std::string& word : {identity.name, identity.skin, identity.iris, identity.hair})
        digest.add(word);
    for (const double number : {identity.sex, identity.age, identity.freckles, identity.scalp_hair,
                                identity.hairline, identity.temples, identity.beard})
        digest.add(number);
    for (const auto& [name, value] : identity.shape) {
        digest.add(name);
        digest.add(value);
    }
}

/// A table of measured shapes of a mesh with two vertices, beside numbers for two shapes.
void read_shapes_table(const std::uint8_t* data, std::size_t size, Digest& digest) {
    static const bool made = (make_beside("measured.f32", std::string(48, '\0')), true);
    static const rig::RigDescription adult =
        rig::read_rig(fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    static const rig::Head head = [] {
        rig::Head one;
        one.vertices = Points::Zero(2, 3);
        return one;
    }();
    if (!made) return;
    for (const inverse::MeasuredShape& shape :
         inverse::read_measured_shapes(file_of("measured.json", data, size), {}, adult, head)) {
        digest.add(shape.name);
        digest.add(shape.displacement);
        digest.add(shape.drive.excitation);
    }
}

/// As a file of each format, whatever its header says.
void read_motion(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const fs::path file = file_of("motion", data, size);
    for (const std::string& format : motion::motion_formats()) try {
            const motion::RecordedMotion read = motion::read_motion(file, {.as = format});
            digest.add(read.times_s);
            for (const motion::RecordedTrack& track : read.tracks) {
                digest.add(track.channel);
                digest.add(track.values);
            }
            for (const std::string& name : read.unmapped) digest.add(name);
        } catch (const Error&) {
        }
}

/// Operations of the studio on a small script. Undo gives the script back.
void make_edits(const std::uint8_t* data, std::size_t size, Digest& digest) {
    const JsonCursor json = parse_json_text(text_of(data, size), "edits.json");
    const JsonCursor script = parse_json_text(
        R"({"duration_s": 2, "a/b": [1, [2]], "channels": {"AU12": {"keys": [[0, 0], [1, 1]]}},
            "expressions": [{"expression": "happiness", "start_s": 0.5, "intensity": 1}]})",
        "script.json");
    view::Document document(script.json());
    const std::string before = document.text();
    for (const JsonCursor& item : json.items()) try {
            document.edit({view::read_operation(item)});
        } catch (const Error&) {
        }
    digest.add(document.text());
    while (document.undo()) {
    }
    if (document.text() != before) std::abort();
}

constexpr char kObj[] = "input.obj", kGlb[] = "input.glb", kGltf[] = "input.gltf";

}  // namespace

void Digest::add(const void* bytes, std::size_t size) {
    // Of much data, some thousand places tell as much.
    const std::size_t step = size / (1 << 20) + 1;
    for (std::size_t i = 0; i < size; i += step)
        sum_ = (sum_ ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211U;
}

const std::vector<Target>& targets() {
    static const std::vector<Target> list{
        {"json", read_json},           {"script", read_script},
        {"design", read_design},       {"arithmetic", read_arithmetic},
        {"table", read_table},         {"recording", read_recording},
        {"obj", read_mesh<kObj>},      {"mtl", read_materials},
        {"glb", read_mesh<kGlb>},      {"gltf", read_mesh<kGltf>},
        {"shapes", read_shapes},       {"mesh_message", read_message},
        {"hdr", read_light},           {"picture", read_picture},
        {"sound", read_sound},         {"landmarks", read_landmarks},
        {"identity", read_identity},   {"shapes_table", read_shapes_table},
        {"textgrid", read_textgrid},   {"labels", read_labels},
        {"utterance", read_utterance}, {"motion", read_motion},
        {"edits", make_edits},         {"tet_mesh", read_tets}};
    return list;
}

std::uint64_t run(const Target& target, const std::uint8_t* data, std::size_t size) {
    try {
        Digest digest;
        target.read(data, size, digest);
        return digest.value();
    } catch (const Error&) {
    } catch (const RunError&) {
    }
    return 0;
}

}  // namespace risorius::fuzz
