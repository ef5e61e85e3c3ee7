#include "io/label_files/birdsai.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/image/pictures.h"
#include "io/system/text_file.h"
#include "labels/label_set.h"

namespace thermal {
namespace {

constexpr int kColumns = 10;
constexpr int kObjectColumn = 1;  // ids of 64 bits; all others are small
constexpr std::string_view kUnknownAnimal = "animal";

/// By species number.
constexpr std::array<std::string_view, 9> kSpecies = {
    "human", "elephant", "lion", "giraffe", "dog", "crocodile", "hippopotamus", "zebra", "rhinoceros"};

struct Row {
  int frame = 0;
  std::int64_t object = 0;
  LabelBox box;
  std::string_view category;
  bool occluded = false;
  bool noisy = false;
};

/// Position of a row, for messages.
struct Location {
  std::string file;
  int line = 0;

  [[nodiscard]] DataError fault_of(const std::string& what, const std::string& rule) const {
    return DataError(fmt::format("{}:{}: {}; expected {}", file, line, what, rule));
  }
};

/// Without surrounding blanks.
std::string_view trimmed(std::string_view cell) {
  cell.remove_prefix(std::min(cell.find_first_not_of(' '), cell.size()));
  return cell.substr(0, cell.find_last_not_of(' ') + 1);
}

std::array<std::int64_t, kColumns> numbers_of(std::string_view line, const Location& location) {
  const std::vector<std::string_view> cells = split(line, ',');
  if (cells.size() != kColumns) {
    throw location.fault_of(fmt::format("{} columns", cells.size()),
                            "10: frame, object_id, x_min, y_min, w, h, class, species, occluded, noisy");
  }
  std::array<std::int64_t, kColumns> numbers{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::optional<std::int64_t> number = number_in<std::int64_t>(trimmed(cells[i]));
    const bool fits = i == kObjectColumn || (number && std::in_range<int>(*number));
    if (!number || !fits)
      throw location.fault_of(fmt::format("column {} is \"{}\"", i + 1, cells[i]), "a whole number");
    numbers[i] = *number;
  }
  return numbers;
}

std::string_view category_of(std::int64_t animal_or_human, std::int64_t species, const Location& location) {
  if (animal_or_human != 0 && animal_or_human != 1)
    throw location.fault_of(fmt::format("class {}", animal_or_human), "0 (animal) or 1 (human)");
  if (species < -1 || species >= static_cast<int>(kSpecies.size()))
    throw location.fault_of(fmt::format("species {}", species), "-1 (unknown) to 8 (rhino)");
  if (species == -1) return animal_or_human == 1 ? kSpecies[0] : kUnknownAnimal;
  if ((species == 0) != (animal_or_human == 1))
    throw location.fault_of(fmt::format("class {} with species {}", animal_or_human, species),
                            "class 1 with species 0 or -1, class 0 with another");
  return kSpecies[static_cast<std::size_t>(species)];
}

bool flag_of(std::int64_t number, const char* name, const Location& location) {
  if (number != 0 && number != 1) throw location.fault_of(fmt::format("{} {}", name, number), "0 or 1");
  return number == 1;
}

Row row_of(std::string_view line, const Location& location) {
  const std::array<std::int64_t, kColumns> n = numbers_of(line, location);
  if (n[0] < 0) throw location.fault_of(fmt::format("frame {}", n[0]), "0 or more");
  if (n[4] < 0 || n[5] < 0)
    throw location.fault_of(fmt::format("a box of {} x {} px", n[4], n[5]), "sides that are not negative");
  return {.frame = static_cast<int>(n[0]),
          .object = n[1],
          .box = {.x_px = static_cast<double>(n[2]),
                  .y_px = static_cast<double>(n[3]),
                  .width_px = static_cast<double>(n[4]),
                  .height_px = static_cast<double>(n[5])},
          .category = category_of(n[6], n[7], location),
          .occluded = flag_of(n[8], "occluded", location),
          .noisy = flag_of(n[9], "noisy", location)};
}

/// Files of a folder with one of these extensions, in the order of their names; empty if the folder does not exist.
std::vector<Path> files_of(const Path& folder, std::initializer_list<std::string_view> endings) {
  std::vector<Path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Path& file = entry.path();
    if (std::find(endings.begin(), endings.end(), file.extension().string()) != endings.end())
      files.push_back(file);
  }
  std::ranges::sort(files, {}, [](const Path& file) { return std::pair(file.stem(), file.extension()); });
  return files;
}

/// Pictures of a video by frame: VIDEO_0000000012.jpg is frame 12. Other names do not belong to the video.
std::map<int, Path> pictures_of(const Path& folder, const std::string& video) {
  std::map<int, Path> pictures;
  for (const Path& file : files_of(folder / video, {".jpg", ".jpeg", ".png"})) {
    const std::string stem = file.stem().string();
    if (!stem.starts_with(video + "_")) continue;
    const std::string_view digits = std::string_view(stem).substr(video.size() + 1);
    const std::optional<int> frame = number_in<int>(digits);
    if (!frame) continue;
    const auto [there, fresh] = pictures.emplace(*frame, file);
    if (!fresh)
      throw DataError(fmt::format("{}: {} and {} are both frame {}; expected one picture per frame",
                                  (folder / video).string(), there->second.filename().string(),
                                  file.filename().string(), *frame));
  }
  return pictures;
}

class BirdsaiReader {
 public:
  explicit BirdsaiReader(const Path& folder) : folder_(folder) {
    set_.name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
    set_.root = folder.string();
  }

  LabelSet read() {
    const auto videos = files_of(folder_ / "annotations", {".csv"});
    if (videos.empty()) throw IoError((folder_ / "annotations").string() + " holds no .csv file");
    std::vector<std::vector<Row>> rows;
    for (const Path& file : videos) rows.push_back(rows_of(file));
    number_used_categories(rows);
    for (std::size_t i = 0; i < videos.size(); ++i) add_video(videos[i].stem().string(), rows[i]);
    return std::move(set_);
  }

 private:
  std::vector<Row> rows_of(const Path& file) const {
    const std::string text = read_text_file(file);
    std::vector<Row> rows;
    std::set<std::pair<int, std::int64_t>> seen;
    Location location{.file = file.string()};
    for (std::string_view line : split(text, '\n')) {
      ++location.line;
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (line.empty()) continue;
      rows.push_back(row_of(line, location));
      if (!seen.emplace(rows.back().frame, rows.back().object).second) {
        throw location.fault_of(
            fmt::format("object {} appears twice in frame {}", rows.back().object, rows.back().frame),
            "once");
      }
    }
    return rows;
  }

  void number_used_categories(const std::vector<std::vector<Row>>& rows) {
    std::set<std::string> used;
    for (const auto& video : rows) {
      for (const Row& row : video) used.emplace(row.category);
    }
    for (const auto& [name, id] : number_categories(used)) {
      if (used.contains(name)) set_.categories.push_back({id, name});
    }
    std::sort(set_.categories.begin(), set_.categories.end(),
              [](const LabelCategory& a, const LabelCategory& b) { return a.id < b.id; });
  }

  void add_video(const std::string& video, const std::vector<Row>& rows) {
    const std::map<int, Path> pictures = pictures_of(folder_ / "images", video);
    std::map<int, std::vector<const Row*>> frames;
    for (const auto& [frame, file] : pictures) frames[frame];
    for (const Row& row : rows) frames[row.frame].push_back(&row);
    const PictureSize size = pictures.empty() ? PictureSize{} : read_picture_size(pictures.begin()->second);
    for (const auto& [frame, labels] : frames) {
      const auto picture = pictures.find(frame);
      const std::string name = picture == pictures.end() ? fmt::format("{}_{:010}.jpg", video, frame)
                                                         : picture->second.filename().string();
      set_.images.push_back({.id = static_cast<std::int64_t>(set_.images.size() + 1),
                             .file = fmt::format("images/{}/{}", video, name),
                             .width_px = size.width_px,
                             .height_px = size.height_px,
                             .video = set_.videos.size(),
                             .frame_index = frame});
      for (const Row* row : labels) add_label(*row);
    }
    set_.videos.push_back({.name = video});
  }

  void add_label(const Row& row) {
    const auto category = std::find_if(set_.categories.begin(), set_.categories.end(),
                                       [&row](const LabelCategory& c) { return c.name == row.category; });
    Label label;
    label.id = static_cast<std::int64_t>(set_.labels.size() + 1);
    label.image = set_.images.size() - 1;
    label.category = static_cast<std::size_t>(category - set_.categories.begin());
    label.box = row.box;
    label.area_px = row.box.area_px();
    label.noisy = row.noisy;
    label.track_id = row.object;
    label.occluded = row.occluded;
    set_.labels.push_back(label);
  }

  Path folder_;
  LabelSet set_;
};

}  // namespace

LabelSet read_birdsai(const Path& folder) { return BirdsaiReader(folder).read(); }

BirdsaiKind birdsai_kind(const std::string& category) {
  if (kind_of(category) == Kind::human) return {.animal_or_human = 1, .species = 0};
  const auto* const species = std::find(kSpecies.begin(), kSpecies.end(), category);
  return {.animal_or_human = 0,
          .species = species == kSpecies.end() ? -1 : static_cast<int>(species - kSpecies.begin())};
}

}  // namespace thermal
