#include "dataset/clip/maker.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "io/config/materials.h"
#include "io/image/png.h"
#include "io/manifest_file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/own_settings.h"
#include "support/test_folder.h"
#include "support/tiny_clip.h"

namespace clip_maker_test {

using namespace thermal;

namespace {

/// A folder with the passes of clip "a", and a dataset to make it in.
struct Workplace {
  TestFolder folder;
  Path passes = tiny_clip::write(folder / "passes", "a");
  Path clip = folder / "clip";  ///< where task() makes it

  [[nodiscard]] ClipPasses rendered() const {
    return {.manifest = read_manifest(passes / "manifest.json", kAssets), .folder = passes};
  }
  [[nodiscard]] ClipTask task(const std::string& made_in = "clip") const {
    ClipTask task;
    task.clip.id = "a";
    task.clip.frames = tiny_clip::kFrames;
    task.folder = folder / made_in;
    return task;
  }
  [[nodiscard]] ClipRecord make(const ClipTask& task, const ClipHooks& hooks = {}) const {
    return make_clip(rendered(), task, read_materials(kAssets), hooks);
  }
  [[nodiscard]] ClipRecord make(const ClipHooks& hooks = {}) const { return make(task(), hooks); }
  [[nodiscard]] std::vector<ClipRecord> make_all(const std::vector<ClipTask>& tasks) const {
    return make_clips(rendered(), tasks, read_materials(kAssets), {});
  }
  /// The same, skipping bad frames.
  [[nodiscard]] std::vector<ClipRecord> make_without_bad(const std::vector<ClipTask>& tasks,
                                                         const ClipHooks& hooks = {}) const {
    ClipPasses lenient = rendered();
    lenient.bad_frames = BadFrames::skip;
    return make_clips(lenient, tasks, read_materials(kAssets), hooks);
  }
  [[nodiscard]] Path frame(int number) const { return passes / tiny_clip::file_name(number); }
  void remove(int number) const { std::filesystem::remove(frame(number)); }
  /// Writes an index into a frame that the manifest lacks.
  void put_unknown_index(int number) const {
    ExrChannels planes = tiny_clip::planes(number);
    planes.at("Scene.IndexOB.X")[41] = 99;
    write_exr(frame(number), tiny_clip::kWidth, tiny_clip::kHeight, planes);
  }
};

constexpr const char* kUnknownIndex =
    "object index at pixel (1, 1) = 99 (1 pixels); expected an index of the manifest's objects: 0, 1, 5, 6";

}  // namespace

TEST_CASE(
    "A clip has its pictures, labels, frame records and preview, and a record with the checksum of each") {
  const Workplace place;
  const ClipRecord record = place.make();
  CHECK(record.clip == "a");
  CHECK(record.frames == 3);
  CHECK(record.annotations == 5);  // the person has left by the third frame
  CHECK(record.files.size() == 2 * 3 + 3);
  for (const auto& [name, sum] : record.files) {
    CAPTURE(name);
    CHECK(std::filesystem::exists(place.clip / name));
    CHECK(sum.size() == 64);
  }
  CHECK(to_json(read_clip_record(place.clip / "clip.json")) == to_json(record));
}

TEST_CASE("Pictures have the camera's size, and the elephant is warmer than the ground") {
  const Workplace place;
  (void)place.make();
  const auto ir16 = read_png16(place.clip / "ir16/000000.png");
  CHECK(ir16.width_px() == tiny_clip::kWidth);
  CHECK(ir16.height_px() == tiny_clip::kHeight);
  CHECK(ir16.at(17, 14) > ir16.at(5, 5) + 300);  // 290 K against 278 K, of .01 K each
  CHECK(read_png8(place.clip / "ir8/000000.png").width_px() == tiny_clip::kWidth);
}

TEST_CASE("A clip made twice has the same pixels, with one thread or two") {
  const auto record = [] { return Workplace().make(); };
  const ClipRecord once = with_threads(1, record);
  const ClipRecord twice = with_threads(2, record);
  CHECK(once.pixels_sha256 == twice.pixels_sha256);
  for (const auto& [name, sum] : once.files) {
    if (name == "preview.mp4") continue;  // lossy, and the encoder's own
    CHECK(twice.files.at(name) == sum);
  }
}

TEST_CASE("Another seed or another id gives other pixels") {
  const Workplace place;
  const ClipRecord record = place.make();
  ClipTask other_seed = place.task();
  other_seed.seed = 2;
  CHECK(place.make(other_seed).pixels_sha256 != record.pixels_sha256);
  ClipTask other_id = place.task();
  other_id.clip.id = "b";
  CHECK(place.make(other_id).pixels_sha256 != record.pixels_sha256);
}

TEST_CASE(
    "A codec changes ir8, not ir16 or labels, and each frame's record has the size of what was encoded") {
  const Workplace place;
  const ClipRecord plain = place.make();
  ClipTask task = place.task("coded");
  own_settings(task).codec = VideoCodecSettings{.name = "mjpeg", .bitrate_kbit_s = 20};
  const ClipRecord coded = place.make(task);
  for (const auto& [name, sum] : plain.files) {
    if (name == "preview.mp4") continue;  // lossy, and the encoder's own
    CAPTURE(name);
    const bool is_same = name.starts_with("ir16/") || name == "labels.json";
    CHECK((coded.files.at(name) == sum) == is_same);
  }
  const std::string lines = read_file(place.folder / "coded/frames.jsonl");
  const Json line = parse_json(lines.substr(0, lines.find('\n')), "");
  CHECK(line.at("encoded_bytes").get<int>() > 100);
  CHECK(read_file(place.clip / "frames.jsonl").find("encoded_bytes") == std::string::npos);
}

TEST_CASE("Every frame is reported through the hooks") {
  int waited = 0;
  int done = 0;
  ClipHooks hooks;
  hooks.wait_for_frame = [&](int frame) { CHECK(frame == waited++); };
  hooks.frame_done = [&] { ++done; };
  (void)Workplace().make(hooks);
  CHECK(waited == 3);
  CHECK(done == 3);
}

TEST_CASE("A cancelled clip does not exist") {
  const Workplace place;
  ClipHooks hooks;
  int asked = 0;
  hooks.cancelled = [&] { return ++asked == 3; };
  CHECK_THROWS_AS(place.make(hooks), Cancelled);
}

TEST_CASE("A clip with a missing frame does not exist, and the file is named") {
  const Workplace place;
  place.remove(2);
  CHECK(message_of<IoError>([&] { (void)place.make(); }) ==
        fmt::format("cannot read {}: no such file", place.frame(2).string()));
}

TEST_CASE("A frame with an index missing from the manifest is named") {
  const Workplace place;
  place.put_unknown_index(1);
  CHECK(message_of<DataError>([&] { (void)place.make(); }) ==
        fmt::format("{}: {}", place.frame(1).string(), kUnknownIndex));
}

TEST_CASE("The first of several bad frames is named, whichever is found first") {
  const Workplace place;
  place.put_unknown_index(0);  // takes longer to detect than a missing file
  place.remove(1);
  for (int time = 0; time < 20; ++time)
    CHECK(message_of<DataError>([&] { (void)place.make(); }).starts_with(place.frame(0).string()));
}

TEST_CASE("A clip skips its bad frames: their numbers stay unused, and its record lists them") {
  const Workplace place;
  place.remove(1);
  std::vector<SkippedFrame> reported;
  int done = 0;
  ClipHooks hooks;
  hooks.frame_skipped = [&](const SkippedFrame& frame) { reported.push_back(frame); };
  hooks.frame_done = [&] { ++done; };
  const ClipRecord record = place.make_without_bad({place.task()}, hooks).front();
  const SkippedFrame missing = {.frame_index = 1, .file = "000001.exr", .reason = "no such file"};
  CHECK(record.skipped == std::vector{missing});
  CHECK(reported == record.skipped);
  CHECK(done == 3);
  CHECK(record.frames == 2);
  CHECK(record.files.size() == 2 * 2 + 3);
  CHECK(record.files.contains("ir16/000002.png"));
  CHECK_FALSE(std::filesystem::exists(place.clip / "ir8/000001.png"));
  const Json labels = read_json(place.clip / "labels.json");
  CHECK(labels["images"].size() == 2);
  CHECK(labels["images"][1]["id"] == 3);
  CHECK(labels["images"][1]["frame_index"] == 2);
  CHECK(read_clip_record(place.clip / "clip.json").skipped == record.skipped);
}

TEST_CASE("Pictures of the other frames do not depend on threads, nor on why one is skipped") {
  const auto record_with = [](int threads, bool missing) {
    const Workplace place;
    missing ? place.remove(1) : place.put_unknown_index(1);
    return with_threads(threads, [&place] { return place.make_without_bad({place.task()}).front(); });
  };
  const ClipRecord once = record_with(1, true);
  const ClipRecord twice = record_with(2, true);
  const ClipRecord unknown = record_with(2, false);
  CHECK(twice.pixels_sha256 == once.pixels_sha256);
  CHECK(twice.files.at("labels.json") == once.files.at("labels.json"));
  CHECK(unknown.pixels_sha256 == once.pixels_sha256);
  CHECK(unknown.skipped.front().reason == kUnknownIndex);
  // Without state between frames, those before and after are unchanged.
  CHECK(once.files.at("ir16/000002.png") == Workplace().make().files.at("ir16/000002.png"));
}

TEST_CASE("A bad frame is skipped in all tasks") {
  const Workplace place;
  place.put_unknown_index(2);
  const std::vector<ClipRecord> records = place.make_without_bad({place.task("one"), place.task("two")});
  for (const ClipRecord& record : records) {
    CHECK(record.frames == 2);
    CHECK(record.skipped.front().frame_index == 2);
  }
}

TEST_CASE("A clip without any good frame is a fault; the first is named, and the number of others") {
  const Workplace place;
  for (int frame = 0; frame < tiny_clip::kFrames; ++frame) place.remove(frame);
  CHECK(message_of<DataError>([&] { (void)place.make_without_bad({place.task()}); }) ==
        fmt::format("cannot read {}: no such file; its 2 other frames cannot be converted either",
                    place.frame(0).string()));
}

TEST_CASE("Faults that are not a frame's are not skipped") {
  const Workplace place;
  ClipHooks hooks;
  hooks.wait_for_frame = [](int) { throw TryAgainError("no room"); };
  CHECK(message_of<TryAgainError>([&] { (void)place.make_without_bad({place.task()}, hooks); }) == "no room");
  hooks.wait_for_frame = [&](int) {  // a folder in the way of the first picture
    make_folder(place.clip / "ir8/000000.png");
  };
  CHECK(message_of<IoError>([&] { (void)place.make_without_bad({place.task()}, hooks); }) ==
        fmt::format("cannot write {}: File exists", (place.clip / "ir8/000000.png").string()));
}

TEST_CASE("A picture larger than the limit is refused before memory of that size is allocated") {
  const Workplace place;
  ClipPasses passes = place.rendered();
  passes.manifest.camera.width_px = 100'000;
  passes.manifest.camera.height_px = 100'000;
  passes.manifest.supersample = 16;
  CHECK(message_of<DataError>([&] { (void)make_clip(passes, place.task(), read_materials(kAssets), {}); }) ==
        fmt::format("{}: size of the passes = 1600000 x 1600000 px; expected at most 256000000 pixels "
                    "(--max-megapixels)",
                    place.passes.string()));
}

TEST_CASE("Leftovers of an earlier run are removed") {
  const Workplace place;
  make_folder(place.clip / "ir8");
  write_file(place.clip / "ir8/000099.png", {});
  const ClipRecord record = place.make();
  CHECK_FALSE(std::filesystem::exists(place.clip / "ir8/000099.png"));
  CHECK(record.pixels_sha256 == Workplace().make().pixels_sha256);
}

namespace {

/// Tasks of three datasets that differ in everything a variant may change: season, seed, sensor. The first and the
/// third differ only in the sensor.
std::vector<ClipTask> three_tasks(const Workplace& place) {
  std::vector<ClipTask> tasks = {place.task("one"), place.task("two"), place.task("three")};
  tasks[1].clip.season = Season::summer;
  tasks[1].seed = 7;
  own_settings(tasks[2]).sensor.optics.blur_sigma_px = 0;
  own_settings(tasks[2]).sensor.agc.mode = AgcMode::plateau;
  return tasks;
}

}  // namespace

TEST_CASE("Tasks made together give the same files as each alone, with one thread or two") {
  const Workplace together;
  const Workplace alone;
  const std::vector<ClipTask> tasks = three_tasks(together);
  const std::vector<ClipRecord> records =
      with_threads(GENERATE(1, 2), [&] { return together.make_all(tasks); });
  REQUIRE(records.size() == 3);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    CAPTURE(i);
    ClipTask task = tasks[i];
    task.folder = alone.clip;
    Json expected = to_json(alone.make(task));
    Json found = to_json(records[i]);
    expected["files"].erase("preview.mp4");  // lossy, and the encoder's own
    found["files"].erase("preview.mp4");
    CHECK(found == expected);
    const Path folder = tasks[i].folder;
    CHECK(to_json(read_clip_record(folder / "clip.json")) == to_json(records[i]));
    for (const auto& [name, sum] : records[i].files) CHECK(std::filesystem::exists(folder / name));
  }
  CHECK(records[0].pixels_sha256 != records[1].pixels_sha256);
  CHECK(records[0].pixels_sha256 != records[2].pixels_sha256);
}

TEST_CASE("A frame is waited for and reported once, however many tasks there are") {
  const Workplace place;
  int waited = 0;
  int done = 0;
  ClipHooks hooks;
  hooks.wait_for_frame = [&](int frame) { CHECK(frame == waited++); };
  hooks.frame_done = [&] { ++done; };
  (void)make_clips(place.rendered(), three_tasks(place), read_materials(kAssets), hooks);
  CHECK(waited == 3);
  CHECK(done == 3);
}

TEST_CASE("With a missing frame no task's clip is complete") {
  const Workplace place;
  std::filesystem::remove(place.passes / tiny_clip::file_name(2));
  const std::vector<ClipTask> tasks = three_tasks(place);
  CHECK_THROWS_AS(place.make_all(tasks), IoError);
  for (const ClipTask& task : tasks) CHECK_FALSE(std::filesystem::exists(task.folder / "clip.json"));
}

TEST_CASE("An impossible request of a task is reported with its variant") {
  const Workplace place;
  std::vector<ClipTask> tasks = three_tasks(place);
  tasks[1].variant = "list.json: variants[1] (barrel)";
  own_settings(tasks[1]).distortion.k1 = -0.1;
  CHECK_THAT(message_of<ConfigError>([&] { (void)place.make_all(tasks); }),
             StartsWith("list.json: variants[1] (barrel): clip a: overscan_px = 0 px; expected at least "));
}

}  // namespace clip_maker_test
