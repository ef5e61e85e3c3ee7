#include <cstdio>
#include <exception>

#include "cli/manual/write_manual.h"

/// Usage: veldt_manual FOLDER; a build step.
int main(int argc, char** argv) {
  if (argc != 2) {
    (void)std::fputs("usage: veldt_manual FOLDER\n", stderr);
    return 1;
  }
  try {
    veldt::write_manual(argv[1]);
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "veldt_manual: %s\n", error.what());
    return 1;
  }
  return 0;
}
