#pragma once

namespace veldt {

/// All that main() does. Without types of libraries, which would take main() longer to compile than all else here.
int run_program(int argc, const char* const* argv);

}  // namespace veldt
