#include <array>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace index_plane_test {

using namespace thermal;

namespace {

template <typename Number>
std::vector<std::uint16_t> indices_of(const std::vector<Number>& numbers, int largest = kLargestIndex) {
  std::vector<std::uint16_t> indices(numbers.size());
  to_indices(std::span<const Number>(numbers), 2, "plane", indices, largest, ", it is said");
  return indices;
}

template <typename Number>
std::string fault_of(Number number, int largest = kLargestIndex) {
  return message_of<DataError>([&] { (void)indices_of<Number>({0, 1, 2, number, number, 5}, largest); });
}

}  // namespace

TEMPLATE_TEST_CASE("Whole numbers become indices", "", float, double, std::uint16_t, std::uint32_t,
                   std::int64_t, std::uint64_t) {
  CHECK(indices_of<TestType>({0, 1, 101, 32767}) == std::vector<std::uint16_t>{0, 1, 101, 32767});
  CHECK(fault_of<TestType>(32768) ==
        "plane at pixel (1, 1) = 32768; expected a whole number from 0 to 32767, it is said");
  CHECK(fault_of<TestType>(11, 10) ==
        "plane at pixel (1, 1) = 11; expected a whole number from 0 to 10, it is said");
}

TEST_CASE("What would wrap around, or be cut, is refused") {
  CHECK(fault_of<std::uint32_t>(65536 + 101).starts_with("plane at pixel (1, 1) = 65637; "));
  CHECK(fault_of<std::int64_t>(-65435).starts_with("plane at pixel (1, 1) = -65435; "));
  CHECK(fault_of<std::uint64_t>(std::numeric_limits<std::uint64_t>::max())
            .starts_with("plane at pixel (1, 1) = 1844"));
  CHECK(fault_of<float>(101.5F).starts_with("plane at pixel (1, 1) = 101.5; "));
  CHECK(fault_of<double>(101.9).starts_with("plane at pixel (1, 1) = 101.9; "));
  CHECK(fault_of<float>(-0.25F).starts_with("plane at pixel (1, 1) = -0.25; "));
  CHECK(fault_of<double>(std::numeric_limits<double>::quiet_NaN())
            .starts_with("plane at pixel (1, 1) = nan; "));
  CHECK(fault_of<float>(std::numeric_limits<float>::infinity()).starts_with("plane at pixel (1, 1) = inf; "));
}

}  // namespace index_plane_test
