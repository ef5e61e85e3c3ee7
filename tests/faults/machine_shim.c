// Preloaded into a program, makes allocations fail or the clock jump. Variables, all optional but FAULT_LOG:
//   FAULT_LOG      file that gets a line for each injected fault: program, process, call
//   FAULT_PROGRAM  only in the process of this name
//   FAULT_MALLOC   the allocation of this number fails, and the next ones, FAULT_COUNT in all
//   FAULT_LEAST    allocations of fewer bytes are not counted and do not fail
//   FAULT_CLOCK    days by which the clock jumps forth and back
// Where memory fails, a crash is logged with the library that caused it.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/time.h>
#include <time.h>

#include "fault_log.h"

static long malloc_at, count, least_bytes, clock_days;
static atomic_long allocations, clock_reads;

enum { MOST_FRAMES = 32 };

static const char* file_name(const char* path) {
  const char* slash = strrchr(path, '/');
  return slash != NULL ? slash + 1 : path;
}

/// Logs the innermost file on the stack that is neither the C library nor this one. The default action follows.
static void log_crash(int signal_number) {
  (void)signal_number;
  void* frames[MOST_FRAMES];
  const int depth = backtrace(frames, MOST_FRAMES);
  Dl_info own, here;
  if (dladdr((void*)log_crash, &own) == 0) return;
  for (int i = 0; i < depth; i++) {
    if (dladdr(frames[i], &here) == 0 || here.dli_fbase == own.dli_fbase) continue;
    if (strncmp(file_name(here.dli_fname), "libc.so", 7) == 0) continue;
    note("crash", file_name(here.dli_fname));
    return;
  }
}

static void watch_for_crashes(void) {
  void* frame;
  backtrace(&frame, 1);  // loads what it needs, which allocates
  const struct sigaction action = {.sa_handler = log_crash, .sa_flags = (int)SA_RESETHAND};
  sigaction(SIGSEGV, &action, NULL);
}

__attribute__((constructor)) static void begin(void) {
  if (!is_meant()) return;
  if (getenv("FAULT_MALLOC") != NULL) watch_for_crashes();
  least_bytes = number("FAULT_LEAST", 1);
  count = number("FAULT_COUNT", 1);
  malloc_at = number("FAULT_MALLOC", 0);
  clock_days = number("FAULT_CLOCK", 0);
}

extern void* __libc_malloc(size_t bytes);
extern void* __libc_calloc(size_t items, size_t bytes);
extern void* __libc_realloc(void* old, size_t bytes);
extern void* __libc_memalign(size_t alignment, size_t bytes);

static int is_denied(size_t bytes) {
  if (malloc_at == 0 || (long)bytes < least_bytes) return 0;
  const long number_of_call = atomic_fetch_add(&allocations, 1) + 1;
  if (number_of_call < malloc_at || number_of_call >= malloc_at + count) return 0;
  note("malloc", "");
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t bytes) { return is_denied(bytes) ? NULL : __libc_malloc(bytes); }
void* calloc(size_t items, size_t bytes) {
  return is_denied(items * bytes) ? NULL : __libc_calloc(items, bytes);
}
void* realloc(void* old, size_t bytes) { return is_denied(bytes) ? NULL : __libc_realloc(old, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) {
  return is_denied(bytes) ? NULL : __libc_memalign(alignment, bytes);
}
int posix_memalign(void** to, size_t alignment, size_t bytes) {
  if (is_denied(bytes)) return ENOMEM;
  *to = __libc_memalign(alignment, bytes);
  return *to != NULL ? 0 : ENOMEM;
}

/// Seconds by which the clock is wrong at its next reading: back, right, forth, and so on.
static time_t shift_s(void) {
  if (clock_days == 0) return 0;
  const long reading = atomic_fetch_add(&clock_reads, 1);
  if (reading < 3) note("clock", "");
  return (reading % 3 - 1) * clock_days * 86400;
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int result = (int)syscall(SYS_clock_gettime, clock, now);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec += shift_s();
  return result;
}

int gettimeofday(struct timeval* restrict now, void* restrict zone) {
  const int result = (int)syscall(SYS_gettimeofday, now, zone);
  if (result == 0) now->tv_sec += shift_s();
  return result;
}

time_t time(time_t* to) {
  const time_t now = (time_t)syscall(SYS_time, NULL) + shift_s();
  if (to != NULL) *to = now;
  return now;
}
