// SPDX-License-Identifier: MIT
#include "risorius/media/picture_file.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"
#include "risorius/media/detail/ffmpeg.h"
#include "risorius/media/detail/png_chunks.h"
#include "risorius/media/image_file.h"

namespace risorius::media {

using namespace detail;

namespace {

constexpr const char* kPicture = "a picture (PNG, JPEG, TGA, BMP, TIFF, WebP)";

/// Bytes in memory that FFmpeg reads like a file.
class MemoryFile {
  public:
    explicit MemoryFile(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {
        constexpr int kBuffer = 1 << 16;
        auto* buffer = static_cast<unsigned char*>(av_malloc(kBuffer));
        if (buffer)
            io_ = avio_alloc_context(buffer, kBuffer, /*write_flag=*/0, this, read, nullptr, seek);
        if (!io_) {
            av_free(buffer);
            throw std::bad_alloc();
        }
    }
    ~MemoryFile() {
        av_freep(&io_->buffer);
        avio_context_free(&io_);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    AVIOContext* io() const { return io_; }

  private:
    static int read(void* self, std::uint8_t* out, int size) {
        auto& file = *static_cast<MemoryFile*>(self);
        const auto count = std::min(static_cast<std::size_t>(size), file.bytes_.size() - file.at_);
        if (count == 0) return AVERROR_EOF;
        std::memcpy(out, file.bytes_.data() + file.at_, count);
        file.at_ += count;
        return static_cast<int>(count);
    }
    static std::int64_t seek(void* self, std::int64_t offset, int whence) {
        auto& file = *static_cast<MemoryFile*>(self);
        const auto size = static_cast<std::int64_t>(file.bytes_.size());
        if (whence & AVSEEK_SIZE) return size;
        const std::int64_t from = (whence & 3) == SEEK_CUR   ? static_cast<std::int64_t>(file.at_)
                                  : (whence & 3) == SEEK_END ? size
                                                             : 0;
        if (from + offset < 0 || from + offset > size) return AVERROR(EINVAL);
        file.at_ = static_cast<std::size_t>(from + offset);
        return from + offset;
    }
    const std::vector<std::uint8_t>& bytes_;
    std::size_t at_ = 0;
    AVIOContext* io_ = nullptr;
};

Image rgba_of(const AVFrame& picture, const std::string& name) {
    Image image(picture.width, picture.height);
    const int flags =
        SWS_BICUBIC | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT;
    const auto format = static_cast<AVPixelFormat>(picture.format);
    const ScalerPtr scaler(sws_getContext(picture.width, picture.height, format, picture.width,
                                          picture.height, AV_PIX_FMT_RGBA, flags, nullptr, nullptr,
                                          nullptr));
    if (!scaler) throw Error(name, "a pixel format that can be converted", "another one");
    // JPEG files follow JFIF: BT.601 with full range.
    const int* matrix = sws_getCoefficients(SWS_CS_ITU601);
    const bool is_yuv = (av_pix_fmt_desc_get(format)->flags & AV_PIX_FMT_FLAG_RGB) == 0;
    sws_setColorspaceDetails(scaler.get(), matrix,
                             is_yuv || picture.color_range == AVCOL_RANGE_JPEG, matrix,
                             /*dstRange=*/1, /*brightness=*/0, /*contrast=*/1 << 16,
                             /*saturation=*/1 << 16);
    std::uint8_t* rows[4] = {image.rgba.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {image.width_px * 4, 0, 0, 0};
    sws_scale(scaler.get(), picture.data, picture.linesize, 0, picture.height, rows, strides);
    return image;
}

/// `bytes`: of the file. A large picture needs a large file, unless it is a damaged one that states any size.
CodecPtr codec_for(const AVCodec* decoder, std::size_t bytes) {
    constexpr std::int64_t kOfSmallFile = 20'000'000;  // 4096 squared, of one colour
    constexpr std::int64_t kOfEachByte = 10'000;       // what compression by zlib can reach
    CodecPtr codec(avcodec_alloc_context3(decoder));
    if (!codec) throw std::bad_alloc();
    codec->thread_count = 1;
    codec->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;
    codec->max_pixels =
        std::min(kMostPixels, kOfSmallFile + kOfEachByte * static_cast<std::int64_t>(bytes));
    return codec;
}

/// The first picture in a packet; null when it holds none.
FramePtr decoded(AVCodecContext& codec, const AVPacket& packet) {
    FramePtr picture(av_frame_alloc());
    if (!picture) throw std::bad_alloc();
    if (avcodec_send_packet(&codec, &packet) < 0) return nullptr;
    avcodec_send_packet(&codec, nullptr);
    if (avcodec_receive_frame(&codec, picture.get()) < 0) return nullptr;
    return picture;
}

/// Whether the name ends in "tga", and the header is one: a kind of picture, and the bits of a pixel.
bool may_be_tga(const std::vector<std::uint8_t>& bytes, const std::string& name) {
    constexpr std::size_t kHeader = 18;
    if (bytes.size() <= kHeader || name.size() < 4) return false;
    std::string ending = name.substr(name.size() - 4);
    for (char& c : ending) c = static_cast<char>(c | 0x20);
    const int map = bytes[1], kind = bytes[2] & ~8, bits = bytes[16];
    return ending == ".tga" && map <= 1 && kind >= 1 && kind <= 3 &&
           (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

std::optional<Image> read_tga(const std::vector<std::uint8_t>& bytes, const std::string& name) {
    const AVCodec* decoder = avcodec_find_decoder(AV_CODEC_ID_TARGA);
    if (!decoder) return std::nullopt;
    const CodecPtr codec = codec_for(decoder, bytes.size());
    const PacketPtr packet(av_packet_alloc());
    if (!packet || av_new_packet(packet.get(), static_cast<int>(bytes.size())) < 0)
        throw std::bad_alloc();
    std::memcpy(packet->data, bytes.data(), bytes.size());
    if (avcodec_open2(codec.get(), decoder, nullptr) < 0) return std::nullopt;
    const FramePtr picture = decoded(*codec, *packet);
    if (!picture) return std::nullopt;
    return rgba_of(*picture, name);
}

/// A PNG without what does not change its pixels: FFmpeg unpacks texts and profiles, of which a kilobyte can stand for a megabyte.
/// Null for other files.
std::optional<std::vector<std::uint8_t>> pixels_only(const std::vector<std::uint8_t>& bytes) {
    if (!is_png(bytes)) return std::nullopt;
    std::vector<std::uint8_t> out(kPngSignature.begin(), kPngSignature.end());
    std::size_t at = kPngSignature.size();
    while (const auto chunk = png_chunk(bytes, at)) {
        const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        const std::size_t size = std::min(chunk->size, bytes.size() - at);
        const bool is_critical = (chunk->type[0] & 0x20) == 0;
        if (is_critical || chunk->type == "tRNS")
            out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(size));
        at += size;
    }
    return out;
}

/// Throws Error for a JPEG of very many scans: each goes through all pixels, and takes some bytes.
void check_scans(const std::vector<std::uint8_t>& bytes, const std::string& name) {
    constexpr std::size_t kMostScans = 200;  // programs write some ten
    if (bytes.size() < 2 || bytes[0] != 0xff || bytes[1] != 0xd8) return;
    std::size_t scans = 0;
    for (std::size_t i = 3; i < bytes.size(); ++i)
        scans += bytes[i - 1] == 0xff && bytes[i] == 0xda;
    if (scans > kMostScans) throw Error(name, "a JPEG of at most 200 scans", std::to_string(scans));
}

}  // namespace

Image read_picture(const std::vector<std::uint8_t>& whole, const std::string& name) {
    silence_ffmpeg();
    check_scans(whole, name);
    const auto pixels = pixels_only(whole);
    const std::vector<std::uint8_t>& bytes = pixels ? *pixels : whole;
    const Error no_picture(name, kPicture,
                           "another kind of file, one cut short, or more than 100 million pixels");
    // FFmpeg does not know a TGA by its first bytes.
    if (may_be_tga(bytes, name))
        if (const auto tga = read_tga(bytes, name)) return *tga;
    const MemoryFile file(bytes);
    AVFormatContext* format = avformat_alloc_context();
    if (!format) throw std::bad_alloc();
    format->pb = file.io();
    // FFmpeg knows some 300 kinds of files, of sound and subtitles too. Bytes that look like these are not read any further.
    format->format_whitelist = av_strdup("png_pipe,jpeg_pipe,bmp_pipe,tiff_pipe,webp_pipe");
    if (!format->format_whitelist) {
        avformat_free_context(format);
        throw std::bad_alloc();
    }
    // On failure FFmpeg frees the context.
    if (avformat_open_input(&format, nullptr, nullptr, nullptr) < 0) throw no_picture;
    struct Close {
        AVFormatContext*& format;
        ~Close() { avformat_close_input(&format); }
    } close{format};
    const AVCodec* decoder = nullptr;
    const int index = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (index < 0 || !decoder) throw no_picture;
    const CodecPtr codec = codec_for(decoder, bytes.size());
    const PacketPtr packet(av_packet_alloc());
    if (!packet) throw std::bad_alloc();
    if (avcodec_parameters_to_context(codec.get(), format->streams[index]->codecpar) < 0 ||
        avcodec_open2(codec.get(), decoder, nullptr) < 0 || av_read_frame(format, packet.get()) < 0)
        throw no_picture;
    const FramePtr picture = decoded(*codec, *packet);
    if (!picture) throw no_picture;
    return rgba_of(*picture, name);
}

Image read_picture(const std::filesystem::path& file) {
    constexpr FileKind kKind{kPicture, 500 * kMegabyte};
    check_file(file, kKind);
    return read_picture(read_bytes(file, kKind), file.string());
}

}  // namespace risorius::media
