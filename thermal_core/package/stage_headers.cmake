# Copies the public headers of the libraries in `floors` from `source` to `staged`. `#include "base/error.h"` becomes
# `#include <veldt/base/error.h>` there, so that nothing as common as base/ gets on the include path of a user.
# `left_out` names headers and folders, or how their names begin.
file(REMOVE_RECURSE ${staged})
list(JOIN left_out "|" left_out)
foreach(floor IN LISTS floors)
  file(GLOB_RECURSE headers RELATIVE ${source} ${source}/${floor}/*.h)
  list(FILTER headers EXCLUDE REGEX "^(${left_out})")
  foreach(header IN LISTS headers)
    file(READ ${source}/${header} text)
    string(REGEX REPLACE "#include \"([^\"]+)\"" "#include <veldt/\\1>" text "${text}")
    file(WRITE ${staged}/${header} "${text}")
  endforeach()
endforeach()
