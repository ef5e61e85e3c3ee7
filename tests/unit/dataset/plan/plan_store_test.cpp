#include "dataset/plan/plan_store.h"

#include "io/bake/ground_maps_file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace plan_store_test {

using namespace thermal;
using enum PlanState::Kind;

namespace {

/// A config, and a folder with the file of its plan that says what it is a plan of.
class Planned {
 public:
  explicit Planned(bool physical = false) : config_(resolve_config(document(physical), "demo", kAssets)) {
    const Json outline = {{"covers", Json::object()}, {"actors", Json::array()}};
    plan_ = {{"format", "veldt-plan"},
             {"version", kPlanVersion},
             {"config", planned_part(config_)},
             {"files", Json::object()},
             {"actors", 0},
             {"plants", 0},
             {"outline", outline}};
    for (const ClipSpec& clip : config_.spec.clips)
      plan_["clips"].push_back({{"id", clip.id},
                                {"of_flight", ""},
                                {"start_s", 0},
                                {"frames", clip.frames},
                                {"frame_rate_hz", 9},
                                {"duration_s", 1},
                                {"frames_with_actors", 0},
                                {"min_agl_m", 1},
                                {"max_agl_m", 1},
                                {"mean_agl_m", 1},
                                {"mean_look_angle_deg", 90}});
  }

  Json& plan() { return plan_; }
  const TestFolder& folder() const { return folder_; }
  const PlanStore& store() const { return store_; }
  const ResolvedConfig& config() const { return config_; }

  /// Writes all, and whatever is in the folder, as a complete plan.
  PlanState written() const {
    (void)folder_.file("plan.json", plan_.dump());
    store_.write_checksums();
    return state();
  }

  PlanState state() const { return store_.state(config_); }

 private:
  static Json document(bool physical) {
    Json demo = read_json(kAssets.config("demo"));
    demo["sensor"] = {{"model", physical ? "physical" : "published"}};
    return demo;
  }

  ResolvedConfig config_;
  Json plan_;
  TestFolder folder_;
  PlanStore store_{folder_.path(), kAssets};
};

}  // namespace

TEST_CASE("A plan that has all its files unchanged is complete") {
  Planned planned;
  CHECK(planned.state().kind == missing);
  CHECK(planned.state().why == (planned.folder() / "plan.json").string() + " is missing");
  const PlanState state = planned.written();
  CHECK(state.kind == complete);
  CHECK(state.why.empty());
  CHECK(state.plan.clips.size() == planned.config().spec.clips.size());
  CHECK(planned.store().state(planned.config(), true).kind == missing);  // no pictures for a preview
}

TEST_CASE("A plan is of another version, of another config, or was made from other files") {
  Planned planned;
  const std::string file = (planned.folder() / "plan.json").string();
  planned.plan()["config"]["seed"] = 5;
  CHECK(planned.written().kind == other_config);
  CHECK(planned.state().why.starts_with(file + " is of another config: seed"));
  planned.plan()["config"] = planned_part(planned.config());
  planned.plan()["files"]["README.md"] = std::string(64, '0');
  CHECK(planned.written().kind == other_config);
  CHECK(planned.state().why == file + " was made from another README.md");
  planned.plan()["version"] = kPlanVersion + 1;
  CHECK(planned.written().kind == other_version);
}

TEST_CASE("A plan whose files are not as their checksums say is damaged") {
  Planned planned;
  (void)planned.folder().file("scene.bin", "bytes");
  CHECK(planned.written().kind == complete);
  (void)planned.folder().file("scene.bin", "other");
  CHECK(planned.state().kind == damaged);
  CHECK(planned.state().why.starts_with((planned.folder() / "scene.bin").string() + " is damaged"));
  std::filesystem::remove(planned.folder() / "scene.bin");
  CHECK(planned.state().kind == damaged);
  std::filesystem::remove(planned.folder() / "checksums.json");
  CHECK(planned.state().kind == damaged);
  (void)planned.folder().file("plan.json", "{");
  CHECK(planned.state().kind == damaged);
}

TEST_CASE("A physical plan needs maps of the ground for the days of its config") {
  Planned planned(true);
  CHECK(planned.written().kind == lacks_ground_maps);
  GroundMaps maps{.size_m = 1,
                  .cells = 1,
                  .sky_view = {0},
                  .height_m = {0},
                  .crown_top_m = {0},
                  .moisture = {0},
                  .water_m = {},
                  .covers = {.cells = 1,
                             .kinds = {"soil"},
                             .kind = {0},
                             .grass = {0},
                             .trodden = {0},
                             .ash = {0},
                             .border = {0}},
                  .sunlit = {}};
  write_ground_maps(maps, planned.folder().path(), planned.folder().path());
  const PlanState state = planned.written();
  CHECK(state.kind == lacks_ground_maps);
  CHECK(state.why.starts_with(planned.folder().path().string() + " has no maps of the ground for day "));
  for (const SunPath& path : sun_paths(planned.config().spec))
    maps.sunlit.push_back({.path = path, .hours = {1}});
  write_ground_maps(maps, planned.folder().path(), planned.folder().path());
  CHECK(planned.written().kind == complete);
}

}  // namespace plan_store_test
