#pragma once

#include <string_view>

namespace thermal {

/// Physical contributions to the signal besides the surface's own emission, which is always included.
struct Terms {
  bool place = false;      ///< sky view, shade and moisture of the ground from maps, depth in crowns
  bool facing = false;     ///< the direction that a surface faces
  bool variation = false;  ///< fractal temperature field over ground and plants
  bool parts = false;      ///< parts of an actor at their own temperatures
  bool sky = false;        ///< reflection of sky and surroundings
  bool angular = false;    ///< emissivity decreasing with the angle of view
  bool mirror = false;     ///< what stands around water, reflected in it; needs `sky`
  bool path = false;       ///< air between surface and camera: transmission and emission
  bool smear = false;      ///< motion of the picture within the exposure
  bool falloff = false;    ///< of the lens: NUC removes it from the signal, and noise grows by its inverse

  [[nodiscard]] bool operator==(const Terms&) const = default;
};

/// A config's choice for one term; `automatic` leaves it to the budget.
enum class TermChoice { off, on, automatic };

/// Its name in configs: "off", "on" or "auto".
[[nodiscard]] constexpr std::string_view choice_name(TermChoice choice) noexcept {
  if (choice == TermChoice::automatic) return "auto";
  return choice == TermChoice::on ? "on" : "off";
}

/// A config's choice for each term.
struct TermChoices {
  TermChoice place = TermChoice::off;
  TermChoice facing = TermChoice::off;
  TermChoice variation = TermChoice::off;
  TermChoice parts = TermChoice::off;
  TermChoice sky = TermChoice::off;
  TermChoice angular = TermChoice::off;
  TermChoice mirror = TermChoice::off;
  TermChoice path = TermChoice::off;
  TermChoice smear = TermChoice::off;
  TermChoice falloff = TermChoice::off;

  [[nodiscard]] bool operator==(const TermChoices&) const = default;
};

/// One row per term, in order: name, choice, outcome, and the term before it without which it has no effect.
struct TermInfo {
  std::string_view name;
  TermChoice TermChoices::*choice;
  bool Terms::*kept;
  bool Terms::*needed = nullptr;
};
/// All terms, in the order in which they are computed.
inline constexpr TermInfo kTerms[] = {{"place", &TermChoices::place, &Terms::place},
                                      {"facing", &TermChoices::facing, &Terms::facing},
                                      {"variation", &TermChoices::variation, &Terms::variation},
                                      {"parts", &TermChoices::parts, &Terms::parts},
                                      {"sky", &TermChoices::sky, &Terms::sky},
                                      {"angular", &TermChoices::angular, &Terms::angular},
                                      {"mirror", &TermChoices::mirror, &Terms::mirror, &Terms::sky},
                                      {"path", &TermChoices::path, &Terms::path},
                                      {"smear", &TermChoices::smear, &Terms::smear},
                                      {"falloff", &TermChoices::falloff, &Terms::falloff}};

}  // namespace thermal
