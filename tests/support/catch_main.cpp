// The entry point of every test program built against Catch2 version 2. Version 3 brings its own
// (Catch2::Catch2WithMain), and this file is then left out of the build.

// GCC 12 under -fsanitize sees an uninitialised std::function inside its own <regex>, which Catch2 includes.
#ifndef __clang__  // which has no such warning
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
