#include "bench/convert_stages.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <span>

#include <fmt/format.h>
#include <isa-l/igzip_lib.h>

#include "base/error.h"
#include "base/parallel.h"
#include "bench/measure.h"
#include "dataset/clip/annotations.h"
#include "dataset/clip/record.h"
#include "imaging/frame_converter.h"
#include "imaging/target_contrast.h"
#include "io/image/png.h"
#include "io/pass_reader.h"
#include "io/system/sha256.h"
#include "io/video/h264_file.h"

namespace thermal {
namespace {

constexpr double kBudgetS = 0.2;

/// Reads a file into existing memory.
void read_raw(const Path& file, std::vector<char>& memory) {
  std::ifstream in(file, std::ios::binary);
  in.rdbuf()->sgetn(memory.data(), static_cast<std::streamsize>(memory.size()));
}

template <typename T>
std::span<const std::byte> bytes_of(const Plane<T>& picture) {
  return std::as_bytes(picture.pixels());
}

/// ISA-L at level 3 on unfiltered pixels, in one call.
class RawDeflate {
 public:
  explicit RawDeflate(std::span<const std::byte> pixels)
      : pixels_(pixels.begin(), pixels.end()),
        search_(ISAL_DEF_LVL3_DEFAULT),
        out_(2 * pixels.size() + 4096) {}
  /// Returns the number of bytes written.
  std::size_t operator()() {
    ::isal_deflate_stateless_init(&stream_);
    stream_.level = 3;
    stream_.level_buf = search_.data();
    stream_.level_buf_size = static_cast<std::uint32_t>(search_.size());
    stream_.gzip_flag = IGZIP_ZLIB;
    stream_.end_of_stream = 1;
    stream_.next_in = reinterpret_cast<std::uint8_t*>(pixels_.data());
    stream_.avail_in = static_cast<std::uint32_t>(pixels_.size());
    stream_.next_out = out_.data();
    stream_.avail_out = static_cast<std::uint32_t>(out_.size());
    if (::isal_deflate_stateless(&stream_) != COMP_OK) throw Error("ISA-L cannot compress a picture");
    return stream_.total_out;
  }

 private:
  ::isal_zstream stream_{};
  std::vector<std::byte> pixels_;
  std::vector<std::uint8_t> search_;
  std::vector<std::uint8_t> out_;
};

/// One model's stages for a frame, each of which can be repeated.
class Line {
 public:
  Line(const ConvertJob& job, const ClipTask& task)
      : manifest_(job.scene.manifest),
        task_(task),
        converter_(manifest_, job.materials, task.clip.season, task.settings().sensor, task.physics),
        camera_(task.settings().sensor, clip(), converter_.brightest_w_m2_sr()) {}

  [[nodiscard]] PassNeeds needs() const { return converter_.needs(); }
  void convert(const Passes& passes) { converter_.convert(passes, manifest_.frames[0], scene_); }
  void expose() {
    camera_.expose(scene_.radiance_w_m2_sr, pictures_, [this](const Plane<float>& radiance) {
      set_contrast(camera_, radiance, scene_.instances);
    });
  }
  /// Writes its labels and its line of frames.jsonl; returns the number of bytes.
  std::size_t label_and_record() {
    ClipAnnotations annotations(manifest_);
    annotations.add_frame(0, scene_.instances);
    std::size_t bytes = 0;
    annotations.write([&bytes](std::string_view text) { bytes += text.size(); });
    return bytes + tone_record(pictures_.curve, task_.settings().sensor.agc, converter_.brightest_w_m2_sr())
                       .dump()
                       .size();
  }
  [[nodiscard]] const SensorFrame& pictures() const { return pictures_; }

 private:
  [[nodiscard]] ThermalCamera::Clip clip() const {
    return {.id = manifest_.clip,
            .seed = 1,
            .frame_rate_hz = manifest_.frame_rate_hz,
            .width_px = manifest_.camera.width_px,
            .height_px = manifest_.camera.height_px,
            .noise_gain = {},
            .sampling = {}};
  }

  const Manifest& manifest_;
  const ClipTask& task_;
  FrameConverter converter_;
  ThermalCamera camera_;
  SceneFrame scene_;
  SensorFrame pictures_;
};

/// Pixels of the object index that differ after reading back.
double wrong_px(const Passes& read, const Passes& written) {
  double wrong = 0;
  for (std::size_t i = 0; i < read.object_index.size(); ++i)
    wrong += read.object_index.pixels()[i] != written.object_index.pixels()[i];
  for (std::size_t i = 0; i < read.depth_m.size(); ++i)
    wrong += read.depth_m.pixels()[i] != written.depth_m.pixels()[i];
  return wrong;
}

template <typename T>
double wrong_px(const Plane<T>& read, const Plane<T>& written) {
  double wrong = 0;
  for (std::size_t i = 0; i < written.size(); ++i) wrong += read.pixels()[i] != written.pixels()[i];
  return wrong;
}

/// Measures the rows of one picture size.
class Stages {
 public:
  Stages(const ConvertJob& job, const Path& folder)
      : job_(job),
        folder_(folder),
        pixels_(job.scene.passes.object_index.size()),
        file_bytes_(std::filesystem::file_size(job.file)),
        size_(
            fmt::format("{} x {}", job.scene.manifest.camera.width_px, job.scene.manifest.camera.height_px)),
        published_(job, job.published),
        physical_(job, job.physical) {}

  std::vector<ConvertRow> rows() {
    measure_limits();
    measure_scene();
    measure_png(published_.pictures().ir8, "PNG, 8 bits", [](const Path& file) { return read_png8(file); });
    measure_png(published_.pictures().ir16, "PNG, 16 bits",
                [](const Path& file) { return read_png16(file); });
    measure_output();
    return rows_;
  }

 private:
  struct Limit {
    std::string name;
    double seconds = 0;
  };

  void add(const std::string& name, std::size_t bytes, const Limit& limit, std::vector<Figure> figures,
           const std::function<void()>& work) {
    const double seconds = shortest_run_s(work, kBudgetS);
    rows_.push_back({.group = size_ + ", stages, one thread",
                     .name = name,
                     .ms = 1e3 * seconds,
                     .mb_per_s = static_cast<double>(bytes) / 1e6 / seconds,
                     .limit = limit.name,
                     .times_limit = limit.seconds > 0 ? seconds / limit.seconds : 0,
                     .bound = "",
                     .figures = std::move(figures)});
  }

  void add_limit(const std::string& name, std::size_t bytes, double seconds, std::vector<Figure> figures) {
    rows_.push_back({.group = size_ + ", limits of this machine",
                     .name = name,
                     .ms = 1e3 * seconds,
                     .mb_per_s = static_cast<double>(bytes) / 1e6 / seconds,
                     .limit = "",
                     .times_limit = 0,
                     .bound = "",
                     .figures = std::move(figures)});
  }

  /// Copies as many bytes as a stage reads and writes.
  [[nodiscard]] static Limit copying(std::size_t bytes) { return {"memcpy", memcpy_s(bytes, kBudgetS / 4)}; }

  void measure_limits() {
    add_limit("memcpy, as many bytes as a file of passes", file_bytes_, copying(file_bytes_).seconds, {});
    std::vector<char> memory(file_bytes_);
    raw_read_s_ = shortest_run_s([&] { read_raw(job_.file, memory); }, kBudgetS);
    add_limit("raw read of that file, from memory", file_bytes_, raw_read_s_, {});
  }

  void measure_scene() {
    const PassReader reader(job_.scene.manifest);
    const PassNeeds all = physical_.needs();
    const Passes passes = reader.read(job_.file, all);
    const std::size_t plane = pixels_ * sizeof(float);
    const std::size_t indices = 2 * pixels_ * sizeof(std::uint16_t);
    const Limit raw_read{"raw read", raw_read_s_};
    add("read, published", file_bytes_, raw_read, {{"wrong_px", wrong_px(passes, job_.scene.passes)}},
        [&] { (void)reader.read(job_.file, published_.needs()); });
    add("read, physical", file_bytes_, raw_read, {{"wrong_px", wrong_px(passes, job_.scene.passes)}},
        [&] { (void)reader.read(job_.file, all); });
    add("convert, published", indices, copying(indices + plane), {}, [&] { published_.convert(passes); });
    add("convert, physical", indices + 4 * plane, copying(indices + 5 * plane), {},
        [&] { physical_.convert(passes); });
    add("expose, published", plane, copying(plane + 3 * pixels_), {}, [&] { published_.expose(); });
    add("expose, physical", plane, copying(plane + 3 * pixels_), {}, [&] { physical_.expose(); });
  }

  template <typename T, typename Read>
  void measure_png(const Plane<T>& picture, const std::string& name, const Read& read) {
    const std::span<const std::byte> pixels = bytes_of(picture);
    RawDeflate deflate(pixels);
    const double deflate_s = shortest_run_s([&] { (void)deflate(); }, kBudgetS);
    add_limit("raw deflate, ISA-L, of " + name.substr(5), pixels.size(), deflate_s,
              {{"bytes", static_cast<double>(deflate())}});
    encode_png(picture, png_);
    const Path file = folder_ / "picture.png";
    std::filesystem::remove(file);
    write_file(file, png_);
    png_bytes_ += png_.size();
    add(name, pixels.size(), {"raw deflate", deflate_s},
        {{"bytes", static_cast<double>(png_.size())}, {"wrong_px", wrong_px(read(file), picture)}},
        [&] { encode_png(picture, png_); });
  }

  void measure_output() {
    const SensorFrame& pictures = published_.pictures();
    const std::vector<std::byte> files(png_bytes_, std::byte{1});
    const std::size_t summed = 3 * pixels_ + png_bytes_;
    add("SHA-256 of pixels and files", summed, copying(summed), {}, [&] {
      (void)sha256_of(bytes_of(pictures.ir8));
      (void)sha256_of(bytes_of(pictures.ir16));
      (void)sha256_of(files);
    });
    add("files written", png_bytes_, copying(png_bytes_), {}, [&] {
      std::filesystem::remove(folder_ / "written.png");
      write_file(folder_ / "written.png", files);
    });
    std::size_t text = 0;
    const auto label_and_record = [&] { text = published_.label_and_record(); };
    label_and_record();
    add("labels and frame record", text, copying(text), {{"bytes", static_cast<double>(text)}},
        label_and_record);
    PreviewVideo video(folder_ / "preview.mp4", job_.scene.manifest.frame_rate_hz, pictures.ir8.width_px(),
                       pictures.ir8.height_px());
    add("preview", pixels_, copying(pixels_), {}, [&] { video.add(pictures.ir8); });
  }

  const ConvertJob& job_;
  const Path& folder_;
  std::size_t pixels_;
  std::size_t file_bytes_;
  std::string size_;
  Line published_;
  Line physical_;
  double raw_read_s_ = 0;
  std::vector<std::byte> png_;
  std::size_t png_bytes_ = 0;
  std::vector<ConvertRow> rows_;
};

}  // namespace

std::vector<ConvertRow> convert_stage_rows(const ConvertJob& job, const Path& folder) {
  std::vector<ConvertRow> rows = with_threads(1, [&] { return Stages(job, folder).rows(); });
  std::stable_partition(rows.begin(), rows.end(),
                        [](const ConvertRow& row) { return row.group.ends_with("limits of this machine"); });
  return rows;
}

}  // namespace thermal
