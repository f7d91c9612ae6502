// Encoding settings and why:
//
//   no B-frames        decoding order is display order, so players that step frame by frame cannot
//   be off by one closed groups of   a quarter of a second, without scene detection: any frame is
//   reached by decoding few others four threads       x264's bytes depend on the number of threads,
//   so it is fixed rather than asked of the machine bitexact           no dates, library versions
//   or random identifiers in the container BT.709, limited    the sRGB-encoded values are carried
//   unchanged as R'G'B', which is what video players assume
//
// Matroska stores times rounded to whole milliseconds; the exact frame period stands in its
// DefaultDuration.
#include "media/detail/encoder.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "core/error.h"
#include "media/detail/ffmpeg.h"

namespace risorius::media::detail {

namespace {

constexpr int kThreads = 4;
constexpr int kSlices = 4;

}  // namespace

struct Encoder::Impl {
    std::string name;
    Container container;
    VideoOptions options;
    bool alpha;
    AVFormatContext* format = nullptr;
    AVStream* stream = nullptr;
    CodecPtr codec;
    FramePtr picture;
    PacketPtr packet;
    ScalerPtr scaler;
    std::int64_t next = 0;

    ~Impl() { close(); }

    void close() {
        if (!format) return;
        if (format->pb) avio_closep(&format->pb);
        avformat_free_context(format);
        format = nullptr;
    }

    [[noreturn]] void fail(const std::string& what, int code) const {
        throw RunError(name + ": " + what + ": " + ffmpeg_text(code));
    }

    void check(int code, const char* what) const {
        if (code < 0) fail(what, code);
    }

    void set(void* object, const char* key, const std::string& value) const {
        check(av_opt_set(object, key, value.c_str(), 0), key);
    }

    void open(const std::filesystem::path& file);
    void open_codec();
    void open_h264();
    void open_ffv1();
    void convert(const Image& frame);
    void write_packets();
};

void Encoder::Impl::open(const std::filesystem::path& file) {
    silence_ffmpeg();
    const std::string url = ffmpeg_url(file.string());
    const bool mp4 = container == Container::kMp4;
    check(avformat_alloc_output_context2(&format, nullptr, mp4 ? "mp4" : "matroska", url.c_str()),
          "no muxer");
    format->flags |= AVFMT_FLAG_BITEXACT;
    open_codec();

    stream = avformat_new_stream(format, nullptr);
    if (!stream) throw std::bad_alloc();
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = stream->r_frame_rate = codec->framerate;
    check(avcodec_parameters_from_context(stream->codecpar, codec.get()), "no stream parameters");

    check(avio_open(&format->pb, url.c_str(), AVIO_FLAG_WRITE), "cannot be written");
    if (mp4) {
        // The index before the data lets a player start without reading the whole file. Without
        // B-frames the first frame is at time zero and no edit list is needed to put it there.
        set(format->priv_data, "movflags", "+faststart");
        set(format->priv_data, "use_editlist", "0");
    }
    check(avformat_write_header(format, nullptr), "cannot be written");
}

void Encoder::Impl::open_codec() {
    const char* codec_name = container == Container::kMp4 ? "libx264" : "ffv1";
    const AVCodec* encoder = avcodec_find_encoder_by_name(codec_name);
    if (!encoder)
        throw RunError(name + ": the installed libavcodec has no " + codec_name + " encoder");
    codec.reset(avcodec_alloc_context3(encoder));
    picture.reset(av_frame_alloc());
    packet.reset(av_packet_alloc());
    if (!codec || !picture || !packet) throw std::bad_alloc();

    codec->width = options.width_px;
    codec->height = options.height_px;
    codec->time_base = {1, options.fps};
    codec->framerate = {options.fps, 1};
    codec->sample_aspect_ratio = {1, 1};
    codec->color_primaries = AVCOL_PRI_BT709;
    codec->thread_count = kThreads;
    codec->flags |= AV_CODEC_FLAG_BITEXACT;
    if (format->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    if (container == Container::kMp4)
        open_h264();
    else
        open_ffv1();
    check(avcodec_open2(codec.get(), encoder, nullptr), "the encoder does not start");

    picture->format = codec->pix_fmt;
    picture->width = codec->width;
    picture->height = codec->height;
    picture->color_range = codec->color_range;
    picture->colorspace = codec->colorspace;
    picture->color_primaries = codec->color_primaries;
    picture->color_trc = codec->color_trc;
    picture->chroma_location = codec->chroma_sample_location;
    check(av_frame_get_buffer(picture.get(), 0), "no memory for a frame");
}

void Encoder::Impl::open_h264() {
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->colorspace = AVCOL_SPC_BT709;
    codec->color_trc = AVCOL_TRC_BT709;
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->chroma_sample_location = AVCHROMA_LOC_LEFT;
    codec->gop_size = std::max(1, options.fps / 4);
    codec->max_b_frames = 0;
    codec->flags |= AV_CODEC_FLAG_CLOSED_GOP;
    set(codec->priv_data, "preset", options.preset);
    set(codec->priv_data, "crf", std::to_string(options.crf));
    set(codec->priv_data, "x264-params", "scenecut=0");

    scaler.reset(sws_alloc_context());
    if (!scaler) throw std::bad_alloc();
    SwsContext* sws = scaler.get();
    for (const char* side : {"src", "dst"}) {
        check(av_opt_set_int(sws, (std::string(side) + "w").c_str(), options.width_px, 0), "width");
        check(av_opt_set_int(sws, (std::string(side) + "h").c_str(), options.height_px, 0),
              "height");
    }
    av_opt_set_int(sws, "src_format", AV_PIX_FMT_RGB0, 0);
    av_opt_set_int(sws, "dst_format", AV_PIX_FMT_YUV420P, 0);
    // Chroma samples sit beside the left luma column and between the rows, as H.264 assumes.
    av_opt_set_int(sws, "dst_h_chr_pos", 0, 0);
    av_opt_set_int(sws, "dst_v_chr_pos", 128, 0);
    av_opt_set_int(sws, "sws_flags",
                   SWS_BICUBIC | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT, 0);
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(sws, bt709, /*srcRange=*/1, bt709, /*dstRange=*/0, /*brightness=*/0,
                             /*contrast=*/kOne, /*saturation=*/kOne);
    check(sws_init_context(sws, nullptr, nullptr), "no colour conversion");
}

void Encoder::Impl::open_ffv1() {
    codec->pix_fmt = alpha ? AV_PIX_FMT_BGRA : AV_PIX_FMT_0RGB32;
    codec->colorspace = AVCOL_SPC_RGB;
    codec->color_trc = AVCOL_TRC_IEC61966_2_1;
    codec->color_range = AVCOL_RANGE_JPEG;
    codec->gop_size = 1;  // every frame stands alone
    codec->level = 3;
    codec->slices = kSlices;
    codec->thread_type = FF_THREAD_SLICE;
    set(codec->priv_data, "slicecrc", "1");
}

void Encoder::Impl::convert(const Image& frame) {
    check(av_frame_make_writable(picture.get()), "no memory for a frame");
    const int width = options.width_px, height = options.height_px;
    if (scaler) {
        const std::uint8_t* rows[4] = {frame.rgba.data(), nullptr, nullptr, nullptr};
        const int strides[4] = {width * 4, 0, 0, 0};
        check(sws_scale(scaler.get(), rows, strides, 0, height, picture->data, picture->linesize),
              "no colour conversion");
        return;
    }
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* from = frame.pixel(0, y);
        std::uint8_t* to = picture->data[0] + static_cast<std::ptrdiff_t>(y) * picture->linesize[0];
        for (int x = 0; x < width; ++x, from += 4, to += 4) {
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
            to[3] = from[3];
        }
    }
}

void Encoder::Impl::write_packets() {
    for (;;) {
        const int code = avcodec_receive_packet(codec.get(), packet.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
        check(code, "the encoder gave up");
        packet->duration = 1;
        av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
        packet->stream_index = stream->index;
        check(av_interleaved_write_frame(format, packet.get()), "cannot be written");
        // Written at once, so that a full disk stops the run at the frame that does not fit.
        avio_flush(format->pb);
        check(format->pb->error, "cannot be written");
    }
}

Encoder::Encoder(const std::filesystem::path& file, std::string name, Container container,
                 const VideoOptions& options, bool alpha)
    : impl_(std::make_unique<Impl>()) {
    impl_->name = std::move(name);
    impl_->container = container;
    impl_->options = options;
    impl_->alpha = alpha;
    impl_->open(file);
}

Encoder::~Encoder() = default;

void Encoder::append(const Image& frame) {
    impl_->convert(frame);
    impl_->picture->pts = impl_->next++;
    impl_->check(avcodec_send_frame(impl_->codec.get(), impl_->picture.get()),
                 "the encoder gave up");
    impl_->write_packets();
}

void Encoder::finish() {
    impl_->check(avcodec_send_frame(impl_->codec.get(), nullptr), "the encoder gave up");
    impl_->write_packets();
    impl_->check(av_write_trailer(impl_->format), "cannot be written");
    avio_flush(impl_->format->pb);
    impl_->check(impl_->format->pb->error, "cannot be written");
    impl_->check(avio_closep(&impl_->format->pb), "cannot be written");
    impl_->close();
}

}  // namespace risorius::media::detail
