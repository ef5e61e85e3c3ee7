// Preloaded into a program, makes chosen calls on files below a folder fail.
// Variables, all optional but the first two:
//   FAULT_UNDER    folder, absolute: calls on other files are left alone
//   FAULT_LOG      file that gets a line for each injected fault: program, process, call, path
//   FAULT_PROGRAM  only in the process of this name
//   FAULT_CALL     kind of call that is counted, such as write, or any
//   FAULT_AT       the call of this number fails, and the next ones, FAULT_COUNT in all
//   FAULT_ERROR    with this errno
//   FAULT_SHORT    instead of failing, write() writes and read() reads less
//   FAULT_SIGNAL   instead of failing, the process gets this signal
//   FAULT_BYTES    after so many written bytes, every write fails because the disk is full
//   FAULT_TALLY    inject nothing; log all calls
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <sys/stat.h>

#include "fault_log.h"

enum { kMostFiles = 65536 };
enum verdict { kPass, kFail, kShorten };

static const char* under;
static const char* chosen_call;
static long at, count, error_number, shorten, signal_number, most_bytes, tally;
static atomic_long calls, written_bytes;
static atomic_uchar watched[kMostFiles];

__attribute__((constructor)) static void begin(void) {
  if (!is_meant()) return;
  chosen_call = getenv("FAULT_CALL");
  at = number("FAULT_AT", 0);
  count = number("FAULT_COUNT", 1);
  error_number = number("FAULT_ERROR", EIO);
  shorten = number("FAULT_SHORT", 0);
  signal_number = number("FAULT_SIGNAL", 0);
  most_bytes = number("FAULT_BYTES", -1);
  tally = number("FAULT_TALLY", 0);
  under = getenv("FAULT_UNDER");
}

static int is_below(const char* path) {
  const size_t length = strlen(under);
  return strncmp(path, under, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

/// The path of a file in a folder that may be open, or "".
static void resolve(int folder, const char* path, char* resolved) {
  char start[PATH_MAX] = "";
  resolved[0] = '\0';
  if (path == NULL) return;
  if (path[0] != '/') {
    char link[64];
    snprintf(link, sizeof link, folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/%d", folder);
    const long length = syscall(SYS_readlinkat, AT_FDCWD, link, start, sizeof start - 1);
    start[length > 0 ? length : 0] = '\0';
  }
  if (strlen(start) + strlen(path) + 2 < PATH_MAX)
    sprintf(resolved, "%s%s%s", start, *start ? "/" : "", path);
}

static enum verdict judge(const char* call, const char* path) {
  if (tally) note(call, path);
  if (at == 0 || chosen_call == NULL || (strcmp(chosen_call, call) != 0 && strcmp(chosen_call, "any") != 0))
    return kPass;
  const long number_of_call = atomic_fetch_add(&calls, 1) + 1;
  if (number_of_call < at || number_of_call >= at + count) return kPass;
  note(call, path);
  if (signal_number != 0) {
    kill(getpid(), (int)signal_number);
    return kPass;
  }
  if (shorten) return kShorten;
  errno = (int)error_number;
  return kFail;
}

static enum verdict judge_path(const char* call, int folder, const char* path) {
  if (under == NULL) return kPass;
  char resolved[PATH_MAX];
  resolve(folder, path, resolved);
  return is_below(resolved) ? judge(call, resolved) : kPass;
}

static enum verdict judge_file(const char* call, int file) {
  if (under == NULL || file < 0 || file >= kMostFiles || !atomic_load(&watched[file])) return kPass;
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const long length = syscall(SYS_readlinkat, AT_FDCWD, link, path, sizeof path - 1);
  path[length > 0 ? length : 0] = '\0';
  return judge(call, path);
}

/// Of a write, which may also be one too many for the disk.
static enum verdict judge_write(int file, size_t bytes) {
  const enum verdict verdict = judge_file("write", file);
  if (verdict == kFail || most_bytes < 0 || file < 0 || file >= kMostFiles || !atomic_load(&watched[file]))
    return verdict;
  if (atomic_fetch_add(&written_bytes, (long)bytes) + (long)bytes <= most_bytes) return verdict;
  note("full", "");
  errno = ENOSPC;
  return kFail;
}

static int watch(int folder, const char* path, int file) {
  if (under == NULL || file < 0 || file >= kMostFiles) return file;
  char resolved[PATH_MAX];
  resolve(folder, path, resolved);
  atomic_store(&watched[file], is_below(resolved));
  return file;
}

static void forget(int file) {
  if (file >= 0 && file < kMostFiles) atomic_store(&watched[file], 0);
}

#define REAL(name)                                                       \
  ({                                                                     \
    static __typeof__(&name) real;                                       \
    if (real == NULL) real = (__typeof__(&name))dlsym(RTLD_NEXT, #name); \
    real;                                                                \
  })

#define MODE(flags)                                                                 \
  ({                                                                                \
    va_list more;                                                                   \
    va_start(more, flags);                                                          \
    const mode_t mode = (flags) & (O_CREAT | O_TMPFILE) ? va_arg(more, mode_t) : 0; \
    va_end(more);                                                                   \
    mode;                                                                           \
  })

#define OPEN(name)                                               \
  int name(const char* path, int flags, ...) {                   \
    const mode_t mode = MODE(flags);                             \
    if (judge_path("open", AT_FDCWD, path) == kFail) return -1;  \
    return watch(AT_FDCWD, path, REAL(name)(path, flags, mode)); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                   \
  int name(int folder, const char* path, int flags, ...) {             \
    const mode_t mode = MODE(flags);                                   \
    if (judge_path("open", folder, path) == kFail) return -1;          \
    return watch(folder, path, REAL(name)(folder, path, flags, mode)); \
  }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                               \
  FILE* name(const char* path, const char* how) {                 \
    if (judge_path("open", AT_FDCWD, path) == kFail) return NULL; \
    FILE* file = REAL(name)(path, how);                           \
    if (file != NULL) watch(AT_FDCWD, path, fileno(file));        \
    return file;                                                  \
  }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int file, const void* from, size_t bytes) {
  const enum verdict verdict = judge_write(file, bytes);
  if (verdict == kFail) return -1;
  return REAL(write)(file, from, verdict == kShorten && bytes > 1 ? bytes / 2 : bytes);
}

ssize_t read(int file, void* to, size_t bytes) {
  const enum verdict verdict = judge_file("read", file);
  if (verdict == kFail) return -1;
  return REAL(read)(file, to, verdict == kShorten && bytes > 1 ? bytes / 2 : bytes);
}

size_t fwrite(const void* from, size_t size, size_t items, FILE* file) {
  if (judge_write(fileno(file), size * items) == kFail) return 0;
  return REAL(fwrite)(from, size, items, file);
}

size_t fread(void* to, size_t size, size_t items, FILE* file) {
  if (judge_file("read", fileno(file)) == kFail) return 0;
  return REAL(fread)(to, size, items, file);
}

int fflush(FILE* file) {
  if (file != NULL && judge_file("flush", fileno(file)) == kFail) return EOF;
  return REAL(fflush)(file);
}

/// A failed close has closed all the same.
#define CLOSE(name, kind, number_of, failed)                     \
  int name(kind file) {                                          \
    const enum verdict verdict = judge_file("close", number_of); \
    const int error = errno;                                     \
    forget(number_of);                                           \
    const int result = REAL(name)(file);                         \
    if (verdict != kFail) return result;                         \
    errno = error;                                               \
    return failed;                                               \
  }
CLOSE(close, int, file, -1)
CLOSE(fclose, FILE*, fileno(file), EOF)

int fsync(int file) { return judge_file("fsync", file) == kFail ? -1 : REAL(fsync)(file); }

int rename(const char* from, const char* to) {
  return judge_path("rename", AT_FDCWD, to) == kFail ? -1 : REAL(rename)(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  return judge_path("rename", to_folder, to) == kFail
             ? -1
             : REAL(renameat2)(from_folder, from, to_folder, to, flags);
}

int mkdir(const char* path, mode_t mode) {
  return judge_path("mkdir", AT_FDCWD, path) == kFail ? -1 : REAL(mkdir)(path, mode);
}

int unlink(const char* path) {
  return judge_path("unlink", AT_FDCWD, path) == kFail ? -1 : REAL(unlink)(path);
}

int unlinkat(int folder, const char* path, int flags) {
  return judge_path("unlink", folder, path) == kFail ? -1 : REAL(unlinkat)(folder, path, flags);
}

int link(const char* from, const char* to) {
  return judge_path("link", AT_FDCWD, to) == kFail ? -1 : REAL(link)(from, to);
}

#define LOCK(name)                                                                                \
  int name(int file, int command, ...) {                                                          \
    va_list more;                                                                                 \
    va_start(more, command);                                                                      \
    void* argument = va_arg(more, void*);                                                         \
    va_end(more);                                                                                 \
    const int locks = command == F_OFD_SETLK || command == F_OFD_SETLKW;                          \
    return locks && judge_file("lock", file) == kFail ? -1 : REAL(name)(file, command, argument); \
  }
LOCK(fcntl)
LOCK(fcntl64)
