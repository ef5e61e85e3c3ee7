#include <atomic>
#include <set>

#include "dataset/run/render_job.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace worker_pool_test {

using namespace thermal;

namespace {

using Hands = std::vector<std::vector<std::string>>;

/// A Blender that reports its scene as built, and waits.
std::vector<RenderJob::Task> idle_tasks(const TestFolder& folder, const Hands& hands) {
  const Path program =
      folder.file("blender", "#!/bin/sh\necho '{\"event\": \"scene_built\"}' >&3; exec sleep 3600\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  std::vector<RenderJob::Task> tasks;
  for (const auto& hand : hands)
    tasks.push_back({.blender = program,
                     .assets = Assets(folder.path()),
                     .plan = {},
                     .passes = folder.path(),
                     .log = folder / (hand.front() + ".log"),
                     .clips = hand,
                     .threads = 0,
                     .preview = false,
                     .restarted = {}});
  return tasks;
}

}  // namespace

TEST_CASE("Clips are distributed in turns, and every Blender gets one") {
  const std::vector<std::string> clips = {"a", "b", "c", "d", "e"};
  CHECK(deal_clips(clips, 1) == Hands{clips});
  CHECK(deal_clips(clips, 2) == Hands{{"a", "c", "e"}, {"b", "d"}});
  CHECK(deal_clips({"a", "b"}, 9) == Hands{{"a"}, {"b"}});
  CHECK(deal_clips({}, 3).empty());
}

TEST_CASE("Blender processes share the threads, and each has at least one") {
  CHECK(threads_each(3, 1) == 3);
  CHECK(threads_each(8, 2) == 4);
  CHECK(threads_each(8, 3) == 2);
  CHECK(threads_each(2, 4) == 1);
}

TEST_CASE("An exception in one task stops all, and is the one that is thrown") {
  const TestFolder folder;
  std::atomic<int> stopped = 0;
  const ClipWork work = [&](const std::string& clip, RenderJob& job, const std::function<bool()>& cancelled) {
    if (clip == "b") throw DataError("of b");
    try {
      job.wait_for_frame(clip, 0, cancelled);
    } catch (const Cancelled&) {
      ++stopped;
      throw;
    }
  };
  CHECK(message_of<DataError>([&] {
          run_workers(idle_tasks(folder, {{"a"}, {"b"}, {"c"}}), 0, work, {});
        }) == "of b");
  CHECK(stopped == 2);
}

TEST_CASE("All tasks stop on request") {
  const TestFolder folder;
  const ClipWork work = [](const std::string& clip, RenderJob& job, const std::function<bool()>& cancelled) {
    job.wait_for_frame(clip, 0, cancelled);
  };
  CHECK_THROWS_AS(run_workers(idle_tasks(folder, {{"a"}, {"b"}}), 0, work, [] { return true; }), Cancelled);
}

}  // namespace worker_pool_test
