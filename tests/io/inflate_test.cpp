// SPDX-License-Identifier: MIT
// Blocks of zlib that Python packed: with a code of their own, with the fixed one, and as they are; and damaged ones.
#include "risorius/io/detail/inflate.h"

#include <gtest/gtest.h>

namespace risorius::io {
namespace {

std::string from_hex(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size(); at += 2)
        out += static_cast<char>(std::stoi(text.substr(at, 2), nullptr, 16));
    return out;
}

/// What was packed.
std::string unpacked_text() {
    std::string out;
    for (int i = 0; i < 700; ++i) out += static_cast<char>(i % 3 ? i * i * 7 % 251 : 32 + i % 26);
    for (int i = 0; i < 600; ++i) out += static_cast<char>(i % 26 + 97);
    return out;
}

/// zlib.compress(plain, 9)
const std::string kOwnCode = from_hex(
    "78daedc9cf2beb010000703249116a4894efefdfbf7f7fa5b071c081e547c4d47b6f7bdef6bc3db3677b1b4e0e2ed2"
    "6aad6c"
    "5c948b030ee668c9af52645a2916a55d38ac480e6eef7f78679feb07286b82a777b1f153f26c82d99be5e12aa90657"
    "170e8c"
    "a91bf07606395fc65b498aed64d7ef85950fb964557bdd372787a0b1007a69258e64ba25c3092fe2664c594be9b523"
    "406504"
    "5e6cc6e66de45b9e2954f0de1dc99d551fe68cbb0d70b40719f6e3d78dd4959ded7f16faeae58bb476f164f6c5a1fe"
    "43f4ca"
    "475c27e9e16e6e3428de61cac3a0ee2e05bc0a5c78c4deeac8f91366f19dafdc926a73ea5ad4d83c068530d2b28d1f"
    "b9a8cb"
    "043be6102697e4d776ad2464ae88d0ba076511a2d5499f3770b703e254b5b2d0abd794037017bc67c1ce3ac8f16266"
    "ba8d2f"
    "2b929adad4dd62e3b4039cb020b35d78553985f7b207d5c2cd803cd3a02d3b4d12813a3de8bd487c84e8d5766e7f49"
    "1c7228"
    "81846e7501f2369c09632fc7642ccaa472fcc8961479579b4f0c5b1d987f442a147ca794ca0eb27398b011947bba35"
    "7fd26c"
    "f441f643f4394ed43fd1e934f7542fc69f9543bbee6b04927eb8bb070b6e90d81c3398e54b7724a5427dcc1b7536f0"
    "a41979"
    "8fe05b23542ec54663c2f18b1cce68dbb2e9b2428900ea182296f6e9f6552ef4218af78aa7534748c0b90c37cc6003"
    "3764f5"
    "01d38bf3e55552d7ac6a99303a4ec1e25da4ad092f2aa3daa6d9e271a1e34cb6ec695db0595e03f52ea0d553c4c02d"
    "dd70ce"
    "395b4584553cebbab802844ae0f6576c6992748c31894bde75246db7a861c138de04a36b48ae16dfaaa4de17d99379"
    "a1ee4d"
    "7e2c688ad72c7543830f2876470447e9ee612e792dfaae94c37e3dde073c5dc0e90bacbe8f7cee67ec577ce3b5e41f"
    "567b46"
    "8d8d3b70ee01c9baf11d2f555160f36f826d5e6e5ed42295e6482d945a43639bc48b40675a38f948b45e2a8131fdcb"
    "d76f2e"
    "f7f7c91f1eefcfa95fbedfd3fe99c09fd960e86f38f2399ff3fff30f42c1ffa5");

TEST(Inflate, UnpacksWhatZlibPacked) {
    std::string out = "before";
    EXPECT_EQ(detail::inflate(kOwnCode, 1300, out), "");
    EXPECT_EQ(out, "before" + unpacked_text());
    out.clear();
    EXPECT_EQ(detail::inflate(from_hex("78da4b4c4a4e444500417c06e5"), 18, out),
              "");  // the fixed code
    EXPECT_EQ(out, "abcabcabcabcabcabc");
    out.clear();
    EXPECT_EQ(detail::inflate(from_hex("7801010800f7ff61732069742069730c7702ce"), 8, out), "");
    EXPECT_EQ(out, "as it is");
}

TEST(Inflate, TellsWhatIsWrong) {
    std::string out;
    EXPECT_EQ(detail::inflate(kOwnCode, 1299, out), "more bytes than it should hold");
    EXPECT_EQ(detail::inflate("no header", 99, out), "incorrect header check");
    EXPECT_EQ(detail::inflate("", 99, out), "an end within the block");
    std::string changed = kOwnCode;
    changed.back() = static_cast<char>(changed.back() ^ 1);
    EXPECT_EQ(detail::inflate(changed, 1300, out), "incorrect data check");
    for (std::size_t length = 0; length < kOwnCode.size(); ++length)
        EXPECT_NE(detail::inflate(kOwnCode.substr(0, length), 1300, out), "") << length;
}

// Any byte replaced: an error, or the same text where the bits had no meaning.
TEST(Inflate, DoesNotCrashOnChangedBytes) {
    for (std::size_t at = 0; at < kOwnCode.size(); ++at)
        for (const char other : {'\0', '\x55', '\xff'}) {
            std::string changed = kOwnCode, out;
            changed[at] = other;
            if (detail::inflate(changed, 1300, out).empty()) {
                EXPECT_EQ(out, unpacked_text()) << at;
            }
        }
}

}  // namespace
}  // namespace risorius::io
