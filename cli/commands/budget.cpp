#include "imaging/budget.h"

#include <algorithm>
#include <memory>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/planning.h"
#include "dataset/outline/outline.h"
#include "io/assets.h"
#include "io/config/materials.h"

namespace veldt {
namespace {

constexpr std::size_t kMostConditions = 4;  ///< whose materials are listed

void print_materials(const thermal::SceneOutline& outline) {
  for (std::size_t k = 0; k < std::min(outline.conditions.size(), kMostConditions); ++k) {
    const thermal::SceneOutline::Conditions& viewing = outline.conditions[k];
    if (viewing.view_directions.empty()) continue;
    const auto nearest = std::min_element(viewing.view_directions.begin(), viewing.view_directions.end(),
                                          [](const auto& a, const auto& b) { return a.range_m < b.range_m; });
    const bool inverted = viewing.weather.air.inversion_k > 0;
    print("\nair at {:.5g} K, humidity {:.2g}, range {:.0f} m [mK]\n{:<16}{:>10}{:>10}{}\n",
          viewing.weather.air.temperature_k, viewing.weather.air.relative_humidity, nearest->range_m, "",
          "sky", "path", inverted ? ", of it inversion" : "");
    for (const thermal::SceneOutline::Cover& cover : outline.covers) {
      const thermal::MaterialShift shift = thermal::shift_of(*cover.material, viewing, nearest->range_m,
                                                             viewing.response.value_or(outline.response));
      print("{:<16}{:>+10.0f}{:>+10.0f}", cover.material->name, 1e3 * shift.sky_k, 1e3 * shift.path_k);
      if (inverted) print("{:>+17.0f}", 1e3 * shift.inversion_k);
      print("\n");
    }
  }
  if (outline.conditions.size() > kMostConditions)
    print("\nand {} more, of other clips\n", outline.conditions.size() - kMostConditions);
}

void print_budget(const thermal::Budget& budget, const thermal::SceneOutline& outline) {
  print(
      "NETD {:.0f} mK: an automatic term is kept if it differs by more than {:.1f} mK across the "
      "pictures\n\n",
      1e3 * outline.netd_k, 1e3 * outline.netd_k / 3);
  print("{:<12}{:>8}{:>14}{:>22}  {}\n", "term", "choice", "spread [mK]", "largest on actor [mK]", "");
  for (const thermal::TermEffect& effect : budget.effects) {
    print("{:<12}{:>8}{:>14.1f}{:>22.1f}  {}\n", effect.name, choice_name(effect.choice),
          1e3 * effect.spread_k, 1e3 * effect.actor_shift_k, effect.kept ? "kept" : "dropped");
  }
  print("\ndropped in total: {:.1f} mK\n", 1e3 * budget.dropped_k);
  print_materials(outline);
}

struct BudgetArguments {
  std::string config;
  std::vector<std::string> settings;
  bool json = false;
};

int run_budget(const BudgetArguments& options, const CommonOptions& common) {
  const thermal::Assets assets = thermal::Assets::find();
  const thermal::ResolvedConfig given = load_config(options.config, options.settings, assets);
  const thermal::MaterialLibrary materials = thermal::read_materials(assets);
  const auto [config, plan] = plan_with_progress(common, assets, given, options.config);
  const thermal::SceneOutline outline = thermal::outline_of(config.spec, plan, materials);
  const thermal::KeptTerms kept(config.spec, outline);
  const thermal::Budget& budget = kept.budget();
  if (options.json) {
    print_json(thermal::to_json(budget));
  } else {
    print_budget(budget, outline);
  }
  return kDone;
}

}  // namespace

void add_budget(Parser& parser) {
  Command command =
      parser.add_command("budget", "Each physical term in mK against NETD: kept or dropped, and why");
  command.footer("Example: veldt budget configs/demo.json --set season=winter");
  auto options = std::make_shared<BudgetArguments>();
  command.add_option("config", options->config, "Config of a dataset, JSON").required();
  add_settings(command, options->settings);
  command.add_flag("--json", options->json, "Print JSON");
  command.runs([options](const CommonOptions& common) { return run_budget(*options, common); });
}

}  // namespace veldt
