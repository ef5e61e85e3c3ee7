#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "io/exr/mattes.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace matte_ranks_test {

using namespace thermal;

namespace {

/// Contents of one pixel: hashes, which are ten times the indices here, and coverages, by rank.
using Pixel = std::vector<std::pair<std::uint32_t, float>>;

/// A row of pixels with equal numbers of ranks.
MatteChannels mattes_of(const std::vector<Pixel>& row) {
  MatteChannels mattes;
  for (std::size_t k = 0; k < row.front().size(); ++k) {
    Plane<float> hashes(static_cast<int>(row.size()), 1);
    Plane<float> coverages(static_cast<int>(row.size()), 1);
    for (std::size_t x = 0; x < row.size(); ++x) {
      hashes.pixels()[x] = std::bit_cast<float>(row[x].at(k).first);
      coverages.pixels()[x] = row[x].at(k).second;
    }
    mattes.names.insert(mattes.names.end(), {"hash" + std::to_string(k), "coverage" + std::to_string(k)});
    mattes.planes.insert(mattes.planes.end(), {std::move(hashes), std::move(coverages)});
  }
  return mattes;
}

std::uint16_t a_tenth(std::uint32_t hash) { return static_cast<std::uint16_t>(hash / 10); }

Passes ranked(const std::vector<Pixel>& row, const MatteIndex& index_of = a_tenth) {
  Passes passes;
  rank_mattes(mattes_of(row), index_of, passes);
  return passes;
}

template <typename T>
std::vector<T> values(const Plane<T>& plane) {
  return {plane.pixels().begin(), plane.pixels().end()};
}

using Indices = std::vector<std::uint16_t>;
using Shares = std::vector<float>;

}  // namespace

TEST_CASE("Ranks and coverages are read unchanged") {
  const Passes passes =
      ranked({{{70, 1.0F}, {0, 0.0F}}, {{10, 0.75F}, {70, 0.25F}}, {{70, 0.5F}, {10, 0.125F}}});
  REQUIRE(passes.ranks.size() == 2);
  CHECK(values(passes.ranks[0].object_index) == Indices{7, 1, 7});
  CHECK(values(passes.ranks[0].coverage) == Shares{1, 0.75F, 0.5F});
  CHECK(values(passes.ranks[1].object_index) == Indices{0, 7, 1});
  CHECK(values(passes.ranks[1].coverage) == Shares{0, 0.25F, 0.125F});
  CHECK(values(passes.object_index) == Indices{7, 1, 7});
}

TEST_CASE("Ranks without coverage are left out") {
  CHECK(ranked({{{70, 1.0F}, {10, 0.0F}, {0, 0.5F}}}).ranks.size() == 1);
  const Passes nothing = ranked({{{0, 0.0F}}, {{70, 0.0F}}, {{0, 1.0F}}});
  CHECK(nothing.ranks.empty());
  CHECK(values(nothing.object_index) == Indices{0, 0, 0});
}

TEST_CASE("A hash without coverage is not looked up, and each other one once") {
  std::vector<std::uint32_t> asked;
  (void)ranked({{{70, 1.0F}, {20, 0.0F}}, {{10, 1.0F}, {0, 0.5F}}, {{70, 1.0F}, {0, 0.0F}}},
               [&](std::uint32_t hash) {
                 asked.push_back(hash);
                 return a_tenth(hash);
               });
  CHECK(asked == std::vector<std::uint32_t>{70, 10});
}

TEST_CASE("The label is sky where more is uncovered than any object covers") {
  const Passes passes =
      ranked({{{70, 0.5F}, {10, 0.0F}}, {{70, 0.375F}, {10, 0.125F}}, {{70, 0.375F}, {10, 0.25F}}});
  CHECK(values(passes.object_index) == Indices{7, 0, 7});
  CHECK(values(passes.ranks[0].object_index) == Indices{7, 7, 7});
}

TEST_CASE("Hashes of one object are summed, and the most coverage comes first") {
  const Passes passes =
      ranked({{{70, 0.375F}, {10, 0.25F}, {11, 0.25F}}, {{10, 0.25F}, {70, 0.75F}, {0, 0.0F}}});
  REQUIRE(passes.ranks.size() == 2);
  CHECK(values(passes.ranks[0].object_index) == Indices{1, 7});
  CHECK(values(passes.ranks[0].coverage) == Shares{0.5F, 0.75F});
  CHECK(values(passes.ranks[1].object_index) == Indices{7, 1});
  CHECK(values(passes.ranks[1].coverage) == Shares{0.375F, 0.25F});
  CHECK(values(passes.object_index) == Indices{1, 7});
}

TEST_CASE("Objects of equal coverage keep the file's order") {
  CHECK(values(ranked({{{70, 0.5F}, {10, 0.5F}}, {{10, 0.5F}, {70, 0.5F}}}).object_index) == Indices{7, 1});
}

TEST_CASE("Coverages with a sum above 1 are scaled to 1") {
  const Passes passes = ranked({{{70, 1.5F}, {10, 0.5F}}, {{70, 3.0F}, {10, 0.0F}}});
  CHECK(values(passes.ranks[0].coverage) == Shares{0.75F, 1});
  CHECK(values(passes.ranks[1].coverage) == Shares{0.25F, 0});
}

TEST_CASE("An invalid coverage is an error with its place") {
  const auto fault_of = [](float coverage, std::uint32_t hash = 10) {
    return message_of<DataError>([&] {
      (void)ranked({{{70, 1.0F}, {0, 0.0F}}, {{70, 0.5F}, {hash, coverage}}});
    });
  };
  CHECK(fault_of(-0.25F) == "coverage1 at pixel (1, 0) = -0.25; expected a coverage from 0 to 1");
  CHECK(fault_of(std::numeric_limits<float>::quiet_NaN(), 0) ==
        "coverage1 at pixel (1, 0) = nan; expected a coverage from 0 to 1");
  CHECK(fault_of(std::numeric_limits<float>::infinity()) ==
        "coverage1 at pixel (1, 0) = inf; expected a coverage from 0 to 1");
  CHECK(fault_of(-0.0F) == "(no fault was thrown)");
}

TEST_CASE("A hash is located where it first has coverage, and its pixels are counted") {
  const MatteChannels mattes = mattes_of({{{10, 1.0F}, {70, 0.0F}},
                                          {{10, 0.5F}, {70, 0.5F}},
                                          {{70, 0.75F}, {70, 0.25F}},
                                          {{10, 1.0F}, {0, 0.0F}}});
  const MatteSpot spot = spot_matte(mattes, 70);
  CHECK(spot.channel == "hash1");
  CHECK(spot.x_px == 1);
  CHECK(spot.y_px == 0);
  CHECK(spot.pixels == 2);
}

}  // namespace matte_ranks_test
