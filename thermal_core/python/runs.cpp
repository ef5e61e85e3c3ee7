#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/dataset_file.h"
#include "dataset/dataset_index.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/generate.h"
#include "dataset/run/options.h"
#include "dataset/run/render.h"
#include "io/system/child_process.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

namespace py = pybind11;

/// Called with a stage ("planning", "ground maps" or "frames"), the current clip, and counts of done and all.
using Report = std::function<void(const std::string& stage, const std::string& clip, int done, int total)>;

/// Connects a run, which does not hold the interpreter's lock, to Python: reports go there; exceptions raised there, or
/// Ctrl-C, end the run.
class Listener {
 public:
  explicit Listener(Report report) : report_(std::move(report)) {}

  void report(const char* stage, const Progress& progress) {
    if (!report_) return;
    const py::gil_scoped_acquire python;
    keep_fault([&] { report_(stage, progress.clip, progress.done, progress.total); });
  }

  /// Whether an exception is pending. Python checks signals in its main thread alone.
  [[nodiscard]] bool is_to_stop() {
    const py::gil_scoped_acquire python;
    keep_fault([] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    });
    return fault_ != nullptr;
  }

  /// Rethrows the pending exception, if there is one.
  void raise() const {
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  template <typename Call>
  void keep_fault(const Call& call) {
    if (fault_) return;
    try {
      call();
    } catch (const py::error_already_set&) {
      fault_ = std::current_exception();
    }
  }

  Report report_;
  std::exception_ptr fault_;  ///< accessed under the interpreter's lock only
};

struct Sources {
  std::string config;  ///< JSON
  std::string name;    ///< of it, in messages
  std::string folder;  ///< that its paths are relative to
  std::vector<std::string> settings;
  std::string home;
};

ResolvedConfig config_of(const Sources& sources) {
  Json document = parse_json(sources.config, sources.name);
  for (const std::string& setting : sources.settings) apply_setting(document, setting);
  root_files(document, sources.folder);
  return resolve_config(std::move(document), sources.name, Assets(sources.home));
}

PlanOptions planning_of(const Assets& assets, int threads, Listener& listener) {
  return {.assets = assets,
          .threads = threads,
          .blender = find_program("blender"),
          .show = [&listener](const Progress& now) { listener.report("planning", now); },
          .show_maps = [&listener](const Progress& now) { listener.report("ground maps", now); },
          .left_over = {}};
}

py::dict dict_of(const RunOutcome& outcome) {
  using namespace py::literals;
  return py::dict("made"_a = outcome.made, "already_there"_a = outcome.already_there,
                  "failed"_a = outcome.failed, "frames_made"_a = outcome.frames_made,
                  "complete"_a = outcome.complete);
}

struct RunSettings {
  std::vector<std::string> clips;
  std::string blender;
  int jobs = 1;
  int threads = 0;
  bool keep_passes = false;
};

RunOutcome run(const PlannedDataset& dataset, GenerateOptions options, const RunSettings& settings,
               Listener& listener) {
  if (dataset.config.spec.engine == Engine::blender)
    options.blender = find_blender(settings.blender, "blender");
  const RunHooks hooks = {.progress = [&](const Progress& now) { listener.report("frames", now); },
                          .cancelled = [&] { return listener.is_to_stop(); }};
  try {
    return generate(dataset.config, dataset.plan, options, hooks);
  } catch (const Cancelled&) {
    listener.raise();
    throw;
  }
}

GenerateOptions options_of(const std::string& home, const std::string& out, const Path& plan,
                           const RunSettings& settings) {
  return {.assets = Assets(home),
          .out = out,
          .plan = plan,
          .blender = find_program(settings.blender.empty() ? "blender" : settings.blender),
          .clips = settings.clips,
          .shard = {},
          .jobs = settings.jobs,
          .threads = settings.threads,
          .keep_passes = settings.keep_passes};
}

py::dict generate_config(const Sources& sources, const std::string& out, const RunSettings& settings,
                         const Report& report) {
  Listener listener(report);
  RunOutcome outcome;
  {
    const py::gil_scoped_release others_run;
    GenerateOptions options = options_of(sources.home, out, Layout{out}.plan(), settings);
    const PlannedDataset planned =
        plan_in_dataset(out, config_of(sources), sources.name,
                        planning_of(options.assets, settings.threads, listener), check_same_dataset);
    listener.raise();
    (void)choose_clips(planned.config.spec, options.clips, options.shard);
    outcome = run(planned, std::move(options), settings, listener);
  }
  return dict_of(outcome);
}

py::dict generate_plan(const std::string& plan, const std::string& home, const std::string& out,
                       const RunSettings& settings, const Report& report) {
  Listener listener(report);
  RunOutcome outcome;
  {
    const py::gil_scoped_release others_run;
    GenerateOptions options = options_of(home, out, plan, settings);
    const PlanStore store(plan, options.assets);
    const PlannedDataset dataset = store.open();
    store.check_clips(ids_of(choose_clips(dataset.config.spec, options.clips, options.shard)));
    outcome = run(dataset, std::move(options), settings, listener);
  }
  return dict_of(outcome);
}

std::vector<std::string> plan_config(const Sources& sources, const std::string& folder, int threads,
                                     const Report& report) {
  Listener listener(report);
  const py::gil_scoped_release others_run;
  const Assets assets(sources.home);
  const PlannedDataset planned =
      PlanStore(folder, assets)
          .plan_with_config(config_of(sources), sources.name, planning_of(assets, threads, listener));
  listener.raise();
  return ids_of(planned.config.spec.clips);
}

}  // namespace

void add_runs(py::module_& module) {
  py::class_<Sources>(module, "Sources")
      .def(py::init<std::string, std::string, std::string, std::vector<std::string>, std::string>(),
           py::arg("config"), py::arg("name"), py::arg("folder"), py::arg("settings"), py::arg("home"));
  py::class_<RunSettings>(module, "RunSettings")
      .def(py::init<std::vector<std::string>, std::string, int, int, bool>(), py::arg("clips"),
           py::arg("blender"), py::arg("jobs"), py::arg("threads"), py::arg("keep_passes"));
  module.def("generate_config", &generate_config, py::arg("sources"), py::arg("out"), py::arg("settings"),
             py::arg("report"));
  module.def("generate_plan", &generate_plan, py::arg("plan"), py::arg("home"), py::arg("out"),
             py::arg("settings"), py::arg("report"));
  module.def("plan_config", &plan_config, py::arg("sources"), py::arg("folder"), py::arg("threads"),
             py::arg("report"));
}

}  // namespace thermal::python
