#include <cmath>

#include "analysis/balance/balance.h"
#include "analysis/balance/program.h"
#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace balance_check_test {

using namespace thermal;

namespace {

FrameType frames_of(const ClassCounts& labels, std::size_t count) {
  return {.labels = labels, .frames = std::vector<int>(count)};
}

BalanceVideo video_of(const std::string& name, std::vector<FrameType> types) {
  return {.name = name, .types = std::move(types), .unlabelled = 0};
}

/// Small animals in frames of one and of three, small poachers beside animals in the second video.
BalanceProgram two_videos() {
  BalanceProgram program;
  program.videos = {video_of("one", {frames_of({1}, 4), frames_of({3}, 2)}),
                    video_of("two", {frames_of({1, 0, 0, 1}, 2), frames_of({0, 0, 0, 2}, 1)})};
  program.bounds[0] = {.at_least = 5, .at_most = 8};
  program.bounds[3] = {.at_least = 2, .at_most = 3};
  return program;
}

/// Five animals of one, two animals and two poachers of two: all of its animals.
BalanceSolution valid_solution() { return complete_solution(two_videos(), {{2, 1}, {2, 0}}); }

std::vector<std::string> faults_of(const BalanceSolution& solution) {
  return check_balance(two_videos(), solution);
}

}  // namespace

TEST_CASE("a solution is completed with the best levels for its frames") {
  const BalanceSolution solution = valid_solution();
  CHECK(faults_of(solution).empty());
  CHECK(solution.labels_of(two_videos(), 0) == ClassCounts{5, 0, 0, 0, 0, 0});
  CHECK(solution.labels_of(two_videos(), 1) == ClassCounts{2, 0, 0, 2, 0, 0});
  CHECK(solution.most == ClassCounts{5, 0, 0, 2, 0, 0});
  // The second video's animals are exhausted, so that the least is the first one's.
  CHECK(solution.least == ClassCounts{5, 0, 0, 2, 0, 0});
  CHECK(solution.used_up[1][0]);
  CHECK(solution.objective == 0);
}

TEST_CASE("where every video is exhausted, the least is the most of any") {
  const BalanceSolution solution = complete_solution(two_videos(), {{4, 2}, {2, 1}});
  CHECK(solution.most == ClassCounts{10, 0, 0, 4, 0, 0});
  CHECK(solution.least == solution.most);
  CHECK(solution.objective == 0);
}

TEST_CASE("each violated constraint is reported") {
  BalanceSolution solution = valid_solution();
  using Faults = std::vector<std::string>;
  SECTION("more frames than there are") {
    solution.taken[1][0] = 3;
    CHECK(faults_of(solution).front() == "two: x of type 0 = 3 frames; expected 0 to 2");
  }
  SECTION("fewer than none") {
    solution.taken[0][0] = -1;
    CHECK(faults_of(solution).front() == "one: x of type 0 = -1 frames; expected 0 to 4");
  }
  SECTION("u") {
    solution.most[0] = 4;
    solution.objective = -1;
    CHECK(faults_of(solution) == Faults{"one: u of small_animal = 4; expected at least 5, its labels"});
  }
  SECTION("v of a video with labels left") {
    solution.least[0] = 6;
    solution.objective = -1;
    CHECK(faults_of(solution) == Faults{"one: v of small_animal = 6; expected at most 5"});
  }
  SECTION("v beyond M") {
    solution = complete_solution(two_videos(), {{4, 2}, {2, 0}});  // twelve animals, four too many
    solution.least[0] = 11;
    solution.objective = -1;
    CHECK(faults_of(solution) == Faults{"one: v of small_animal = 11; expected at most 10",
                                        "two: v of small_animal = 11; expected at most 10",
                                        "small_animal = 12 labels; expected 5 to 8"});
  }
  SECTION("w that is 0 although all labels are selected") {
    solution.used_up[1][0] = false;
    CHECK(faults_of(solution) == Faults{"two: v of small_animal = 5; expected at most 2"});
  }
  SECTION("w that is 1 although not all labels are selected") {
    solution.used_up[0][0] = true;
    CHECK(faults_of(solution) ==
          Faults{"one: w of small_animal = 1; expected 0, because 5 of 10 labels are selected"});
  }
  SECTION("too few labels") {
    solution = complete_solution(two_videos(), {{2, 0}, {2, 0}});
    CHECK(faults_of(solution) == Faults{"small_animal = 4 labels; expected 5 to 8"});
  }
  SECTION("too many labels") {
    solution = complete_solution(two_videos(), {{2, 1}, {2, 1}});
    CHECK(faults_of(solution) == Faults{"small_poacher = 4 labels; expected 2 to 3"});
  }
  SECTION("another objective") {
    solution.objective = 7;
    CHECK(faults_of(solution) == Faults{"objective = 7; expected 0, the sum of u - v"});
  }
  SECTION("another program") {
    solution.taken.pop_back();
    CHECK(faults_of(solution) == Faults{"the solution belongs to another program"});
  }
}

TEST_CASE("bounds that cannot be met are reported with the nearest feasible ones") {
  BalanceProgram program = two_videos();
  const auto message = [&] { return message_of<ConfigError>([&] { (void)balance(program, {}); }); };
  SECTION("more than there are") {
    program.bounds[3] = {.at_least = 500, .at_most = 800};
    CHECK(message() == "per-class small_poacher: at least 500 requested, 4 available");
  }
  SECTION("more than the other bounds leave") {
    program.videos = {video_of("herded", {frames_of({3, 0, 0, 1}, 2), frames_of({0, 0, 0, 2}, 1)})};
    program.bounds[0] = {};
    program.bounds[3] = {.at_least = 4, .at_most = 4};
    CHECK(message() ==
          "per-class small_poacher: at least 4 requested, at most 2 possible with the other bounds");
  }
  SECTION("no sum in between") {
    program.videos = {video_of("herd", {frames_of({5}, 9)})};
    program.bounds = {};
    program.bounds[0] = {.at_least = 11, .at_most = 13};
    CHECK(message() ==
          "per-class small_animal: at least 11 requested, at most 10 possible with the other "
          "bounds");
    program.bounds[0] = {.at_least = 12, .at_most = 14};
    CHECK(message() ==
          "per-class small_animal: at most 14 requested, at least 15 possible with the other "
          "bounds");
  }
}

TEST_CASE("invalid options are reported") {
  const auto message = [](const BalanceOptions& options) {
    return message_of<ConfigError>([&] { (void)balance(two_videos(), options); });
  };
  CHECK(message({.gap = -0.1}) == "gap = -0.1; expected a number from 0 to 1");
  CHECK(message({.gap = std::nan("")}) == "gap = nan; expected a number from 0 to 1");
  CHECK(message({.time_limit_s = 0}) == "time_limit_s = 0 s; expected a time above 0 s");
}

}  // namespace balance_check_test
