// SPDX-License-Identifier: MIT
#include "risorius/media/picture_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>

#include "risorius/core/error.h"
#include "risorius/media/detail/ffmpeg.h"

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

}  // namespace

Image read_picture(const std::vector<std::uint8_t>& bytes, const std::string& name) {
    silence_ffmpeg();
    const Error no_picture(name, kPicture, "another kind of file, or one cut short");
    const MemoryFile file(bytes);
    AVFormatContext* format = avformat_alloc_context();
    if (!format) throw std::bad_alloc();
    format->pb = file.io();
    // On failure FFmpeg frees the context.
    if (avformat_open_input(&format, nullptr, nullptr, nullptr) < 0) throw no_picture;
    struct Close {
        AVFormatContext*& format;
        ~Close() { avformat_close_input(&format); }
    } close{format};
    const AVCodec* decoder = nullptr;
    const int index = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (index < 0 || !decoder) throw no_picture;
    const CodecPtr codec(avcodec_alloc_context3(decoder));
    const FramePtr picture(av_frame_alloc());
    const PacketPtr packet(av_packet_alloc());
    if (!codec || !picture || !packet) throw std::bad_alloc();
    codec->thread_count = 1;
    codec->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;
    if (avcodec_parameters_to_context(codec.get(), format->streams[index]->codecpar) < 0 ||
        avcodec_open2(codec.get(), decoder, nullptr) < 0 ||
        av_read_frame(format, packet.get()) < 0 ||
        avcodec_send_packet(codec.get(), packet.get()) < 0)
        throw no_picture;
    avcodec_send_packet(codec.get(), nullptr);
    if (avcodec_receive_frame(codec.get(), picture.get()) < 0) throw no_picture;
    return rgba_of(*picture, name);
}

Image read_picture(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file))
        throw Error(file.string(), kPicture,
                    std::filesystem::exists(file) ? "a folder or device" : "no such file");
    std::ifstream in(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
    return read_picture(bytes, file.string());
}

}  // namespace risorius::media
