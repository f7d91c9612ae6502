// SPDX-License-Identifier: MIT
#include "risorius/core/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <limits>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/file_reader.h"
#include "risorius/core/input_log.h"

namespace risorius {

struct Sha256::Impl {
    std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context{EVP_MD_CTX_new(), &EVP_MD_CTX_free};

    Impl() { check(context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr)); }
    static void check(bool done) {
        if (!done) throw RunError("SHA-256 cannot be had from OpenSSL's libcrypto");
    }
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;

void Sha256::add(const void* bytes, std::size_t count) {
    Impl::check(EVP_DigestUpdate(impl_->context.get(), bytes, count));
}

std::string Sha256::finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned count = 0;
    Impl::check(EVP_DigestFinal_ex(impl_->context.get(), digest.data(), &count));
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (unsigned i = 0; i < count; ++i) {
        text += kDigits[digest[i] >> 4];
        text += kDigits[digest[i] & 15];
    }
    return text;
}

std::string sha256_of_file(const std::filesystem::path& file) {
    const ReadingFormerOutput former;  // what is hashed may be replaced
    constexpr FileKind kAnyFile{"a readable file", std::numeric_limits<std::uint64_t>::max()};
    FileReader in(file, kAnyFile);
    if (!in.is_regular())
        throw Error(file.string(), "a readable file that is not a pipe", "a pipe");
    Sha256 sha;
    std::vector<char> block(1 << 20);
    for (std::size_t got = block.size(); got == block.size();) {
        got = in.read(block.data(), block.size());
        sha.add(block.data(), got);
    }
    return sha.finish();
}

}  // namespace risorius
