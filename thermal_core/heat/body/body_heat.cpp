#include "heat/body/body_heat.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/polynomial.h"
#include "base/ranges.h"

namespace thermal {
namespace {

/// Temperature of each kind of part, by what arrives at its surface.
struct PartTemperature {
  const BodyMoment& moment;
  const Incoming& incoming;

  [[nodiscard]] const Forcing& forcing() const { return moment.around.forcing; }

  double operator()(std::monostate) const { return forcing().air_k; }
  double operator()(const Clothing& clothing) const {
    return clothing_surface_k(clothing, clothing.insulation_clo(forcing().air_k, moment.dress),
                              moment.activity, forcing(), incoming);
  }
  double operator()(const Coat& coat) const {
    return coat_surface_k(coat, moment.activity, moment.since_bath_s, forcing(), incoming);
  }
  double operator()(const ColdBlooded& body) const {
    return cold_blooded_surface_k(body, moment.refuge_k.value_or(moment.around.ground_k), forcing(),
                                  incoming);
  }
  double operator()(const Unheated& thing) const {
    return body_surface_k(thing.surface, {}, forcing(), incoming);
  }
  double operator()(const Sheet& sheet) const {
    return sheet_k(sheet, moment.around, moment.roof_k, incoming);
  }
  double operator()(const EngineWarmed& part) const {
    return (*this)(part.sheet) + warmth_k(part.warmth, moment.vehicle);
  }
  double operator()(const Powered& part) const { return (*this)(part.sheet) + part.excess_k; }
  double operator()(const FirePart& part) const {
    const CampFire& fire = moment.fire.fire;
    if (!moment.fire.burning)
      return ash_bed_k(fire, moment.around, GroundProperties(), moment.around.ground_k, moment.fire.since_s);
    if (part.of == FirePart::Of::flames)
      return fire.flame_k * std::sqrt(std::sqrt(flame_emissivity(fire)));  // radiates as much as a blackbody
    return part.of == FirePart::Of::embers ? fire.ember_k : fire.ash_k;
  }
};

struct Validate {
  const std::string& where;

  void operator()(std::monostate) const {}
  void operator()(const Unheated& thing) const { thing.surface.validate(where); }
  void operator()(const EngineWarmed& part) const {
    part.sheet.validate(where);
    part.warmth.validate(where);
  }
  template <typename Kind>
  void operator()(const Kind& kind) const {
    kind.validate(where);
  }
};

BodyMoment without_sun(BodyMoment moment) {
  Forcing& forcing = moment.around.forcing;
  forcing.beam_w_m2 = forcing.diffuse_w_m2 = forcing.global_w_m2 = 0;
  return moment;
}

double arriving_sun(const BodyMoment& moment, const EastNorthUp& normal) {
  return incoming_on(moment.around, normal).sun_w_m2;
}

/// Adds the straight line in arriving sunlight through a surface that faces the sun and one that faces away.
void add_sun(const BodyHeat& heat, const BodyMoment& moment, BodyFit& fit) {
  const EastNorthUp& sun = moment.around.forcing.sun;
  const EastNorthUp away = {-sun[0], -sun[1], -sun[2]};
  const double bright = arriving_sun(moment, sun);
  const double dim = arriving_sun(moment, away);
  if (!(bright > dim)) return;
  const double bright_k = part_temperature_k(heat, moment, sun) - fit.at_k(sun[2]);
  const double dim_k = part_temperature_k(heat, moment, away) - fit.at_k(away[2]);
  fit.sun_k_m2_w = (bright_k - dim_k) / (bright - dim);
  fit.a_k += dim_k - fit.sun_k_m2_w * dim;
}

}  // namespace

void Powered::validate(const std::string& where) const {
  sheet.validate(where);
  require_range(where + ".excess_k", excess_k, "K", 0, 900);
}

void validate(const BodyHeat& heat, const std::string& where) { std::visit(Validate{where}, heat); }

double part_temperature_k(const BodyHeat& heat, const BodyMoment& moment, double normal_z) noexcept {
  return std::visit(PartTemperature{moment, incoming_on_slope(moment.around, normal_z)}, heat);
}

double part_temperature_k(const BodyHeat& heat, const BodyMoment& moment,
                          const EastNorthUp& normal) noexcept {
  return std::visit(PartTemperature{moment, incoming_on(moment.around, normal)}, heat);
}

BodyFit fit_body(const BodyHeat& heat, const BodyMoment& moment) {
  constexpr int kSlopes = 40;
  const BodyMoment night = without_sun(moment);
  const std::vector<double> powers =
      fit_polynomial([&](double normal_z) { return part_temperature_k(heat, night, normal_z); }, 3);
  BodyFit fit = {.a_k = powers[0], .b_k = powers[1], .c_k = powers[2]};
  const bool day = moment.around.forcing.global_w_m2 > 0;
  if (day) add_sun(heat, moment, fit);
  for (int slope = 0; slope <= kSlopes; ++slope) {
    const double up = -1 + 2.0 * slope / kSlopes;
    const double across = std::sqrt(std::max(0.0, 1 - up * up));
    for (int azimuth = 0; azimuth < (day ? 8 : 1); ++azimuth) {
      const double angle = azimuth * std::numbers::pi / 4;
      const EastNorthUp normal = {across * std::cos(angle), across * std::sin(angle), up};
      const double error_k =
          part_temperature_k(heat, moment, normal) - fit.at_k(up, day ? arriving_sun(moment, normal) : 0);
      fit.error_mk = std::max(fit.error_mk, 1000 * std::abs(error_k));
    }
  }
  return fit;
}

}  // namespace thermal
