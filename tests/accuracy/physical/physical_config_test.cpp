#include "accuracy/physical/assets.h"
#include "base/error.h"
#include "dataset/outline/outline.h"
#include "io/config/config.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace physical_config_test {

using namespace thermal;

namespace {

/// A minimal config of the physical model, with some keys set as by `--set`.
ResolvedConfig config_with(const std::vector<std::string>& settings) {
  Json document = parse_json(R"({"name": "test", "sensor": {"model": "physical", "netd_mk": 40},
                                 "clips": [{"id": "a", "season": "winter", "frames": 1}]})",
                             "test.json");
  for (const std::string& setting : settings) apply_setting(document, setting);
  return resolve_config(std::move(document), "test.json", kAssets);
}

std::string fault_of(const std::string& setting) {
  return message_of<ConfigError>([&] { (void)config_with({setting}); });
}

/// The weather of a clip of a season at scene time 0.
Weather at_start(const ResolvedConfig& config, Season season) {
  return ClipSpec{.season = season, .settings = config.spec.settings}.weather_at(0, config.spec.heat_balance);
}

std::vector<TermChoice> choices(const ResolvedConfig& config) {
  std::vector<TermChoice> result;
  for (const TermInfo& term : kTerms) result.push_back(config.spec.settings->terms.*term.choice);
  return result;
}

}  // namespace

TEST_CASE("The physical model leaves every term to the budget, the published one drops them all") {
  CHECK(config_with({}).spec.physical);
  CHECK(choices(config_with({})) == std::vector(std::size(kTerms), TermChoice::automatic));
  const ResolvedConfig published = config_with({"sensor.model=published"});
  CHECK_FALSE(published.spec.physical);
  CHECK(choices(published) == std::vector(std::size(kTerms), TermChoice::off));
}

TEST_CASE("A term's setting overrides the model's") {
  for (const char* model : {"physical", "published"}) {
    const ResolvedConfig config = config_with(
        {std::string("sensor.model=") + model, "terms.sky=on", "terms.path=off", "terms.parts=auto"});
    CHECK(config.spec.settings->terms.sky == TermChoice::on);
    CHECK(config.spec.settings->terms.path == TermChoice::off);
    CHECK(config.spec.settings->terms.parts == TermChoice::automatic);
  }
}

TEST_CASE("A term has one of three choices and a known name") {
  CHECK(fault_of("terms.sky=maybe") == R"(test.json: terms.sky = "maybe"; expected one of on, off, auto)");
  CHECK(fault_of("terms.skies=on") ==
        "test.json: terms.skies is not a known key; expected one of place, facing, variation, parts, sky, "
        "angular, mirror, "
        "path, smear, falloff");
}

TEST_CASE("Without weather in the config, a clip's air is its season's") {
  const ResolvedConfig config = config_with({});
  const Weather winter = at_start(config, Season::winter);
  // By the day's curve at 3:00, whose minimum and maximum are rounded to 0.01 K and vapour to 0.01 hPa of 6.
  CHECK_THAT(winter.air.temperature_k, WithinAbs(273, 0.01));
  CHECK_THAT(winter.air.relative_humidity, WithinAbs(0.6, 0.002));
  CHECK(winter.air.cloud_fraction == 0);
  CHECK_FALSE(winter.vehicle_stopped_s.has_value());
  const Weather summer = at_start(config, Season::summer);
  CHECK_THAT(summer.air.temperature_k, WithinAbs(293, 0.01));
  CHECK_THAT(summer.air.relative_humidity, WithinAbs(0.7, 0.002));
  const ResolvedConfig published = config_with({"scene.temperatures=table_1"});
  CHECK(at_start(published, Season::winter) == weather_of(Season::winter));
}

TEST_CASE("Weather in the config overrides the season's, value by value") {
  const ResolvedConfig config =
      config_with({"weather.air_temperature_k=281.5", "weather.cloud_fraction=0.5"});
  for (const Season season : {Season::winter, Season::summer}) {
    const Weather weather = at_start(config, season);
    CHECK_THAT(weather.air.temperature_k, WithinAbs(281.5, 1e-9));
    CHECK(weather.air.cloud_fraction == 0.5);
    CHECK_THAT(weather.air.relative_humidity, WithinAbs(weather_of(season).air.relative_humidity, 1e-9));
  }
  CHECK(at_start(config_with({"weather.vehicle_stopped_s=60"}), Season::winter).vehicle_stopped_s == 60);
}

TEST_CASE("Impossible weather is an error") {
  const std::string air_rule = "; expected at least 233 and at most 323 K";
  CHECK(fault_of("weather.air_temperature_k=200") ==
        "test.json: weather.air_temperature_k = 200 K" + air_rule);
  CHECK(fault_of("weather.air_temperature_k=340") ==
        "test.json: weather.air_temperature_k = 340 K" + air_rule);
  CHECK(fault_of("weather.relative_humidity=60") ==
        "test.json: weather.relative_humidity = 60; expected at least 0 and at most 1");
  CHECK(fault_of("weather.cloud_fraction=-1") ==
        "test.json: weather.cloud_fraction = -1; expected at least 0 and at most 1");
}

TEST_CASE("The response is one of the files in assets") {
  const ResolvedConfig config = config_with({"sensor.response=vox_germanium"});
  CHECK(config.spec.settings->sensor.response.begin_um() == 7);
  CHECK(config.spec.settings->sensor.response.end_um() == 15);
  CHECK(config.spec.settings->sensor.response.at(10) == 1);
  CHECK(config_with({}).spec.settings->sensor.response.end_um() == 14);
  const std::string known = "flat_7_5_13_5um, flat_8_14um, vox_germanium";
  CHECK(fault_of("sensor.response=gold") ==
        "test.json: sensor.response = \"gold\"; expected one of " + known);
  CHECK(fault_of("sensor.response=flat_8_15um") ==
        "test.json: sensor.response = \"flat_8_15um\"; expected one of " + known +
            "; did you mean \"flat_8_14um\"?");
}

TEST_CASE(
    "A clip's physics are its weather, its response and the terms that were kept; the published model has "
    "none") {
  const ResolvedConfig config =
      config_with({"weather.air_temperature_k=281.5", "sensor.response=vox_germanium", "seed=9"});
  const Terms kept = {.sky = true, .path = true};
  HeatDays heat(materials());
  const auto physics = task_of(config.spec, config.spec.clips[0], kept, heat, nullptr).physics;
  REQUIRE(physics);
  REQUIRE(physics->heat);
  CHECK(physics->heat->day->weather() == physics->weather.day);
  CHECK(physics->terms == kept);
  // At time 0; the clip's middle is seconds later, and the air cools by less than 1 K an hour.
  CHECK_THAT(physics->weather.air.temperature_k, WithinAbs(281.5, 0.02));
  CHECK(physics->response.end_um() == 15);
  CHECK(physics->seed == 9);
  const ResolvedConfig published = config_with({"sensor.model=published"});
  CHECK_FALSE(task_of(published.spec, published.spec.clips[0], kept, heat, nullptr).physics);
}

TEST_CASE("The budget knows the finest sensor of all clips, and a clip may choose its own terms") {
  Json document = config_with({"terms.sky=on"}).document;
  Json fine = document["clips"][0];
  fine.update({{"id", "fine"}, {"sensor", {{"netd_mk", 10}}}});
  Json bare = document["clips"][0];
  bare.update({{"id", "bare"}, {"terms", {{"sky", "off"}}}});
  document["clips"].push_back(fine);
  document["clips"].push_back(bare);
  const DatasetSpec spec = resolve_config(document, "test.json", kAssets).spec;
  const SceneOutline outline = empty_outline(spec);
  CHECK(outline.netd_k == spec.clips[1].settings->netd_k);
  CHECK_THAT(outline.netd_k, WithinRel(0.25 * spec.settings->netd_k, 1e-12));
  const KeptTerms kept(spec, outline);
  CHECK(kept.of(spec.clips[0]).sky);
  CHECK(kept.of(spec.clips[1]).sky);
  CHECK_FALSE(kept.of(spec.clips[2]).sky);
}

TEST_CASE("The flat responses are flat, and the camera's peaks near 10 um") {
  for (const double um : {8.0, 11.0, 14.0}) CHECK(response("flat_8_14um").at(um) == 1);
  for (const double um : {7.5, 10.0, 13.5}) CHECK(response("flat_7_5_13_5um").at(um) == 1);
  const SpectralResponse camera = response("vox_germanium");
  CHECK(camera.at(10) == 1);
  CHECK(camera.at(7) == 0);
  CHECK(camera.at(15) == 0);
  CHECK(camera.at(14) < 0.5);
}

}  // namespace physical_config_test
