// SPDX-License-Identifier: MIT
// SHA-256, compared with the vectors of FIPS 180-4 and NIST's example file.
#include "risorius/core/sha256.h"

#include <gtest/gtest.h>

#include "media/pictures.h"
#include "risorius/core/error.h"

namespace risorius {
namespace {

std::string sha256(const std::string& text) {
    Sha256 sha;
    sha.add(text.data(), text.size());
    return sha.finish();
}

TEST(Sha256, AgreesWithThePublishedVectors) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnHowTheBytesAreDivided) {
    const std::string text(1000000, 'a');
    Sha256 sha;
    std::size_t step = 1;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t count = std::min(step, text.size() - at);
        sha.add(text.data() + at, count);
        at += count;
        step = step * 3 + 1;
    }
    EXPECT_EQ(sha.finish(), sha256(text));
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
    const TemporaryFolder folder;
    std::ofstream(folder / "abc.txt") << "abc";
    EXPECT_EQ(sha256_of_file(folder / "abc.txt"), sha256("abc"));
}

TEST(Sha256, OfAMissingFileSaysSo) {
    try {
        sha256_of_file("nowhere/mesh.obj");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "nowhere/mesh.obj: expected a readable file, found no such file");
    }
}

}  // namespace
}  // namespace risorius
