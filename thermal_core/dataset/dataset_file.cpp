#include "dataset/dataset_file.h"

#include <set>

#include "base/error.h"
#include "base/relative_name.h"
#include "dataset/layout.h"
#include "io/json_entry.h"

namespace thermal {
namespace {

/// Read as data that may be damaged.
Json read_as_data(const Path& file) {
  try {
    return read_json(file);
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
}

void check_clips(const Json& dataset, const std::string& file) {
  const std::string list = "clips";
  std::set<std::string> seen;
  const auto clips = dataset.find(list);
  if (clips == dataset.end() || !clips->is_array())
    throw DataError(
        fault(file + ": clips", clips == dataset.end() ? "missing" : brief(*clips), "", "a list"));
  for (std::size_t i = 0; i < clips->size(); ++i) {
    const JsonEntry clip((*clips)[i], file, list, i);
    const std::string id = clip.text("id");
    if (!RelativeName::part_of(id)) throw clip.fault_of("id", RelativeName::kPartRule);
    if (!seen.insert(id).second) throw clip.fault_of("id", "each id once");
    (void)clip.text("status");
  }
}

}  // namespace

Json read_dataset_file(const Path& root) {
  const Layout layout{root};
  for (const Path& place : {layout.dataset_json(), layout.annotations_json(), layout.clips()})
    check_is_no_link(place);
  const Path file = layout.dataset_json();
  Json dataset = read_as_data(file);
  if (!dataset.is_object() || dataset.value("format", Json()) != "veldt-dataset")
    throw DataError(file.string() + " does not belong to a Veldt dataset");
  check_clips(dataset, file.string());
  return dataset;
}

}  // namespace thermal
