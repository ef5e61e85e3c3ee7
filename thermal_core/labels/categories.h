#pragma once

#include <map>
#include <set>
#include <string>

namespace thermal {

/// Ids of the categories a dataset may label. Known categories have the same id in every dataset, so that datasets
/// can be joined; others follow in alphabetical order. Ids start at 1.
[[nodiscard]] std::map<std::string, int> number_categories(const std::set<std::string>& used);

}  // namespace thermal
