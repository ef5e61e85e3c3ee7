#include <algorithm>

#include "base/error.h"
#include "io/image/pictures.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace text_picture_test {

using namespace thermal;

namespace {

Path font() { return kAssets.folder("fonts") / "B612-Regular.otf"; }

}  // namespace

TEST_CASE("Text is drawn with soft edges, wider the longer it is") {
  const TextPicture one = draw_text(font(), "H", 40);
  const TextPicture two = draw_text(font(), "HH", 40);
  CHECK(two.coverage.width_px() > one.coverage.width_px() + 15);
  // Capital letters of common fonts are 0.65 to 0.75 em high; OpenImageIO's extent has a pixel more.
  CHECK(one.baseline_px >= 26);
  CHECK(one.baseline_px <= 31);
  CHECK(one.coverage.height_px() <= one.baseline_px + 1);  // nothing is below the line
  const TextPicture low = draw_text(font(), "g", 40);
  CHECK(low.coverage.height_px() > low.baseline_px + 4);
  const auto pixels = draw_text(font(), "S", 40).coverage;
  CHECK(std::ranges::max(pixels.pixels()) == 255);
  CHECK(std::ranges::any_of(pixels.pixels(), [](auto level) { return level > 60 && level < 200; }));
}

TEST_CASE("A character that is not ASCII shows as a question mark, and no text as nothing") {
  CHECK(draw_text(font(), "a·b…", 40).coverage == draw_text(font(), "a?b?", 40).coverage);
  CHECK(draw_text(font(), "a\nb", 40).coverage == draw_text(font(), "a?b", 40).coverage);
  CHECK(draw_text(font(), "", 40).coverage.empty());
}

TEST_CASE("A font that cannot be used is named") {
  CHECK(message_of<IoError>([] { (void)draw_text("none.otf", "H", 40); }) ==
        "cannot read none.otf: no such file");
  const Path not_a_font = kAssets.folder("fonts") / "LICENSE";
  CHECK(message_of<IoError>([&] {
          (void)draw_text(not_a_font, "H", 40);
        }).starts_with("cannot use the font " + not_a_font.string() + ": "));
}

}  // namespace text_picture_test
