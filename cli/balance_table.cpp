#include "cli/balance_table.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "cli/output.h"

namespace veldt {
namespace {

using thermal::ClassCounts;
using thermal::kBalanceClasses;

/// A line of the table: a video, or all of them.
struct Row {
  std::string dataset;
  std::string video;
  std::size_t frames_taken = 0;
  std::size_t frames = 0;
  std::size_t unlabelled = 0;
  ClassCounts taken{};
  ClassCounts available{};

  void add(const Row& other) {
    frames_taken += other.frames_taken;
    frames += other.frames;
    unlabelled += other.unlabelled;
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      taken[k] += other.taken[k];
      available[k] += other.available[k];
    }
  }
};

std::vector<Row> rows_of(const Balanced& balanced) {
  std::vector<Row> rows;
  for (const thermal::SelectedDataset& dataset : balanced.selection.datasets) {
    for (const thermal::SelectedVideo& selected : dataset.videos) {
      const std::size_t i = rows.size();
      const thermal::BalanceVideo& video = balanced.program.videos[i];
      Row row{.dataset = dataset.path,
              .video = selected.name,
              .frames_taken = selected.frames.size(),
              .frames = video.unlabelled,
              .unlabelled = video.unlabelled,
              .taken = balanced.result.solution.labels_of(balanced.program, i),
              .available = video.available()};
      for (const thermal::FrameType& type : video.types) row.frames += type.frames.size();
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

Row sum_of(const std::vector<Row>& rows) {
  Row all{.dataset = "", .video = "all"};
  for (const Row& row : rows) all.add(row);
  return all;
}

std::string share(std::int64_t taken, std::int64_t available) {
  return available == 0 ? "-" : fmt::format("{}/{}", taken, available);
}

std::string head_of(std::size_t k) {
  std::string name = thermal::balance_class_names()[k];
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Cells of a row after its name.
std::vector<std::string> cells_of(const Row& row) {
  std::vector<std::string> cells = {fmt::format("{}/{}", row.frames_taken, row.frames)};
  for (std::size_t k = 0; k < kBalanceClasses; ++k) cells.push_back(share(row.taken[k], row.available[k]));
  return cells;
}

/// Columns under their headings, as wide as needed; names left-aligned, numbers right-aligned.
void print_rows(const std::vector<std::pair<std::string, std::vector<std::string>>>& lines) {
  std::vector<std::size_t> widths(kBalanceClasses + 1, 0);
  std::size_t name_width = 0;
  for (const auto& [name, cells] : lines) {
    name_width = std::max(name_width, name.size());
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  for (const auto& [name, cells] : lines) {
    print("{:<{}}", name, name_width);
    for (std::size_t i = 0; i < cells.size(); ++i) print("  {:>{}}", cells[i], widths[i]);
    print("\n");
  }
}

std::vector<std::string> headings() {
  std::vector<std::string> cells = {"frames"};
  for (std::size_t k = 0; k < kBalanceClasses; ++k) cells.push_back(head_of(k));
  return cells;
}

thermal::Json counts_json(const ClassCounts& counts) {
  thermal::Json json = thermal::Json::object();
  for (std::size_t k = 0; k < kBalanceClasses; ++k) json[thermal::balance_class_names()[k]] = counts[k];
  return json;
}

thermal::Json row_json(const Row& row) {
  return {{"frames_taken", row.frames_taken},
          {"frames", row.frames},
          {"unlabelled_frames", row.unlabelled},
          {"taken", counts_json(row.taken)},
          {"available", counts_json(row.available)}};
}

thermal::Json bounds_json(const thermal::BalanceProgram& program) {
  thermal::Json json = thermal::Json::object();
  for (std::size_t k = 0; k < kBalanceClasses; ++k)
    json[thermal::balance_class_names()[k]] = {{"at_least", program.bounds[k].at_least},
                                               {"at_most", program.bounds[k].at_most}};
  return json;
}

}  // namespace

void print_table(const Balanced& balanced) {
  const std::vector<Row> rows = rows_of(balanced);
  const Row all = sum_of(rows);
  std::vector<std::pair<std::string, std::vector<std::string>>> lines = {{"taken/all", headings()}};
  for (const Row& row : rows) {
    const bool several = balanced.sources.size() > 1;
    lines.emplace_back(several ? row.dataset + ": " + row.video : row.video, cells_of(row));
  }
  lines.emplace_back("all", cells_of(all));
  print_rows(lines);
  const thermal::BalanceResult& result = balanced.result;
  print(
      "objective: {} (most labels from one video minus fewest from a video with labels left, summed over "
      "classes)\n",
      result.solution.objective);
  print("lower bound: {}, gap {:.2f} %, {:.1f} s\n", result.bound, 100 * result.gap, balanced.time_s);
  if (all.frames_taken == 0) print("no frame is selected: no class requires a label\n");
  if (all.unlabelled > 0)
    print("{} frames have no label that counts; none of them is selected\n", all.unlabelled);
}

thermal::Json to_json(const Balanced& balanced) {
  const std::vector<Row> rows = rows_of(balanced);
  thermal::Json videos = thermal::Json::array();
  for (const Row& row : rows) {
    thermal::Json video = {{"dataset", row.dataset}, {"video", row.video}};
    video.update(row_json(row));
    videos.push_back(std::move(video));
  }
  return {{"objective", balanced.result.solution.objective},
          {"bound", balanced.result.bound},
          {"gap", balanced.result.gap},
          {"in_time", balanced.result.in_time},
          {"time_s", balanced.time_s},
          {"per_class", bounds_json(balanced.program)},
          {"most_from_a_video", counts_json(balanced.result.solution.most)},
          {"least_from_a_video", counts_json(balanced.result.solution.least)},
          {"all", row_json(sum_of(rows))},
          {"videos", std::move(videos)}};
}

}  // namespace veldt
