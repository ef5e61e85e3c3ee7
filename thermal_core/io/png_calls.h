#pragma once

#include <array>
#include <csetjmp>
#include <type_traits>

#include <png.h>

namespace thermal {

/// What libpng said when it gave up. Its place is libpng's "error pointer".
struct PngFault {
  std::array<char, 128> words{};
};

/// libpng's error function: keeps its words, and leaves by a jump to png_calls().
[[noreturn]] inline void give_up(png_structp png, png_const_charp words) {
  auto& kept = static_cast<PngFault*>(png_get_error_ptr(png))->words;
  std::size_t length = 0;
  for (; words[length] != '\0' && length + 1 < kept.size(); ++length) kept[length] = words[length];
  kept[length] = '\0';
  png_longjmp(png, 1);
}

/// libpng's warning function: nothing below cli prints.
inline void say_nothing(png_structp /*png*/, png_const_charp /*words*/) {}

/// Calls libpng; false if it gave up. It jumps over all frames in between, whose objects are not destroyed: `calls`
/// and what libpng calls back may own nothing when they call libpng, and throw nothing.
template <typename Calls>
[[nodiscard]] bool png_calls(png_structp png, const Calls& calls) {
  static_assert(std::is_trivially_destructible_v<Calls>);
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's only way
  calls();
  return true;
}

}  // namespace thermal
