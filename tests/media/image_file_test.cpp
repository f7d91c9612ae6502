// SPDX-License-Identifier: MIT
// PNG pictures are written and read back.
#include "risorius/media/image_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "media/pictures.h"
#include "risorius/core/error.h"

namespace risorius::media {
namespace {

std::string message_of_reading(const std::filesystem::path& file) {
    try {
        read_png(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// The colour type in a PNG's header: 2 is RGB, 6 is RGB with alpha (PNG specification, 11.2.2).
int colour_type(const std::filesystem::path& file) { return bytes_of(file).at(25); }

TEST(PngFile, OpaquePictureReadsBackBitForBitWithoutAnAlphaChannel) {
    const TemporaryFolder folder;
    const Image image = noise(37, 23, 1);
    write_png(image, folder / "a.png");
    const Image back = read_png(folder / "a.png");
    EXPECT_EQ(back.width_px, 37);
    EXPECT_EQ(back.height_px, 23);
    EXPECT_EQ(back.rgba, image.rgba);
    EXPECT_EQ(colour_type(folder / "a.png"), 2);
}

TEST(PngFile, TransparentPictureReadsBackBitForBitEvenUnderAlphaZero) {
    const TemporaryFolder folder;
    Image image = noise(16, 9, 2, /*opaque=*/false);
    image.pixel(3, 3)[3] = 0;
    write_png(image, folder / "a.png");
    EXPECT_EQ(read_png(folder / "a.png").rgba, image.rgba);
    EXPECT_EQ(colour_type(folder / "a.png"), 6);
}

TEST(PngFile, FirstRowIsTheTopAndChannelsAreRedGreenBlue) {
    // An independent picture: the smallest PNG of a red pixel above a blue one, written by hand (stored deflate block).
    const unsigned char png[] = {
        0x89, 'P', 'N',  'G',  13,   10,   26,   10,                                             //
        0,    0,   0,    13,   'I',  'H',  'D',  'R',  0,    0,    0,    1,   0, 0,    0,    2,  //
        8,    2,   0,    0,    0,    0x16, 0xe3, 0x21, 0x70,                                     //
        0,    0,   0,    19,   'I',  'D',  'A',  'T',  0x78, 1,    1,    8,   0, 0xf7, 0xff,     //
        0,    255, 0,    0,    0,    0,    0,    255,                                            //
        0x08, 0,   0x01, 0xff, 0xf0, 0xe2, 0x8c, 0xde,                                           //
        0,    0,   0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
    const TemporaryFolder folder;
    std::ofstream(folder / "a.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png), sizeof png);
    const Image image = read_png(folder / "a.png");
    EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255}));
}

TEST(PngFile, WritingMakesTheFoldersAboveAndLeavesNothingBesideTheFile) {
    const TemporaryFolder folder;
    write_png(noise(4, 4, 3), folder / "one/two/a.png");
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"one", "one/two", "one/two/a.png"}));
}

TEST(PngFile, FailedWritingKeepsThePictureThatWasThere) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "a.png/inside");
    EXPECT_THROW(write_png(noise(4, 4, 3), folder / "a.png"), Error);
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"a.png", "a.png/inside"}));
}

TEST(PngFile, WrongFilesAreNamedForWhatTheyAre) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "a.png";
    EXPECT_EQ(message_of_reading(file),
              file.string() + ": expected a PNG picture, found no such file");
    EXPECT_EQ(message_of_reading(folder.path()),
              folder.path().string() + ": expected a PNG picture, found a folder");
    std::ofstream(file) << "GIF89a is another format";
    EXPECT_EQ(message_of_reading(file),
              file.string() + ": expected a PNG picture, found another kind of file");
}

TEST(PngFile, OneOfMorePixelsThanMemoryHoldsIsRefused) {
    const TemporaryFolder folder;
    write_png(noise(1, 1, 3), folder / "a.png");
    std::string bytes = bytes_of(folder / "a.png");
    // Of 30,000 x 30,000 pixels, as a file of 100 kB may be: width, height, three bytes of the format, and the checksum of them
    bytes.replace(16, 8, std::string("\0\0\x75\x30\0\0\x75\x30", 8));
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);
    for (std::size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
    std::ofstream(folder / "a.png", std::ios::binary) << bytes;
    EXPECT_EQ(
        message_of_reading(folder / "a.png"),
        (folder / "a.png").string() + ": expected at most 100 million pixels, found 30000 x 30000");
}

TEST(PngFile, PictureCutShortAnywhereIsRefused) {
    const TemporaryFolder folder;
    write_png(noise(8, 8, 4), folder / "whole.png");
    const std::string whole = bytes_of(folder / "whole.png");
    for (std::size_t length = 8; length < whole.size(); length += 7) {
        std::ofstream(folder / "a.png", std::ios::binary) << whole.substr(0, length);
        EXPECT_EQ(message_of_reading(folder / "a.png"),
                  (folder / "a.png").string() + ": expected a PNG picture, found one cut short");
    }
}

}  // namespace
}  // namespace risorius::media
