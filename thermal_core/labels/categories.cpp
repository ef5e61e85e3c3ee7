#include "labels/categories.h"

#include <array>
#include <string_view>

namespace thermal {
namespace {

/// Never reorder: the position is the id.
constexpr std::array<std::string_view, 18> kKnown = {
    "human",     "elephant", "rhinoceros", "hippopotamus", "zebra",   "lion",
    "crocodile", "giraffe",  "impala",     "vehicle",      "cattle",  "goat",
    "dog",       "baboon",   "warthog",    "ostrich",      "buffalo", "wildebeest"};

}  // namespace

std::map<std::string, int> number_categories(const std::set<std::string>& used) {
  std::map<std::string, int> ids;
  int id = 0;
  for (const std::string_view name : kKnown) ids.emplace(name, ++id);
  for (const std::string& name : used) {
    if (!ids.contains(name)) ids.emplace(name, ++id);
  }
  return ids;
}

}  // namespace thermal
