#include "analysis/balance_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace thermal {
namespace {

/// Whether there is an x for every type and a w for every video.
bool has_shape(const BalanceProgram& program, const BalanceSolution& solution) {
  const std::size_t count = program.videos.size();
  if (solution.taken.size() != count || solution.used_up.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (solution.taken[i].size() != program.videos[i].types.size()) return false;
  }
  return true;
}

class Checker {
 public:
  Checker(const BalanceProgram& program, const BalanceSolution& solution)
      : program_(program), solution_(solution) {}

  std::vector<std::string> check() && {
    for (std::size_t i = 0; i < program_.videos.size(); ++i) check_frames(i);
    for (std::size_t k = 0; k < kBalanceClasses; ++k) check_class(k);
    std::int64_t objective = 0;
    for (std::size_t k = 0; k < kBalanceClasses; ++k) objective += solution_.most[k] - solution_.least[k];
    if (objective != solution_.objective)
      add("objective = {}; expected {}, the sum of u - v", solution_.objective, objective);
    return std::move(faults_);
  }

 private:
  void check_frames(std::size_t i) {
    const BalanceVideo& video = program_.videos[i];
    for (std::size_t j = 0; j < video.types.size(); ++j) {
      const std::int64_t x = solution_.taken[i][j];
      const auto most = static_cast<std::int64_t>(video.types[j].frames.size());
      if (x < 0 || x > most) add("{}: x of type {} = {} frames; expected 0 to {}", video.name, j, x, most);
    }
  }

  void check_class(std::size_t k) {
    std::int64_t top = 0;
    for (std::size_t i = 0; i < program_.videos.size(); ++i) top = std::max(top, available(i, k));
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < program_.videos.size(); ++i) {
      check_video(i, k, top);
      sum += taken(i, k);
    }
    const ClassBounds& bounds = program_.bounds[k];
    if (sum < bounds.at_least || sum > bounds.at_most)
      add("{} = {} labels; expected {} to {}", balance_class_names()[k], sum, bounds.at_least,
          bounds.at_most);
  }

  void check_video(std::size_t i, std::size_t k, std::int64_t top) {
    const std::string& name = program_.videos[i].name;
    const std::string& of = balance_class_names()[k];
    const std::int64_t s = taken(i, k);
    const std::int64_t there = available(i, k);
    const std::int64_t w = solution_.used_up[i][k] ? 1 : 0;
    const std::int64_t u = solution_.most[k];
    const std::int64_t v = solution_.least[k];
    if (u < s) add("{}: u of {} = {}; expected at least {}, its labels", name, of, u, s);
    if (v > s + (top - there) * w)
      add("{}: v of {} = {}; expected at most {}", name, of, v, s + (top - there) * w);
    if (there * (1 - w) < there - s)
      add("{}: w of {} = {}; expected 0, because {} of {} labels are selected", name, of, w, s, there);
  }

  [[nodiscard]] std::int64_t taken(std::size_t i, std::size_t k) const {
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < program_.videos[i].types.size(); ++j)
      sum += program_.videos[i].types[j].labels[k] * solution_.taken[i][j];
    return sum;
  }
  [[nodiscard]] std::int64_t available(std::size_t i, std::size_t k) const {
    std::int64_t sum = 0;
    for (const FrameType& type : program_.videos[i].types)
      sum += type.labels[k] * static_cast<std::int64_t>(type.frames.size());
    return sum;
  }

  template <typename... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    faults_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  const BalanceProgram& program_;
  const BalanceSolution& solution_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> check_balance(const BalanceProgram& program, const BalanceSolution& solution) {
  if (!has_shape(program, solution)) return {"the solution belongs to another program"};
  return Checker(program, solution).check();
}

}  // namespace thermal
