#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "io/config/spectra.h"
#include "radiometry/band_radiance.h"
#include "radiometry/radiance_table.h"

namespace veldt {
namespace {

struct RadianceArguments {
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

/// Conversion from temperature to radiance, and its error bound.
class Evaluator {
 public:
  Evaluator(const thermal::SpectralResponse& response, const std::string& method) : band_(response) {
    if (method == "table") table_.emplace(band_);
  }

  [[nodiscard]] double temperature_k(double radiance) const { return band_.temperature(radiance); }

  [[nodiscard]] double radiance(double temperature_k, double emissivity) const {
    return emissivity * band_.radiance(temperature_k);
  }

  /// One row of the answer for a surface of this emissivity.
  [[nodiscard]] thermal::Json answer(double temperature_k, double emissivity) const {
    const thermal::BandValue value = band_.evaluate(temperature_k);
    const double radiance = table_ ? static_cast<double>(table_->radiance(static_cast<float>(temperature_k)))
                                   : value.radiance_w_m2_sr;
    return {{"temperature_k", temperature_k},
            {"radiance_w_m2_sr", emissivity * radiance},
            {"d_radiance_d_temperature_w_m2_sr_k", emissivity * value.derivative_w_m2_sr_k},
            {"ln_radiance", value.ln_radiance + std::log(emissivity)},
            {"relative_error_bound", bound(temperature_k, emissivity * radiance)}};
  }

 private:
  /// Error bound of the radiance and of its product with an emissivity: two roundings, and lost digits below the
  /// smallest normal double.
  [[nodiscard]] double bound(double temperature_k, double radiance) const {
    using Double = std::numeric_limits<double>;
    if (temperature_k == 0) return 0;
    if (radiance == 0) return 1;
    const double of_band =
        table_ ? table_->relative_error_bound(temperature_k) : band_.relative_error_bound(temperature_k);
    return of_band + Double::epsilon() + (radiance < Double::min() ? Double::denorm_min() / radiance : 0);
  }

  thermal::BandRadiance band_;
  std::optional<thermal::RadianceTable> table_;
};

void print_table(const thermal::Json& rows) {
  print("{:>24} {:>24} {:>24}\n", "temperature [K]", "radiance [W/m2/sr]", "derivative [W/m2/sr/K]");
  for (const thermal::Json& row : rows) {
    print("{:>24.17g} {:>24.17g} {:>24.17g}\n", row["temperature_k"].get<double>(),
          row["radiance_w_m2_sr"].get<double>(), row["d_radiance_d_temperature_w_m2_sr_k"].get<double>());
  }
}

/// Up to here the reference and its inverse are checked against 60-digit values.
constexpr double kHottestK = 1e6;

void check_values(const std::vector<double>& values, const std::string& option, const std::string& unit,
                  double most, const std::string& why = "") {
  for (const double value : values) {
    if (value >= 0 && value <= most) continue;
    throw thermal::ConfigError(
        thermal::fault(option, fmt::format("{}", value), unit,
                       fmt::format("a number from 0 {0} to {1:.7g} {0}{2}", unit, most, why)));
  }
}

/// The given band or response. ConfigError for an unreadable response.
thermal::SpectralResponse response_of(const RadianceArguments& options) {
  if (options.response.empty()) return parse_band(options.band_um);
  try {
    return thermal::read_response(options.response);
  } catch (const thermal::IoError& error) {
    throw thermal::ConfigError(error.what());
  }
}

int run_radiance(const RadianceArguments& options) {
  check_values(options.temperatures_k, "--temperature-k", "K", kHottestK);
  if (!(options.emissivity > 0 && options.emissivity <= 1)) {
    throw thermal::ConfigError(
        thermal::fault("--emissivity", fmt::format("{}", options.emissivity), "", "above 0 and at most 1"));
  }
  const thermal::SpectralResponse response = response_of(options);
  const Evaluator evaluator(response, options.method);
  check_values(options.radiances_w_m2_sr, "--radiance", "W m^-2 sr^-1",
               evaluator.radiance(kHottestK, options.emissivity),
               fmt::format(", that of {} K in this band", kHottestK));
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
  print_json(document);
  return kDone;
}

}  // namespace

void add_radiance(Parser& parser) {
  Command command =
      parser.add_command("radiance", "In-band radiance of a temperature, or temperature of a radiance");
  command.footer("Example: veldt radiance --temperature-k 290,300,310 --band-um 7.5:13.5");
  auto options = std::make_shared<RadianceArguments>();
  Option temperatures =
      command.add_option("--temperature-k", options->temperatures_k, "Temperatures [K], from 0 to 1e6")
          .comma_separated()
          .type_name("T,…");
  Option radiances = command
                         .add_option("--radiance", options->radiances_w_m2_sr,
                                     "Radiances [W m^-2 sr^-1], from 0 to that of 1e6 K")
                         .comma_separated()
                         .type_name("L,…");
  temperatures.excludes(radiances);
  Option band =
      command.add_option("--band-um", options->band_um, "Band with a flat response [um]").type_name("A:B");
  command.add_option("--response", options->response, "Response curve, CSV: wavelength_um,response")
      .type_name("CSV")
      .excludes(band);
  command.add_option("--emissivity", options->emissivity, "Emissivity of the surface").shows_default();
  command.add_option("--method", options->method, "reference, or the table the frames are made with")
      .one_of({"reference", "table"})
      .shows_default();
  command.add_flag("--json", options->json, "Print JSON");
  command.runs([options](const CommonOptions& /*common*/) {
    if (options->temperatures_k.empty() && options->radiances_w_m2_sr.empty())
      throw thermal::ConfigError("nothing asked; expected --temperature-k T,… or --radiance L,…");
    return run_radiance(*options);
  });
}

}  // namespace veldt
