#include "io/assets.h"

#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

/// Folders that this user may not read count as missing.
bool is_home(const Path& folder) {
  std::error_code ignored;
  return std::filesystem::is_directory(folder / "assets", ignored) &&
         std::filesystem::is_directory(folder / "blender_scripts", ignored);
}

Path find_home() {
  if (const char* named = std::getenv("VELDT_HOME"); named != nullptr && *named != '\0') {
    if (is_home(named)) return named;
    throw IoError(
        fault("VELDT_HOME", fmt::format("\"{}\"", named), "", "a folder with assets and blender_scripts"));
  }
  const Path program = std::filesystem::read_symlink("/proc/self/exe");
  for (Path folder = program.parent_path();; folder = folder.parent_path()) {
    if (is_home(folder)) return folder;
    if (folder == folder.root_path()) break;
  }
  Path installed = program.parent_path().parent_path() / "share" / "veldt";
  if (is_home(installed)) return installed;
  throw IoError(fmt::format("no folder with assets and blender_scripts at or above {}; set VELDT_HOME to it",
                            program.parent_path().string()));
}

}  // namespace

Assets Assets::find() { return Assets(find_home()); }

Json Assets::schema(const std::string& name) const {
  return read_json(home_ / "configs" / "schema" / (name + ".schema.json"));
}

}  // namespace thermal
