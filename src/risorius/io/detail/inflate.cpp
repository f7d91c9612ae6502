// SPDX-License-Identifier: MIT
#include "risorius/io/detail/inflate.h"

#define ZLIB_CONST
#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>

namespace risorius::io::detail {

namespace {

constexpr std::size_t kPart = 1 << 16;        // bytes that are unpacked at a time
constexpr std::size_t kMostPacked = 1 << 30;  // zlib counts them in 32 bits

/// The state of zlib, with its memory.
class ZlibStream {
  public:
    ZlibStream() {
        if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
    }
    ~ZlibStream() { inflateEnd(&stream_); }
    ZlibStream(const ZlibStream&) = delete;
    ZlibStream& operator=(const ZlibStream&) = delete;
    z_stream* operator->() { return &stream_; }
    int unpack() { return ::inflate(&stream_, Z_NO_FLUSH); }

  private:
    z_stream stream_{};
};

}  // namespace

std::string inflate(std::string_view packed, std::size_t most_bytes, std::string& out) {
    ZlibStream stream;
    std::array<char, kPart> part;
    std::size_t held = 0;
    int state = Z_OK;
    while (state == Z_OK) {
        if (stream->avail_in == 0) {
            const std::size_t count = std::min(packed.size(), kMostPacked);
            stream->next_in = reinterpret_cast<const Bytef*>(packed.data());
            stream->avail_in = static_cast<uInt>(count);
            packed.remove_prefix(count);
        }
        stream->next_out = reinterpret_cast<Bytef*>(part.data());
        stream->avail_out = static_cast<uInt>(kPart);
        state = stream.unpack();
        const std::size_t got = kPart - stream->avail_out;
        if (got > most_bytes - held) return "more bytes than it should hold";
        held += got;
        out.append(part.data(), got);
    }
    if (state == Z_STREAM_END) return "";
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state == Z_BUF_ERROR) return "an end within the block";
    if (state == Z_NEED_DICT) return "a block that needs a dictionary";
    return stream->msg != nullptr ? stream->msg : "a damaged block";
}

}  // namespace risorius::io::detail
