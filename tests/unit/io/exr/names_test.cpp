/// Names of channels of an EXR file, and the layer, pass and component they mean.

#include "io/exr/header.h"
#include "support/catch.h"

namespace exr_names_test {

using namespace thermal;

namespace {

std::string apart(const ExrChannel& channel) {
  return channel.layer + " | " + channel.pass + " | " + channel.component;
}

/// Channels of one part.
std::vector<std::string> apart(const std::vector<std::string>& names,
                               const std::vector<std::string>& views = {}) {
  std::vector<ExrChannel> channels;
  for (const std::string& name : names) channels.emplace_back().name = name;
  name_channels(channels, {.parts = {{.name = "", .view = ""}}, .views = views});
  std::vector<std::string> described;
  for (const ExrChannel& channel : channels) described.push_back(apart(channel));
  return described;
}

std::string one(const std::string& name, const std::vector<std::string>& views = {}) {
  return apart({name}, views).front();
}

struct NamedPart {
  std::string name;
  std::string channel;
  std::string view = {};
};

/// A channel each of several parts.
std::vector<ExrChannel> in_parts(const std::vector<NamedPart>& parts) {
  std::vector<ExrChannel> channels;
  ExrParts file;
  for (const NamedPart& part : parts) {
    ExrChannel& channel = channels.emplace_back();
    channel.part = static_cast<int>(file.parts.size());
    channel.name = part.channel;
    file.parts.push_back({.name = part.name, .view = part.view});
  }
  name_channels(channels, file);
  return channels;
}

/// The first channel's, of a file with one more part.
std::string in_part(const std::string& part, const std::string& channel) {
  return apart(in_parts({{.name = part, .channel = channel}, {.name = "other", .channel = "q"}}).front());
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("A name is layer, pass and component, joined by dots") {
  CHECK(one("IndexOB") == " | IndexOB | ");
  CHECK(one("IndexOB.X") == " | IndexOB | X");
  CHECK(one("Scene.IndexOB.X") == "Scene | IndexOB | X");
  CHECK(one("View Layer.Object Index.V") == "View Layer | Object Index | V");
  CHECK(one("rig.left.IndexOB") == "rig.left | IndexOB | ");
  CHECK(one("rig.left.N.green") == "rig.left | N | G");
  CHECK(one("Z") == " | Z | ");
  CHECK(one("a..b") == "a |  | b");
  CHECK(one(".") == " |  | ");
  CHECK(one("") == " |  | ");
}

TEST_CASE("Z after a layer is its depth, and after a pass the pass's component") {
  CHECK(apart({"Scene.IndexOB.X", "Scene.Z"}) == Texts{"Scene | IndexOB | X", "Scene | Z | "});
  CHECK(apart({"beauty.R", "beauty.Z"}) == Texts{" | beauty | R", "beauty | Z | "});
  CHECK(apart({"Scene.Mist.Z", "Scene.Depth.Z"}) == Texts{"Scene | Mist | Z", "Scene | Depth | Z"});
  CHECK(apart({"S.Vector.X", "S.Vector.Y", "S.Vector.Z"}) ==
        Texts{"S | Vector | X", "S | Vector | Y", "S | Vector | Z"});
  CHECK(apart({"P.X", "P.Z", "P.R"}) == Texts{" | P | X", " | P | Z", " | P | R"});
}

TEST_CASE("A part's name is the layer of channels without one") {
  CHECK(in_part("Scene", "IndexOB") == "Scene | IndexOB | ");
  CHECK(in_part("Scene", "IndexOB.X") == "Scene | IndexOB | X");
  CHECK(in_part("Scene.IndexOB", "X") == "Scene | IndexOB | X");
  CHECK(in_part("IndexOB", "X") == " | IndexOB | X");
  CHECK(in_part("depth", "depth.Z") == " | depth | Z");
  CHECK(in_part("Scene.Depth", "Depth.Z") == "Scene | Depth | Z");
  CHECK(in_part("Position", "Z") == " | Position | Z");
  CHECK(in_part("ViewLayer.Object Index", "ViewLayer.Object Index.X") == "ViewLayer | Object Index | X");
  CHECK(in_part("", "IndexOB.X") == " | IndexOB | X");
  CHECK(apart(in_parts({{.name = "only", .channel = "IndexOB.X"}}).front()) == " | IndexOB | X");
}

TEST_CASE("Several views make one layer each, however they are declared") {
  const Texts views = {"left", "right"};
  CHECK(one("ViewLayer.IndexOB.left.X", views) == "ViewLayer.left | IndexOB | X");  // Blender 3.4
  CHECK(one("ViewLayer.left.IndexOB.X", views) == "ViewLayer.left | IndexOB | X");  // OpenEXR
  CHECK(one("right.IndexOB", views) == "right | IndexOB | ");
  CHECK(one("IndexOB.X", views) == " | IndexOB | X");
  CHECK(one("left", views) == " | left | ");
  CHECK(apart({"S.left.IndexOB.X", "S.left.Z"}, views) == Texts{"S.left | IndexOB | X", "S.left | Z | "});

  const std::vector<ExrChannel> blender5 = in_parts(
      {{.name = "ViewLayer.Object Index-left", .channel = "ViewLayer.Object Index.X", .view = "left"},
       {.name = "ViewLayer.Object Index-right", .channel = "ViewLayer.Object Index.X", .view = "right"}});
  CHECK(apart(blender5[0]) == "ViewLayer.left | Object Index | X");
  CHECK(apart(blender5[1]) == "ViewLayer.right | Object Index | X");
  const std::vector<ExrChannel> bare = in_parts({{.name = "left", .channel = "IndexOB.X", .view = "left"},
                                                 {.name = "depth_right", .channel = "Z", .view = "right"},
                                                 {.name = "bright", .channel = "N.X", .view = "right"}});
  CHECK(apart(bare[0]) == "left | IndexOB | X");
  CHECK(apart(bare[1]) == "right | depth | Z");
  CHECK(apart(bare[2]) == "bright.right | N | X");
}

TEST_CASE("A single view is ignored") {
  const std::vector<ExrChannel> channels = in_parts({{.name = "a", .channel = "S.IndexOB.X", .view = "main"},
                                                     {.name = "b", .channel = "S.Depth.Z", .view = "main"}});
  CHECK(apart(channels[0]) == "S | IndexOB | X");
  CHECK(apart(channels[1]) == "S | Depth | Z");
}

TEST_CASE("Equal names in several parts are distinguished by the parts' names") {
  const std::vector<ExrChannel> channels = in_parts({{.name = "one", .channel = "S.IndexOB.X"},
                                                     {.name = "", .channel = "S.IndexOB.X"},
                                                     {.name = "three", .channel = "S.Depth.Z"}});
  CHECK(full_names(channels) == Texts{"one.S.IndexOB.X", "part 1.S.IndexOB.X", "S.Depth.Z"});
}

TEST_CASE("Passes are recognised by every known spelling") {
  for (const char* name : {"IndexOB", "indexob", "Object Index", "object_index", "OBJECT-INDEX", "ObjectID",
                           "object_id", "Object ID"})
    CHECK(pass_kind_of(name) == PassKind::object_index);
  for (const char* name : {"IndexMA", "Material Index", "material_index", "MaterialID", "material id"})
    CHECK(pass_kind_of(name) == PassKind::material_index);
  for (const char* name : {"Depth", "depth", "Z", "z"}) CHECK(pass_kind_of(name) == PassKind::depth);
  for (const char* name : {"Normal", "normal", "N"}) CHECK(pass_kind_of(name) == PassKind::normal);
  for (const char* name :
       {"", "Denoising Depth", "Denoising Normal", "Mist", "Index", "ID", "CryptoObject00", "Combined"})
    CHECK(pass_kind_of(name) == std::nullopt);
}

namespace {

/// Name of the selected channel among those of one layer.
std::string taken(const Texts& names, PassKind kind, const std::string& axis = "") {
  std::vector<ExrChannel> channels;
  for (const std::string& name : names) channels.emplace_back().name = name;
  name_channels(channels, {.parts = {{.name = "", .view = ""}}, .views = {}});
  std::vector<const ExrChannel*> all;
  for (const ExrChannel& channel : channels) all.push_back(&channel);
  const ExrChannel* best = best_of(all, kind, axis);
  return best == nullptr ? "none" : best->name;
}

}  // namespace

TEST_CASE("Of several components the usual one is taken, and alpha last") {
  CHECK(taken({"IndexOB.A", "IndexOB.B", "IndexOB.G", "IndexOB.R"}, PassKind::object_index) == "IndexOB.R");
  CHECK(taken({"IndexOB.A", "IndexOB.Q"}, PassKind::object_index) == "IndexOB.Q");
  CHECK(taken({"IndexOB.A"}, PassKind::object_index) == "IndexOB.A");
  CHECK(taken({"IndexOB.R", "IndexOB.V", "IndexOB.x"}, PassKind::object_index) == "IndexOB.x");
  CHECK(taken({"ObjectID.X", "IndexOB.V"}, PassKind::object_index) == "IndexOB.V");
  CHECK(taken({"Depth.R", "Depth.V", "Depth.X", "Depth.Z"}, PassKind::depth) == "Depth.Z");
  CHECK(taken({"Z", "Depth.V"}, PassKind::depth) == "Depth.V");
  CHECK(taken({"Depth.Z"}, PassKind::normal, "Z") == "none");
}

TEST_CASE("Normals are X, Y, Z or R, G, B") {
  const Texts letters = {"N.x", "N.y", "N.z"};
  CHECK(taken(letters, PassKind::normal, "X") == "N.x");
  CHECK(taken(letters, PassKind::normal, "Z") == "N.z");
  const Texts colours = {"Normal.B", "Normal.G", "Normal.R"};
  CHECK(taken(colours, PassKind::normal, "X") == "Normal.R");
  CHECK(taken(colours, PassKind::normal, "Y") == "Normal.G");
  CHECK(taken(colours, PassKind::normal, "Z") == "Normal.B");
  CHECK(taken({"N.R", "N.X"}, PassKind::normal, "X") == "N.X");
  CHECK(taken({"N.X"}, PassKind::normal, "Y") == "none");
}

}  // namespace exr_names_test
