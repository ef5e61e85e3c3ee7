#pragma once

#include <clocale>

namespace thermal {

/// While it exists, libraries called on this thread use C's number format and UTF-8 names, regardless of the process's
/// locale.
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
