#include "radiometry/temperature_table.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

using namespace thermal;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A table of the square, whose exact values a test can write down; it counts how often it is asked.
struct Squares {
  int calls = 0;
  TemperatureTable table{[this](double radiance) {
                           ++calls;
                           return radiance * radiance;
                         },
                         1, 9};

  float operator()(float radiance) const {
    float temperature = -1;
    table.temperatures({&radiance, 1}, {&temperature, 1});
    return temperature;
  }
};

}  // namespace

TEST_CASE("The stated error is that of straight lines through the curve") {
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

TEST_CASE("Outside the table it is, and there it is exact") {
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
