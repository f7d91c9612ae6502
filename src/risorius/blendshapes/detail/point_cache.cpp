// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/point_cache.h"

#include <cstdint>
#include <cstring>

namespace risorius::blendshapes {

namespace {

template <typename T>
void put(std::string& out, T value, bool big_endian) {
    static_assert(sizeof(T) == 4);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    for (int i = 0; i < 4; ++i)
        out += static_cast<char>(bits >> 8 * (big_endian ? 3 - i : i) & 0xff);
}

}  // namespace

std::string pc2_bytes(const PointCache& cache) {
    std::string out("POINTCACHE2\0", 12);
    put(out, std::int32_t{1}, false);  // version
    put(out, static_cast<std::int32_t>(cache.vertices), false);
    put(out, 0.f, false);  // first frame
    put(out, 1.f, false);  // frames per sample
    put(out, static_cast<std::int32_t>(cache.frames), false);
    for (const float value : cache.positions) put(out, value, false);
    return out;
}

std::string mdd_bytes(const PointCache& cache) {
    std::string out;
    put(out, static_cast<std::int32_t>(cache.frames), true);
    put(out, static_cast<std::int32_t>(cache.vertices), true);
    for (long f = 0; f < cache.frames; ++f)
        put(out, static_cast<float>(static_cast<double>(f) / cache.fps), true);
    for (const float value : cache.positions) put(out, value, true);
    return out;
}

}  // namespace risorius::blendshapes
