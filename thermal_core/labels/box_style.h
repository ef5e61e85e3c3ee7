#pragma once

#include <optional>
#include <string_view>

#include "labels/label_set.h"

namespace thermal {

/// How tightly boxes are drawn.
enum class BoxStyle {
  visible,  ///< around the pixels that the target covers
  drawn     ///< as people draw them, with a margin
};

/// Margin that people leave on each side of a person [px], by the box of the visible target: 0.7 px and a tenth of the
/// square root of its area, 2.1 px at most. 0 for a box of no area.
///
/// A straight line through the mean margins of the 536 people of 5 to 20 px in every other one of 160 night frames of
/// HIT-UAV (Suo et al., Scientific Data 10:227, 2023), measured from where a warm target falls to half of its contrast,
/// less the 0.3 px by which Veldt's boxes are wider than that. A single side of a single box scatters by 1.7 px
/// (standard deviation).
[[nodiscard]] double drawn_margin_px(const LabelBox& visible) noexcept;

/// A box with that margin, within its picture of a known size.
[[nodiscard]] LabelBox drawn_box(const LabelBox& visible, int width_px, int height_px) noexcept;

/// Shares of a drawn box's width and height that the warm target in it fills, above 0 to 1.
struct BoxFill {
  double width = 1;
  double height = 1;

  [[nodiscard]] bool operator==(const BoxFill&) const = default;
};

/// The same by kind of target, as the annotators of one data set draw.
struct DrawnFills {
  BoxFill people;
  BoxFill animals;
  BoxFill vehicles;

  [[nodiscard]] const BoxFill& of(Kind kind) const noexcept;
  [[nodiscard]] bool operator==(const DrawnFills&) const = default;
};

/// Of sets by name; empty for others. Medians of measure_drawn_fills(); kinds with too few targets in a set have the
/// fills of people.
/// - hit_uav: 776 people in 160 night frames of HIT-UAV (Suo et al., Scientific Data 10:227, 2023).
/// - birdsai: 44 people and 79 elephants in 300 night frames of three flights of BIRDSAI (Bondi et al., WACV 2020).
[[nodiscard]] std::optional<DrawnFills> drawn_fills_named(std::string_view name) noexcept;

/// All boxes as people draw them, within their pictures, whose sizes must be known: with drawn_margin_px(), or so that
/// targets fill their shares of them. A target is 0.3 px narrower on each side than its visible box, as above; a box is
/// never drawn within the visible one. Areas stay those of the targets.
void widen_as_drawn(LabelSet& set, const std::optional<DrawnFills>& fills = {});

}  // namespace thermal
