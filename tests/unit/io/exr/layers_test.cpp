/// Which channels of a file are the planes of a clip: layers, parts, views, and channels named in the manifest.

#include <map>

#include "base/error.h"
#include "io/exr/passes.h"
#include "support/catch.h"
#include "support/exr_forms.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace exr_layers_test {

using namespace thermal;
using exr_forms::floats;
using exr_forms::window;

namespace {

/// One pixel per channel, with a number that identifies it.
using Numbers = std::map<std::string, float>;

struct NumberedPart {
  std::string name;
  Numbers numbers;
  std::string view = {};
};

/// A file of one pixel.
struct Exr {
  explicit Exr(const Numbers& numbers) : Exr({{.name = "", .numbers = numbers}}) {}
  explicit Exr(const std::vector<NumberedPart>& parts) {
    std::vector<exr_forms::Part> written;
    for (const NumberedPart& part : parts) {
      exr_forms::Part& to = written.emplace_back();
      to.display = window(0, 0, 1, 1);
      for (const auto& [channel, number] : part.numbers) to.channels[channel] = floats({number});
      to.name = part.name;
      to.view = part.view;
    }
    exr_forms::write(file, written);
  }

  /// Numbers of object index, material index, depth and normal; -1 where a plane is empty.
  [[nodiscard]] std::vector<float> read(const ExrLayout& layout = {}, const PassNeeds& needs = {}) const {
    const Passes passes = read_passes(file, layout, needs);
    const auto number = [](const auto& plane) {
      return plane.empty() ? -1.0F : static_cast<float>(plane.at(0, 0));
    };
    std::vector<float> numbers = {number(passes.object_index), number(passes.material_index),
                                  number(passes.depth_m)};
    for (const Plane<float>& normal : passes.normal) numbers.push_back(number(normal));
    numbers.push_back(number(passes.actor_index));
    return numbers;
  }

  /// What is wrong, without the file's name.
  [[nodiscard]] std::string fault(const ExrLayout& layout = {}, const PassNeeds& needs = {}) const {
    const std::string message = message_of<DataError>([&] { (void)read_passes(file, layout, needs); });
    const std::string name = file.string() + ": ";
    return message.starts_with(name) ? message.substr(name.size()) : message;
  }

  TestFolder folder;
  Path file = folder / "f.exr";
};

using Read = std::vector<float>;
constexpr PassNeeds kAll = {.depth = true, .normals = true, .actors = true};
constexpr float kNone = -1;

/// All planes of a layer, numbered from a first number.
Numbers layer(const std::string& prefix, float first) {
  return {{prefix + "IndexOB.X", first},     {prefix + "IndexMA.X", first + 1},
          {prefix + "Depth.Z", first + 2},   {prefix + "Normal.X", first + 3},
          {prefix + "Normal.Y", first + 4},  {prefix + "Normal.Z", first + 5},
          {prefix + "Combined.R", first + 9}};
}

ExrLayout naming(const PassChannels& channels, const std::string& layer = "",
                 const std::string& actors = "") {
  return {.layer = layer, .actor_layer = actors, .channels = channels};
}

ExrLayout naming_objects(const std::string& channel, const std::string& layer = "",
                         const std::string& actors = "") {
  return naming({.object_index = channel, .material_index = "", .depth = "", .normal = ""}, layer, actors);
}

Numbers both(Numbers a, const Numbers& b) {
  a.insert(b.begin(), b.end());
  return a;
}

const std::string kSeveral = "; expected the manifest's \"layer\" to name one";

}  // namespace

TEST_CASE("A layer of several is chosen by its name") {
  const Exr exr(both(layer("Near.", 10), layer("Far.", 20)));
  CHECK(exr.read({.layer = "Near"}, kAll) == Read{10, 11, 12, 13, 14, 15, kNone});
  CHECK(exr.read({.layer = "Far"}, kAll) == Read{20, 21, 22, 23, 24, 25, kNone});
  CHECK(exr.fault() == "IndexOB is in several layers: Far, Near" + kSeveral);
  const std::string rule = "; expected a layer with an object index: Far, Near";
  CHECK(exr.fault({.layer = "far"}) == "layer = \"far\"" + rule + "; did you mean \"Far\"?");
  CHECK(exr.fault({.layer = "ViewLayer"}) == "layer = \"ViewLayer\"" + rule);
}

TEST_CASE("Layers may be parts, by their names or by their channels'") {
  const Exr named({{.name = "Near", .numbers = layer("", 10)}, {.name = "Far", .numbers = layer("", 20)}});
  CHECK(named.read({.layer = "Near"}, kAll) == Read{10, 11, 12, 13, 14, 15, kNone});
  CHECK(named.read({.layer = "Far"}, kAll) == Read{20, 21, 22, 23, 24, 25, kNone});
  CHECK(named.fault() == "IndexOB is in several layers: Far, Near" + kSeveral);
  const Exr prefixed(
      {{.name = "a", .numbers = layer("Near.", 10)}, {.name = "b", .numbers = layer("Far.", 20)}});
  CHECK(prefixed.read({.layer = "Near"}, kAll) == Read{10, 11, 12, 13, 14, 15, kNone});
  CHECK(prefixed.fault() == "IndexOB is in several layers: Far, Near" + kSeveral);
}

TEST_CASE("Files with one part per pass are read as Blender 5 writes them") {
  const Exr exr(
      {{.name = "ViewLayer.Combined", .numbers = {{"ViewLayer.Combined.R", 1}}},
       {.name = "ViewLayer.Depth", .numbers = {{"ViewLayer.Depth.Z", 2}}},
       {.name = "ViewLayer.Normal",
        .numbers = {{"ViewLayer.Normal.X", 3}, {"ViewLayer.Normal.Y", 4}, {"ViewLayer.Normal.Z", 5}}},
       {.name = "ViewLayer.Object Index", .numbers = {{"ViewLayer.Object Index.X", 6}}},
       {.name = "ViewLayer.Material Index", .numbers = {{"ViewLayer.Material Index.X", 7}}}});
  CHECK(exr.read({}, kAll) == Read{6, 7, 2, 3, 4, 5, kNone});
  CHECK(exr.read({.layer = "ViewLayer"}, kAll) == Read{6, 7, 2, 3, 4, 5, kNone});
}

TEST_CASE("Files with one part per pass are read where only the parts' names distinguish them") {
  const Exr exr({{.name = "rgba", .numbers = {{"R", 1}, {"G", 1}, {"B", 1}}},
                 {.name = "depth", .numbers = {{"Z", 2}}},
                 {.name = "N", .numbers = {{"red", 3}, {"green", 4}, {"blue", 5}}},
                 {.name = "object_id", .numbers = {{"R", 6}}},
                 {.name = "material_id", .numbers = {{"material_id.R", 7}}}});
  CHECK(exr.read({}, kAll) == Read{6, 7, 2, 3, 4, 5, kNone});
}

TEST_CASE("Planes without a layer belong to the only object index") {
  const Exr exr({{.name = "ids", .numbers = {{"IndexOB.X", 1}, {"IndexMA.X", 2}}},
                 {.name = "beauty", .numbers = {{"Z", 3}, {"R", 9}}},
                 {.name = "geometry", .numbers = {{"N.X", 4}, {"N.Y", 5}, {"N.Z", 6}}}});
  CHECK(exr.read({}, kAll) == Read{1, 2, 3, 4, 5, 6, kNone});
  CHECK(Exr({{"Scene.IndexOB.X", 1}, {"Z", 3}}).read({}, {.depth = true})[2] == 3);
  CHECK(Exr({{"IndexOB.X", 1}, {"Scene.Depth.Z", 3}}).read({}, {.depth = true})[2] == 3);
  const Exr two({{"IndexOB.X", 1}, {"A.Depth.Z", 3}, {"B.Depth.Z", 4}});
  CHECK(two.fault({}, {.depth = true}) ==
        "Depth is in several layers: A, B; expected the manifest's \"channels\" to name one");
  const Exr actors({{"IndexOB.X", 1}, {"Actors.Depth.Z", 3}});
  CHECK(actors.fault({.actor_layer = "Actors"}, {.depth = true}) ==
        "no depth channel, which the chosen terms need; the file has: Actors.Depth.Z, IndexOB.X");
  CHECK(two.read() == Read{1, kNone, kNone, kNone, kNone, kNone, kNone});  // not requested
}

TEST_CASE("Another layer's planes are never taken for the chosen one's") {
  const std::string rest = ", which the chosen terms need; the file has: ";
  CHECK(Exr({{"A.IndexOB.X", 1}, {"B.IndexOB.X", 2}, {"B.Depth.Z", 3}})
            .fault({.layer = "A"}, {.depth = true}) ==
        "no depth channel" + rest + "A.IndexOB.X, B.Depth.Z, B.IndexOB.X");
  CHECK(Exr({{"A.IndexOB.X", 1}, {"B.Depth.Z", 3}}).fault({}, {.depth = true}) ==
        "no depth channel" + rest + "A.IndexOB.X, B.Depth.Z");
  CHECK(Exr({{"A.IndexOB.X", 1}, {"A.Normal.X", 3}, {"A.Normal.Z", 3}}).fault({}, {.normals = true}) ==
        "no normal Y channel" + rest + "A.IndexOB.X, A.Normal.X, A.Normal.Z");
}

TEST_CASE("One of several views is a layer") {
  const Exr exr({{.name = "V.Object Index-left", .numbers = {{"V.Object Index.X", 1}}, .view = "left"},
                 {.name = "V.Object Index-right", .numbers = {{"V.Object Index.X", 2}}, .view = "right"},
                 {.name = "V.Depth-left", .numbers = {{"V.Depth.Z", 3}}, .view = "left"},
                 {.name = "V.Depth-right", .numbers = {{"V.Depth.Z", 4}}, .view = "right"}});
  CHECK(exr.fault() == "Object Index is in several layers: V.left, V.right" + kSeveral);
  CHECK(exr.read({.layer = "V.right"}, {.depth = true}) == Read{2, kNone, 4, kNone, kNone, kNone, kNone});
}

TEST_CASE("A layer without a name is selected by naming its channel") {
  const Exr exr({{"IndexOB.X", 1}, {"Depth.Z", 2}, {"Far.IndexOB.X", 3}, {"Far.Depth.Z", 4}});
  CHECK(exr.fault() == "IndexOB is in several layers: (no name), Far" + kSeveral);
  CHECK(exr.read(naming_objects("IndexOB.X"), {.depth = true})[2] == 2);
  CHECK(exr.read({.layer = "Far"}, {.depth = true})[2] == 4);
  const Exr flat({{"IndexOB.X", 1}, {"Far.IndexOB.X", 3}, {"Far.Depth.Z", 4}});
  CHECK(flat.fault(naming_objects("IndexOB.X"), {.depth = true}) ==
        "no depth channel, which the chosen terms need; the file has: Far.Depth.Z, Far.IndexOB.X, IndexOB.X");
}

TEST_CASE("Channels with unusual names are named by the manifest") {
  const Exr exr({{"Scene.ids.R", 1},
                 {"Scene.stuff", 2},
                 {"Scene.far.Q", 3},
                 {"Scene.up.R", 4},
                 {"Scene.up.G", 5},
                 {"Scene.up.B", 6},
                 {"Scene.IndexOB.X", 7},
                 {"Scene.Depth.Z", 8}});
  const PassChannels names = {.object_index = "Scene.ids.R",
                              .material_index = "Scene.stuff",
                              .depth = "Scene.far.Q",
                              .normal = "Scene.up"};
  CHECK(exr.read(naming(names), kAll) == Read{1, 2, 3, 4, 5, 6, kNone});
  CHECK(exr.read(naming_objects("Scene.ids.R"), {.depth = true}) ==
        Read{1, kNone, 8, kNone, kNone, kNone, kNone});
}

TEST_CASE("An unknown channel name is an error that lists the existing ones") {
  const Exr exr({{"S.IndexOB.X", 1}, {"S.Depth.Z", 2}, {"S.up.X", 3}, {"S.up.Y", 4}});
  const std::string list = "S.Depth.Z, S.IndexOB.X, S.up.X, S.up.Y";
  CHECK(exr.fault(naming_objects("ids")) ==
        "channels.object_index = \"ids\"; expected a channel of the file: " + list);
  CHECK(exr.fault(naming({.object_index = "", .material_index = "S.IndexOB.Y", .depth = "", .normal = ""})) ==
        "channels.material_index = \"S.IndexOB.Y\"; expected a channel of the file: " + list +
            "; did you mean \"S.IndexOB.X\"?");
  CHECK(exr.fault(naming({.object_index = "", .material_index = "", .depth = "S.Depth", .normal = ""}),
                  {.depth = true}) == "channels.depth = \"S.Depth\"; expected a channel of the file: " +
                                          list + "; did you mean \"S.Depth.Z\"?");
  CHECK(exr.fault(naming({.object_index = "", .material_index = "", .depth = "S.Depth", .normal = ""})) ==
        "(no fault was thrown)");  // not requested
  CHECK(exr.fault(naming({.object_index = "", .material_index = "", .depth = "", .normal = "S.ip"}),
                  {.normals = true}) ==
        "channels.normal = \"S.ip\"; expected a pass with a channel .X in the file: S.Depth, "
        "S.IndexOB, S.up; "
        "did you mean \"S.up\"?");
  CHECK(exr.fault(naming({.object_index = "", .material_index = "", .depth = "", .normal = "S.up"}),
                  {.normals = true}) ==
        "channels.normal = \"S.up\"; expected a pass with a channel .Z in the file: S.Depth, "
        "S.IndexOB, S.up");
}

TEST_CASE("A name shared by several parts is resolved by the part") {
  const Exr exr({{.name = "one", .numbers = {{"ids", 1}, {"N.X", 4}, {"N.Y", 4}, {"N.Z", 4}}},
                 {.name = "two", .numbers = {{"ids", 2}, {"N.X", 5}, {"N.Y", 5}, {"N.Z", 5}}}});
  CHECK(exr.read(naming_objects("two.ids"))[0] == 2);
  CHECK(exr.read(naming_objects("ids", "one"), {.normals = true})[3] == 4);
  CHECK(exr.read(naming({.object_index = "ids", .material_index = "", .depth = "", .normal = "N"}, "two"),
                 {.normals = true})[3] == 5);
  CHECK(exr.fault(naming_objects("ids")) ==
        "channels.object_index = \"ids\"; expected one of the channels of that name: one.ids, two.ids");
}

TEST_CASE("Actors alone are in their layer, also in parts and with named channels") {
  const Exr parts(
      {{.name = "Scene", .numbers = {{"IndexOB.X", 1}}}, {.name = "Actors", .numbers = {{"IndexOB.X", 2}}}});
  CHECK(parts.read({.actor_layer = "Actors"}, {.actors = true}) ==
        Read{1, kNone, kNone, kNone, kNone, kNone, 2});
  const Exr bare({{"IndexOB.X", 1}, {"Actors.IndexOB.X", 2}});
  CHECK(bare.read({.actor_layer = "Actors"}, {.actors = true}).back() == 2);
  const Exr named({{"Scene.ids.R", 1}, {"Actors.ids.R", 2}});
  CHECK(named.read(naming_objects("Scene.ids.R", "", "Actors"), {.actors = true}).back() == 2);
  const Exr same({{"Scene.IndexOB.X", 3}});
  CHECK(same.read({.layer = "Scene", .actor_layer = "Scene"}, {.actors = true}) ==
        Read{3, kNone, kNone, kNone, kNone, kNone, 3});
}

TEST_CASE("Depth for labels is read where a file has it, and missed nowhere") {
  const PassNeeds needs = {.depth_if_there = true};
  CHECK(Exr({{"A.IndexOB.X", 1}, {"A.Depth.Z", 7}}).read({}, needs)[2] == 7);
  CHECK(Exr({{"A.IndexOB.X", 1}, {"A.Depth.Z", 7}}).read()[2] == kNone);
  CHECK(Exr({{"A.IndexOB.X", 1}}).read({}, needs)[2] == kNone);
}

TEST_CASE("An index that was written as a picture is named by its red") {
  const std::string rule = "no object index channel; expected one such as Scene.IndexOB.X; the file has: ";
  const std::string hint =
      "; an index that was written as a picture is named by \"channels\": {\"object_index\": ";
  CHECK(Exr({{"R", 1}, {"G", 1}, {"B", 1}}).fault() == rule + "B, G, R" + hint + "\"R\"} in the manifest");
  CHECK(Exr({{"Mask.R", 1}, {"Mask.G", 1}, {"Mask.B", 1}}).fault() ==
        rule + "Mask.B, Mask.G, Mask.R" + hint + "\"Mask.R\"} in the manifest");
  CHECK(Exr({{"R", 1}, {"G", 1}, {"Mask.B", 1}}).fault() == rule + "G, Mask.B, R");
  CHECK(Exr({{"R", 1}, {"G", 1}, {"B", 1}}).read(naming_objects("R"))[0] == 1);
}

TEST_CASE("Pictures that no pinhole camera with the manifest's pixels makes are refused") {
  exr_forms::Part part = {.display = window(0, 0, 1, 1), .channels = {{"IndexOB.X", floats({1})}}};
  const TestFolder folder;
  const Path file = folder / "f.exr";
  const auto fault_of = [&](const ExrLayout& layout) {
    exr_forms::write(file, {part});
    return message_of<DataError>([&] { (void)read_passes(file, layout); }).substr(file.string().size());
  };
  part.pixel_aspect = 2;
  CHECK(fault_of({.pixel_aspect = 1}) ==
        ": pixelAspectRatio = 2; expected 1, the manifest's camera.fy_px / camera.fx_px");
  CHECK(read_passes(file, {.pixel_aspect = 2.01}).object_index.at(0, 0) == 1);
  CHECK(read_passes(file, {}).object_index.at(0, 0) == 1);
  part.pixel_aspect = 1;  // what writers state who know nothing of it
  exr_forms::write(file, {part});
  CHECK(read_passes(file, {.pixel_aspect = 2}).object_index.at(0, 0) == 1);
  part.environment = Imf::ENVMAP_LATLONG;
  CHECK(fault_of({}) == ": envmap = latlong; expected none: the picture of a pinhole camera");
  part.environment = Imf::ENVMAP_CUBE;
  CHECK(fault_of({}) == ": envmap = cube; expected none: the picture of a pinhole camera");
}

TEST_CASE("Available planes are found without reading them") {
  const auto has_passes = [](const Exr& exr, const ExrLayout& layout = {}) {
    const PassNeeds planes = planes_in_exr(exr.file, layout);
    return std::vector<bool>{planes.depth, planes.normals, planes.actors};
  };
  using HasPasses = std::vector<bool>;
  CHECK(has_passes(Exr(layer("Scene.", 1))) == HasPasses{true, true, false});
  CHECK(has_passes(Exr({{"IndexOB.X", 1}})) == HasPasses{false, false, false});
  CHECK(has_passes(Exr({{"IndexOB.X", 1}, {"N.X", 1}, {"N.Y", 1}})) == HasPasses{false, false, false});
  const Exr two(both(layer("A.", 1), {{"B.IndexOB.X", 2}}));
  CHECK(has_passes(two, {.layer = "A", .actor_layer = "B"}) == HasPasses{true, true, true});
  CHECK(has_passes(two, {.layer = "B"}) == HasPasses{false, false, false});
  CHECK(has_passes(Exr({{"A.IndexOB.X", 1}}), {.layer = "A", .actor_layer = "B"}) ==
        HasPasses{false, false, false});
  const Exr named({{"A.ids", 1}, {"A.far", 2}});
  CHECK(has_passes(named,
                   naming({.object_index = "A.ids", .material_index = "", .depth = "A.far", .normal = ""})) ==
        HasPasses{true, false, false});
  CHECK(message_of<DataError>([&] { (void)planes_in_exr(two.file, {}); }) ==
        two.file.string() + ": IndexOB is in several layers: A, B" + kSeveral);
}

}  // namespace exr_layers_test
