#include "io/label_files/birdsai.h"

#include "base/error.h"
#include "io/image/png.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace birdsai_files_test {

using namespace thermal;

namespace {

/// A BIRDSAI folder with one video's rows.
Path birdsai(const TestFolder& folder, const std::string& rows) {
  std::filesystem::create_directories(folder / "real/annotations");
  (void)folder.file("real/annotations/night.csv", rows);
  return folder / "real";
}

std::string fault_in(const std::string& rows) {
  const TestFolder folder;
  const Path root = birdsai(folder, rows);
  const std::string message = message_of<DataError>([&] { (void)read_birdsai(root); });
  const std::string name = (root / "annotations" / "night.csv").string() + ":";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

}  // namespace

TEST_CASE("BIRDSAI's rows become labels") {
  const TestFolder folder;
  const LabelSet set = read_birdsai(birdsai(
      folder, "4,2,10,20,5,6,1,-1,0,0\r\n4,1,-3,0,8,9,0,1,1,0\n\n0,1,1,2,3,4,0,-1,0,1\n7,3,0,0,2,2,0,8,0,0"));
  CHECK(set.name == "real");
  REQUIRE(set.videos.size() == 1);
  CHECK(set.videos[0].name == "night");
  REQUIRE(set.images.size() == 3);
  CHECK(set.images[0].frame_index == 0);
  CHECK(set.images[1].file == "images/night/night_0000000004.jpg");
  CHECK(set.images[1].width_px == 0);
  REQUIRE(set.labels.size() == 4);
  const Label& human = set.labels[1];
  CHECK(set.categories[human.category].name == "human");
  CHECK(human.box == LabelBox{10, 20, 5, 6});
  CHECK(human.area_px == 30);
  CHECK(human.track_id == std::optional<std::int64_t>(2));
  CHECK(human.occluded == std::optional(false));
  const Label& elephant = set.labels[2];
  CHECK(set.categories[elephant.category].name == "elephant");
  CHECK(elephant.occluded == std::optional(true));
  CHECK(set.categories[set.labels[0].category].name == "animal");
  CHECK(set.labels[0].noisy);
  CHECK(set.categories[set.labels[3].category].name == "rhinoceros");
}

TEST_CASE("BIRDSAI's rows may begin with a byte-order mark") {
  const TestFolder folder;
  const LabelSet set = read_birdsai(birdsai(folder,
                                            "\xEF\xBB\xBF"
                                            "4,2,10,20,5,6,1,-1,0,0\r\n"));
  REQUIRE(set.labels.size() == 1);
  CHECK(set.labels[0].box == LabelBox{10, 20, 5, 6});
}

TEST_CASE("Frames without a row are there if their picture is") {
  const TestFolder folder;
  const Path root = birdsai(folder, "1,1,1,1,2,2,0,1,0,0\n");
  std::filesystem::create_directories(root / "images/night");
  const std::vector<std::byte> png = encode_png(Plane<std::uint8_t>(7, 5));
  write_file(root / "images/night/night_0000000000.png", png);
  write_file(root / "images/night/night_0000000001.png", png);
  write_file(root / "images/night/notes_3.png", png);
  write_file(root / "images/night/night_x.png", png);
  const LabelSet set = read_birdsai(root);
  REQUIRE(set.images.size() == 2);
  CHECK(set.images[0].file == "images/night/night_0000000000.png");
  CHECK(set.images[1].width_px == 7);
  CHECK(set.images[1].height_px == 5);
  CHECK(set.labels[0].image == 1);
}

TEST_CASE("Two pictures of one frame are a fault") {
  const TestFolder folder;
  const Path root = birdsai(folder, "1,1,1,1,2,2,0,1,0,0\n");
  std::filesystem::create_directories(root / "images/night");
  for (const char* name : {"night_0000000001.png", "night_1.jpg"})
    (void)folder.file(std::string("real/images/night/") + name, "a picture");
  CHECK(message_of<DataError>([&] { (void)read_birdsai(root); }) ==
        (root / "images/night").string() +
            ": night_0000000001.png and night_1.jpg are both frame 1; expected one picture per frame");
}

TEST_CASE("Objects of BIRDSAI have ids of 64 bits") {
  const TestFolder folder;
  const LabelSet set = read_birdsai(birdsai(folder, "0,4294967295,1,1,2,2,0,1,0,0\n"));
  CHECK(set.labels[0].track_id == std::optional<std::int64_t>(4294967295));
}

TEST_CASE("An invalid row of BIRDSAI is reported with its line") {
  CHECK(fault_in("0,1,1,1,2,2,0,1,0,0\n0,2,1,1,2,2,0,1,0\n") ==
        "2: 9 columns; expected 10: frame, object_id, x_min, y_min, w, h, class, species, occluded, noisy");
  CHECK(fault_in("0,1,1,1,2,2,0,1,0,0,0\n") ==
        "1: 11 columns; expected 10: frame, object_id, x_min, y_min, w, h, class, species, occluded, noisy");
  CHECK(fault_in("0,1,1.5,1,2,2,0,1,0,0\n") == "1: column 3 is \"1.5\"; expected a whole number");
  CHECK(fault_in("0,1,,1,2,2,0,1,0,0\n") == "1: column 3 is \"\"; expected a whole number");
  CHECK(fault_in("frame,1,1,1,2,2,0,1,0,0\n") == "1: column 1 is \"frame\"; expected a whole number");
  CHECK(fault_in("0,1,99999999999,1,2,2,0,1,0,0\n") ==
        "1: column 3 is \"99999999999\"; expected a whole number");
  CHECK(fault_in("-1,1,1,1,2,2,0,1,0,0\n") == "1: frame -1; expected 0 or more");
  CHECK(fault_in("0,1,1,1,-2,2,0,1,0,0\n") == "1: a box of -2 x 2 px; expected sides that are not negative");
  CHECK(fault_in("0,1,1,1,2,2,2,1,0,0\n") == "1: class 2; expected 0 (animal) or 1 (human)");
  CHECK(fault_in("0,1,1,1,2,2,0,9,0,0\n") == "1: species 9; expected -1 (unknown) to 8 (rhino)");
  CHECK(fault_in("0,1,1,1,2,2,0,0,0,0\n") ==
        "1: class 0 with species 0; expected class 1 with species 0 or -1, class 0 with another");
  CHECK(fault_in("0,1,1,1,2,2,0,1,2,0\n") == "1: occluded 2; expected 0 or 1");
  CHECK(fault_in("0,1,1,1,2,2,0,1,0,-1\n") == "1: noisy -1; expected 0 or 1");
  CHECK(fault_in("3,1,1,1,2,2,0,1,0,0\n3,1,5,5,2,2,0,1,0,0\n") ==
        "2: object 1 appears twice in frame 3; expected once");
}

TEST_CASE("A folder without BIRDSAI's annotations is reported") {
  const TestFolder folder;
  CHECK(message_of<IoError>([&] { (void)read_birdsai(folder.path()); }) ==
        (folder / "annotations").string() + " holds no .csv file");
}

TEST_CASE("Categories have BIRDSAI's class and species") {
  CHECK(birdsai_kind("human").animal_or_human == 1);
  CHECK(birdsai_kind("human").species == 0);
  CHECK(birdsai_kind("elephant").species == 1);
  CHECK(birdsai_kind("rhinoceros").species == 8);
  CHECK(birdsai_kind("impala").animal_or_human == 0);
  CHECK(birdsai_kind("impala").species == -1);
}

}  // namespace birdsai_files_test
