#include "io/label_files/coco_head.h"

#include <fmt/format.h>

#include "base/error.h"
#include "io/json/entry.h"

namespace thermal {
namespace {

/// Thrown to end reading.
struct ImagesBegin {};

void take(const std::string& file, const std::string& list, std::size_t place, const Json& json,
          CocoHead& head) {
  if (list == "images" || list == "annotations") throw ImagesBegin();
  const JsonEntry entry(json, file, list, place);
  if (list == "categories") head.categories.emplace_back(entry.text("name"), entry.integer("id"));
  if (list == "videos") head.videos.push_back(entry.text("name"));
}

}  // namespace

CocoHead read_coco_head(const Path& file) {
  check_is_own_file(file);
  CocoHead head;
  const std::string name = file.string();
  try {
    (void)read_json_elements(file, [&](const std::string& list, std::size_t place, const Json& json) {
      take(name, list, place, json, head);
    });
  } catch (const ImagesBegin&) {
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
  if (head.categories.empty())
    throw DataError(
        fmt::format("{}: no list \"categories\" before its images; expected a COCO file of Veldt's", name));
  return head;
}

}  // namespace thermal
