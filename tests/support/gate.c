// Preloaded into a program, holds it at a moment that a test has chosen, however fast or slow the machine is: the first
// thread that is about to open, make or rename to a path which ends in $GATE_BEFORE reads from the FIFO $GATE, and so
// waits until the test closes its end. Without that FIFO, it does not wait. What the program starts is left alone.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static char *gate, *before;
static atomic_flag passed = ATOMIC_FLAG_INIT;

__attribute__((constructor)) static void begin(void) {
  const char *at = getenv("GATE"), *ends = getenv("GATE_BEFORE");
  if (at == NULL || ends == NULL) return;
  gate = strdup(at);
  before = strdup(ends);
  unsetenv("LD_PRELOAD");
}

static int is_meant(const char* path) {
  if (before == NULL || path == NULL) return 0;
  const size_t length = strlen(path), end = strlen(before);
  return length >= end && strcmp(path + length - end, before) == 0;
}

/// By system calls alone, because sanitizers and this file replace the functions. A signal's handler runs here, and the
/// wait goes on.
static void pass(const char* path) {
  if (!is_meant(path) || atomic_flag_test_and_set(&passed)) return;
  const int error = errno;
  long fifo;
  do {
    fifo = syscall(SYS_openat, AT_FDCWD, gate, O_RDONLY | O_CLOEXEC, 0);
  } while (fifo < 0 && errno == EINTR);
  char none;
  while (fifo >= 0 && syscall(SYS_read, fifo, &none, 1) < 0 && errno == EINTR) continue;
  if (fifo >= 0) syscall(SYS_close, fifo);
  errno = error;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

#define OPEN(name, given, ...)                       \
  int name(given const char* path, int flags, ...) { \
    va_list more;                                    \
    va_start(more, flags);                           \
    const mode_t mode = va_arg(more, mode_t);        \
    va_end(more);                                    \
    pass(path);                                      \
    return REAL(name)(__VA_ARGS__, flags, mode);     \
  }
#define IN_FOLDER int folder,
#define NOWHERE
OPEN(open, NOWHERE, path)
OPEN(open64, NOWHERE, path)
OPEN(openat, IN_FOLDER, folder, path)
OPEN(openat64, IN_FOLDER, folder, path)

#define FOPEN(name)                               \
  FILE* name(const char* path, const char* how) { \
    pass(path);                                   \
    return REAL(name)(path, how);                 \
  }
FOPEN(fopen)
FOPEN(fopen64)

int mkdir(const char* path, mode_t mode) {
  pass(path);
  return REAL(mkdir)(path, mode);
}

int rename(const char* from, const char* to) {
  pass(to);
  return REAL(rename)(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  pass(to);
  return REAL(renameat2)(from_folder, from, to_folder, to, flags);
}
