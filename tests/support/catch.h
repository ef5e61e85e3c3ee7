#pragma once

/// One spelling of Catch2 for every test, whether version 2 (Debian 12) or version 3 (Debian 13 and later)
/// is installed. Tests include this header alone and write the matchers unqualified, with version 3's names.

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>

using Catch::Matchers::ContainsSubstring;
#else
#include <string>

#include <catch2/catch.hpp>

// Version 2 names this one Contains, which there also matches elements of a vector.
// NOLINTNEXTLINE(readability-identifier-naming): version 3's name
inline auto ContainsSubstring(const std::string& substring) { return Catch::Matchers::Contains(substring); }
#endif

// Global on purpose: test files are not included elsewhere, and `CHECK_THAT(x, WithinRel(y, tolerance))` reads best
// unqualified.
// NOLINTBEGIN(google-global-names-in-headers)
using Catch::Matchers::EndsWith;
using Catch::Matchers::Equals;
using Catch::Matchers::Message;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Catch::Matchers::WithinULP;
// NOLINTEND(google-global-names-in-headers)
