#include "dataset/clip/frame_faults.h"

#include "io/config/materials.h"
#include "io/manifest_file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/test_folder.h"
#include "support/tiny_clip.h"

namespace frame_faults_test {

using namespace thermal;

TEST_CASE("A fault's message is reported without the file's name at its start") {
  CHECK(without_name("cannot read one/1.exr: no such file", "one/1.exr") == "no such file");
  CHECK(without_name("one/1.exr: size = 1 x 2 px", "one/1.exr") == "size = 1 x 2 px");
  CHECK(without_name("one/1.exr is bad", "one/1.exr") == "one/1.exr is bad");
  CHECK(without_name("bad: one/1.exr: worse", "one/1.exr") == "bad: one/1.exr: worse");
}

TEST_CASE("A clip without any good frame is reported with its first fault and the number of others") {
  CHECK(no_frame_left("a: bad", 1) == "a: bad");
  CHECK(no_frame_left("a: bad", 2) == "a: bad; its 1 other frame cannot be converted either");
  CHECK(no_frame_left("a: bad", 9) == "a: bad; its 8 other frames cannot be converted either");
}

TEST_CASE("A clip can be remade once any of its skipped frames can be converted") {
  const TestFolder folder;
  const Path passes = tiny_clip::write(folder / "passes", "a");
  const ClipPasses clip = {.manifest = read_manifest(passes / "manifest.json", kAssets), .folder = passes};
  const MaterialLibrary materials = read_materials(kAssets);
  const auto can = [&](std::initializer_list<int> frames) {
    std::vector<SkippedFrame> skipped;
    for (const int frame : frames) skipped.push_back({.frame_index = frame, .file = "", .reason = ""});
    ClipTask task;
    task.clip.id = "a";
    return can_be_mended(clip, task, materials, skipped);
  };
  CHECK(can({1}));
  std::filesystem::remove(passes / tiny_clip::file_name(0));
  ExrChannels planes = tiny_clip::planes(1);
  planes.at("Scene.IndexOB.X")[41] = 99;  // readable, but not convertible
  write_exr(passes / tiny_clip::file_name(1), tiny_clip::kWidth, tiny_clip::kHeight, planes);
  CHECK_FALSE(can({0, 1}));
  CHECK(can({0, 1, 2}));
  CHECK_FALSE(can({-1, 3, 2147483647}));  // a record written by hand
}

}  // namespace frame_faults_test
