#include "dataset/reports/frames.h"

#include <cmath>

#include <fmt/format.h>

#include "dataset/reports/flights.h"
#include "dataset/reports/labels.h"
#include "support/catch.h"

namespace frames_test {

using namespace thermal;

namespace {

/// Videos of pictures with these numbers of labels.
LabelSet set_with(const std::vector<std::vector<int>>& videos) {
  LabelSet set;
  set.categories = {{1, "human"}, {2, "elephant"}};
  for (const std::vector<int>& pictures : videos) {
    set.videos.push_back({.name = fmt::format("v{}", set.videos.size())});
    for (const int labels : pictures) {
      LabelImage& image = set.images.emplace_back();
      image.width_px = image.height_px = 10;
      image.video = set.videos.size() - 1;
      for (int k = 0; k < labels; ++k) set.labels.emplace_back().image = set.images.size() - 1;
    }
  }
  return set;
}

using Chosen = std::vector<std::pair<std::size_t, std::string>>;

Chosen chosen_of(const LabelSet& set) {
  Chosen chosen;
  for (const SampleFrame& sample : choose_samples(set)) chosen.emplace_back(sample.image, sample.why);
  return chosen;
}

}  // namespace

TEST_CASE("A video shows the picture with most labels, its median and its first empty one") {
  CHECK(chosen_of(set_with({{2, 0, 5, 0, 5, 1}})) ==
        Chosen{{2, "most labels"}, {0, "median"}, {1, "no labels"}});
}

TEST_CASE("A video with fewer kinds of pictures shows those it has") {
  CHECK(chosen_of(set_with({{0, 0}})) == Chosen{{0, "no labels"}});
  CHECK(chosen_of(set_with({{3}})) == Chosen{{0, "most labels"}});
  CHECK(chosen_of(set_with({{}})).empty());
  CHECK(chosen_of(set_with({})).empty());
}

TEST_CASE("Many videos show fewer pictures each, and very many only some videos") {
  CHECK(choose_samples(set_with(std::vector(6, std::vector{1, 2, 3, 0}))).size() == 18);
  CHECK(choose_samples(set_with(std::vector(9, std::vector{1, 2, 3, 0}))).size() == 18);
  CHECK(choose_samples(set_with(std::vector(10, std::vector{1, 2, 3, 0}))).size() == 10);
  const LabelSet many = set_with(std::vector(100, std::vector{1, 0}));
  const std::vector<SampleFrame> samples = choose_samples(many);
  REQUIRE(samples.size() == 18);
  CHECK(samples.front().image == 0);
  CHECK(samples.back().image > 180);
}

TEST_CASE("Categories with most labels come first, equal ones by name, and those without labels last") {
  LabelSet set = set_with({{3}});
  set.categories = {{1, "a"}, {2, "z"}, {3, "b"}, {4, "c"}};
  set.labels[0].category = 3;
  set.labels[1].category = 2;
  set.labels[2].category = 2;
  CHECK(category_ranks(set) == std::vector<std::size_t>{2, 3, 0, 1});
  const Json figures = label_figures(set);
  CHECK(figures.at("categories") == Json{"b", "c"});
  CHECK(figures.at("unused_categories") == Json{"a", "z"});
}

TEST_CASE("The heat map of one box is the fraction of each cell that it covers") {
  LabelSet set = set_with({{1, 0}});
  set.labels[0].box = {.x_px = 2.5, .y_px = 0, .width_px = 5, .height_px = 0.125};
  const Json heat = label_figures(set).at("heat");
  CHECK(heat.at("columns") == 40);
  CHECK(heat.at("rows") == 40);
  CHECK(heat.at("boxes_over")[9] == 0);
  CHECK(heat.at("boxes_over")[10] == 0.25);  // half of the cell, in one of two pictures
  CHECK(heat.at("boxes_over")[29] == 0.25);
  CHECK(heat.at("boxes_over")[30] == 0);
  CHECK(heat.at("boxes_over")[50] == 0);
}

TEST_CASE("Boxes that extend beyond the picture count inside it") {
  LabelSet set = set_with({{1}});
  set.labels[0].box = {.x_px = -50, .y_px = -50, .width_px = 200, .height_px = 200};
  const Json boxes_over = label_figures(set).at("heat").at("boxes_over");
  REQUIRE_FALSE(boxes_over.empty());
  for (const Json& cell : boxes_over) CHECK(cell == 1);
}

TEST_CASE("Seen ground: a rectangle straight down, nothing towards the horizon") {
  const Json camera = {
      {"width_px", 640}, {"height_px", 512}, {"focal_length_m", 0.016}, {"pixel_pitch_um", 25}};  // 640 px
  const std::array<double, 16> down = {1, 0, 0, 100, 0, -1, 0, 50, 0, 0, -1, 70, 0, 0, 0, 1};
  const auto corners = seen_ground(down, 60, camera);
  REQUIRE(corners.size() == 4);
  const std::vector<std::array<double, 2>> expected = {{70, 74}, {130, 74}, {130, 26}, {70, 26}};
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(std::abs(corners[k][0] - expected[k][0]) < 1e-9);
    CHECK(std::abs(corners[k][1] - expected[k][1]) < 1e-9);
  }
  const std::array<double, 16> level = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 60, 0, 0, 0, 1};  // to the north
  CHECK(seen_ground(level, 60, camera).empty());
}

TEST_CASE("What a camera sees whose axis is off the middle, and whose pixels are not square") {
  // 200 px to the left, 440 to the right, 100 up and 412 down; 60 m down a px is 60 / 500 m wide and 60 / 400 m high.
  const Json camera = {{"width_px", 640},      {"height_px", 512}, {"focal_length_m", 0.016},
                       {"pixel_pitch_um", 25}, {"fx_px", 500},     {"fy_px", 400},
                       {"cx_px", 200},         {"cy_px", 100}};
  const std::array<double, 16> down = {1, 0, 0, 100, 0, -1, 0, 50, 0, 0, -1, 70, 0, 0, 0, 1};
  const auto corners = seen_ground(down, 60, camera);
  REQUIRE(corners.size() == 4);
  const std::vector<std::array<double, 2>> expected = {
      {100 - 24, 50 + 15}, {100 + 52.8, 50 + 15}, {100 + 52.8, 50 - 61.8}, {100 - 24, 50 - 61.8}};
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(std::abs(corners[k][0] - expected[k][0]) < 1e-9);
    CHECK(std::abs(corners[k][1] - expected[k][1]) < 1e-9);
  }
}

}  // namespace frames_test
