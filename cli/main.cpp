#include "cli/command.h"
#include "cli/output.h"
#include "io/video/h264_file.h"

int main(int argc, char** argv) {
  veldt::open_standard_streams();
  thermal::silence_ffmpeg();
  return veldt::run_command_line(argc, argv);
}
