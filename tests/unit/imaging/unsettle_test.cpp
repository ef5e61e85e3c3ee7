#include <cmath>
#include <vector>

#include "imaging/row_kernels.h"
#include "scene/variation_field.h"
#include "support/catch.h"

namespace unsettle_test {

using namespace thermal;

namespace {

constexpr std::size_t kSide = 500;
constexpr float kStep = 0.5F;  // correlation lengths between places

struct Places {
  std::vector<float> x;
  std::vector<float> y;
};

Places grid(float from_x, float from_y) {
  Places places;
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    places.x.push_back(from_x + kStep * static_cast<float>(i % kSide));
    places.y.push_back(from_y + kStep * static_cast<float>(i / kSide));
  }
  return places;
}

std::vector<float> values_at(const VariationField& field, const Places& at, bool unsettled) {
  const std::vector<std::uint16_t> surface(at.x.size());
  const float per_length = 1;
  std::vector<float> x = at.x;
  std::vector<float> y = at.y;
  std::vector<float> footprint(at.x.size());
  const std::vector<float> fine(at.x.size(), 0.01F);
  if (unsettled) {
    kernels::unsettle({surface.data(), &per_length, at.x.data(), at.y.data(), fine.data()}, x.data(),
                      y.data(), footprint.data(), x.size());
  }
  std::vector<float> values(at.x.size());
  field.sample(x, y, fine, values);
  return values;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("The field repeats itself after 16 lengths, and no longer where its places are unsettled") {
  const VariationField field(1);
  const bool unsettled = GENERATE(false, true);
  const std::vector<float> here = values_at(field, grid(0, 0), unsettled);
  for (const auto& [x, y] :
       {std::pair{16.0F, 0.0F}, {0.0F, 16.0F}, {16.0F, 16.0F}, {16.0F, -16.0F}, {48.0F, 0.0F}}) {
    CAPTURE(unsettled, x, y);
    const double r = correlation(here, values_at(field, grid(x, y), unsettled));
    CHECK((unsettled ? std::abs(r) < 0.2 : r > 0.95));
  }
}

TEST_CASE("Unsettled places stretch and shrink by at most 22 %") {
  const Places at = grid(-300, -200);
  const std::vector<std::uint16_t> surface(at.x.size());
  const float per_length = 1;
  const std::vector<float> fine(at.x.size(), 0.01F);
  std::vector<float> x(at.x.size());
  std::vector<float> y(at.x.size());
  std::vector<float> footprint(at.x.size());
  kernels::unsettle({surface.data(), &per_length, at.x.data(), at.y.data(), fine.data()}, x.data(), y.data(),
                    footprint.data(), x.size());
  for (std::size_t i = 0; i + kSide < x.size(); ++i) {
    for (const std::size_t next : {i + 1, i + kSide}) {
      if (next == i + 1 && next % kSide == 0) continue;
      const double step =
          std::hypot(static_cast<double>(x[next] - x[i]), static_cast<double>(y[next] - y[i]));
      REQUIRE(std::abs(step / static_cast<double>(kStep) - 1) < 0.22);
    }
  }
  CHECK(footprint.front() == 0.01F);
}

}  // namespace unsettle_test
