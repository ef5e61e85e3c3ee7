#include "dataset/videos/palette.h"

#include <set>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace palette_test {

using namespace thermal;

namespace {

/// Luma of ITU-R BT.601, 0 to 255.
double lightness(const PaletteColour& colour) {
  return 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2];
}

}  // namespace

TEST_CASE("Palettes begin and end with the colours they are known by") {
  const auto ends = [](const char* name) {
    const PaletteTable table = palette_table(name);
    return std::pair(table.front(), table.back());
  };
  using Colour = PaletteColour;
  CHECK(ends("white_hot") == std::pair(Colour{0, 0, 0}, Colour{255, 255, 255}));
  CHECK(ends("black_hot") == std::pair(Colour{255, 255, 255}, Colour{0, 0, 0}));
  CHECK(ends("ironbow") == std::pair(Colour{0, 0, 12}, Colour{255, 254, 244}));
  CHECK(ends("rainbow").second == Colour{255, 0, 0});
  CHECK(ends("viridis") == std::pair(Colour{68, 1, 84}, Colour{253, 231, 37}));  // as matplotlib's
  CHECK(ends("inferno") == std::pair(Colour{0, 0, 4}, Colour{252, 255, 164}));   // likewise
}

TEST_CASE("Ironbow has a colour of its own for each level, and hotter is never darker") {
  const PaletteTable table = palette_table("ironbow");
  CHECK(std::set<PaletteColour>(table.begin(), table.end()).size() == 256);
  // A channel is rounded to 0.5: that of lightness, whose weights sum to 1, too; of a difference, 1.
  for (std::size_t k = 1; k < table.size(); ++k) CHECK(lightness(table[k]) > lightness(table[k - 1]) - 1);
  CHECK(lightness(table[128]) > lightness(table[0]) + 60);
}

TEST_CASE("Every palette that is named is there, with 200 colours or more") {
  CHECK(palette_names().size() == 7);
  for (const std::string& name : palette_names()) {
    CAPTURE(name);
    const PaletteTable table = palette_table(name);
    CHECK(std::set<PaletteColour>(table.begin(), table.end()).size() >= 200);
  }
}

TEST_CASE("An unknown palette is a fault with a near miss") {
  CHECK(message_of<ConfigError>([] { (void)palette_table("ironbw"); }) ==
        "--palette = \"ironbw\"; expected one of white_hot, black_hot, ironbow, rainbow, inferno, viridis, "
        "turbo; "
        "did you mean \"ironbow\"?");
}

}  // namespace palette_test
