#pragma once

#include <clocale>

namespace thermal {

/// While it exists, libraries that this thread calls write and read numbers as C does, and take names for UTF-8,
/// whatever locale the process has.
class CLocale {
 public:
  CLocale() : locale_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(::uselocale(locale_)) {}
  ~CLocale() {
    ::uselocale(before_);
    if (locale_) ::freelocale(locale_);
  }
  CLocale(const CLocale&) = delete;
  CLocale& operator=(const CLocale&) = delete;

 private:
  locale_t locale_;
  locale_t before_;
};

}  // namespace thermal
