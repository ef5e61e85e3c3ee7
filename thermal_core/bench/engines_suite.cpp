#include "bench/engines_suite.h"

#include <array>
#include <optional>

#include <fmt/format.h>

#include "base/parallel.h"
#include "bench/engine_scenes.h"
#include "bench/memory_rows.h"
#include "bench/render_suite.h"
#include "io/system/temporary.h"

namespace thermal {
namespace {

constexpr std::array kSupersamples = {1, 2, 4};

/// Cost of frames of one clip with both engines.
struct Measured {
  std::string clip;
  int supersample = 1;
  double plants = 0;
  EmbreeTimes embree;
  double embree_peak_mb = 0;
  std::optional<Profile> cycles = {};

  [[nodiscard]] std::string name() const {
    const int count = supersample * supersample;
    return fmt::format("{}, {} {}", clip, count, count == 1 ? "ray" : "rays");
  }
  /// Without writing the file, as for `embree`.
  [[nodiscard]] double cycles_s() const { return cycles->frame_s - cycles->split_s.at("write"); }
};

RenderRow frame_row(const Measured& of) {
  const double embree_s = of.embree.full_s;
  if (!of.cycles) return {"frame, s", of.name(), {{"embree", embree_s}}};
  return {"frame, s",
          of.name(),
          {{"cycles", of.cycles_s()},
           {"cycles_trace", of.cycles->split_s.at("trace")},
           {"embree", embree_s},
           {"cycles/embree", of.cycles_s() / embree_s}}};
}

RenderRow adaptive_row(const Measured& of) {
  const double full_s = of.embree.full_s;
  const double adaptive_s = of.embree.adaptive_s;
  RenderRow row = {"frame, s, adaptive sampling",
                   of.name(),
                   {{"embree", adaptive_s},
                    {"full/adaptive", full_s / adaptive_s},
                    {"all_rays_share", of.embree.all_rays_share}}};
  if (of.cycles) row.figures.push_back({"cycles/embree", of.cycles_s() / adaptive_s});
  return row;
}

RenderRow memory_row(const Measured& of) {
  RenderRow row = {"peak memory so far, MB", of.name(), {{"plants", of.plants}}};
  if (of.cycles) row.figures.push_back({"cycles", of.cycles->peak_mb});
  row.figures.push_back({"embree", of.embree_peak_mb});
  return row;
}

RenderRow differing_row(const std::string& name, const Differing& differing) {
  return {"pixels that differ, 1 ray",
          name,
          {{"pixels", differing.pixels},
           {"object_mean", differing.object.mean},
           {"object_most", differing.object.most},
           {"material_mean", differing.material.mean},
           {"material_most", differing.material.most}}};
}

class EnginesSuite {
 public:
  explicit EnginesSuite(const EnginesSuiteTask& task) : task_(task) {}

  std::vector<RenderRow> rows() {
    const std::vector<EngineScene> scenes = plan_engine_scenes({.assets = task_.assets,
                                                                .folder = folder_.path(),
                                                                .threads = task_.threads,
                                                                .announce = task_.announce});
    task_.announce("memory of Embree by plants, threads and frames");
    const std::vector<RenderRow> memory = memory_rows();
    for (const EngineScene& scene : scenes) measure(scene);
    std::vector<RenderRow> rows;
    for (const auto& row_of : {frame_row, adaptive_row, memory_row}) {
      for (const Measured& one : measured_) {
        if (row_of != adaptive_row || one.supersample > 1) rows.push_back(row_of(one));
      }
    }
    rows.insert(rows.end(), differing_.begin(), differing_.end());
    rows.insert(rows.end(), memory.begin(), memory.end());
    return rows;
  }

 private:
  void measure(const EngineScene& scene) {
    const Path out = folder_.path() / (scene.name + " by Blender");
    const std::vector<Profile> profiles = task_.blender.empty() ? std::vector<Profile>() : cycles(scene, out);
    std::vector<Measured> all = embree(scene, out);
    for (std::size_t k = 0; k < profiles.size(); ++k) all[k].cycles = profiles[k];
    for (const EngineClip& clip : scene.clips) {
      for (const Measured& one : all) {
        if (one.clip == clip.name) measured_.push_back(one);
      }
    }
  }

  [[nodiscard]] std::vector<Profile> cycles(const EngineScene& scene, const Path& out) const {
    task_.announce(scene.name + ", Cycles");
    ProfileFrames frames = {.supersamples = {kSupersamples.begin(), kSupersamples.end()},
                            .frames = kEngineFrames};
    for (const EngineClip& clip : scene.clips) frames.clips.push_back(clip.id);
    return profile_frames({.blender = task_.blender,
                           .assets = task_.assets,
                           .plan = scene.plan,
                           .out = out,
                           .threads = task_.threads},
                          frames);
  }

  /// In the order of Cycles' profiles.
  std::vector<Measured> embree(const EngineScene& planned, const Path& blenders) {
    task_.announce(planned.name + ", Embree");
    const PeakMemory memory;
    const EmbreeScene scene(planned, task_.assets);
    std::vector<Measured> all;
    for (const int supersample : kSupersamples) {
      for (const EngineClip& clip : planned.clips) {
        all.push_back({.clip = clip.name,
                       .supersample = supersample,
                       .plants = static_cast<double>(scene.plants()),
                       .embree = scene.times(clip.id, supersample)});
        all.back().embree_peak_mb = memory.grown_mb();
      }
    }
    if (task_.blender.empty()) return all;
    for (const EngineClip& clip : planned.clips)
      differing_.push_back(differing_row(clip.name, scene.differing(clip.id, blenders / clip.id / "1x1")));
    return all;
  }

  const EnginesSuiteTask& task_;
  TemporaryFolder folder_;
  std::vector<Measured> measured_;
  std::vector<RenderRow> differing_;
};

}  // namespace

std::vector<RenderRow> run_engines_suite(const EnginesSuiteTask& task) {
  return with_threads(task.threads, [&task] { return EnginesSuite(task).rows(); });
}

}  // namespace thermal
