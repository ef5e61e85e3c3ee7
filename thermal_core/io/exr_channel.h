#pragma once

#include <string>

namespace thermal {

/// One channel of an EXR file, with its name parsed: "Scene.IndexOB.X" is component X of pass IndexOB in layer Scene.
/// In a file with several parts, a channel without a layer is in the layer of its part's name; with several views,
/// its layer ends with the view's name ("Scene.left").
struct ExrChannel {
  int part = 0;
  std::string name;  ///< as in the file; channels of different parts may share one
  std::string layer;
  std::string pass;
  std::string component;
  std::string type;         ///< "half", "float" or "uint"
  std::string compression;  ///< of its part

  /// Layer, pass and component, as far as present, joined by dots; unique in the file.
  [[nodiscard]] std::string full_name() const;
};

}  // namespace thermal
