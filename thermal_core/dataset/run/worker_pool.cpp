#include "dataset/run/worker_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "base/parallel.h"

namespace thermal {
namespace {

/// Threads that all stop when the first of them throws.
class WorkerPool {
 public:
  WorkerPool(const ClipWork& work, const std::function<bool()>& cancelled)
      : work_(work), stop_wanted_([this, &cancelled] { return failed_ || (cancelled && cancelled()); }) {}

  void run(const std::vector<RenderJob::Task>& tasks) {
    {
      std::vector<std::jthread> threads;
      for (const RenderJob::Task& task : tasks) threads.emplace_back([this, &task] { run_guarded(task); });
    }
    if (first_fault_) std::rethrow_exception(first_fault_);
  }

 private:
  void run_guarded(const RenderJob::Task& task) noexcept {
    try {
      RenderJob job(task);
      for (const std::string& clip : task.clips) work_(clip, job, stop_wanted_);
      job.wait_for_end(stop_wanted_);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_fault_) first_fault_ = std::current_exception();
      failed_ = true;
    }
  }

  const ClipWork& work_;
  std::function<bool()> stop_wanted_;
  std::mutex mutex_;
  std::exception_ptr first_fault_;
  std::atomic<bool> failed_ = false;
};

}  // namespace

std::vector<std::vector<std::string>> deal_clips(const std::vector<std::string>& clips, int jobs) {
  const std::size_t hands = std::min(static_cast<std::size_t>(jobs), clips.size());
  std::vector<std::vector<std::string>> dealt(hands);
  for (std::size_t i = 0; i < clips.size(); ++i) dealt[i % hands].push_back(clips[i]);
  return dealt;
}

int threads_each(int threads, int jobs) { return std::max(1, threads / jobs); }

void run_workers(const std::vector<RenderJob::Task>& tasks, int threads, const ClipWork& work,
                 const std::function<bool()>& cancelled) {
  const int share = threads == 0 ? thread_count(0) : threads_each(threads, static_cast<int>(tasks.size()));
  const ClipWork limited = [&](const std::string& clip, RenderJob& job, const std::function<bool()>& stop) {
    with_threads(share, [&] { work(clip, job, stop); });
  };
  WorkerPool(limited, cancelled).run(tasks);
}

}  // namespace thermal
