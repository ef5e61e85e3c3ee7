#include "base/error.h"
#include "base/relative_name.h"
#include "dataset/exports/birdsai.h"
#include "dataset/exports/mot.h"
#include "dataset/exports/yolo.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "unit/dataset/exports/export_input.h"

namespace plans_test {

using namespace thermal;
using Names = std::vector<std::string>;

// --- YOLO ------------------------------------------------------------------------------------------------------------

TEST_CASE("YOLO: one line per label, centre and size as fractions, classes from 0") {
  const ExportPlan plan = plan_yolo(two_videos(), "/data/out");
  CHECK(targets_of(plan) == Names{"images/train/east_000000.png", "images/train/east_000002.png",
                                  "images/train/east_000003.png", "images/train/west_000000.png"});
  CHECK(text_of(plan, "labels/train/east_000000.txt") ==
        "0 0.12500000 0.10000000 0.25000000 0.20000000\n"
        "1 0.40000000 0.75000000 0.40000000 0.50000000\n");
  CHECK(text_of(plan, "labels/train/east_000003.txt").empty());
  CHECK(plan.texts.size() == 5);
}

TEST_CASE("YOLO: data.yaml has the folders of pictures and the names of classes") {
  CHECK(text_of(plan_yolo(two_splits(), "/data/\"out\""), "data.yaml") ==
        "# \"night\"\n"
        "path: \"/data/\\\"out\\\"\"  # if you move the folder, change or delete this\n"
        "train: images/train\nval: images/val\n"
        "names:\n  0: \"human\"\n  1: \"giraffe\"\n  2: \"vehicle\"\n");
  ExportInput input = two_splits();
  input.splits = {"most", "test"};
  CHECK_THAT(text_of(plan_yolo(input, "/o"), "data.yaml"),
             ContainsSubstring("train: images/most\n"
                               "val: images/most  # there is no split val: these pictures are trained on\n"
                               "test: images/test\nnames:"));
}

TEST_CASE("YOLO: boxes are clipped to the picture") {
  ExportInput input = two_videos();
  input.set.labels = {label(1, 0, 0, 1, {.x_px = -4, .y_px = 8, .width_px = 8, .height_px = 4}),
                      label(2, 0, 0, 2, {.x_px = 20, .y_px = 2, .width_px = 5, .height_px = 5})};
  CHECK(text_of(plan_yolo(input, "/o"), "labels/train/east_000000.txt") ==
        "0 0.10000000 0.90000000 0.20000000 0.20000000\n");
  CHECK(why_not_in_yolo(input.set, input.set.labels[0]).empty());
  CHECK(why_not_in_yolo(input.set, input.set.labels[1]) == "outside their picture");
}

TEST_CASE("YOLO: ignored labels and crowds are left out, and the picture stays") {
  ExportInput input = two_videos();
  input.set.labels[0].ignore = true;
  input.set.labels[1].crowd = true;
  CHECK(text_of(plan_yolo(input, "/o"), "labels/train/east_000000.txt").empty());
  CHECK(why_not_in_yolo(input.set, input.set.labels[0]) == "marked as ignored, which YOLO cannot mark");
  CHECK(why_not_in_yolo(input.set, input.set.labels[1]) == "of crowds, which YOLO cannot mark");
  CHECK(why_not_in_yolo(input.set, input.set.labels[2]).empty());
}

// --- MOTChallenge ----------------------------------------------------------------------------------------------------

TEST_CASE("MOT: frames and pixels from 1, frames without gaps, rows sorted") {
  ExportInput input = two_videos();
  input.set.labels[1].visibility = 0.25;
  input.set.labels[2].ignore = true;
  const ExportPlan plan = plan_mot(input);
  CHECK(targets_of(plan) == Names{"train/east/img1/000001.png", "train/east/img1/000002.png",
                                  "train/east/img1/000003.png", "train/west/img1/000001.png"});
  CHECK(text_of(plan, "train/east/gt/gt.txt") ==
        "1,3,5,6,8,5,1,8,0.25\n"
        "1,7,1,1,5,2,1,1,1\n"
        "2,7,3.5,2,1.25,3,0,1,1\n");
  CHECK(text_of(plan, "train/west/gt/gt.txt") == "1,1,11,3,4,4,1,10,1\n");
}

TEST_CASE("MOT: files that trackers need for a clip, and for all clips") {
  const ExportPlan plan = plan_mot(two_splits());
  CHECK(text_of(plan, "train/east/seqinfo.ini") ==
        "[Sequence]\nname=east\nimDir=img1\nframeRate=12.5\nseqLength=3\nimWidth=20\nimHeight=10\nimExt=."
        "png\n");
  CHECK(text_of(plan, "val/west/seqinfo.ini") ==
        "[Sequence]\nname=west\nimDir=img1\nseqLength=1\nimWidth=20\nimHeight=10\nimExt=.png\n");
  CHECK(text_of(plan, "seqmaps/night-train.txt") == "name\neast\n");
  CHECK(text_of(plan, "seqmaps/night-val.txt") == "name\nwest\n");
  CHECK(text_of(plan, "classes.txt") == "1 human\n8 giraffe\n10 vehicle\n");
}

TEST_CASE("MOT: a class is one line, whatever its name") {
  ExportInput input = two_videos();
  input.set.categories[0].name = "hu\nman\x1b[31m";
  CHECK(text_of(plan_mot(input), "classes.txt") == "1 hu; man\\x1b[31m\n8 giraffe\n10 vehicle\n");
}

TEST_CASE("MOT: tracks of a clip are renumbered from 1 if needed") {
  ExportInput input = two_videos();
  input.set.labels[1].track_id = 0;
  CHECK(text_of(plan_mot(input), "train/east/gt/gt.txt") ==
        "1,1,5,6,8,5,1,8,1\n1,8,1,1,5,2,1,1,1\n2,8,3.5,2,1.25,3,1,1,1\n");
  CHECK(text_of(plan_mot(input), "train/west/gt/gt.txt") == "1,1,11,3,4,4,1,10,1\n");
}

TEST_CASE("MOT: classes are ids of 64 bits, or places where ids are texts") {
  ExportInput input = two_videos();
  input.set.categories[0].id = 3735928559;
  CHECK(text_of(plan_mot(input), "classes.txt") == "3735928559 human\n8 giraffe\n10 vehicle\n");
  CHECK(text_of(plan_mot(input), "train/east/gt/gt.txt").ends_with("2,7,3.5,2,1.25,3,1,3735928559,1\n"));
  input.set.categories[0].id = "person";
  CHECK(text_of(plan_mot(input), "classes.txt") == "1 human\n2 giraffe\n3 vehicle\n");
  CHECK(text_of(plan_mot(input), "train/east/gt/gt.txt").ends_with("2,7,3.5,2,1.25,3,1,1,1\n"));
}

TEST_CASE("MOT and BIRDSAI need an order of time") {
  ExportInput input = two_videos();
  input.set.videos[0].in_time = false;
  const std::string rule =
      "east: nothing says in which order its pictures were taken; expected frame_index or frame_id of "
      "images, or "
      "names that differ in a number, as --format ";
  CHECK(message_of<DataError>([&] { (void)plan_mot(input); }) == rule + "mot requires");
  CHECK(message_of<DataError>([&] { (void)plan_birdsai(input); }) == rule + "birdsai requires");
}

TEST_CASE("MOT: labels without tracks, and videos that are not clips, are errors") {
  ExportInput input = two_videos();
  input.set.images[1].height_px = 12;
  CHECK(message_of<DataError>([&] { (void)plan_mot(input); }) ==
        "clips/east/ir8/000000.png is 20 x 10 px and clips/east/ir8/000002.png is 20 x 12 px; expected "
        "all pictures of a clip to have one kind and size, as --format mot requires");
  input.set.labels[1].track_id = 7;
  CHECK(message_of<DataError>([&] { (void)plan_mot(input); }) ==
        "annotations 1 and 2 of clips/east/ir8/000000.png both have track_id 7; expected one annotation per "
        "track");
  input.set.labels[1].track_id.reset();
  CHECK(message_of<DataError>([&] { (void)plan_mot(input); }) ==
        "annotation 2 of clips/east/ir8/000000.png has no track_id; expected one, as --format mot requires");
}

// --- BIRDSAI ---------------------------------------------------------------------------------------------------------

TEST_CASE("BIRDSAI: one file per clip, frames and pixels from 0, boxes rounded outwards") {
  ExportInput input = two_videos();
  input.set.labels[1].occluded = true;
  input.set.labels[2].noisy = true;
  const ExportPlan plan = plan_birdsai(input);
  CHECK(targets_of(plan) == Names{"images/east/east_0000000000.png", "images/east/east_0000000002.png",
                                  "images/east/east_0000000003.png", "images/west/west_0000000000.png"});
  CHECK(text_of(plan, "annotations/east.csv") ==
        "0,3,4,5,8,5,0,3,1,0\n"
        "0,7,0,0,5,2,1,0,0,0\n"
        "2,7,2,1,2,3,1,0,0,1\n");
  CHECK(text_of(plan, "annotations/west.csv").empty());  // there is only a vehicle
  CHECK(why_not_in_birdsai(input.set, input.set.labels[3]) == "of vehicles, which BIRDSAI has no class for");
}

TEST_CASE("BIRDSAI: rounding errors of a sum do not add a pixel") {
  ExportInput input = two_videos();
  input.set.labels = {label(1, 0, 0, 1, {.x_px = 1.1, .y_px = 0.1, .width_px = 2.9, .height_px = 0.2}),
                      label(2, 0, 0, 2, {.x_px = -2.5, .y_px = 2.9999999999, .width_px = 1, .height_px = 2})};
  CHECK(text_of(plan_birdsai(input), "annotations/east.csv") ==
        "0,1,1,0,3,1,1,0,0,0\n0,2,-3,3,2,2,1,0,0,0\n");
}

TEST_CASE("BIRDSAI: each split is a separate folder, like TrainReal and TestReal") {
  const ExportPlan plan = plan_birdsai(two_splits());
  CHECK(targets_of(plan).back() == "val/images/west/west_0000000000.png");
  CHECK(text_of(plan, "train/annotations/east.csv") != "(none)");
}

TEST_CASE("BIRDSAI: labels without tracks are errors") {
  ExportInput input = two_videos();
  input.set.labels[0].track_id.reset();
  CHECK(message_of<DataError>([&] { (void)plan_birdsai(input); }) ==
        "annotation 1 of clips/east/ir8/000000.png has no track_id; expected one, as --format birdsai "
        "requires");
}

// --- all -------------------------------------------------------------------------------------------------------------

TEST_CASE("No file of an export is outside its folder, or where another one is") {
  ExportInput input = two_videos();
  const auto fault_of = [&input](const std::string& to) {
    ExportPlan plan;
    plan.texts = {{.to = "a/export.json", .content = ""}};
    plan.pictures = {{.image = 0, .to = to}};
    return message_of<DataError>([&] { check_targets(plan, input.set); });
  };
  for (const std::string to :
       {"../up.png", "a/../../up.png", "/etc/x.png", "", "..", "a/", "./a.png", "-r/a.png", "a\nb.png"})
    CHECK(fault_of(to) == "\"clips/east/ir8/000000.png\": name of its file = \"" + to + "\"; expected " +
                              RelativeName::kRule);
  CHECK(fault_of("a/export.json") ==
        "\"a/export.json\" and \"clips/east/ir8/000000.png\" would both become a/export.json; expected names "
        "that "
        "differ");
  CHECK(fault_of("a/..b/c..png") == "(no fault was thrown)");
}

TEST_CASE("Files that would replace each other are named by their pictures") {
  ExportInput input = two_videos();
  input.set.videos[0].name = "a/b";
  input.set.videos[1].name = "a_b";
  input.set.images[3].file = "clips/west/ir8/000000.jpg";
  const auto fault_of = [&input](const ExportPlan& plan) {
    return message_of<DataError>([&] { check_targets(plan, input.set); });
  };
  const std::string both =
      "\"clips/east/ir8/000000.png\" and \"clips/west/ir8/000000.jpg\" would both become ";
  CHECK(fault_of(plan_yolo(input, "/o")) == both + "labels/train/a_b_000000.txt; expected names that differ");
  CHECK(fault_of(plan_mot(input)) == both + "train/a_b/gt/gt.txt; expected names that differ");
  CHECK(fault_of(plan_birdsai(input)) == both + "annotations/a_b.csv; expected names that differ");
}

TEST_CASE("A video whose name is a path gets one folder, not several") {
  ExportInput input = two_videos();
  input.set.videos[1].name = "../far/west";
  CHECK(targets_of(plan_mot(input)).back() == "train/.._far_west/img1/000001.png");
  CHECK(targets_of(plan_birdsai(input)).back() == "images/.._far_west/.._far_west_0000000000.png");
  CHECK(targets_of(plan_yolo(input, "/o")).back() == "images/train/.._far_west_000000.png");
}

}  // namespace plans_test
