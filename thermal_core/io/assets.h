#pragma once

#include <string>

#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

/// The files that come with Veldt: schemas, materials, sensors, response curves, fonts, scripts. A program finds them
/// once and passes them on; only this class knows their folders.
class Assets {
 public:
  /// `home`: a folder with assets/, blender_scripts/ and configs/, not checked yet.
  explicit Assets(Path home) : home_(std::move(home)) {}

  /// Assets in $VELDT_HOME, or in the nearest folder at or above the running program, or in ../share/veldt beside it.
  /// IoError with the places searched if there are none.
  [[nodiscard]] static Assets find();

  [[nodiscard]] const Path& home() const { return home_; }

  /// assets/`kind`: "materials", "sensors", "links", "responses", "species", "plants", "structures",
  /// "sites", "fonts", "report", "view".
  [[nodiscard]] Path folder(const std::string& kind) const { return home_ / "assets" / kind; }

  /// configs/schema/`name`.schema.json. IoError or DataError if it cannot be read.
  [[nodiscard]] Json schema(const std::string& name) const;

  /// configs/`name`.json
  [[nodiscard]] Path config(const std::string& name) const { return home_ / "configs" / (name + ".json"); }

  /// blender_scripts/`name`
  [[nodiscard]] Path script(const std::string& name) const { return home_ / "blender_scripts" / name; }

 private:
  Path home_;
};

}  // namespace thermal
