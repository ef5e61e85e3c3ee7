#include "cli/command.h"

int main(int argc, char** argv) { return veldt::run_command_line(argc, argv); }
