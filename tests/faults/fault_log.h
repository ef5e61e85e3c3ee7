// What the preloaded libraries share: their orders, in variables, and the log of what they injected.
#pragma once

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

static const char* log_file;

/// Whether FAULT_PROGRAM names this process, or none.
static inline int is_meant(void) {
  const char* program = getenv("FAULT_PROGRAM");
  log_file = getenv("FAULT_LOG");
  return program == NULL || strcmp(program, program_invocation_short_name) == 0;
}

static inline long number(const char* name, long otherwise) {
  const char* text = getenv(name);
  return text != NULL ? strtol(text, NULL, 10) : otherwise;
}

/// By system calls alone, because the functions of the library are replaced here.
static inline void note(const char* call, const char* path) {
  if (log_file == NULL) return;
  const int before = errno;
  char line[PATH_MAX + 128];
  const int length =
      snprintf(line, sizeof line, "%s %d %s %s\n", program_invocation_short_name, (int)getpid(), call, path);
  const long file = syscall(SYS_openat, AT_FDCWD, log_file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file >= 0 && length > 0) syscall(SYS_write, file, line, (size_t)length);
  if (file >= 0) syscall(SYS_close, file);
  errno = before;
}
