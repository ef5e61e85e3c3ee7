#pragma once

namespace veldt {

/// The body of main(). Without types of libraries, which would make main() slow to compile.
int run_program(int argc, const char* const* argv);

}  // namespace veldt
