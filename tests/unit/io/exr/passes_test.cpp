#include "io/exr/passes.h"

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include <sys/resource.h>

#include "base/error.h"
#include "io/exr/file.h"
#include "io/exr/passes_writer.h"
#include "support/catch.h"
#include "support/exr.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace exr_passes_test {

using namespace thermal;

namespace {

const std::vector<float> kObjects = {0, 1, 2, 3, 300, 32767};
const std::vector<float> kMaterials = {5, 4, 3, 2, 1, 0};
const std::vector<float> kAnything(6, 0.5F);

std::vector<int> pixels_of(const Plane<std::uint16_t>& plane) {
  return {plane.pixels().begin(), plane.pixels().end()};
}

/// While it lives, no file of this process grows beyond a size: writing fails then, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uintmax_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

/// A folder with one EXR file of 3 x 2 px.
struct Exr {
  explicit Exr(const ExrChannels& channels, Imf::PixelType type = Imf::FLOAT,
               Imf::Compression compression = Imf::ZIP_COMPRESSION) {
    write_exr(file, 3, 2, channels, type, compression);
  }
  [[nodiscard]] Passes read(const std::string& layer = "") const {
    return read_passes(file, {.layer = layer, .actor_layer = "", .width_px = 3, .height_px = 2});
  }

  TestFolder folder;
  Path file = folder / "000000.exr";
};

/// The fault of the data of a file, without its name.
std::string fault_in(const ExrChannels& channels, const std::string& layer = "") {
  const Exr exr(channels);
  const std::string message = message_of<DataError>([&] { (void)exr.read(layer); });
  const std::string name = exr.file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : "not named: " + message;
}

/// The fault of an object index plane whose pixel (1, 1) is `value`.
std::string fault_of_index(float value) {
  std::vector<float> pixels = kObjects;
  pixels[4] = value;
  return fault_in({{"Scene.IndexOB.X", pixels}});
}

}  // namespace

TEST_CASE("Index planes are read exactly") {
  const Exr exr(
      {{"Scene.IndexOB.X", kObjects}, {"Scene.IndexMA.X", kMaterials}, {"Scene.Depth.Z", kAnything}});
  const Passes passes = exr.read();
  CHECK(passes.object_index.width_px() == 3);
  CHECK(passes.object_index.height_px() == 2);
  CHECK(pixels_of(passes.object_index) == std::vector<int>{0, 1, 2, 3, 300, 32767});
  CHECK(pixels_of(passes.material_index) == std::vector<int>{5, 4, 3, 2, 1, 0});
}

TEST_CASE("A file without a material index has none") {
  CHECK(Exr({{"Scene.IndexOB.X", kObjects}}).read().material_index.empty());
}

TEST_CASE("Planes are read only if they are requested") {
  const Exr exr({{"Scene.IndexOB.X", kObjects},
                 {"Scene.Depth.Z", {1, 2, 3, 4, 5, 1e10F}},
                 {"Scene.Normal.X", {0, 0, 0, 0, 0, 0}},
                 {"Scene.Normal.Y", {1, 0, 0, 0, 0, 0}},
                 {"Scene.Normal.Z", {0, 1, 1, 1, 1, 1}}});
  CHECK(exr.read().depth_m.empty());
  const Passes passes = read_passes(exr.file, {.layer = "", .actor_layer = "", .width_px = 3, .height_px = 2},
                                    {.depth = true, .normals = true});
  CHECK(passes.depth_m.at(1, 1) == 5);
  CHECK(passes.normal[1].at(0, 0) == 1);
  CHECK(passes.normal[2].at(0, 0) == 0);
}

namespace {

const std::vector<float> kActors = {0, 0, 2, 0, 300, 0};

/// Actors that read_passes reads from a file when this layer is requested; `layer` is that of everything.
std::vector<int> actors_of(const ExrChannels& channels, const std::string& actor_layer,
                           const std::string& layer = "Scene") {
  const Exr exr(channels);
  const Passes passes =
      read_passes(exr.file, {.layer = layer, .actor_layer = actor_layer, .width_px = 3, .height_px = 2},
                  {.actors = true});
  CHECK(pixels_of(passes.object_index) == std::vector<int>{0, 1, 2, 3, 300, 32767});
  return pixels_of(passes.actor_index);
}

}  // namespace

TEST_CASE("Actors alone are read from their layer, if requested") {
  const ExrChannels both = {{"Scene.IndexOB.X", kObjects}, {"Actors.IndexOB.X", kActors}};
  CHECK(actors_of(both, "Actors") == std::vector<int>{0, 0, 2, 0, 300, 0});
  CHECK(actors_of(both, "Actors", "") ==
        std::vector<int>{0, 0, 2, 0, 300, 0});  // the other one is everything
  const Exr exr(both);
  CHECK(read_passes(exr.file, {.layer = "Scene", .actor_layer = "", .width_px = 3, .height_px = 2})
            .actor_index.empty());
  CHECK(read_passes(exr.file, {.layer = "Scene", .actor_layer = "Actors", .width_px = 3, .height_px = 2}, {})
            .actor_index.empty());
}

TEST_CASE("A frame may lack the layer of actors") {
  CHECK(actors_of({{"Scene.IndexOB.X", kObjects}, {"Actors.Depth.Z", kAnything}}, "Actors").empty());
}

TEST_CASE("A frame whose actor layer has another name is an error") {
  const Exr exr({{"Scene.IndexOB.X", kObjects}, {"Actors.IndexOB.X", kActors}});
  const auto fault_of = [&](const std::string& actor_layer) {
    return message_of<DataError>([&] {
      (void)read_passes(exr.file,
                        {.layer = "Scene", .actor_layer = actor_layer, .width_px = 3, .height_px = 2},
                        {.actors = true});
    });
  };
  CHECK(fault_of("Actor") ==
        exr.file.string() +
            ": actor_layer = \"Actor\"; expected a layer with an object index: Actors; did "
            "you mean \"Actors\"?");
  CHECK(fault_of("People") ==
        exr.file.string() + ": actor_layer = \"People\"; expected a layer with an object index: Actors");
}

TEST_CASE("Indices of actors alone are checked as all are") {
  const Exr exr({{"Scene.IndexOB.X", kObjects}, {"Actors.IndexOB.X", kAnything}});
  CHECK(message_of<DataError>([&] {
          (void)read_passes(exr.file,
                            {.layer = "Scene", .actor_layer = "Actors", .width_px = 3, .height_px = 2},
                            {.actors = true});
        }) == exr.file.string() +
                  ": Actors.IndexOB.X at pixel (0, 0) = 0.5; expected a whole number from 0 to 32767");
}

TEST_CASE("A plane that the terms need must exist") {
  const Exr exr({{"Scene.IndexOB.X", kObjects}});
  CHECK(message_of<DataError>([&] {
          (void)read_passes(exr.file, {.layer = "", .actor_layer = "", .width_px = 3, .height_px = 2},
                            {.depth = true});
        }) ==
        exr.file.string() + ": no depth channel, which the chosen terms need; the file has: Scene.IndexOB.X");
}

TEST_CASE("Other renderers' spellings are recognised") {
  const auto name = GENERATE(as<std::string>{}, "Scene.IndexOB.X", "ViewLayer.IndexOB.X",
                             "RenderLayer.IndexOB.X", "View Layer.IndexOB.X", "ViewLayer.Object Index.V",
                             "IndexOB.X", "IndexOB", "Object Index", "rig.left.IndexOB.Z");
  CAPTURE(name);
  CHECK(pixels_of(Exr({{name, kObjects}, {"Combined.R", kAnything}}).read().object_index) ==
        std::vector<int>{0, 1, 2, 3, 300, 32767});
}

TEST_CASE("Pixels may be stored as any type the format has") {
  const std::vector<float> small = {0, 1, 2, 3, 300, 2048};  // all of them exact in half precision
  const auto type = GENERATE(Imf::HALF, Imf::FLOAT, Imf::UINT);
  CHECK(pixels_of(Exr({{"Scene.IndexOB.X", small}}, type).read().object_index) ==
        std::vector<int>{0, 1, 2, 3, 300, 2048});
}

TEST_CASE("Channel names are parsed") {
  const Exr exr({{"Scene.IndexOB.X", kObjects}, {"a.b.Depth", kAnything}, {"Z", kAnything}}, Imf::HALF);
  const ExrHeader header = read_exr_header(exr.file);
  CHECK(header.width_px == 3);
  CHECK(header.height_px == 2);
  CHECK(header.compression == "ZIP");
  REQUIRE(header.channels.size() == 3);
  CHECK(header.channels[0].layer == "Scene");
  CHECK(header.channels[0].pass == "IndexOB");
  CHECK(header.channels[0].component == "X");
  CHECK(header.channels[0].type == "half");
  CHECK(header.channels[1].pass == "Z");
  CHECK(header.channels[1].layer.empty());
  CHECK(header.channels[1].component.empty());
  CHECK(header.channels[2].layer == "a.b");
  CHECK(header.channels[2].pass == "Depth");
  CHECK(read_exr_channel(exr.file, header, header.channels[1]).at(2, 1) == 0.5F);
}

TEST_CASE("Compressions have their usual names") {
  const auto [compression, name] = GENERATE(table<Imf::Compression, std::string>(
      {{Imf::NO_COMPRESSION, "none"}, {Imf::RLE_COMPRESSION, "RLE"}, {Imf::PIZ_COMPRESSION, "PIZ"}}));
  const Exr exr({{"IndexOB", kObjects}}, Imf::FLOAT, compression);
  CHECK(read_exr_header(exr.file).compression == name);
  CHECK(pixels_of(exr.read().object_index)[5] == 32767);
}

TEST_CASE("With several layers, the manifest says which") {
  const ExrChannels channels = {{"Actors.IndexOB.X", std::vector<float>(6, 1)},
                                {"Scene.IndexOB.X", kObjects}};
  CHECK(pixels_of(Exr(channels).read("Actors").object_index) == std::vector<int>(6, 1));
  CHECK(pixels_of(Exr(channels).read("Scene").object_index)[5] == 32767);
  CHECK(fault_in(channels) ==
        "IndexOB is in several layers: Actors, Scene; expected the manifest's \"layer\" to name one");
}

TEST_CASE("Without an object index the existing channels are listed") {
  const ExrChannels channels = {{"Scene.Combined.R", kAnything}, {"Scene.Depth.Z", kAnything}};
  CHECK(fault_in(channels) ==
        "no object index channel; expected one such as Scene.IndexOB.X; the file has: "
        "Scene.Combined.R, Scene.Depth.Z");
  CHECK(fault_in({{"Scene.IndexOB.X", kObjects}}, "Actors") ==
        "layer = \"Actors\"; expected a layer with an object index: Scene");
}

TEST_CASE("A number that is not an index is reported with its channel and pixel") {
  const std::string where = "Scene.IndexOB.X at pixel (1, 1) = ";
  const std::string rule = "; expected a whole number from 0 to 32767";
  CHECK(fault_of_index(std::numeric_limits<float>::quiet_NaN()) == where + "nan" + rule);
  CHECK(fault_of_index(-1) == where + "-1" + rule);
  CHECK(fault_of_index(2.5F) == where + "2.5" + rule);
  CHECK(fault_of_index(32768) == where + "32768" + rule);
  CHECK(fault_of_index(std::numeric_limits<float>::infinity()) == where + "inf" + rule);
  CHECK(fault_of_index(1e-30F) == where + "1e-30" + rule);
}

TEST_CASE("A bad material index is reported too") {
  CHECK(fault_in({{"Scene.IndexOB.X", kObjects}, {"Scene.IndexMA.X", {0, 0, 0.25F, 0, 0, 0}}}) ==
        "Scene.IndexMA.X at pixel (2, 0) = 0.25; expected a whole number from 0 to 32767");
}

TEST_CASE("Minus zero is index 0") {
  CHECK(pixels_of(Exr({{"IndexOB", std::vector<float>(6, -0.0F)}}).read().object_index) ==
        std::vector<int>(6, 0));
}

TEST_CASE("A file whose size differs from the manifest's is an error") {
  const Exr exr({{"Scene.IndexOB.X", kObjects}});
  CHECK(message_of<DataError>([&] {
          (void)read_passes(exr.file, {.layer = "", .actor_layer = "", .width_px = 640, .height_px = 512});
        }) == exr.file.string() + ": size = 3 x 2 px; expected the manifest's 640 x 512 px");
  CHECK(read_passes(exr.file, {.layer = "", .actor_layer = "", .width_px = 0, .height_px = 0})
            .object_index.size() == 6);  // 0: any size
}

TEST_CASE("A missing file, or one that is not EXR, cannot be read") {
  const TestFolder folder;
  const Path missing = folder / "missing.exr";
  CHECK(message_of<IoError>([&] {
          (void)read_passes(missing, {.layer = "", .actor_layer = "", .width_px = 3, .height_px = 2});
        }) == "cannot read " + missing.string() + ": no such file");
  const Path text = folder.file("text.exr", "this is a text, and long enough to hold a header");
  CHECK_THAT(message_of<IoError>([&] {
               (void)read_passes(text, {.layer = "", .actor_layer = "", .width_px = 3, .height_px = 2});
             }),
             StartsWith("cannot read " + text.string() + ": "));
}

TEST_CASE("A file truncated anywhere is an error that names it, never a picture") {
  const Exr exr({{"Scene.IndexOB.X", kObjects}});
  const auto bytes = std::filesystem::file_size(exr.file);
  for (auto length = bytes; length-- > 0;) {
    std::filesystem::resize_file(exr.file, length);
    CAPTURE(length, bytes);
    REQUIRE_THAT(message_of<IoError>([&] { (void)exr.read(); }),
                 StartsWith("cannot read " + exr.file.string()));
  }
}

namespace {

const ExrLayout kAnyLayout = {.layer = "", .actor_layer = "", .width_px = 0, .height_px = 0};

/// Planes of a frame of 3 x 2 px with all planes, to which `add` is added.
ExrChannels all_planes(float add) {
  ExrChannels channels = {{"Scene.IndexOB.X", kObjects}, {"Scene.IndexMA.X", kMaterials}};
  for (const char* name : {"Scene.Depth.Z", "Scene.Normal.X", "Scene.Normal.Y", "Scene.Normal.Z"})
    channels[name] = std::vector<float>(6, 0.5F + add);
  for (float& index : channels["Scene.IndexMA.X"]) index += add;
  return channels;
}

bool same(const Passes& a, const Passes& b) {
  return a.object_index == b.object_index && a.material_index == b.material_index &&
         a.actor_index == b.actor_index && a.depth_m == b.depth_m && a.normal == b.normal &&
         a.ranks.size() == b.ranks.size();
}

}  // namespace

TEST_CASE("A buffer holds the requested planes of the last frame, in the same memory") {
  const PassNeeds all = {.depth = true, .normals = true, .actors = false};
  const Exr first(all_planes(0));
  const Exr second(all_planes(1));
  const Exr plain({{"Scene.IndexOB.X", kObjects}});
  PassBuffer buffer;
  read_passes(first.file, kAnyLayout, all, buffer);
  CHECK(same(buffer.passes, read_passes(first.file, kAnyLayout, all)));
  const float* depth = buffer.passes.depth_m.pixels().data();
  const std::uint16_t* objects = buffer.passes.object_index.pixels().data();
  buffer.passes.ranks.resize(1);
  read_passes(second.file, kAnyLayout, all, buffer);
  CHECK(same(buffer.passes, read_passes(second.file, kAnyLayout, all)));
  CHECK(buffer.passes.depth_m.pixels().data() == depth);
  CHECK(buffer.passes.object_index.pixels().data() == objects);
  read_passes(plain.file, kAnyLayout, {}, buffer);
  CHECK(same(buffer.passes, read_passes(plain.file, kAnyLayout)));
  CHECK(buffer.passes.depth_m.empty());
  CHECK(buffer.passes.material_index.empty());
}

TEST_CASE("A buffer keeps nothing of a frame that could not be read") {
  const PassNeeds all = {.depth = true, .normals = true, .actors = false};
  const Exr good({{"Scene.IndexOB.X", kObjects},
                  {"Scene.Depth.Z", kAnything},
                  {"Scene.Normal.X", kAnything},
                  {"Scene.Normal.Y", kAnything},
                  {"Scene.Normal.Z", kAnything}});
  ExrChannels planes = all_planes(7);
  planes["Scene.IndexMA.X"][5] = -1;
  const Exr bad(planes);
  PassBuffer buffer;
  CHECK_THROWS_AS(read_passes(bad.file, kAnyLayout, all, buffer), DataError);
  read_passes(good.file, kAnyLayout, all, buffer);
  CHECK(same(buffer.passes, read_passes(good.file, kAnyLayout, all)));
}

TEST_CASE("A smaller or larger frame than the last is read completely into its buffer") {
  const Exr small(all_planes(0));
  TestFolder folder;
  const Path large = folder / "large.exr";
  write_exr(large, 40, 30, {{"Scene.IndexOB.X", std::vector<float>(1200, 9)}});
  PassBuffer buffer;
  for (const Path& file : {small.file, large, small.file}) {
    read_passes(file, kAnyLayout, {}, buffer);
    CHECK(same(buffer.passes, read_passes(file, kAnyLayout)));
  }
}

TEST_CASE("Written passes are read back with the same bits") {
  const TestFolder folder;
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(3, 2, 32767);
  passes.material_index = Plane<std::uint16_t>(3, 2, 12);
  passes.actor_index = Plane<std::uint16_t>(3, 2, 101);
  passes.depth_m = Plane<float>(3, 2, 1e10F);
  for (Plane<float>& axis : passes.normal) axis = Plane<float>(3, 2, -0.57735026F);
  passes.object_index.at(2, 1) = 0;
  passes.depth_m.at(0, 1) = 61.25F;
  passes.normal[1].at(1, 0) = 0.1F;
  for (const ExrPacking packing : {ExrPacking::none, ExrPacking::run_lengths}) {
    const Path file = folder / "000000.exr";
    write_passes(file, passes, "Scene", "Actors", packing);
    const Passes read =
        read_passes(file, {.layer = "Scene", .actor_layer = "Actors", .width_px = 3, .height_px = 2},
                    {.depth = true, .normals = true, .actors = true});
    CHECK(read.object_index == passes.object_index);
    CHECK(read.material_index == passes.material_index);
    CHECK(read.actor_index == passes.actor_index);
    CHECK(read.depth_m == passes.depth_m);
    CHECK(read.normal == passes.normal);
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  }
}

TEST_CASE("What water mirrors is written in a layer of its own, and read where it is needed") {
  const TestFolder folder;
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(3, 2, 4);
  write_passes(folder / "dry.exr", passes, "Scene", "", ExrPacking::run_lengths);
  passes.mirrored.object_index = Plane<std::uint16_t>(3, 2, 101);
  passes.mirrored.material_index = Plane<std::uint16_t>(3, 2, 7);
  passes.mirrored.depth_m = Plane<float>(3, 2, 61.25F);
  for (Plane<float>& axis : passes.mirrored.normal) axis = Plane<float>(3, 2, 0.57735026F);
  passes.mirrored.object_index.at(1, 1) = 0;
  write_passes(folder / "wet.exr", passes, "Scene", "", ExrPacking::run_lengths);
  for (const char* layer : {"Scene", ""}) {
    const ExrLayout layout = {
        .layer = layer, .actor_layer = "", .mirror_layer = "Mirror", .width_px = 3, .height_px = 2};
    const Passes wet = read_passes(folder / "wet.exr", layout, {.mirrored = true});
    CHECK(wet.object_index == passes.object_index);
    CHECK(wet.mirrored.object_index == passes.mirrored.object_index);
    CHECK(wet.mirrored.material_index == passes.mirrored.material_index);
    CHECK(wet.mirrored.depth_m == passes.mirrored.depth_m);
    CHECK(wet.mirrored.normal == passes.mirrored.normal);
    CHECK(wet.depth_m.empty());
    CHECK(read_passes(folder / "wet.exr", layout).mirrored.empty());
    CHECK(read_passes(folder / "dry.exr", layout, {.mirrored = true}).mirrored.empty());
    CHECK(planes_in_exr(folder / "dry.exr", layout).mirrored);
  }
  CHECK_FALSE(planes_in_exr(folder / "wet.exr", {.layer = "Scene"}).mirrored);
}

TEST_CASE("Passes that are sampled where it matters are read as they were written") {
  const TestFolder folder;
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(3, 2, 4);
  passes.material_index = Plane<std::uint16_t>(3, 2, 9);
  passes.depth_m = Plane<float>(3, 2, 61.25F);
  FineSamples& fine = passes.fine;
  fine.factor = 2;
  fine.row_begin = {0, 1, 3};
  fine.x_px = {1, 0, 2};
  fine.object_index = {5, 6, 7, 8, 10, 11, 12, 13, 14, 15, 16, 17};  // 2 lines of a pixel, 2 of two
  fine.material_index.assign(12, 1);
  fine.depth_m.assign(12, 60.5F);
  // A file has no room for what such pixels would have with one sample: their first one.
  passes.object_index.at(1, 0) = 5;
  passes.object_index.at(0, 1) = 10;
  passes.object_index.at(2, 1) = 12;
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {2, 1}}) {
    passes.material_index.at(x, y) = 1;
    passes.depth_m.at(x, y) = 60.5F;
  }
  write_passes(folder / "000000.exr", passes, "Scene", "", ExrPacking::run_lengths);
  const ExrLayout layout = {.layer = "Scene", .supersample = 2, .width_px = 6, .height_px = 4};
  const Passes read = read_passes(folder / "000000.exr", layout, {.depth = true});
  CHECK(read.object_index == passes.object_index);
  CHECK(read.material_index == passes.material_index);
  CHECK(read.depth_m == passes.depth_m);
  CHECK(read.fine.factor == 2);
  CHECK(read.fine.row_begin == fine.row_begin);
  CHECK(read.fine.x_px == fine.x_px);
  CHECK(read.fine.object_index == fine.object_index);
  CHECK(read.fine.material_index == fine.material_index);
  CHECK(read.fine.depth_m == fine.depth_m);
  CHECK(read_passes(folder / "000000.exr", layout).fine.depth_m.empty());
  // To a manifest without supersampling, it is a larger picture.
  const Passes large = read_passes(folder / "000000.exr", {.layer = "Scene", .width_px = 6, .height_px = 4});
  CHECK(large.fine.factor == 1);
  CHECK(large.object_index.at(3, 1) == 8);
}

TEST_CASE("Passes that cannot be written leave no file") {
  const TestFolder folder;
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(3, 2);
  const Path file = folder / "missing" / "000000.exr";
  CHECK(message_of<IoError>([&] { write_passes(file, passes, "Scene", "", ExrPacking::none); }) ==
        "cannot write " + (folder / "missing" / "part_000000.exr").string() + ": No such file or directory");
}

TEST_CASE("Passes are written whole, or reported: whichever bytes do not fit") {
  const TestFolder folder;
  Passes passes;
  passes.depth_m = Plane<float>(3, 200, 61.25F);
  const Path file = folder / "000000.exr";
  write_passes(file, passes, "Scene", "", ExrPacking::none);
  const auto bytes = std::filesystem::file_size(file);
  std::filesystem::remove(file);
  for (std::uintmax_t most = 0; most < bytes; most += most + 100 < bytes ? 100 : 1) {
    INFO("of " << bytes << " bytes, " << most << " fit");
    const FileSizeLimit limit(most);
    CHECK(message_of<IoError>([&] { write_passes(file, passes, "Scene", "", ExrPacking::none); }) ==
          "cannot write " + (folder / "part_000000.exr").string() + ": File too large");
    CHECK(std::filesystem::is_empty(folder.path()));
  }
}

TEST_CASE("What a killed run left under the temporary name is replaced") {
  const TestFolder folder;
  Passes passes;
  passes.depth_m = Plane<float>(3, 2, 61.25F);
  (void)folder.file("part_000000.exr", "half");
  write_passes(folder / "000000.exr", passes, "Scene", "", ExrPacking::none);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

}  // namespace exr_passes_test
