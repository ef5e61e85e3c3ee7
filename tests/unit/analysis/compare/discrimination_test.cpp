#include "analysis/compare/discrimination.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/parallel.h"
#include "support/catch.h"
#include "support/grey_frames.h"

namespace discrimination_test {

using namespace thermal;

namespace {

/// Rows of three independent normal features, the second moved by `shift`; each a unit of its own.
FeatureTable table_of(std::size_t rows, double shift, std::uint32_t draw) {
  const std::vector<float> values = grey_frames::normal(3 * rows, draw);
  FeatureTable table;
  for (std::size_t k = 0; k < rows; ++k) {
    const auto value = [&](std::size_t f) { return std::optional(static_cast<double>(values[3 * k + f])); };
    table.rows.push_back({value(0), *value(1) + shift, value(2)});
    table.units.push_back(k);
  }
  return table;
}

}  // namespace

TEST_CASE("Equal distributions cannot be separated") {
  // The error of an AUC of .5 with 200 cases on each side is .029; bounds at five.
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const Discrimination found = discriminate(table_of(200, 0, 50), table_of(200, 0, 51), 3, seed);
    CHECK_THAT(found.auc, WithinAbs(0.5, 0.145));
    CHECK_THAT(found.error, WithinAbs(std::sqrt(401.0 / 12 / 200 / 200), 0.002));
  }
}

TEST_CASE("Distributions that do not meet are separated by what differs") {
  const Discrimination found = discriminate(table_of(60, 0, 50), table_of(60, 30, 51), 3, 1);
  CHECK(found.auc == 1);
  CHECK(found.error == 0);
  REQUIRE(found.importances.size() == 3);
  CHECK(found.importances[0].feature == 1);
  CHECK(found.importances[0].alone == 1);
  CHECK_THAT(found.importances[0].fall, WithinAbs(0.5, 0.15));  // shuffled, it separates nothing
  CHECK_THAT(found.importances[1].fall, WithinAbs(0, 0.05));
}

TEST_CASE("Normal distributions two deviations apart") {
  // The best AUC is that of their difference: Phi(2 / sqrt 2) = .921. Error .014; a forest loses a few percent.
  const Discrimination found = discriminate(table_of(200, 0, 50), table_of(200, 2, 51), 3, 1);
  CHECK(found.auc > 0.84);
  CHECK(found.auc < 0.97);
}

TEST_CASE("Few rows are enough") {
  const Discrimination found = discriminate(table_of(4, 0, 50), table_of(4, 30, 51), 3, 1);
  CHECK(found.auc == 1);
  CHECK(discriminate(table_of(2, 0, 50), table_of(300, 30, 51), 3, 1).auc == 1);
}

TEST_CASE("Unknown values count as the median, also if all are unknown") {
  FeatureTable first = table_of(40, 0, 50);
  FeatureTable second = table_of(40, 30, 51);
  for (auto& row : first.rows) row[2].reset();
  for (std::size_t k = 0; k < 20; ++k) second.rows[k][2].reset();
  CHECK(discriminate(first, second, 3, 1).auc == 1);
  for (auto& row : second.rows) row[2].reset();
  const Discrimination found = discriminate(first, second, 3, 1);
  CHECK(found.auc == 1);
  CHECK(found.importances.back().alone == 0.5);
}

TEST_CASE("Rows of one unit are not spread over training and test") {
  // Each unit has a value of its own, which says nothing of the set. Learnt from the same unit, it would say all.
  const auto grouped = [](double offset) {
    FeatureTable table;
    for (std::size_t unit = 0; unit < 20; ++unit) {
      for (int k = 0; k < 10; ++k) {
        table.rows.push_back({100.0 * static_cast<double>(unit) + offset, 0.0, 0.0});
        table.units.push_back(unit);
      }
    }
    return table;
  };
  CHECK(discriminate(grouped(0), grouped(50), 3, 1).auc < 0.8);
}

TEST_CASE("The result does not depend on threads") {
  const auto found = [](int threads) {
    return with_threads(threads, [] { return discriminate(table_of(50, 0, 50), table_of(50, 1, 51), 3, 1); });
  };
  const Discrimination one = found(1);
  const Discrimination four = found(4);
  CHECK(one.auc == four.auc);
  for (std::size_t k = 0; k < 3; ++k) CHECK(one.importances[k].fall == four.importances[k].fall);
}

TEST_CASE("Pairs won") {
  const WonPairs pairs = won_pairs({1, 2, 2, 5}, {2, 6});
  CHECK(pairs.pairs == 8);
  CHECK(pairs.won == 6);  // 2 beats 1 and equals two; 6 beats all
  CHECK(won_pairs({}, {1}).pairs == 0);
}

TEST_CASE("A shuffle is a permutation of its own for each draw") {
  const auto order = shuffled(100, 1, 7);
  CHECK(std::set(order.begin(), order.end()).size() == 100);
  CHECK(order != shuffled(100, 1, 8));
  CHECK(order != shuffled(100, 2, 7));
  CHECK(order == shuffled(100, 1, 7));
}

}  // namespace discrimination_test
