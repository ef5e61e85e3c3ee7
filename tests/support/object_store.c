// Preloaded into a program, makes folders below $OBJECT_STORE behave like a mounted object store: whole new files
// only. Nothing is renamed, linked or locked, no file is changed once it was closed.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static int is_below(const char* path) {
  const char* store = getenv("OBJECT_STORE");
  return store != NULL && strncmp(path, store, strlen(store)) == 0;
}

static int refuse(int error) {
  errno = error;
  return -1;
}

static int is_new_file(const char* path, int flags) {
  return (flags & O_ACCMODE) == O_WRONLY && (flags & O_APPEND) == 0 && access(path, F_OK) != 0;
}

static int may_open(const char* path, int flags) {
  return !is_below(path) || (flags & (O_ACCMODE | O_CREAT)) == O_RDONLY || is_new_file(path, flags);
}

#define OPEN(name)                                                               \
  int name(const char* path, int flags, ...) {                                   \
    va_list more;                                                                \
    va_start(more, flags);                                                       \
    const mode_t mode = va_arg(more, mode_t);                                    \
    va_end(more);                                                                \
    int (*real)(const char*, int, ...) = dlsym(RTLD_NEXT, #name);                \
    return may_open(path, flags) ? real(path, flags, mode) : refuse(EOPNOTSUPP); \
  }
OPEN(open)
OPEN(open64)

int rename(const char* from, const char* to) {
  int (*real)(const char*, const char*) = dlsym(RTLD_NEXT, "rename");
  return is_below(from) || is_below(to) ? refuse(ENOSYS) : real(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  int (*real)(int, const char*, int, const char*, unsigned) = dlsym(RTLD_NEXT, "renameat2");
  return is_below(from) || is_below(to) ? refuse(ENOSYS) : real(from_folder, from, to_folder, to, flags);
}

int link(const char* from, const char* to) {
  int (*real)(const char*, const char*) = dlsym(RTLD_NEXT, "link");
  return is_below(to) ? refuse(ENOSYS) : real(from, to);
}
