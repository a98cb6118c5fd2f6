// SPDX-License-Identifier: Apache-2.0
// FFmpeg's libraries are used directly, and not through cv::VideoWriter, which cannot pass x264 the
// two settings that make the same frames give the same bytes. First, no AVX-512: that code of x264
// r3095 reads memory that it never wrote, so a film depends on what lay in the heap before (seen
// with MALLOC_PERTURB_; its AVX2 code gives one result). Second, a fixed number of threads: x264's
// choices depend on how many it has, and by default that number depends on the machine.
#include "media/h264_file.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <cerrno>
#include <stdexcept>
#include <string>

namespace floorproof {
namespace {

constexpr int kThreads = 4;

int Check(int code, const char* what) {
  if (code >= 0) return code;
  char reason[AV_ERROR_MAX_STRING_SIZE] = "";
  av_strerror(code, reason, sizeof reason);
  throw std::runtime_error(std::string(what) + ": " + reason);
}

template <class T>
T* NotNull(T* pointer, const char* what) {
  if (pointer == nullptr) throw std::runtime_error(what);
  return pointer;
}

const char* X264Settings() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "asm=avx2";
#endif
  return "";
}

}  // namespace

struct H264File::Impl {
  AVFormatContext* container = nullptr;
  AVCodecContext* encoder = nullptr;
  AVStream* stream = nullptr;
  SwsContext* converter = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;
  std::int64_t frames = 0;

  ~Impl() {
    av_packet_free(&packet);
    av_frame_free(&frame);
    sws_freeContext(converter);
    avcodec_free_context(&encoder);
    if (container != nullptr) avio_closep(&container->pb);
    avformat_free_context(container);
  }

  void OpenEncoder(int width, int height, double fps) {
    const AVCodec* codec = NotNull(avcodec_find_encoder_by_name("libx264"),
                                   "FFmpeg's libavcodec was built without libx264");
    encoder = NotNull(avcodec_alloc_context3(codec), "no memory");
    encoder->width = width;
    encoder->height = height;
    encoder->framerate = av_d2q(fps, 1'000'000);
    encoder->time_base = av_inv_q(encoder->framerate);
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;
    // Said in the file, so that browsers do not guess the colours from the size.
    encoder->color_range = AVCOL_RANGE_MPEG;
    encoder->colorspace = AVCOL_SPC_BT709;
    encoder->color_primaries = AVCOL_PRI_BT709;
    encoder->color_trc = AVCOL_TRC_BT709;
    encoder->thread_count = kThreads;
    encoder->flags |= AV_CODEC_FLAG_BITEXACT;
    if (container->oformat->flags & AVFMT_GLOBALHEADER)
      encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    Check(av_opt_set(encoder->priv_data, "profile", "high", 0), "H.264 profile");
    Check(av_opt_set(encoder->priv_data, "crf", "23", 0), "H.264 quality");  // x264's default
    Check(av_opt_set(encoder->priv_data, "x264-params", X264Settings(), 0), "x264 settings");
    Check(avcodec_open2(encoder, codec, nullptr), "the H.264 encoder");
  }

  void OpenConverter() {
    converter = NotNull(sws_getContext(encoder->width, encoder->height, AV_PIX_FMT_RGB24,
                                       encoder->width, encoder->height, AV_PIX_FMT_YUV420P,
                                       SWS_BICUBIC | SWS_ACCURATE_RND, nullptr, nullptr, nullptr),
                        "no conversion from RGB to YUV 4:2:0");
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(converter, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
    frame = NotNull(av_frame_alloc(), "no memory");
    frame->format = AV_PIX_FMT_YUV420P;
    frame->width = encoder->width;
    frame->height = encoder->height;
    Check(av_frame_get_buffer(frame, 0), "a frame's memory");
  }

  // Sends one frame, or the end (nullptr), and writes the packets that come out.
  void Encode(const AVFrame* input) {
    Check(avcodec_send_frame(encoder, input), "encoding");
    for (;;) {
      const int code = avcodec_receive_packet(encoder, packet);
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      Check(code, "encoding");
      packet->duration = 1;
      av_packet_rescale_ts(packet, encoder->time_base, stream->time_base);
      packet->stream_index = stream->index;
      Check(av_interleaved_write_frame(container, packet), "writing");
    }
  }
};

H264File::H264File(const char* path, int width, int height, double fps)
    : impl_(std::make_unique<Impl>()) {
  Impl& f = *impl_;
  Check(avformat_alloc_output_context2(&f.container, nullptr, "mp4", path), "the MP4 container");
  f.container->flags |= AVFMT_FLAG_BITEXACT;  // no version strings in the file
  f.OpenEncoder(width, height, fps);
  f.OpenConverter();
  f.packet = NotNull(av_packet_alloc(), "no memory");
  f.stream = NotNull(avformat_new_stream(f.container, nullptr), "no memory");
  f.stream->time_base = f.encoder->time_base;
  f.stream->avg_frame_rate = f.encoder->framerate;
  Check(avcodec_parameters_from_context(f.stream->codecpar, f.encoder), "the stream's parameters");
  Check(avio_open(&f.container->pb, path, AVIO_FLAG_WRITE), "opening");
  // The index goes first, so that a browser plays the film while it still loads.
  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "faststart", 0);
  const int code = avformat_write_header(f.container, &options);
  av_dict_free(&options);
  Check(code, "writing");
}

H264File::~H264File() = default;

void H264File::Add(const std::uint8_t* rgb) {
  Impl& f = *impl_;
  Check(av_frame_make_writable(f.frame), "a frame's memory");
  const std::uint8_t* const rows[] = {rgb};
  const int stride[] = {3 * f.encoder->width};
  sws_scale(f.converter, rows, stride, 0, f.encoder->height, f.frame->data, f.frame->linesize);
  f.frame->pts = f.frames++;
  f.Encode(f.frame);
}

void H264File::Finish() {
  Impl& f = *impl_;
  if (f.frames == 0) throw std::runtime_error("a film without a frame");
  f.Encode(nullptr);
  Check(av_write_trailer(f.container), "writing the index");
  Check(avio_closep(&f.container->pb), "closing");
}

void SilenceVideoLibrary() { av_log_set_level(AV_LOG_QUIET); }

}  // namespace floorproof
