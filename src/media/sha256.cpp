// SHA-256 (FIPS 180-4), by the processor's own instructions where it has them: every frame's pixels go through it.
#include "media/sha256.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <vector>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

#include "core/error.h"

namespace risorius::media {

namespace {

constexpr std::size_t kBlock = 64;

// FIPS 180-4, 4.2.2: of the cube roots of the first 64 primes
constexpr std::array<std::uint32_t, 64> kRounds = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using State = std::array<std::uint32_t, 8>;

// What goes into the rounds does not hang on the state: found for several blocks side by side, as wide as vectors are.
constexpr std::size_t kLanes = 8;
using Lanes = std::uint32_t __attribute__((vector_size(4 * kLanes)));
using Schedule = std::array<Lanes, 64>;

// A block's own word of each round, constant included, lies `kLanes` apart from the next.
void add_block(State& state, const std::uint32_t* words) {
    State s = state;
    const auto round = [&](std::size_t i, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                           std::uint32_t& d, std::uint32_t e, std::uint32_t f, std::uint32_t g,
                           std::uint32_t& h) {
        h += words[i * kLanes] + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
             (((f ^ g) & e) ^ g);
        d += h;
        h += (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) | ((a | b) & c));
    };
    for (std::size_t i = 0; i < 64; i += 8) {  // each of the eight takes every role once
        round(i, s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7]);
        round(i + 1, s[7], s[0], s[1], s[2], s[3], s[4], s[5], s[6]);
        round(i + 2, s[6], s[7], s[0], s[1], s[2], s[3], s[4], s[5]);
        round(i + 3, s[5], s[6], s[7], s[0], s[1], s[2], s[3], s[4]);
        round(i + 4, s[4], s[5], s[6], s[7], s[0], s[1], s[2], s[3]);
        round(i + 5, s[3], s[4], s[5], s[6], s[7], s[0], s[1], s[2]);
        round(i + 6, s[2], s[3], s[4], s[5], s[6], s[7], s[0], s[1]);
        round(i + 7, s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[0]);
    }
    for (std::size_t i = 0; i < 8; ++i) state[i] += s[i];
}

void add_blocks_portably(State& state, const std::uint8_t* bytes, std::size_t blocks) {
    Schedule w, words;
    while (blocks > 0) {
        const std::size_t some = std::min(blocks, kLanes);
        for (std::size_t i = 0; i < 16; ++i) {
            w[i] = Lanes{};
            for (std::size_t lane = 0; lane < some; ++lane) {
                std::uint32_t word = 0;
                std::memcpy(&word, bytes + lane * kBlock + 4 * i, 4);
                if constexpr (std::endian::native == std::endian::little)
                    word = __builtin_bswap32(word);
                w[i][lane] = word;
            }
            words[i] = w[i] + kRounds[i];
        }
        for (std::size_t i = 16; i < 64; ++i) {
            const Lanes &a = w[i - 15], &b = w[i - 2];
            w[i] = w[i - 16] + w[i - 7] + ((a >> 7 | a << 25) ^ (a >> 18 | a << 14) ^ a >> 3) +
                   ((b >> 17 | b << 15) ^ (b >> 19 | b << 13) ^ b >> 10);
            words[i] = w[i] + kRounds[i];
        }
        const auto* first = reinterpret_cast<const std::uint32_t*>(words.data());
        for (std::size_t lane = 0; lane < some; ++lane) add_block(state, first + lane);
        bytes += some * kBlock;
        blocks -= some;
    }
}

#if defined(__x86_64__)
bool has_sha_instructions() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b >> 29 & 1) &&
           __builtin_cpu_supports("sse4.1");
}

// The state lies in two registers as the instructions want it: ABEF and CDGH.
__attribute__((target("sha,sse4.1,ssse3"))) void add_blocks_by_instructions(
    State& state, const std::uint8_t* bytes, std::size_t blocks) {
    const __m128i swap = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    const auto load = [](const void* from) {
        return _mm_loadu_si128(static_cast<const __m128i*>(from));
    };
    __m128i low = _mm_shuffle_epi32(load(state.data()), 0xb1);
    __m128i high = _mm_shuffle_epi32(load(state.data() + 4), 0x1b);
    __m128i abef = _mm_alignr_epi8(low, high, 8), cdgh = _mm_blend_epi16(high, low, 0xf0);
    for (; blocks > 0; --blocks, bytes += kBlock) {
        const __m128i abef_before = abef, cdgh_before = cdgh;
        __m128i w[4];
        for (int i = 0; i < 4; ++i) w[i] = _mm_shuffle_epi8(load(bytes + 16 * i), swap);
        for (int i = 0; i < 16; ++i) {
            const __m128i sum = _mm_add_epi32(w[i & 3], load(kRounds.data() + 4 * i));
            cdgh = _mm_sha256rnds2_epu32(cdgh, abef, sum);
            abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(sum, 0x0e));
            if (i >= 12) continue;  // the next four words of the schedule but three
            const __m128i last = w[(i + 3) & 3];
            __m128i next = _mm_sha256msg1_epu32(w[i & 3], w[(i + 1) & 3]);
            next = _mm_add_epi32(next, _mm_alignr_epi8(last, w[(i + 2) & 3], 4));
            w[i & 3] = _mm_sha256msg2_epu32(next, last);
        }
        abef = _mm_add_epi32(abef, abef_before);
        cdgh = _mm_add_epi32(cdgh, cdgh_before);
    }
    low = _mm_shuffle_epi32(abef, 0x1b);
    high = _mm_shuffle_epi32(cdgh, 0xb1);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data()), _mm_blend_epi16(low, high, 0xf0));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data() + 4), _mm_alignr_epi8(high, low, 8));
}
#endif

void add_blocks(State& state, const std::uint8_t* bytes, std::size_t blocks) {
#if defined(__x86_64__)
    static const bool by_instructions = has_sha_instructions();
    if (by_instructions) return add_blocks_by_instructions(state, bytes, blocks);
#endif
    add_blocks_portably(state, bytes, blocks);
}

}  // namespace

struct Sha256::Impl {
    // FIPS 180-4, 5.3.3: of the square roots of the first eight primes
    State state{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<std::uint8_t, kBlock> waiting;  ///< for the rest of a block
    std::uint64_t count = 0;                   ///< bytes so far

    void add(const std::uint8_t* bytes, std::size_t more) {
        const std::size_t held = count % kBlock;
        count += more;
        if (held > 0) {
            const std::size_t taken = std::min(more, kBlock - held);
            std::memcpy(waiting.data() + held, bytes, taken);
            bytes += taken;
            more -= taken;
            if (held + taken < kBlock) return;
            add_blocks(state, waiting.data(), 1);
        }
        add_blocks(state, bytes, more / kBlock);
        if (more % kBlock > 0)
            std::memcpy(waiting.data(), bytes + more - more % kBlock, more % kBlock);
    }
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {}
Sha256::~Sha256() = default;

void Sha256::add(const void* bytes, std::size_t count) {
    if (count > 0) impl_->add(static_cast<const std::uint8_t*>(bytes), count);
}

std::string Sha256::finish() {
    const std::uint64_t bits = 8 * impl_->count;
    std::array<std::uint8_t, 2 * kBlock> end{0x80};
    const std::size_t padding = kBlock - (impl_->count + 8) % kBlock;  // 1..64: at least the 0x80
    for (std::size_t i = 0; i < 8; ++i)
        end[padding + i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
    impl_->add(end.data(), padding + 8);
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint32_t word : impl_->state)
        for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[word >> shift & 15];
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
