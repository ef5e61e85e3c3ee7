#include "heat/body/body_heat.h"

#include <cmath>

#include "base/error.h"

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

}  // namespace thermal
