#include <cmath>

#include "dataset/live/frame_stream.h"
#include "support/catch.h"

namespace lateness_test {

using namespace thermal;

TEST_CASE("A camera in time leaves out nothing, and one that is late catches up") {
  CHECK(frames_to_leave_out(0, 10) == 0);
  CHECK(frames_to_leave_out(0.099, 10) == 0);
  CHECK(frames_to_leave_out(0.199, 10) == 0);
  CHECK(frames_to_leave_out(0.201, 10) == 1);
  CHECK(frames_to_leave_out(1.05, 10) == 9);
  for (double late_s = 0; late_s < 2; late_s += 0.013) {
    const int left_out = frames_to_leave_out(late_s, 30);
    const double then_late_s = late_s - (1 + left_out) / 30.0;  // of the next frame, when it begins
    CHECK(then_late_s < 1 / 30.0);
  }
}

TEST_CASE("Lateness is that of half, of 95 % and of all frames") {
  std::vector<double> late_s;
  for (int k = 200; k >= 0; --k) late_s.push_back(k);
  const Lateness found = lateness_of(late_s);
  CHECK(found.median_s == 100);
  CHECK(found.high_s == 190);
  CHECK(found.most_s == 200);
  CHECK(lateness_of({}).most_s == 0);
}

}  // namespace lateness_test
