#include "dataset/videos/video.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/text.h"
#include "dataset/videos/cell_painter.h"
#include "dataset/videos/clip_film.h"
#include "io/image/pictures.h"
#include "io/system/temporary.h"
#include "io/video/h264_file.h"

namespace thermal {
namespace {

enum class OutKind { video, png, jpeg };

OutKind kind_of(const Path& out) {
  const std::string ending = lower_case(out.extension().string());
  if (ending == ".mp4") return OutKind::video;
  if (ending == ".png") return OutKind::png;
  if (ending == ".jpg" || ending == ".jpeg") return OutKind::jpeg;
  throw ConfigError(fault("--out", fmt::format("\"{}\"", out.string()), "",
                          "a name that ends in .mp4 (video), .png or .jpg (one frame)"));
}

void check_request(const VideoRequest& request) {
  const OutKind kind = kind_of(request.out);
  if (kind == OutKind::video && request.frame)
    throw ConfigError(fault("--frame", std::to_string(*request.frame), "",
                            "a picture as --out, .png or .jpg; a video shows all frames"));
  if (std::filesystem::is_directory(request.out))
    throw ConfigError(
        fault("--out", fmt::format("\"{}\"", request.out.string()), "", "a file, not a folder"));
}

void check_count(const std::vector<std::string>& ids, const Path& source) {
  if (ids.size() <= kMostClips) return;
  throw ConfigError(fmt::format("{} has {} clips; expected at most {} in one video, chosen by --clips",
                                source.string(), ids.size(), kMostClips));
}

/// Clips that another dataset has as well. Requested clips must all exist there.
std::vector<std::string> common_clips(const std::vector<std::string>& ids, const FilmedDataset& other,
                                      bool asked) {
  if (asked) {
    other.check_clips(ids);
    return ids;
  }
  std::vector<std::string> common;
  for (const std::string& id : ids) {
    if (std::ranges::find(other.made, id) != other.made.end()) common.push_back(id);
  }
  if (common.empty())
    throw ConfigError(fmt::format("--side-by-side {} has none of the clips {}; expected the same ids",
                                  other.layout.root.string(), list_names(ids)));
  return common;
}

/// Everything that is shown, in the order of the grid's cells.
struct Programme {
  std::vector<FilmedDataset> datasets;  ///< one, or two side by side
  std::vector<ClipFilm> films;
  std::vector<std::string> not_made;

  [[nodiscard]] const FilmedDataset& dataset_of(std::size_t film) const {
    return datasets[film % datasets.size()];
  }
  [[nodiscard]] double rate_hz() const {
    return std::ranges::max(films, {}, &ClipFilm::frame_rate_hz).frame_rate_hz;
  }
  [[nodiscard]] int frames() const {
    double seconds = 0;
    for (const ClipFilm& film : films)
      seconds = std::max(seconds, (film.frames.back().frame_index + 1) / film.frame_rate_hz);
    return static_cast<int>(std::lround(std::ceil(seconds * rate_hz() - 1e-6)));
  }
};

/// A bar of temperatures needs one curve for the whole frame.
void check_curves(const Programme& programme) {
  for (const ClipFilm& film : programme.films) {
    const bool is_local =
        std::ranges::any_of(film.frames, [](const FilmFrame& frame) { return !frame.thresholds; });
    if (is_local)
      throw ConfigError(
          fmt::format("--scale: clip {} has the gain control {}, whose levels depend on the place; "
                      "expected --range as well, or no --scale",
                      film.id, film.agc_mode));
  }
}

Programme read_programme(const VideoRequest& request) {
  const ClipSource source = find_clip_source(request.source, request.clips);
  std::vector<std::string> ids = source.clips;
  Programme programme;
  programme.datasets.push_back(source.dataset);
  if (!request.beside.empty()) {
    programme.datasets.push_back(find_clip_source(request.beside, {}).dataset);
    ids = common_clips(ids, programme.datasets.back(), source.chosen);
  }
  check_count(ids, request.source);
  for (const std::string& id : ids) {
    for (const FilmedDataset& dataset : programme.datasets)
      programme.films.push_back(read_clip_film(dataset, id, request.boxes || request.tracks));
  }
  if (request.scale && !request.range) check_curves(programme);
  programme.not_made = source.not_made();
  return programme;
}

/// Headings over the columns: the datasets' names, or those of their folders if both have one name.
std::vector<std::string> headings_of(const Programme& programme) {
  std::vector<std::string> headings;
  for (const FilmedDataset& dataset : programme.datasets) headings.push_back(dataset.name);
  if (headings.size() == 2 && headings[0] == headings[1]) {
    for (std::size_t k = 0; k < 2; ++k)
      headings[k] = std::filesystem::weakly_canonical(programme.datasets[k].layout.root).filename().string();
  }
  return headings;
}

Grid grid_of(const Programme& programme, const VideoRequest& request) {
  GridRequest what;
  for (const ClipFilm& film : programme.films) what.frames.push_back({film.width_px, film.height_px});
  what.columns = programme.datasets.size() == 2 ? 2 : 0;
  what.width_px = request.width_px;
  what.bar = request.scale;
  what.headings = programme.datasets.size() == 2;
  return make_grid(what);
}

/// The last frame of a film that was taken at or before a time; otherwise the first.
std::size_t frame_at(const ClipFilm& film, double time_s) {
  constexpr double kRounding = 1e-6;  // of a frame
  const double index = std::floor(time_s * film.frame_rate_hz + kRounding);
  const auto after = std::ranges::upper_bound(film.frames, index, {},
                                              [](const FilmFrame& frame) { return 1.0 * frame.frame_index; });
  return after == film.frames.begin() ? 0 : static_cast<std::size_t>(after - film.frames.begin() - 1);
}

/// Paints whole frames of the video.
class Painter {
 public:
  Painter(const Programme& programme, const VideoRequest& request)
      : programme_(programme),
        grid_(grid_of(programme, request)),
        style_{.palette = palette_table(request.palette),
               .boxes = request.boxes,
               .tracks = request.tracks,
               .range = request.range,
               .text_px = grid_.text_px},
        letters_(request.assets),
        picture_(grid_.height_px, grid_.width_px, CV_8UC3) {
    fill(picture_, {0, 0, grid_.width_px, grid_.height_px}, {kBackground, 1});
    for (std::size_t k = 0; k < programme.films.size(); ++k)
      cells_.emplace_back(programme.films[k], grid_.cells[k], style_, programme.dataset_of(k), letters_);
    paint_headings();
  }

  [[nodiscard]] const Grid& grid() const { return grid_; }

  const cv::Mat& paint(int frame) {
    letters_.trim();
    const double time_s = frame / programme_.rate_hz();
    for (std::size_t k = 0; k < cells_.size(); ++k)
      cells_[k].paint(frame_at(programme_.films[k], time_s), picture_);
    return picture_;
  }

 private:
  void paint_headings() {
    if (grid_.headings.empty()) return;
    const std::vector<std::string> names = headings_of(programme_);
    const int size_px = grid_.text_px * 5 / 4;
    for (std::size_t k = 0; k < grid_.headings.size(); ++k) {
      const PixelRect& line = grid_.headings[k];
      const std::string text = letters_.shortened(printable(names[k]), size_px, true, line.width_px);
      write(picture_, letters_.picture(text, size_px, true),
            {line.x_px, line.y_px + (line.height_px + letters_.capital_px(size_px)) / 2}, {kBright, 1});
    }
  }

  const Programme& programme_;
  Grid grid_;
  CellStyle style_;
  Letters letters_;
  cv::Mat picture_;
  std::vector<CellPainter> cells_;
};

/// Copies Y, U and V of a whole frame.
void copy_planes(const cv::Mat& i420, const H264File::Planes& out) {
  const std::uint8_t* from = i420.data;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const int part = plane == 0 ? 1 : 2;
    const int width_px = out.width_px / part;
    for (int y = 0; y < out.height_px / part; ++y, from += width_px)
      std::copy_n(from, width_px, out.data[plane] + static_cast<std::ptrdiff_t>(y) * out.stride_px[plane]);
  }
}

void write_video(Painter& painter, const Programme& programme, const VideoRequest& request,
                 const RunHooks& hooks) {
  TemporaryFile part(request.out);
  // Four threads on every machine. At 20, noise and thin lines look as in the frames.
  H264File file(part.path(), {.frame_rate_hz = programme.rate_hz(),
                              .width_px = painter.grid().width_px,
                              .height_px = painter.grid().height_px,
                              .preset = "medium",
                              .quality = 20,
                              .threads = 4,
                              .streamable = true});
  const int frames = programme.frames();
  const std::string name = request.out.filename().string();
  cv::Mat i420;
  for (int frame = 0; frame < frames; ++frame) {
    if (hooks.stop_wanted()) throw Cancelled();
    cv::cvtColor(painter.paint(frame), i420, cv::COLOR_BGR2YUV_I420);
    file.add([&i420](const H264File::Planes& planes) { copy_planes(i420, planes); });
    hooks.report({.clip = name, .done = frame + 1, .total = frames});
  }
  file.close();
  part.keep();
}

void write_still(Painter& painter, int frame, const VideoRequest& request) {
  const PictureFormat format =
      kind_of(request.out) == OutKind::png ? PictureFormat::png : PictureFormat::jpeg;
  write_file_atomically(request.out, encode_picture(painter.paint(frame), format));
}

int still_frame(const VideoRequest& request, int frames) {
  const int frame = request.frame.value_or(frames / 2);
  if (frame >= 0 && frame < frames) return frame;
  throw ConfigError(fault("--frame", std::to_string(frame), "", fmt::format("0 to {}", frames - 1)));
}

}  // namespace

VideoOutcome make_video(const VideoRequest& request, const RunHooks& hooks) {
  check_request(request);
  const Programme programme = read_programme(request);
  Painter painter(programme, request);
  const bool video = kind_of(request.out) == OutKind::video;
  if (video) write_video(painter, programme, request, hooks);
  if (!video) write_still(painter, still_frame(request, programme.frames()), request);
  return {.frames = video ? programme.frames() : 1,
          .seconds = video ? programme.frames() / programme.rate_hz() : 0,
          .clips = programme.films.size() / programme.datasets.size(),
          .width_px = painter.grid().width_px,
          .height_px = painter.grid().height_px,
          .bytes = std::filesystem::file_size(request.out),
          .not_made = programme.not_made};
}

}  // namespace thermal
