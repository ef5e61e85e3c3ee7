#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "io/spectrum_files.h"
#include "radiometry/band_radiance.h"
#include "radiometry/radiance_table.h"

namespace veldt {
namespace {

struct Options {
  std::vector<double> temperatures_k;
  std::vector<double> radiances_w_m2_sr;
  std::string band_um = "8:14";
  std::string response;
  double emissivity = 1;
  std::string method = "reference";
  bool json = false;
};

/// "A:B", 0 < A < B.
thermal::SpectralResponse parse_band(const std::string& text) {
  double begin_um = 0;
  double end_um = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, begin_um);
  const bool colon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
  const auto second = colon ? std::from_chars(first.ptr + 1, end, end_um) : first;
  const bool good = colon && second.ec == std::errc() && second.ptr == end;
  if (good && begin_um > 0 && begin_um < end_um) return thermal::SpectralResponse::flat(begin_um, end_um);
  throw thermal::ConfigError(thermal::fault("--band-um", text, "um", "A:B with 0 < A < B"));
}

/// How radiance is computed from temperature, and how far off it may be.
class Evaluator {
 public:
  Evaluator(const thermal::SpectralResponse& response, const std::string& method) : band_(response) {
    if (method == "table") table_.emplace(band_);
  }

  [[nodiscard]] double temperature_k(double radiance) const { return band_.temperature(radiance); }

  /// One row of the answer for a surface of this emissivity.
  [[nodiscard]] thermal::Json answer(double temperature_k, double emissivity) const {
    const thermal::BandValue value = band_.evaluate(temperature_k);
    const double radiance = table_ ? static_cast<double>(table_->radiance(static_cast<float>(temperature_k)))
                                   : value.radiance_w_m2_sr;
    return {{"temperature_k", temperature_k},
            {"radiance_w_m2_sr", emissivity * radiance},
            {"d_radiance_d_temperature_w_m2_sr_k", emissivity * value.derivative_w_m2_sr_k},
            {"ln_radiance", value.ln_radiance + std::log(emissivity)},
            {"relative_error_bound", bound(temperature_k, value)}};
  }

 private:
  /// table: what it measured of itself. reference: rounding of temperature and wavelengths grows with the
  /// problem's condition T L'/L, and some forty operations round once each.
  [[nodiscard]] double bound(double temperature_k, const thermal::BandValue& value) const {
    if (table_) return table_->worst_relative_error();
    constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2;
    const bool known = value.radiance_w_m2_sr > 0;
    const double condition = known ? temperature_k * value.derivative_w_m2_sr_k / value.radiance_w_m2_sr : 0;
    return (6 * condition + 44) * kRounding;
  }

  thermal::BandRadiance band_;
  std::optional<thermal::RadianceTable> table_;
};

void print_table(const thermal::Json& rows) {
  fmt::print("{:>24} {:>24} {:>24}\n", "temperature [K]", "radiance [W/m2/sr]", "derivative [W/m2/sr/K]");
  for (const thermal::Json& row : rows) {
    fmt::print("{:>24.17g} {:>24.17g} {:>24.17g}\n", row["temperature_k"].get<double>(),
               row["radiance_w_m2_sr"].get<double>(),
               row["d_radiance_d_temperature_w_m2_sr_k"].get<double>());
  }
}

void check_values(const std::vector<double>& values, const std::string& option, const std::string& unit) {
  for (const double value : values) {
    if (std::isfinite(value) && value >= 0) continue;
    throw thermal::ConfigError(
        thermal::fault(option, fmt::format("{}", value), unit, "a finite number, at least 0 " + unit));
  }
}

int run(const Options& options) {
  check_values(options.temperatures_k, "--temperature-k", "K");
  check_values(options.radiances_w_m2_sr, "--radiance", "W m^-2 sr^-1");
  if (!(options.emissivity > 0 && options.emissivity <= 1)) {
    throw thermal::ConfigError(
        thermal::fault("--emissivity", fmt::format("{}", options.emissivity), "", "above 0 and at most 1"));
  }
  const thermal::SpectralResponse response =
      options.response.empty() ? parse_band(options.band_um) : thermal::read_response(options.response);
  const Evaluator evaluator(response, options.method);
  thermal::Json rows = thermal::Json::array();
  for (const double temperature_k : options.temperatures_k) {
    rows.push_back(evaluator.answer(temperature_k, options.emissivity));
  }
  for (const double radiance : options.radiances_w_m2_sr) {
    const double temperature_k = evaluator.temperature_k(radiance / options.emissivity);
    rows.push_back(evaluator.answer(temperature_k, options.emissivity));
  }
  if (!options.json) {
    print_table(rows);
    return kDone;
  }
  const thermal::Json document = {{"method", options.method},
                                  {"band_um", {response.begin_um(), response.end_um()}},
                                  {"emissivity", options.emissivity},
                                  {"values", rows}};
  fmt::print("{}\n", document.dump(2));
  return kDone;
}

}  // namespace

void add_radiance(CLI::App& app, Session& session) {
  CLI::App* command = add_command(app, session, "radiance",
                                  "In-band radiance of a temperature, or temperature of a radiance");
  auto options = std::make_shared<Options>();
  auto* temperatures =
      command->add_option("--temperature-k", options->temperatures_k, "Temperatures [K], at least 0")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->type_name("T,…");
  auto* radiances =
      command->add_option("--radiance", options->radiances_w_m2_sr, "Radiances [W m^-2 sr^-1], at least 0")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->type_name("L,…");
  temperatures->excludes(radiances);
  auto* band =
      command->add_option("--band-um", options->band_um, "Band with a flat response [um]")->type_name("A:B");
  command->add_option("--response", options->response, "Response curve, CSV: wavelength_um,response")
      ->type_name("CSV")
      ->excludes(band);
  command->add_option("--emissivity", options->emissivity, "Emissivity of the surface")
      ->capture_default_str();
  command->add_option("--method", options->method, "reference, or the table the frames are made with")
      ->check(CLI::IsMember({"reference", "table"}))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &session] {
    session.run = [options] {
      if (options->temperatures_k.empty() && options->radiances_w_m2_sr.empty()) {
        throw thermal::ConfigError("nothing asked; expected --temperature-k T,… or --radiance L,…");
      }
      return run(*options);
    };
  });
}

}  // namespace veldt
