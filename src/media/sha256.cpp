// SHA-256 (FIPS 180-4) by libavutil.
#include "media/sha256.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <new>
#include <vector>

extern "C" {
#include <libavutil/mem.h>
#include <libavutil/sha.h>
}

#include "core/error.h"

namespace risorius::media {

struct Sha256::Impl {
    AVSHA* context = av_sha_alloc();
    Impl() {
        if (!context) throw std::bad_alloc();
        av_sha_init(context, 256);
    }
    ~Impl() { av_free(context); }
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {}
Sha256::~Sha256() = default;

void Sha256::add(const void* bytes, std::size_t count) {
    av_sha_update(impl_->context, static_cast<const std::uint8_t*>(bytes), count);
}

std::string Sha256::finish() {
    std::array<std::uint8_t, 32> digest;
    av_sha_final(impl_->context, digest.data());
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (std::uint8_t byte : digest) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    }
    return text;
}

std::string sha256_of_file(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw Error(file.string(), "a readable file", "no such file");
    if (std::filesystem::is_directory(file, ignored))
        throw Error(file.string(), "a readable file", "a folder");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                             &std::fclose);
    if (!in) throw Error(file.string(), "a readable file", "one that cannot be opened");
    Sha256 sha;
    std::vector<char> block(1 << 20);
    std::size_t got = 0;
    while ((got = std::fread(block.data(), 1, block.size(), in.get())) > 0)
        sha.add(block.data(), got);
    if (std::ferror(in.get())) throw Error(file.string(), "a readable file", "a read error");
    return sha.finish();
}

}  // namespace risorius::media
