#include "io/bake/ground_maps_file.h"

#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "io/json/file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace ground_maps_file_test {

using thermal::DataError;
using thermal::GroundMaps;
using thermal::Json;

namespace {

GroundMaps maps() {
  return {.size_m = 2.5,
          .cells = 2,
          .sky_view = {0, 1, 128, 255},
          .height_m = {-1.5F, 0, 1e-3F, 20},
          .crown_top_m = {0, 0, 3.25F, 0},
          .moisture = {255, 4, 0, 9},
          .water_m = {1.5F, 0, 0, 0},
          .covers = {.cells = 3,
                     .kinds = {"soil", "road"},
                     .kind = {0, 1, 0, 0, 0, 0, 1, 0, 0},
                     .grass = {7, 0, 255, 1, 2, 3, 0, 4, 5},
                     .trodden = {0, 0, 0, 9, 0, 0, 0, 0, 255},
                     .ash = {0, 0, 1, 0, 0, 0, 0, 8, 0},
                     .border = {255, 9, 0, 1, 2, 3, 4, 5, 6}},
          .sunlit = {{.path = {.latitude_deg = -19, .day_of_year = 190}, .hours = {0, 1, 0xFFFFFF, 4}},
                     {.path = {.latitude_deg = 12.25, .day_of_year = 1}, .hours = {9, 8, 7, 6}}}};
}

thermal::BakedGround ground() {
  thermal::BakedGround ground;
  ground.size_m = 2.5;
  return ground;
}

GroundMaps read(const TestFolder& folder) {
  return thermal::read_ground_maps(folder.path(), ground(), kAssets);
}

/// What is wrong with maps that are written after a change, without the folder.
std::string fault_of(const std::function<void(GroundMaps&)>& change) {
  const TestFolder folder;
  GroundMaps changed = maps();
  change(changed);
  thermal::write_ground_maps(changed, folder.path(), folder.path());
  return message_of<DataError>([&] { (void)read(folder); }).substr(folder.path().string().size() + 1);
}

/// The same after a change of the header.
std::string fault_of_header(const std::function<void(Json&)>& change) {
  const TestFolder folder;
  thermal::write_ground_maps(maps(), folder.path(), folder.path());
  Json header = thermal::read_json(folder / "ground.json");
  change(header);
  (void)folder.file("ground.json", header.dump());
  return message_of<DataError>([&] { (void)read(folder); }).substr(folder.path().string().size() + 1);
}

}  // namespace

TEST_CASE("Maps of the ground are read as they were written") {
  const TestFolder folder;
  thermal::write_ground_maps(maps(), folder.path(), folder.path());
  CHECK(read(folder) == maps());
  CHECK(thermal::sun_paths_of_maps(folder.path(), kAssets) ==
        std::vector{maps().sunlit[0].path, maps().sunlit[1].path});
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("They replace earlier ones, and may have no days") {
  const TestFolder folder;
  thermal::write_ground_maps(maps(), folder.path(), folder.path());
  GroundMaps dark = maps();
  dark.sunlit.clear();
  thermal::write_ground_maps(dark, folder.path(), folder.path());
  CHECK(read(folder) == dark);
}

TEST_CASE("Values that no maps have are refused") {
  CHECK(fault_of([](GroundMaps& maps) { maps.size_m = 3; }) ==
        "ground.json: size_m = 3; expected 2.5, as in scene.json");
  CHECK(fault_of([](GroundMaps& maps) { maps.height_m[2] = std::numeric_limits<float>::infinity(); }) ==
        "ground.json: height_m[2] = inf; expected a finite number");
  CHECK(fault_of([](GroundMaps& maps) { maps.crown_top_m[1] = std::nanf(""); }) ==
        "ground.json: crown_top_m[1] = nan; expected a finite number");
  CHECK(fault_of([](GroundMaps& maps) { maps.crown_top_m[3] = -0.5F; }) ==
        "ground.json: crown_top_m[3] = -0.5; expected 0 or more");
  CHECK(fault_of([](GroundMaps& maps) { maps.covers.kind[5] = 2; }) ==
        "ground.json: kind[5] = 2; expected less than 2");
  CHECK(fault_of([](GroundMaps& maps) { maps.covers.kinds.clear(); }) ==
        "ground.json: kinds = a list of 0; expected at least 1 entries");
  CHECK(fault_of([](GroundMaps& maps) { maps.sunlit[1].hours[2] = 1U << 24U; }) ==
        "ground.json: sunlit[6] = 16777216; expected bits of 24 hours");
  CHECK(fault_of([](GroundMaps& maps) { maps.sunlit[0].path.day_of_year = 367; }) ==
        "ground.json: sun_paths[0].day_of_year = 367; expected at least 1 and at most 366");
}

TEST_CASE("Headers that do not fit are refused") {
  CHECK(fault_of_header([](Json& header) { header["version"] = 1; }) ==
        "ground.json: version = 1; expected at least 2 and at most 2");
  CHECK(fault_of_header([](Json& header) { header["cells"] = 3; }) ==
        "ground.json: arrays.sky_view.shape = [2,2]; expected [3, 3]");
  CHECK(fault_of_header([](Json& header) { header["cells"] = 4097; }) ==
        "ground.json: cells = 4097; expected at least 1 and at most 4096");
  CHECK(fault_of_header([](Json& header) { header["sun_paths"].erase(0); }) ==
        "ground.json: arrays.sunlit.shape = [2,2,2]; expected [1, 2, 2]");
  CHECK(fault_of_header([](Json& header) { header["arrays"].erase("grass"); }) ==
        "ground.json: arrays.grass = nothing; expected an array");
  CHECK(fault_of_header([](Json& header) { header["arrays"]["sunlit"]["offset"] = 704; }) ==
        "ground.json: arrays.sunlit.offset = 704; expected a multiple of 64 within the 704 bytes of "
        "ground.bin, with all of the array");
}

TEST_CASE("A binary file that is cut is refused") {
  const TestFolder folder;
  thermal::write_ground_maps(maps(), folder.path(), folder.path());
  std::filesystem::resize_file(folder / "ground.bin", 703);
  CHECK(message_of<DataError>([&] { (void)read(folder); }) ==
        (folder / "ground.bin").string() + ": 703 bytes; expected 704");
}

}  // namespace ground_maps_file_test
