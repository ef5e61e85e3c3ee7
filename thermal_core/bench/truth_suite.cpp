#include "bench/truth_suite.h"

#include <map>
#include <utility>

#include "base/parallel.h"
#include "bench/truth_case.h"
#include "bench/truth_rows.h"

namespace thermal {
namespace {

using Kind = ShippedSampling::Kind;

const std::string kMoving = "sampling, moving";
const std::string kStill = "sampling, still";
const std::string kSpeed = "speed of the camera";
const std::string kFrameRate = "frame rate";
const std::string kOptics = "optics, still";
const std::string kShares = "share of the error";
const std::string kConvergence = "convergence of the truth";

const std::vector<ShippedSampling>& samplings() {
  static const std::vector<ShippedSampling> kAll = {{"1 ray", Kind::full, 1},
                                                    {"2 x 2", Kind::full, 2},
                                                    {"4 x 4", Kind::full, 4},
                                                    {"8 x 8", Kind::full, 8},
                                                    {"adaptive 2 x 2", Kind::adaptive, 2},
                                                    {"adaptive 4 x 4", Kind::adaptive, 4},
                                                    {"coverage", Kind::coverage, 32}};
  return kAll;
}

/// Kernels without motion, each computed once.
class Kernels {
 public:
  const ContrastKernel& of(const TruthCase& measured) {
    const GreySurface& surface = measured.target.surface;
    const std::string name = measured.preset.name + std::to_string(surface.temperature_k);
    const auto found = kernels_.find(name);
    if (found != kernels_.end()) return found->second;
    return kernels_.emplace(name, ContrastKernel(measured.preset.truth, surface, kTruthSoil, {}))
        .first->second;
  }

 private:
  std::map<std::string, ContrastKernel> kernels_;
};

class TruthTable {
 public:
  TruthTable(std::function<void(const std::string&)> announce, std::string only)
      : announce_(std::move(announce)), only_(std::move(only)) {}

  [[nodiscard]] bool wants(const std::string& group) const { return only_.empty() || only_ == group; }

  void add(const std::string& group, const std::string& name, const TruthCase& measured) {
    if (!wants(group)) return;
    announce_(group + ", " + name);
    const TruthErrors errors = shipped_errors(measured, kernels_.of(measured));
    rows_.push_back({.group = group,
                     .name = name,
                     .figures = {{"rms mK", errors.rms_mk},
                                 {"worst mK", errors.worst_mk},
                                 {"signal %", errors.signal_percent},
                                 {"scatter %", errors.scatter_percent},
                                 {"ms/frame", frame_ms(measured)}}});
  }

  void add(const std::vector<RenderRow>& rows) { rows_.insert(rows_.end(), rows.begin(), rows.end()); }
  [[nodiscard]] const ContrastKernel& kernel(const TruthCase& measured) { return kernels_.of(measured); }
  [[nodiscard]] const std::vector<RenderRow>& rows() const noexcept { return rows_; }

 private:
  /// Time depends on sampling and optics, and hardly on the target.
  double frame_ms(const TruthCase& measured) {
    const std::string name = measured.sampling.name + measured.preset.name;
    if (!ms_.contains(name)) ms_[name] = shipped_ms(measured);
    return ms_[name];
  }

  std::function<void(const std::string&)> announce_;
  std::string only_;
  std::vector<RenderRow> rows_;
  Kernels kernels_;
  std::map<std::string, double> ms_;
};

std::string number(double value) {
  return value == static_cast<int>(value) ? std::to_string(static_cast<int>(value)) : std::to_string(value);
}

void add_axes(TruthTable& table, const TruthCase& usual) {
  const std::vector<TruthTarget> targets = truth_targets();
  for (const ShippedSampling& sampling : samplings()) {
    TruthCase one = usual;
    one.sampling = sampling;
    table.add(kMoving, sampling.name, one);
    one.speed_m_s = 0;
    one.walks = false;
    table.add(kStill, sampling.name, one);
  }
  for (const TruthTarget& target : targets) {
    TruthCase one = usual;
    one.target = target;
    if (target.name == "elephant" || target.name == "truck") one.places = 8;  // they cover many pixels
    table.add("target", target.name, one);
  }
  for (const double distance_m : {61.0, 122.0, 300.0, 1000.0}) {
    TruthCase one = usual;
    one.distance_m = distance_m;
    table.add("distance", number(distance_m) + " m", one);
  }
  TruthCase stands = usual;
  stands.walks = false;
  for (const double speed_m_s : {0.0, 6.0, 12.0, 20.0}) {
    TruthCase one = stands;
    one.speed_m_s = speed_m_s;
    table.add(kSpeed, number(speed_m_s) + " m/s", one);
  }
  TruthCase walks = usual;
  walks.speed_m_s = 0;
  table.add(kSpeed, "0, target walks", walks);
  for (const double rate_hz : {9.0, 30.0, 60.0}) {
    TruthCase one = usual;
    one.frame_rate_hz = rate_hz;
    table.add(kFrameRate, number(rate_hz) + " Hz", one);
  }
  for (const TruthPreset& preset : truth_presets()) {
    TruthCase one = stands;
    one.preset = preset;
    one.speed_m_s = 0;
    for (const int factor : {1, 4}) {
      one.sampling = {number(factor) + " x " + number(factor), Kind::full, factor};
      table.add(kOptics, preset.name + ", " + one.sampling.name, one);
    }
  }
}

/// In the order of truth_groups().
std::vector<RenderRow> grouped(const std::vector<RenderRow>& rows) {
  std::vector<RenderRow> out;
  for (const std::string& group : truth_groups()) {
    for (const RenderRow& row : rows)
      if (row.group == group) out.push_back(row);
  }
  return out;
}

}  // namespace

const std::vector<std::string>& truth_groups() {
  static const std::vector<std::string> kGroups = {kMoving,    kStill,  "target", "distance",  kSpeed,
                                                   kFrameRate, kOptics, kShares,  kConvergence};
  return kGroups;
}

std::vector<RenderRow> run_truth_suite(const std::function<void(const std::string&)>& announce,
                                       const std::string& only) {
  return with_threads(1, [&] {
    TruthTable table(announce, only);
    const TruthCase usual = {.target = truth_target(truth_targets(), "person")};
    add_axes(table, usual);
    if (table.wants(kShares)) {
      announce(kShares);
      table.add(share_rows(kShares, usual, table.kernel(usual)));
    }
    if (table.wants(kConvergence)) {
      announce(kConvergence);
      table.add(convergence_rows(kConvergence, usual, table.kernel(usual)));
    }
    return grouped(table.rows());
  });
}

}  // namespace thermal
