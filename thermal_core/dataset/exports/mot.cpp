#include "dataset/exports/mot.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

/// A clip's images are those from `begin` to `end`.
struct Clip {
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::vector<Clip> clips_of(const LabelSet& set) {
  std::vector<Clip> clips;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    if (i == 0 || set.images[i].video != set.images[i - 1].video) clips.push_back({.begin = i, .end = i});
    clips.back().end = i + 1;
  }
  return clips;
}

class MotPlanner {
 public:
  explicit MotPlanner(const ExportInput& input)
      : input_(input),
        set_(input.set),
        first_(first_labels(input.set)),
        seqmaps_(input.splits.size(), "name\n") {}

  ExportPlan plan() {
    for (const Clip& clip : clips_of(set_)) add(clip);
    for (std::size_t split = 0; split < input_.splits.size(); ++split) {
      const std::string name = file_name_of(set_.name) + "-" + input_.splits[split];
      plan_.texts.push_back({.to = "seqmaps/" + name + ".txt", .content = seqmaps_[split]});
    }
    plan_.texts.push_back({.to = "classes.txt", .content = classes()});
    return std::move(plan_);
  }

 private:
  void add(const Clip& clip) {
    check_alike(clip);
    check_in_time(set_, set_.images[clip.begin], "mot");
    const std::size_t video = set_.images[clip.begin].video;
    const std::size_t split = input_.of_video[video];
    const std::string name = file_name_of(set_.videos[video].name);
    const std::string folder = input_.splits[split] + "/" + name;
    seqmaps_[split] += name + "\n";
    for (std::size_t i = clip.begin; i < clip.end; ++i) {
      const std::size_t frame = i - clip.begin + 1;
      plan_.pictures.push_back(
          {.image = i, .to = fmt::format("{}/img1/{:06}{}", folder, frame, ending_of(set_.images[i].file))});
    }
    const std::string& first = set_.images[clip.begin].file;
    plan_.texts.push_back({.to = folder + "/gt/gt.txt", .content = rows(clip), .of = first});
    plan_.texts.push_back({.to = folder + "/seqinfo.ini", .content = seqinfo(clip, name), .of = first});
  }

  /// seqinfo.ini has only one size and extension.
  void check_alike(const Clip& clip) const {
    const LabelImage& one = set_.images[clip.begin];
    for (std::size_t i = clip.begin; i < clip.end; ++i) {
      const LabelImage& other = set_.images[i];
      if (other.width_px == one.width_px && other.height_px == one.height_px &&
          ending_of(other.file) == ending_of(one.file))
        continue;
      throw DataError(
          fmt::format("{} is {} x {} px and {} is {} x {} px; expected all pictures of a clip to have one "
                      "kind and size, as --format mot requires",
                      one.file, one.width_px, one.height_px, other.file, other.width_px, other.height_px));
    }
  }

  [[nodiscard]] std::string rows(const Clip& clip) const {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::size_t k = first_[clip.begin]; k < first_[clip.end]; ++k)
      least = std::min(least, *set_.labels[k].track_id);
    const std::int64_t shift = least < 1 ? 1 - least : 0;
    std::string text;
    for (std::size_t i = clip.begin; i < clip.end; ++i) {
      std::vector<const Label*> labels;
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) labels.push_back(&set_.labels[k]);
      std::ranges::sort(labels, {}, [](const Label* label) { return *label->track_id; });
      for (const Label* label : labels) text += row(*label, i - clip.begin + 1, *label->track_id + shift);
    }
    return text;
  }

  [[nodiscard]] std::string row(const Label& label, std::size_t frame, std::int64_t track) const {
    const LabelBox& box = label.box;
    return fmt::format("{},{},{},{},{},{},{},{},{:.4g}\n", frame, track, box.x_px + 1, box.y_px + 1,
                       box.width_px, box.height_px, label.ignore || label.crowd ? 0 : 1,
                       class_number(label.category), label.visibility.value_or(1));
  }

  [[nodiscard]] std::string seqinfo(const Clip& clip, const std::string& name) const {
    const LabelImage& image = set_.images[clip.begin];
    const double rate_hz = set_.videos[image.video].frame_rate_hz;
    return fmt::format("[Sequence]\nname={}\nimDir=img1\n{}seqLength={}\nimWidth={}\nimHeight={}\nimExt={}\n",
                       name, rate_hz > 0 ? fmt::format("frameRate={:.6g}\n", rate_hz) : "",
                       clip.end - clip.begin, image.width_px, image.height_px, ending_of(image.file));
  }

  [[nodiscard]] std::string classes() const {
    std::string text;
    for (std::size_t i = 0; i < set_.categories.size(); ++i)
      text += fmt::format("{} {}\n", class_number(i), printable(set_.categories[i].name));
    return text;
  }

  [[nodiscard]] std::int64_t class_number(std::size_t category) const {
    const bool are_numbers = std::ranges::all_of(set_.categories, [](const LabelCategory& one) {
      return std::holds_alternative<std::int64_t>(one.id);
    });
    return are_numbers ? std::get<std::int64_t>(set_.categories[category].id)
                       : static_cast<std::int64_t>(category + 1);
  }

  const ExportInput& input_;
  const LabelSet& set_;
  std::vector<std::size_t> first_;
  std::vector<std::string> seqmaps_;  ///< by split
  ExportPlan plan_;
};

}  // namespace

ExportPlan plan_mot(const ExportInput& input) {
  check_tracks(input.set, "mot");
  return MotPlanner(input).plan();
}

}  // namespace thermal
