#include "cli/command.h"
#include "cli/output.h"

int main(int argc, char** argv) {
  veldt::open_standard_streams();
  return veldt::run_command_line(argc, argv);
}
