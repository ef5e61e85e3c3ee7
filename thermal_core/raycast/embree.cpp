#include "raycast/embree.h"

#include <fmt/core.h>

#include "base/error.h"
#include "base/happens_before.h"
#include "raycast/engine_version.h"

namespace thermal {

void check_device(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw Error("Embree: not enough memory for the scene");
  throw Error(fmt::format("Embree: error {}", static_cast<int>(error)));
}

EmbreeDevice new_device() {
  const Unwatched settings;  // Embree's threads compare them in libstdc++, where no suppression finds it
  EmbreeDevice device(rtcNewDevice(nullptr));
  check_device(device.get());
  return device;
}

std::string engine_version() {
  const EmbreeDevice device = new_device();
  const auto number = [&device](RTCDeviceProperty property) {
    return rtcGetDeviceProperty(device.get(), property);
  };
  const int rays = number(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0  ? 16
                   : number(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0 ? 8
                                                                            : 4;
  return fmt::format("{}.{}.{}, {} rays at once", number(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                     number(RTC_DEVICE_PROPERTY_VERSION_MINOR), number(RTC_DEVICE_PROPERTY_VERSION_PATCH),
                     rays);
}

}  // namespace thermal
