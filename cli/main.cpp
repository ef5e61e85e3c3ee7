#include "cli/program.h"

int main(int argc, char** argv) { return veldt::run_program(argc, argv); }
