#pragma once

#include <array>
#include <csetjmp>
#include <type_traits>

#include <png.h>

namespace thermal {

/// libpng's message when it failed. A pointer to it is libpng's "error pointer".
struct PngFault {
  std::array<char, 128> words{};
};

/// libpng's error function: keeps the message, and jumps back to png_calls().
[[noreturn]] inline void give_up(png_structp png, png_const_charp words) {
  auto& kept = static_cast<PngFault*>(png_get_error_ptr(png))->words;
  std::size_t length = 0;
  for (; words[length] != '\0' && length + 1 < kept.size(); ++length) kept[length] = words[length];
  kept[length] = '\0';
  png_longjmp(png, 1);
}

/// libpng's warning function: nothing below cli prints.
inline void say_nothing(png_structp /*png*/, png_const_charp /*words*/) {}

/// Calls libpng; false if it failed. It jumps over all frames in between, whose objects are not destroyed: `calls`
/// and libpng's callbacks must not own anything when they call libpng, and must not throw.
template <typename Calls>
[[nodiscard]] bool png_calls(png_structp png, const Calls& calls) {
  static_assert(std::is_trivially_destructible_v<Calls>);
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's only way
  calls();
  return true;
}

}  // namespace thermal
