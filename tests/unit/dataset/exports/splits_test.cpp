#include "dataset/exports/splits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace splits_test {

using namespace thermal;

namespace {

using Row = std::vector<int>;  ///< of one video: pictures, then labels of each category

/// "v3": spelled so because GCC 12 warns of `"v" + std::to_string(3)`.
std::string numbered(const char* what, std::size_t number) {
  std::string name = what;
  return name.append(std::to_string(number));
}

/// Videos named "v0", "v1" … with these contents.
LabelSet set_of(const std::vector<Row>& rows) {
  LabelSet set;
  for (std::size_t k = 1; k < rows.front().size(); ++k)
    set.categories.push_back({.id = static_cast<int>(k), .name = numbered("category", k)});
  for (std::size_t video = 0; video < rows.size(); ++video) {
    set.videos.push_back({.name = numbered("v", video)});
    LabelImage image;
    image.video = video;
    set.images.insert(set.images.end(), static_cast<std::size_t>(rows[video][0]), image);
    Label label;
    label.image = set.images.size() - 1;
    for (label.category = 0; label.category + 1 < rows[video].size(); ++label.category)
      set.labels.insert(set.labels.end(), static_cast<std::size_t>(rows[video][label.category + 1]), label);
  }
  return set;
}

/// Pairs of a split and an existing category it lacks, and the sum of squared errors of shares.
std::pair<int, double> cost_of(const std::vector<Row>& rows, const std::vector<std::size_t>& of_video,
                               const std::vector<SplitShare>& shares) {
  std::pair<int, double> cost;
  for (std::size_t k = 0; k < rows.front().size(); ++k) {
    double total = 0;
    std::vector<double> got(shares.size(), 0);
    for (std::size_t video = 0; video < rows.size(); ++video) {
      total += rows[video][k];
      if (of_video[video] != kNoSplit) got[of_video[video]] += rows[video][k];
    }
    for (std::size_t split = 0; total > 0 && split < shares.size(); ++split) {
      if (got[split] == 0) ++cost.first;
      cost.second += std::pow(got[split] / total - shares[split].share, 2);
    }
  }
  return cost;
}

/// The best of all solutions in which every split has a video.
std::pair<int, double> best_cost(const std::vector<Row>& rows, const std::vector<SplitShare>& shares) {
  std::pair<int, double> best{std::numeric_limits<int>::max(), 0};
  std::vector<std::size_t> way(rows.size(), 0);
  const auto ways = static_cast<std::size_t>(std::pow(shares.size(), rows.size()));
  for (std::size_t number = 0; number < ways; ++number) {
    std::vector<int> videos_in(shares.size(), 0);
    for (std::size_t rest = number, i = 0; i < rows.size(); ++i, rest /= shares.size()) {
      way[i] = rest % shares.size();
      ++videos_in[way[i]];
    }
    if (std::ranges::count(videos_in, 0) == 0) best = std::min(best, cost_of(rows, way, shares));
  }
  return best;
}

std::vector<Row> random_rows(std::mt19937& random, std::size_t videos, std::size_t categories) {
  std::vector<Row> rows(videos, Row(categories + 1, 0));
  for (Row& row : rows) {
    row[0] = 1 + static_cast<int>(random() % 50);
    for (std::size_t k = 1; k < row.size(); ++k)
      if (random() % 2 == 0) row[k] = static_cast<int>(random() % 200);
  }
  return rows;
}

const std::vector<SplitShare> kTwo = parse_splits("train:0.8,val:0.2");
const std::vector<SplitShare> kThree = parse_splits("train:0.6,val:0.2,test:0.2");

}  // namespace

TEST_CASE("Shares are read in order, and scaled to add up to 1") {
  REQUIRE(kThree.size() == 3);
  CHECK(kThree[0].name == "train");
  CHECK(kThree[2].name == "test");
  CHECK(kThree[1].share == 0.2);
  const std::vector<SplitShare> thirds = parse_splits("a:0.333,b_2:0.333,c-3:0.333");
  CHECK(thirds[0].share == thirds[2].share);
  CHECK(std::abs(thirds[0].share - 1.0 / 3) < 1e-15);
  CHECK(parse_splits("all:1").size() == 1);
}

TEST_CASE("Invalid shares are errors") {
  for (const char* text :
       {"", "train", "train:", ":0.5,b:0.5", "train:0.8,val:0.3", "train:0.8", "a:0.5,a:0.5", "a:1,b:0",
        "a:1.5,b:-0.5", "a:0.5,b:0.5,", "a:0.5x,b:0.5", "a:nan,b:0.5", "../up:0.5,b:0.5", "a b:0.5,c:0.5"}) {
    CHECK(
        message_of<ConfigError>([&] { (void)parse_splits(text); }) ==
        "--split = " + std::string(text) +
            "; expected NAME:SHARE,NAME:SHARE…, names that differ and shares above 0 that add up to 1, e.g. "
            "train:0.8,val:0.2");
  }
}

TEST_CASE("Every video with pictures goes to one split, and none without") {
  std::vector<Row> rows(20, Row{3, 5});
  rows[4] = {0, 0};
  const std::vector<std::size_t> of_video = split_videos(set_of(rows), kTwo, 1);
  REQUIRE(of_video.size() == 20);
  CHECK(of_video[4] == kNoSplit);
  CHECK(std::ranges::count(of_video, 0U) == 15);  // 15.2 would be 80 %
  CHECK(std::ranges::count(of_video, 1U) == 4);
}

TEST_CASE("Splits are optimal, compared with trying all") {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const auto& shares = i % 2 == 0 ? kTwo : kThree;
    const std::vector<Row> rows = random_rows(random, shares.size() + random() % 5, 1 + random() % 4);
    const auto best = best_cost(rows, shares);
    const auto found = cost_of(rows, split_videos(set_of(rows), shares, 7), shares);
    INFO("instance " << i);
    CHECK(found.first == best.first);  // every split has each category where possible
    CHECK(found.second <= best.second + 1e-9);
  }
}

TEST_CASE("With many clips, every share of everything is near the requested one") {
  std::mt19937 random(2);
  const std::vector<Row> rows = random_rows(random, 200, 6);
  const std::vector<std::size_t> of_video = split_videos(set_of(rows), kThree, 3);
  for (std::size_t k = 0; k < rows.front().size(); ++k) {
    double total = 0;
    std::vector<double> got(3, 0);
    for (std::size_t video = 0; video < rows.size(); ++video) {
      total += rows[video][k];
      got[of_video[video]] += rows[video][k];
    }
    for (std::size_t split = 0; split < 3; ++split)
      CHECK(std::abs(got[split] / total - kThree[split].share) < 0.005);
  }
}

TEST_CASE("The same seed gives the same splits in any order of videos; another seed gives others") {
  std::mt19937 random(3);
  const std::vector<Row> rows = random_rows(random, 40, 3);
  LabelSet set = set_of(rows);
  const std::vector<std::size_t> one = split_videos(set, kTwo, 5);
  CHECK(split_videos(set, kTwo, 5) == one);
  CHECK(split_videos(set, kTwo, 6) != one);
  std::ranges::reverse(set.videos);
  for (LabelImage& image : set.images) image.video = set.videos.size() - 1 - image.video;
  std::vector<std::size_t> back = split_videos(set, kTwo, 5);
  std::ranges::reverse(back);
  CHECK(back == one);
}

TEST_CASE("Fewer clips with pictures than splits is an error") {
  CHECK(message_of<ConfigError>([] {
          (void)split_videos(set_of({{3, 1}, {0, 0}, {4, 2}}), kThree, 1);
        }) ==
        "--split = 3 splits; expected no more than there are clips with pictures, 2: frames of one clip "
        "never go to "
        "several splits");
  const std::vector<std::size_t> of_video = split_videos(set_of({{3, 1}, {400, 2}, {4, 2}}), kThree, 1);
  CHECK(std::ranges::count(of_video, 0U) == 1);  // each split has one
  CHECK(std::ranges::count(of_video, 1U) == 1);
}

}  // namespace splits_test
