// SPDX-License-Identifier: MIT
// Pictures that a mesh's materials name, from an OBJ with its MTL to pixels.
#include "risorius/scene/texture_picture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "message_of.h"
#include "paths.h"
#include "risorius/io/read_mesh.h"
#include "risorius/media/image_file.h"
#include "risorius/scene/scene_from_rig.h"
#include "temporary_folder.h"

namespace risorius::scene {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

fs::path folder() {
    const fs::path folder = fs::path(testing::TempDir()) / "risorius_textures";
    fs::create_directories(folder);
    return folder;
}

geom::PolygonMesh square_with(const std::string& library) {
    std::ofstream(folder() / "square.mtl") << library;
    std::ofstream(folder() / "square.obj")
        << "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "g square\nf 1/1 2/2 3/3\nusemtl painted\nf 1/1 3/3 4/4\n";
    return io::read_mesh(folder() / "square.obj");
}

TEST(Textures, TheFacesOfAMaterialWithAPictureGetItAndOthersNone) {
    Image image(3, 2);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(9 * i);
    media::write_png(image, folder() / "a b.png");
    const geom::PolygonMesh mesh =
        square_with("newmtl plain\nKd 1 1 1\nnewmtl painted\n  map_Kd -clamp on a b.png\n");
    EXPECT_EQ(mesh.face_texture, (std::vector<int>{-1, 0}));
    ASSERT_EQ(mesh.textures.size(), 1U);
    EXPECT_EQ(read_texture(mesh.textures[0]).rgba, image.rgba);
}

TEST(Textures, AMeshWithoutItsLibraryHasNone) {
    square_with("");
    fs::remove(folder() / "square.mtl");
    EXPECT_TRUE(io::read_mesh(folder() / "square.obj").textures.empty());
}

TEST(Textures, APictureThatIsNotThereIsReportedWhereItIsNamed) {
    const geom::PolygonMesh mesh = square_with("newmtl painted\nmap_Kd lost.png\n");
    EXPECT_EQ(message_of([&] { read_texture(mesh.textures.at(0)); }),
              (folder() / "square.mtl").string() + ":2: expected the picture " +
                  (folder() / "lost.png").string() + ", found no such file");
    const geom::PolygonMesh lengthy =
        square_with("newmtl painted\nmap_Kd " + std::string(5000, 'x') + ".png\n");
    EXPECT_TRUE(message_of([&] {
                    read_texture(lengthy.textures.at(0));
                }).starts_with((folder() / "square.mtl").string() + ":2: expected the picture "));
}

TEST(Textures, APictureThatIsMovedOverTheSurfaceIsLeftOutWithANote) {
    const geom::PolygonMesh mesh = square_with("newmtl painted\nmap_Kd -o 0.5 0 a.png\n");
    EXPECT_TRUE(mesh.textures.empty());
    EXPECT_EQ(mesh.notes,
              (std::vector<std::string>{(folder() / "square.mtl").string() +
                                        ":2: the picture is left out, because \"-o\" moves it over "
                                        "the texture coordinates"}));
    // These move nothing.
    const geom::PolygonMesh still =
        square_with("newmtl painted\nmap_Kd -o 0 0 0 -s 1 1 1 -t 0 0 0 a.png\n");
    EXPECT_TRUE(still.notes.empty());
    EXPECT_EQ(still.textures.at(0).file, folder() / "a.png");
}

TEST(Textures, APictureOfAnotherComputerIsFoundBesideItsLibrary) {
    media::write_png(Image(2, 2), folder() / "Skin Of Anna.png");
    for (const std::string name : {"C:\\scans\\anna\\Skin Of Anna.png", "skin of anna.PNG",
                                   "pictures/of/anna/skin of anna.png"})
        EXPECT_EQ(square_with("newmtl painted\nmap_Kd " + name + "\n").textures.at(0).file,
                  folder() / "Skin Of Anna.png")
            << name;
}

TEST(Textures, WhatAPngHoldsBesidePixelsIsNotUnpacked) {
    // A profile of a kilobyte could stand for a megabyte. This one cannot be unpacked at all.
    Image picture(3, 2);
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        picture.rgba[i] = static_cast<std::uint8_t>(37 * i);
    media::write_png(picture, folder() / "plain.png");
    std::string bytes = bytes_of(folder() / "plain.png");
    bytes.insert(33, std::string("\0\0\0\5iCCPa\0\0zz????", 17));  // behind the header
    std::ofstream(folder() / "profile.png", std::ios::binary) << bytes;
    EXPECT_EQ(read_texture({folder() / "profile.png", "here", {}}).rgba, picture.rgba);
}

TEST(Textures, ATgaIsRead) {
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = bytes[14] = 1;
    bytes[16] = 24;
    std::ofstream(folder() / "green.tga", std::ios::binary)
        << bytes << std::string("\x10\xc0\x20", 3);
    EXPECT_EQ(read_texture({folder() / "green.tga", "here", {}}).rgba,
              (std::vector<std::uint8_t>{0x20, 0xc0, 0x10, 255}));
}

TEST(Textures, WhatCannotBeReadIsToldForEachPicture) {
    const geom::PolygonMesh mesh = square_with("newmtl painted\nmap_Kd lost.png\n");
    EXPECT_EQ(
        picture_problems(mesh),
        (std::vector<std::string>{(folder() / "square.mtl").string() + ":2: expected the picture " +
                                  (folder() / "lost.png").string() +
                                  ", found no such file; what it would colour has the colours "
                                  "of the look"}));
}

TEST(Textures, AFileThatIsNoPictureIsRefused) {
    const geom::Texture texture{folder() / "words.png", "here", {}};
    // FFmpeg would read the second one, as it would read films, sound and subtitles. The third one states 133 million pixels in 55
    // bytes.
    for (const std::string& bytes :
         {"no picture at all, only words"s, "P6 1 1 255\n\x01\x02\x03"s,
          bytes_of(RISORIUS_SOURCE_DIR "/tests/fuzz/seeds/picture/huge.bmp")}) {
        std::ofstream(folder() / "words.png", std::ios::binary) << bytes;
        EXPECT_EQ(message_of([&] { read_texture(texture); }),
                  (folder() / "words.png").string() +
                      ": expected a picture (PNG, JPEG, TGA, BMP, TIFF, WebP), found another kind "
                      "of file, one cut short, or more than 100 million pixels");
    }
    std::string scans = "\xff\xd8";
    for (int i = 0; i < 201; ++i) scans += "\xff\xda";
    std::ofstream(folder() / "scans.jpg", std::ios::binary) << scans;
    EXPECT_EQ(
        message_of([&] {
            read_texture({folder() / "scans.jpg", "here", {}});
        }),
        (folder() / "scans.jpg").string() + ": expected a JPEG of at most 200 scans, found 201");
}

std::string base64(const std::string& bytes) {
    constexpr const char* kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : kLetters[group >> (18 - 6 * k) & 63U];
    }
    return out;
}

TEST(Textures, AGltfMayCarryItsPicturesInside) {
    Image image(2, 2);
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(15 * i);
    media::write_png(image, folder() / "inside.png");
    std::ifstream png(folder() / "inside.png", std::ios::binary);
    const std::string picture{std::istreambuf_iterator<char>(png), {}};
    const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1,
                             0, 0, 0, 1, 0, 0, 1};  // places, then coordinates
    const std::string buffer(reinterpret_cast<const char*>(numbers), sizeof numbers);
    std::ofstream(folder() / "inside.gltf")
        << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"mimeType":"image/png","uri":"data:image/png;base64,)"
        << base64(picture)
        << R"("}],"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)"
        << base64(buffer) << R"("}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]})";
    const geom::PolygonMesh mesh = io::read_mesh(folder() / "inside.gltf");
    EXPECT_EQ(mesh.face_texture, std::vector<int>{0});
    ASSERT_EQ(mesh.textures.size(), 1U);
    EXPECT_EQ(read_texture(mesh.textures[0]).rgba, image.rgba);
}

/// A chunk of a GLB file: its length, its kind, its bytes filled up to a multiple of four.
std::string glb_chunk(const std::string& kind, std::string bytes, char filling) {
    while (bytes.size() % 4 != 0) bytes += filling;
    const auto length = static_cast<std::uint32_t>(bytes.size());
    return std::string(reinterpret_cast<const char*>(&length), 4) + kind + bytes;
}

TEST(Textures, AGlbMayNameAPictureBesideIt) {
    const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    const std::string chunks =
        glb_chunk("JSON",
                  R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":"iris.png"}],"buffers":[{"byteLength":60}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]})",
                  ' ') +
        glb_chunk(std::string("BIN\0", 4),
                  std::string(reinterpret_cast<const char*>(numbers), sizeof numbers), '\0');
    const std::uint32_t header[] = {0x46546C67, 2, static_cast<std::uint32_t>(12 + chunks.size())};
    std::ofstream(folder() / "beside.glb", std::ios::binary)
        << std::string(reinterpret_cast<const char*>(header), sizeof header) << chunks;
    const geom::PolygonMesh mesh = io::read_mesh(folder() / "beside.glb");
    ASSERT_EQ(mesh.textures.size(), 1U);
    EXPECT_EQ(mesh.textures[0].file, folder() / "iris.png");
}

}  // namespace
}  // namespace risorius::scene
