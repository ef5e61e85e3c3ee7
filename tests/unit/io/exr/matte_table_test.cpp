#include <algorithm>
#include <bit>
#include <tuple>

#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputPart.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/exr/cryptomatte.h"
#include "io/pass_reader.h"
#include "support/catch.h"
#include "support/mattes.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace matte_table_test {

using namespace thermal;

namespace {

constexpr int kWidth = 3;
constexpr int kHeight = 2;
const std::vector<std::string> kNames = {"ground", "anna", "stone_1", "stone_2"};

/// Anna on the ground, an edge between them, stones, an edge to the sky, sky.
const std::vector<MatteRank> kRanks = {
    {{"ground", "anna", "ground", "stone_1", "anna", ""}, {1, 1, 0.625F, 0.5F, 0.75F, 0}},
    {{"", "", "anna", "stone_2", "", ""}, {0, 0, 0.375F, 0.25F, 0, 0}},
    {{"", "", "", "anna", "", ""}, {0, 0, 0, 0.25F, 0, 0}}};

Manifest manifest() {
  Manifest manifest;
  manifest.camera = {
      .width_px = kWidth, .height_px = kHeight, .fx_px = 1, .fy_px = 1, .cx_px = 1, .cy_px = 1};
  manifest.cryptomatte = "CryptoObject";
  manifest.objects = {matte_object(1, "ground"), matte_object(7, "anna"),
                      matte_object(3, "stones", {"stone_*"})};
  return manifest;
}

/// A folder with one file.
struct Exr {
  explicit Exr(const ExrChannels& channels = matte_channels(kRanks),
               const ExrTexts& texts = matte_texts(kNames),
               Imf::Compression compression = Imf::ZIP_COMPRESSION) {
    write_exr_with_texts(file, kWidth, kHeight, channels, texts, compression);
  }
  [[nodiscard]] Passes read(const PassNeeds& needs = {}, const Manifest& by = manifest()) const {
    return PassReader(by).read(file, needs);
  }
  /// Without the file's name.
  [[nodiscard]] std::string fault(const PassNeeds& needs = {}, const Manifest& by = manifest()) const {
    const std::string message = message_of<DataError>([&] { (void)read(needs, by); });
    const std::string name = fmt::format("{}: ", file.string());
    return message.starts_with(name) ? message.substr(name.size()) : fmt::format("not named: {}", message);
  }

  TestFolder folder;
  Path file = folder / "000000.exr";
};

template <typename T>
std::vector<T> values(const Plane<T>& plane) {
  return {plane.pixels().begin(), plane.pixels().end()};
}

using Indices = std::vector<std::uint16_t>;
using Shares = std::vector<float>;

void check_usual(const Passes& passes) {
  CHECK(passes.object_index.width_px() == kWidth);
  CHECK(passes.object_index.height_px() == kHeight);
  CHECK(values(passes.object_index) == Indices{1, 7, 1, 3, 7, 0});
  REQUIRE(passes.ranks.size() == 2);
  CHECK(values(passes.ranks[0].object_index) == Indices{1, 7, 1, 3, 7, 0});
  CHECK(values(passes.ranks[0].coverage) == Shares{1, 1, 0.625F, 0.75F, 0.75F, 0});
  CHECK(values(passes.ranks[1].object_index) == Indices{0, 0, 7, 7, 0, 0});
  CHECK(values(passes.ranks[1].coverage) == Shares{0, 0, 0.375F, 0.25F, 0, 0});
}

/// Other planes of the layer: each pixel's number and one for each plane.
ExrChannels with_other_planes(const std::string& layer = "ViewLayer.") {
  ExrChannels channels = matte_channels(kRanks);
  float first = 100;
  for (const char* name : {"Depth.Z", "Normal.X", "Normal.Y", "Normal.Z", "IndexMA.X"}) {
    for (int i = 0; i < kWidth * kHeight; ++i)
      channels[layer + name].push_back(first + static_cast<float>(i));
    first += 100;
  }
  return channels;
}

}  // namespace

TEST_CASE("A cryptomatte is read to the bit, with any lossless compression") {
  for (const Imf::Compression lossless : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                          Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    check_usual(Exr(matte_channels(kRanks), matte_texts(kNames), lossless).read());
  }
}

TEST_CASE("Lossy compressions are refused") {
  const auto fault_of = [](Imf::Compression compression) {
    return Exr(matte_channels(kRanks), matte_texts(kNames), compression).fault();
  };
  const std::string text =
      "cryptomatte ViewLayer.CryptoObject: ViewLayer.CryptoObject00.r: compression = {}; expected one that "
      "keeps the "
      "bits of hashes: none, RLE, ZIPS, ZIP or PIZ";
  CHECK(fault_of(Imf::PXR24_COMPRESSION) == fmt::format(fmt::runtime(text), "PXR24"));
  CHECK(fault_of(Imf::B44_COMPRESSION) == fmt::format(fmt::runtime(text), "B44"));
  CHECK(fault_of(Imf::B44A_COMPRESSION) == fmt::format(fmt::runtime(text), "B44A"));
  CHECK(fault_of(Imf::DWAA_COMPRESSION) == fmt::format(fmt::runtime(text), "DWAA"));
  CHECK(fault_of(Imf::DWAB_COMPRESSION) == fmt::format(fmt::runtime(text), "DWAB"));
}

TEST_CASE("PXR24 does change hashes") {
  const Exr exr(matte_channels(kRanks), matte_texts(kNames), Imf::PXR24_COMPRESSION);
  const ExrHeader header = read_exr_header(exr.file);
  const Cryptomatte cryptomatte = cryptomattes_in(header).front();
  REQUIRE_FALSE(cryptomatte.channels.empty());
  const Plane<float> hashes = read_exr_channel(exr.file, header, *cryptomatte.channels.front());
  CHECK(std::bit_cast<std::uint32_t>(hashes.at(0, 0)) != cryptomatte_hash("ground"));
}

TEST_CASE("Half floats cannot hold hashes") {
  const Exr exr;
  Imf::Header header(kWidth, kHeight);
  for (const auto& [name, text] : matte_texts(kNames)) header.insert(name, Imf::StringAttribute(text));
  std::vector<half> pixels(kWidth * kHeight);
  Imf::FrameBuffer buffer;
  for (const auto& [name, unused] : matte_channels(kRanks)) {
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    buffer.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels.data()), 2, 2 * kWidth));
  }
  {
    Imf::OutputFile out(exr.file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(kHeight);
  }
  CHECK(exr.fault() ==
        "cryptomatte ViewLayer.CryptoObject: ViewLayer.CryptoObject00.r: type = half; expected float, whose "
        "bits are the "
        "hashes of names");
}

TEST_CASE("A cryptomatte may be in several parts, and in tiles") {
  const Exr exr;
  const ExrChannels channels = matte_channels(kRanks, "CryptoObject");
  std::vector<Imf::Header> headers;
  for (const char* part : {"CryptoObject00", "CryptoObject01"}) {
    Imf::Header& header = headers.emplace_back(kWidth, kHeight);
    header.setName(part);
    header.setType(Imf::TILEDIMAGE);
    header.setTileDescription(Imf::TileDescription(2, 1));
    for (const char* component : {"R", "G", "B", "A"})
      header.channels().insert(component, Imf::Channel(Imf::FLOAT));
    for (const auto& [name, text] : matte_texts(kNames, "CryptoObject"))
      header.insert(name, Imf::StringAttribute(text));
  }
  {
    Imf::MultiPartOutputFile out(exr.file.c_str(), headers.data(), 2);
    for (int number = 0; number < 2; ++number) {
      Imf::FrameBuffer buffer;
      for (const auto& [theirs, ours] : {std::pair("R", "r"), {"G", "g"}, {"B", "b"}, {"A", "a"}}) {
        const std::vector<float>& pixels = channels.at(fmt::format("CryptoObject0{}.{}", number, ours));
        char* const base = reinterpret_cast<char*>(const_cast<float*>(pixels.data()));
        buffer.insert(theirs, Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * kWidth));
      }
      Imf::TiledOutputPart part(out, number);
      part.setFrameBuffer(buffer);
      part.writeTiles(0, part.numXTiles() - 1, 0, part.numYTiles() - 1);
    }
  }
  check_usual(exr.read());
}

TEST_CASE("Pixels outside the data window are sky") {
  const Exr exr;
  Imf::Header header(kWidth, kHeight);
  header.dataWindow() = Imath::Box2i({1, 1}, {2, 1});
  const ExrChannels channels = matte_channels({{{"anna", "ground"}, {1, 0.75F}}});
  Imf::FrameBuffer buffer;
  for (const auto& [name, pixels] : channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    char* const base = reinterpret_cast<char*>(const_cast<float*>(pixels.data()));
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, base, header.dataWindow(), sizeof(float)));
  }
  for (const auto& [name, text] : matte_texts(kNames)) header.insert(name, Imf::StringAttribute(text));
  {
    Imf::OutputFile out(exr.file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  }
  const Passes passes = exr.read();
  CHECK(values(passes.object_index) == Indices{0, 0, 0, 0, 7, 1});
  REQUIRE(passes.ranks.size() == 1);
  CHECK(values(passes.ranks[0].coverage) == Shares{0, 0, 0, 0, 1, 0.75F});
}

TEST_CASE("Depth and normals are read if requested, materials if present") {
  const Exr exr(with_other_planes());
  const Passes bare = exr.read();
  check_usual(bare);
  CHECK(bare.depth_m.empty());
  CHECK(bare.normal[0].empty());
  CHECK(values(bare.material_index) == Indices{500, 501, 502, 503, 504, 505});
  const Passes all = exr.read({.depth = true, .normals = true, .actors = true});
  CHECK(values(all.depth_m) == Shares{100, 101, 102, 103, 104, 105});
  CHECK(values(all.normal[0]) == Shares{200, 201, 202, 203, 204, 205});
  CHECK(values(all.normal[1]) == Shares{300, 301, 302, 303, 304, 305});
  CHECK(values(all.normal[2]) == Shares{400, 401, 402, 403, 404, 405});
  CHECK(all.actor_index.empty());
}

TEST_CASE("Planes come from the cryptomatte's layer, and materials are empty without any in the file") {
  ExrChannels channels = with_other_planes();
  for (const auto& [name, pixels] : with_other_planes("Fog.")) {
    if (name.starts_with("Fog.")) channels.emplace(name, std::vector<float>(pixels.size(), 9));
  }
  CHECK(values(Exr(channels).read({.depth = true, .normals = false, .actors = false}).depth_m) ==
        Shares{100, 101, 102, 103, 104, 105});
  CHECK(Exr().read().material_index.empty());
}

TEST_CASE("Planes that are needed and missing are an error") {
  const Exr exr;
  CHECK(exr.fault({.depth = true, .normals = false, .actors = false}) ==
        "no depth channel, which the chosen terms need; the file has: ViewLayer.CryptoObject00.a, "
        "ViewLayer.CryptoObject00.b, ViewLayer.CryptoObject00.g, ViewLayer.CryptoObject00.r, "
        "ViewLayer.CryptoObject01.a, ViewLayer.CryptoObject01.b, ViewLayer.CryptoObject01.g, "
        "ViewLayer.CryptoObject01.r");
  CHECK_FALSE(exr.fault({.depth = false, .normals = true, .actors = false}).empty());
}

TEST_CASE("Available planes are listed without reading them") {
  const auto planes_in = [](const Exr& exr) {
    return MatteTable(manifest()).planes_in(exr.file, {.layer = "", .actor_layer = "", .channels = {}});
  };
  CHECK(planes_in(Exr(with_other_planes())).depth);
  CHECK(planes_in(Exr(with_other_planes())).normals);
  CHECK_FALSE(planes_in(Exr()).depth);
  CHECK_FALSE(planes_in(Exr()).normals);
}

TEST_CASE("Without a manifest in the file, the names of objects are hashed") {
  Manifest plain = manifest();
  plain.objects[2].mattes = {"stone_1", "stone_2"};
  check_usual(Exr(matte_channels(kRanks), matte_texts({})).read({}, plain));
}

TEST_CASE("Blender's manifests have hashes from before their conversion to floats") {
  ExrTexts texts = matte_texts(kNames);
  texts["cryptomatte/542cafa/manifest"] = R"({"tree_97": "ffeed3b0"})";
  Manifest trees = manifest();
  trees.objects[0].mattes = {"tree_*"};  // so that only its name identifies it
  const std::vector<MatteRank> ranks = {{std::vector<std::string>(6, "tree_97"), std::vector<float>(6, 1)}};
  CHECK(values(Exr(matte_channels(ranks), texts).read({}, trees).object_index) == Indices(6, 1));
}

TEST_CASE("A name that matches no object is an error with its place and the expected names") {
  Manifest other = manifest();
  other.objects[1].name = "ana";
  CHECK(Exr().fault({}, other) ==
        "ViewLayer.CryptoObject00.r at pixel (1, 0) = \"anna\" (4 pixels); expected a name among the "
        "manifest's "
        "objects: ground, ana, stone_*; did you mean \"ana\"?");
}

TEST_CASE("A hash without a name is reported as a number") {
  CHECK(Exr(matte_channels(kRanks), matte_texts({})).fault() ==
        fmt::format("ViewLayer.CryptoObject00.r at pixel (0, 1) = \"{:08x}\" (1 pixels); expected the hash "
                    "of a name among "
                    "the manifest's objects: ground, anna, stone_*",
                    cryptomatte_hash("stone_1")));
}

TEST_CASE("Unreadable names are reported where they are missed, and nowhere else") {
  ExrTexts texts = matte_texts(kNames);
  texts["cryptomatte/542cafa/manifest"] = std::string(1, '{');
  Manifest plain = manifest();
  plain.objects[2].mattes = {"stone_1", "stone_2"};
  check_usual(Exr(matte_channels(kRanks), texts).read({}, plain));
  CHECK(Exr(matte_channels(kRanks), texts).fault() ==
        fmt::format(
            "ViewLayer.CryptoObject00.r at pixel (0, 1) = \"{:08x}\" (1 pixels); expected the hash of a name "
            "among "
            "the manifest's objects: ground, anna, stone_*; the file's names cannot be read: manifest = 1 "
            "characters; expected a JSON object of names and their hashes",
            cryptomatte_hash("stone_1")));
}

TEST_CASE("A name that matches patterns of two objects is an error with its place") {
  Manifest other = manifest();
  other.objects[1].mattes = {"anna", "*_2"};
  CHECK(Exr().fault({}, other) ==
        "ViewLayer.CryptoObject00.b at pixel (0, 1) = \"stone_2\" (1 pixels); expected a name of one object, "
        "but anna's "
        "\"*_2\" and stones's \"stone_*\" match it");
}

TEST_CASE("A manifest with invalid mattes is an error before anything is read") {
  Manifest other = manifest();
  other.objects[1].mattes = {"ground"};
  CHECK(message_of<DataError>([&] { (void)PassReader(other); }) ==
        "objects[1].mattes[0] = \"ground\"; expected a unique name, but objects[0].name is \"ground\"");
}

TEST_CASE("Errors in pixels name their channel") {
  std::vector<MatteRank> ranks = kRanks;
  ranks[1].coverage[4] = -1;
  CHECK(Exr(matte_channels(ranks)).fault() ==
        "ViewLayer.CryptoObject00.a at pixel (1, 1) = -1; expected a coverage from 0 to 1");
}

TEST_CASE("A cryptomatte of another size is an error that accounts for supersampling and overscan") {
  Manifest finer = manifest();
  finer.supersample = 2;
  finer.overscan_px = 1;
  CHECK(Exr().fault({}, finer) == "size = 3 x 2 px; expected the manifest's 10 x 8 px");
}

TEST_CASE("Among cryptomattes of several layers one must be named") {
  ExrChannels channels = matte_channels(kRanks);
  for (const auto& [name, pixels] :
       matte_channels({{std::vector<std::string>(6, "anna"), std::vector<float>(6, 1)}}, "Fog.CryptoObject"))
    channels.emplace(name, pixels);
  ExrTexts texts = matte_texts(kNames);
  texts.merge(matte_texts(kNames, "Fog.CryptoObject", "0000001"));
  const Exr exr(channels, texts);
  CHECK(exr.fault() ==
        "cryptomatte = \"CryptoObject\"; expected the whole name of one: Fog.CryptoObject, "
        "ViewLayer.CryptoObject");
  Manifest chosen = manifest();
  chosen.layer = "ViewLayer";
  check_usual(exr.read({}, chosen));
  chosen.layer = "";
  chosen.cryptomatte = "Fog.CryptoObject";
  CHECK(values(exr.read({}, chosen).object_index) == Indices(6, 7));
}

TEST_CASE("A missing or truncated file is an error that names it") {
  const Exr exr;
  const auto unreadable = [&] { return message_of<IoError>([&] { (void)exr.read(); }); };
  std::filesystem::resize_file(exr.file, std::filesystem::file_size(exr.file) - 20);
  CHECK(unreadable().starts_with(fmt::format("cannot read {}: ", exr.file.string())));
  std::filesystem::remove(exr.file);
  CHECK(unreadable() == fmt::format("cannot read {}: no such file", exr.file.string()));
}

TEST_CASE("A survey counts the pixels of rank 0") {
  const Exr exr;
  const ExrHeader header = read_exr_header(exr.file);
  const std::vector<Cryptomatte> all = cryptomattes_in(header);
  REQUIRE(all.size() == 1);
  std::vector<std::tuple<std::string, std::uint32_t, std::int64_t>> found;
  for (const MatteUse& use : survey_mattes(exr.file, header, all.front()))
    found.emplace_back(use.name, use.hash, use.pixels);
  REQUIRE(found.size() == 4);
  std::vector<std::uint32_t> twice = {cryptomatte_hash("anna"), cryptomatte_hash("ground")};
  std::sort(twice.begin(), twice.end());  // for equal numbers of pixels, the lower hash comes first
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(found[i] == std::tuple(all.front().names.at(twice[i]), twice[i], 2));
  CHECK(found[2] == std::tuple("", 0U, 1));
  CHECK(found[3] == std::tuple("stone_1", cryptomatte_hash("stone_1"), 1));
}

TEST_CASE("A survey of an unreadable file is an error that names it") {
  const Exr exr(matte_channels(kRanks), matte_texts(kNames), Imf::DWAA_COMPRESSION);
  const ExrHeader header = read_exr_header(exr.file);
  const std::vector<Cryptomatte> all = cryptomattes_in(header);
  CHECK(message_of<DataError>([&] { (void)survey_mattes(exr.file, header, all.front()); }) ==
        fmt::format("{}: {}", exr.file.string(), all.front().fault));
}

}  // namespace matte_table_test
