#include <array>
#include <cstdint>
#include <stdexcept>

#include "base/parallel.h"
#include "raycast/ray_caster.h"
#include "support/catch.h"
#include "support/grove.h"

/// oneTBB cancels all work that is tied to what is cancelled. Embree keeps work of its own with each scene; it must not be
/// tied to the loop in which the scene was built, which is over.
namespace cancelled_test {

namespace {

/// Where loops that are over had what they kept on the stack.
[[gnu::noinline]] std::uint64_t write_over_stack() {
  std::array<volatile std::uint64_t, 4096> numbers;
  for (auto& number : numbers) number = 0xBADBADBADBADBAD8ULL;
  return numbers[7];
}

/// Only what has started other work passes its cancellation on.
void cancel_pipeline() {
  const auto give_up = [](std::size_t item) {
    thermal::parallel_for(8, 1, [](std::size_t, std::size_t) { (void)write_over_stack(); });
    if (item == 3) throw std::runtime_error("enough");
  };
  thermal::run_pipeline(4, [](std::size_t) { return true; }, {{.in_order = true, .work = give_up}});
}

}  // namespace

TEST_CASE("Work can be cancelled after a place was built") {
  const small_scene::Scenery place = grove::place();
  const thermal::BakedScene scene = place.baked();
  for (int round = 0; round < 100; ++round) {
    const thermal::RayCaster caster(scene);
    thermal::parallel_for(64, 1, [](std::size_t, std::size_t) { (void)write_over_stack(); });
    CHECK_THROWS_AS(cancel_pipeline(), std::runtime_error);
  }
}

}  // namespace cancelled_test
