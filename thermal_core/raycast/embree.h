#pragma once

// The only file that depends on Embree's version: 3 in Debian 12, 4 in Debian 13.

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>

#if VELDT_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace thermal {

template <auto Release>
struct EmbreeRelease {
  template <typename Handle>
  void operator()(Handle* handle) const noexcept {
    Release(handle);
  }
};
template <typename Handle, auto Release>
using EmbreeHandle = std::unique_ptr<std::remove_pointer_t<Handle>, EmbreeRelease<Release>>;

using EmbreeDevice = EmbreeHandle<RTCDevice, rtcReleaseDevice>;
using EmbreeScene = EmbreeHandle<RTCScene, rtcReleaseScene>;
using EmbreeGeometry = EmbreeHandle<RTCGeometry, rtcReleaseGeometry>;

/// Error if a call on this device, or one before a device exists, has failed on this thread.
void check_device(RTCDevice device);

/// Uses the largest vectors of this processor. Error if Embree cannot run on it.
[[nodiscard]] EmbreeDevice new_device();

/// Rays that are traced together: a tenth faster than 8.
inline constexpr std::size_t kPacketRays = 16;
using RayPacket = RTCRayHit16;                    ///< aligned to 64 bytes
using PacketMask = std::array<int, kPacketRays>;  ///< aligned like a packet; -1: trace this ray, 0: do not

/// The context that Embree passes to filter functions.
#if VELDT_EMBREE == 3
using EmbreeContext = RTCIntersectContext;
#else
using EmbreeContext = RTCRayQueryContext;
#endif

/// For packets of nearly parallel rays.
inline EmbreeContext coherent_rays() noexcept {
  EmbreeContext context{};
#if VELDT_EMBREE == 3
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#else
  rtcInitRayQueryContext(&context);
#endif
  return context;
}

/// For packets of diverging rays.
inline EmbreeContext scattered_rays() noexcept {
  EmbreeContext context{};
#if VELDT_EMBREE == 3
  rtcInitIntersectContext(&context);
#else
  rtcInitRayQueryContext(&context);
#endif
  return context;
}

/// Finds the first triangle between tnear and tfar of each ray that filter functions accept, and sets tfar to where it
/// is hit.
inline void find_nearest(RTCScene scene, const PacketMask& mask, EmbreeContext& context,
                         RayPacket& rays) noexcept {
#if VELDT_EMBREE == 3
  rtcIntersect16(mask.data(), scene, &context, &rays);
#else
  RTCIntersectArguments arguments{};
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  arguments.context = &context;
  rtcIntersect16(mask.data(), scene, &rays, &arguments);
#endif
}

/// Sets tfar of each ray to minus infinity if anything is between its tnear and tfar. No filter function is called.
/// Rays are traced one by one, in half of the time among leaves.
inline void find_any(RTCScene scene, const PacketMask& mask, RTCRay16& rays) noexcept {
  EmbreeContext context = scattered_rays();
#if VELDT_EMBREE == 3
  rtcOccluded16(mask.data(), scene, &context, &rays);
#else
  RTCOccludedArguments arguments{};
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded16(mask.data(), scene, &rays, &arguments);
#endif
}

}  // namespace thermal
