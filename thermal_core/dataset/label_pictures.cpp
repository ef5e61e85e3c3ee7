#include "dataset/label_pictures.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"

namespace thermal {

Path picture_of(const LabelSet& set, const LabelImage& image) {
  const Path plain = Path(image.file).lexically_normal();  // "./a//b.png" is a/b.png
  const auto name = RelativeName::of(plain.string());
  if (!name)
    throw DataError(fault(fmt::format("{}: file_name of image {}", set.name, id_text(image.id)),
                          fmt::format("\"{}\"", image.file), "", RelativeName::kRule));
  Path file = set.root;
  for (const Path& part : plain) {
    file /= part;
    check_is_no_link(file);
  }
  check_is_file(file);
  return file;
}

}  // namespace thermal
