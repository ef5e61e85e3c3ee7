// Labels from index planes: box and mask of each actor, and how much of it a bush leaves visible.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

#include <veldt/labels/instances.h>

using IndexPlane = thermal::Plane<std::uint16_t>;

constexpr int kWidth = 12;
constexpr std::uint16_t kElephant = 7;
constexpr std::uint16_t kPerson = 8;

/// A plane drawn in text, row after row: a digit is the index of an object, a dot is ground, which has index 1.
IndexPlane drawn(std::string_view marks) {
  IndexPlane plane(kWidth, static_cast<int>(marks.size()) / kWidth);
  std::ranges::transform(marks, plane.pixels().begin(),
                         [](char mark) { return static_cast<std::uint16_t>(mark == '.' ? 1 : mark - '0'); });
  return plane;
}

std::vector<thermal::Instance> actors_in(const IndexPlane& plane) {
  const std::vector<std::uint16_t> actors = {kElephant, kPerson};
  return thermal::extract_instances(plane, thermal::survey_indices(plane), thermal::IndexSet(actors));
}

int main() {
  const IndexPlane frame = drawn(
      "............"
      "..7777......"
      ".777722....8"
      ".777222....8"
      "..7.22......"
      "............");
  const IndexPlane without_bush = drawn(
      "............"
      "..7777......"
      ".777777....8"
      ".777777....8"
      "..7..7......"
      "............");
  const std::vector<thermal::Instance> whole = actors_in(without_bush);
  for (const thermal::Instance& actor : actors_in(frame)) {
    const auto unhidden = std::ranges::find(whole, actor.index, &thermal::Instance::index);
    const auto [x_px, y_px, width_px, height_px] = actor.box;
    std::printf("index %d: box %d,%d %d x %d px, %u of %u px visible%s, mask %s\n", actor.index, x_px, y_px,
                width_px, height_px, actor.area_px, unhidden->area_px,
                actor.truncated ? ", at the border" : "", thermal::encode_coco_rle(actor.mask).c_str());
  }
}
