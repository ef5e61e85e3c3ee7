#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "radiometry/radiance_table.h"
#include "support/catch.h"

namespace temperature_table_test {

using namespace thermal;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A table of the square, whose exact values a test can compute; it counts its calls.
struct Squares {
  std::atomic<int> calls = 0;  // a table is made on all cores
  TemperatureTable table;
  explicit Squares(double hottest = 0)
      : table(
            [this](double radiance) {
              ++calls;
              return radiance * radiance;
            },
            1, 9, hottest) {}

  float operator()(float radiance) const {
    float temperature = -1;
    table.temperatures({&radiance, 1}, {&temperature, 1});
    return temperature;
  }
};

}  // namespace

TEST_CASE("The stated error is that of linear interpolation") {
  const Squares squares;
  // For r^2 and nodes h = 8 / 8192 apart it is h^2 / 4 = 2.4e-7; nodes of up to 81 in single precision add half
  // a step each of 7.6e-6, and so does the result.
  CHECK(squares.table.worst_error_k() >= 2.4e-7);
  CHECK(squares.table.worst_error_k() <= 2.4e-7 + 2 * 3.9e-6);
}

TEST_CASE("Inside the table the exact inverse is not called again") {
  Squares squares;
  const int calls = squares.calls;
  CHECK(squares(1) == 1);
  CHECK_THAT(static_cast<double>(squares(2.5F)), WithinAbs(6.25, squares.table.worst_error_k()));
  CHECK(squares(9) == 81);
  CHECK(squares.calls == calls);
}

TEST_CASE("Outside the table it is called, and the result is exact") {
  Squares squares;
  const int calls = squares.calls;
  CHECK(squares(0.5F) == 0.25F);
  CHECK(squares(16) == 256);
  CHECK(squares(-3) == 9);
  CHECK(squares(std::nextafter(9.0F, 10.0F)) == std::nextafter(9.0F, 10.0F) * std::nextafter(9.0F, 10.0F));
  CHECK(squares(kInfinity) == kInfinity);
  CHECK(squares(-kInfinity) == kInfinity);
  CHECK(std::isnan(squares(std::numeric_limits<float>::quiet_NaN())));
  CHECK(squares.calls == calls + 7);
}

TEST_CASE("A plane may be converted in place") {
  Squares squares;
  std::vector<float> values = {2, 3, 100, 0};
  squares.table.temperatures(values, values);
  CHECK(values[2] == 10000);
  CHECK(values[3] == 0);
  CHECK_THAT(static_cast<double>(values[1]), WithinAbs(9, squares.table.worst_error_k()));
}

TEST_CASE("The hot part is made when its first radiance comes, and not again") {
  Squares squares(100);
  const int calls = squares.calls;
  CHECK_THAT(static_cast<double>(squares(5)), WithinAbs(25, squares.table.worst_error_k()));
  CHECK(squares.calls == calls);
  CHECK(squares(16) == 256);  // a node
  // From 9 / 8 of an octave to 100 / 64, 1024 nodes an octave; both ends, one before 9 and one after 100.
  const int made = squares.calls - calls;
  CHECK(made == 1024 * 3 - 128 + 1024 * 36 / 64 + 3);
  // Lines h = 64 / 1024 apart are off by h^2 / 4 = 9.8e-4 at most; floats step by 4.9e-4 at 8100, twice half of it.
  CHECK_THAT(static_cast<double>(squares(90.03F)), WithinAbs(90.03 * 90.03, 9.8e-4 + 4.9e-4 + 180 * 3.9e-6));
  CHECK(squares(100) == 10000);
  CHECK(squares.calls == calls + made);
  CHECK(squares(std::nextafter(100.0F, 101.0F)) > 10000);  // the exact inverse
  CHECK(squares(0.5F) == 0.25F);
  CHECK(squares(kInfinity) == kInfinity);
  CHECK(std::isnan(squares(std::numeric_limits<float>::quiet_NaN())));
  CHECK(squares.calls == calls + made + 4);
}

TEST_CASE("Two threads may need the hot part at the same time") {
  const Squares alone(100);
  const float expected = alone(90.03F);
  const Squares shared(100);
  float there = 0;
  std::thread other([&] { there = shared(90.03F); });
  const float here = shared(90.03F);
  other.join();
  CHECK(here == expected);
  CHECK(there == expected);
  CHECK(shared.calls == alone.calls);
}

TEST_CASE("Not a bit changes in the first table where there is a hot part") {
  const Squares without;
  const Squares with(100);
  for (float radiance = 1; radiance <= 9; radiance += 0.0007F) {
    CAPTURE(radiance);
    REQUIRE(with(radiance) == without(radiance));
  }
}

}  // namespace temperature_table_test
