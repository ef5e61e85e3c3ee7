#include "cli/program.h"

#include <cstdio>
#include <new>

#include "cli/command.h"
#include "cli/output.h"
#include "io/video/h264_file.h"

namespace veldt {

int run_program(int argc, const char* const* argv) {
  open_standard_streams();
  thermal::silence_ffmpeg();
  try {
    return run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    (void)std::fputs("veldt: out of memory; try again with more, or with fewer --threads\n", stderr);
    return kTryAgain;
  }
}

}  // namespace veldt
