#pragma once

#if defined(VELDT_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
extern "C" {  // in its library, but in no header
void AnnotateIgnoreWritesBegin(const char* file, int line);
void AnnotateIgnoreWritesEnd(const char* file, int line);
}
#endif

namespace thermal {

/// Declares to ThreadSanitizer a happens-before order that TBB guarantees: everything before give() happens before
/// everything after a later take(). ThreadSanitizer cannot see that order, because Debian's libtbb is compiled without
/// it. Sources that include TBB's algorithms are compiled without it too, as it would report TBB's own accesses to
/// tasks that move between threads; what these sources call is checked. Does nothing in other builds.
class HappensBefore {
 public:
#if defined(VELDT_THREAD_SANITIZER)
  void give() noexcept { __tsan_release(this); }
  void take() noexcept { __tsan_acquire(this); }
#else
  void give() noexcept {}
  void take() noexcept {}
#endif
};

/// Calls take() when constructed and give() when destroyed.
class Turn {
 public:
  explicit Turn(HappensBefore& order) noexcept : order_(order) { order_.take(); }
  ~Turn() { order_.give(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  HappensBefore& order_;
};

/// Work that one thread divides into unordered parts and waits for, also when a part throws.
class DividedWork {
 public:
  DividedWork() noexcept { begin_.give(); }
  ~DividedWork() { end_.take(); }
  DividedWork(const DividedWork&) = delete;
  DividedWork& operator=(const DividedWork&) = delete;

  class Part {
   public:
    explicit Part(DividedWork& work) noexcept : work_(work) { work_.begin_.take(); }
    ~Part() { work_.end_.give(); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    DividedWork& work_;
  };

 private:
  HappensBefore begin_;
  HappensBefore end_;
};

/// While it exists, ThreadSanitizer ignores what this thread writes: for calls of a library whose own threads read that
/// in an order that ThreadSanitizer cannot see.
class Unwatched {
 public:
  Unwatched() noexcept { begin(); }
  ~Unwatched() { end(); }
  Unwatched(const Unwatched&) = delete;
  Unwatched& operator=(const Unwatched&) = delete;

 private:
#if defined(VELDT_THREAD_SANITIZER)
  static void begin() noexcept { AnnotateIgnoreWritesBegin(__FILE__, __LINE__); }
  static void end() noexcept { AnnotateIgnoreWritesEnd(__FILE__, __LINE__); }
#else
  static void begin() noexcept {}
  static void end() noexcept {}
#endif
};

}  // namespace thermal
