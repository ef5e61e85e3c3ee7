#pragma once

#include "io/assets.h"

/// The assets of the source tree.
inline const thermal::Assets kAssets{VELDT_SOURCE_DIR};
