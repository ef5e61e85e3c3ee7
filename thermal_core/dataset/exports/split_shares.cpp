#include "dataset/exports/split_shares.h"

#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

bool is_word(const std::string& name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !name.empty() && name.find_first_not_of(kLetters) == std::string::npos;
}

std::optional<SplitShare> parse_split(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || !is_word(text.substr(0, colon))) return std::nullopt;
  const std::optional<double> share = number_in<double>(std::string_view(text).substr(colon + 1));
  if (!share || !(*share > 0) || *share > 1) return std::nullopt;
  return SplitShare{.name = text.substr(0, colon), .share = *share};
}

[[noreturn]] void refuse_splits(const std::string& text) {
  throw ConfigError(
      fault("--split", text, "",
            "NAME:SHARE,NAME:SHARE…, names that differ and shares above 0 that add up to 1, e.g. "
            "train:0.8,val:0.2"));
}

}  // namespace

std::vector<SplitShare> parse_splits(const std::string& text) {
  std::vector<SplitShare> splits;
  std::set<std::string> names;
  double sum = 0;
  for (const std::string_view part : split(text, ',')) {
    const std::optional<SplitShare> split_share = parse_split(std::string(part));
    if (!split_share || !names.insert(split_share->name).second) refuse_splits(text);
    splits.push_back(*split_share);
    sum += split_share->share;
  }
  constexpr double kSlack = 0.001;
  if (std::abs(sum - 1) > kSlack) refuse_splits(text);
  for (SplitShare& split : splits) split.share /= sum;
  return splits;
}

}  // namespace thermal
