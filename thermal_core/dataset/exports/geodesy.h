#pragma once

#include <array>

#include "io/image/pictures.h"

namespace thermal {

/// Local axes of a scene or of a position on Earth: east, north, up.
using LocalVector = std::array<double, 3>;

/// Georeferences a scene: its plane z = 0 is tangent to the WGS 84 ellipsoid, raised by the origin's height, at its (0,
/// 0). Positions are exact, through Earth-centred coordinates, and not a local approximation: the inverse is within
/// 1e-6 m up to 100 km away and 10 km up.
class Georeference {
 public:
  /// @param origin  of latitude within -89 to 89 deg: at a pole, east is undefined
  explicit Georeference(const GeoPosition& origin);

  /// Position of a point [m] of the scene. Iterates Bowring's equation (Survey Review 23, 323, 1976) twice.
  [[nodiscard]] GeoPosition position_of(const LocalVector& point_m) const;

  /// The point [m] of the scene at a position: exact, in closed form.
  [[nodiscard]] LocalVector point_at(const GeoPosition& position) const;

  /// A direction of the scene in the local axes of another position: at a distance d they differ by d / 6370 km.
  [[nodiscard]] LocalVector direction_at(const GeoPosition& geo_position, const LocalVector& direction) const;

 private:
  GeoPosition origin_;
  std::array<LocalVector, 3> axes_;  ///< east, north, up in Earth-centred axes
  LocalVector earth_m_;              ///< the origin, Earth-centred
};

/// Attitude of a camera in photogrammetric convention [deg]: yaw clockwise from north of the picture's top, for a
/// camera that looks down; pitch 0 straight down, 90 at the horizon ahead; roll positive with the right side down.
struct CameraAttitude {
  double yaw_deg = 0;  ///< 0 to 360
  double pitch_deg = 0;
  double roll_deg = 0;
};

/// Attitude of a camera whose axes (x right, y down, z forward, as in OpenCV) have these directions in east, north, up.
/// The angles turn a body whose front is the picture's top and whose down is the view: yaw about down, then pitch about
/// right, then roll about front. At the horizon, where yaw and roll turn alike, roll is 0.
[[nodiscard]] CameraAttitude attitude_of(const LocalVector& right, const LocalVector& down,
                                         const LocalVector& forward) noexcept;

}  // namespace thermal
