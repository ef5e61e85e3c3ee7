#include "scene/passes.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace thermal {
namespace {

/// Repeats each pixel factor x factor times, then overwrites those that have samples.
template <typename T>
Plane<T> filled(const Plane<T>& pixels, const std::vector<T>& samples, const FineSamples& fine) {
  const auto side = static_cast<std::size_t>(fine.factor);
  Plane<T> out(pixels.width_px() * fine.factor, pixels.height_px() * fine.factor);
  if (pixels.empty()) return out;
  for (int y = 0; y < pixels.height_px(); ++y) {
    const auto first = out.row(y * fine.factor);
    for (std::size_t x = 0; x < first.size(); ++x) first[x] = pixels.row(y)[x / side];
    for (int line = 1; line < fine.factor; ++line)
      std::ranges::copy(first, out.row(y * fine.factor + line).begin());
    const std::uint16_t* const x_px = fine.x_px.data() + fine.row_begin[static_cast<std::size_t>(y)];
    for (int line = 0; line < fine.factor; ++line) {
      const auto row = out.row(y * fine.factor + line);
      const T* const values = samples.data() + fine.line_begin(y, line);
      for (std::size_t k = 0; k < side * fine.pixels_in(y); ++k)
        row[x_px[k / side] * side + k % side] = values[k];
    }
  }
  return out;
}

/// The pixels of a plane with all samples, and the samples of `fine`'s pixels.
template <typename T>
void separate(const Plane<T>& full, const FineSamples& fine, Plane<T>& pixels, std::vector<T>& samples) {
  if (full.empty()) return;
  const auto side = static_cast<std::size_t>(fine.factor);
  pixels = Plane<T>(full.width_px() / fine.factor, full.height_px() / fine.factor);
  for (int y = 0; y < pixels.height_px(); ++y) {
    const auto first = full.row(y * fine.factor);
    for (std::size_t x = 0; x < pixels.row(y).size(); ++x) pixels.row(y)[x] = first[x * side];
    for (int line = 0; line < fine.factor; ++line) {
      const std::span<const T> row = full.row(y * fine.factor + line);
      for (std::size_t k = 0; k < fine.pixels_in(y); ++k) {
        const auto block =
            row.subspan(side * fine.x_px[fine.row_begin[static_cast<std::size_t>(y)] + k], side);
        samples.insert(samples.end(), block.begin(), block.end());
      }
    }
  }
}

/// Calls work(plane with one sample a pixel, list of samples, plane with all samples) for every plane of passes.
template <typename One, typename Samples, typename All, typename Work>
void for_each_plane(One& one, Samples& samples, All& all, const Work& work) {
  const auto of_surface = [&work](auto& pixels, auto& lists, auto& planes) {
    work(pixels.object_index, lists.object_index, planes.object_index);
    work(pixels.material_index, lists.material_index, planes.material_index);
    work(pixels.depth_m, lists.depth_m, planes.depth_m);
    for (std::size_t axis = 0; axis < 3; ++axis)
      work(pixels.normal[axis], lists.normal[axis], planes.normal[axis]);
  };
  of_surface(one, samples, all);
  work(one.actor_index, samples.actor_index, all.actor_index);
  of_surface(one.mirrored, samples.mirrored, all.mirrored);
}

}  // namespace

Plane<std::uint16_t> filled_in(const Plane<std::uint16_t>& pixels, const std::vector<std::uint16_t>& samples,
                               const FineSamples& fine) {
  return filled(pixels, samples, fine);
}

Plane<float> filled_in(const Plane<float>& pixels, const std::vector<float>& samples,
                       const FineSamples& fine) {
  return filled(pixels, samples, fine);
}

Passes filled_in(const Passes& passes) {
  Passes full;
  for_each_plane(passes, passes.fine, full, [&](const auto& pixels, const auto& samples, auto& out) {
    out = filled(pixels, samples, passes.fine);
  });
  return full;
}

Plane<std::uint16_t> sampled_mask(const FineSamples& fine, int width_px) {
  const auto rows = static_cast<int>(fine.row_begin.size()) - 1;
  return filled(Plane<std::uint16_t>(width_px, rows), std::vector<std::uint16_t>(fine.object_index.size(), 1),
                fine);
}

Passes separated(const Passes& full, const Plane<std::uint16_t>& sampled, int factor) {
  assert(sampled.size() == full.object_index.size());
  Passes out;
  FineSamples& fine = out.fine;
  fine.factor = factor;
  fine.row_begin.push_back(0);
  for (int y = 0; y < sampled.height_px(); y += factor) {
    for (int x = 0; x < sampled.width_px(); x += factor)
      if (sampled.at(x, y) != 0) fine.x_px.push_back(static_cast<std::uint16_t>(x / factor));
    fine.row_begin.push_back(fine.x_px.size());
  }
  for_each_plane(out, fine, full, [&](auto& pixels, auto& samples, const auto& plane) {
    separate(plane, fine, pixels, samples);
  });
  return out;
}

}  // namespace thermal
