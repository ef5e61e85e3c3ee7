/// EXR files that cannot be read, and values from readable ones for other readers.

#include <bit>
#include <cstring>
#include <fstream>
#include <new>

#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "io/exr/file.h"
#include "io/exr/passes.h"
#include "support/catch.h"
#include "support/exr_forms.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace exr_faults_test {

using namespace thermal;
using exr_forms::floats;
using exr_forms::window;

namespace {

exr_forms::Part part_of(const std::string& name, const std::map<std::string, exr_forms::Stored>& channels) {
  return {.display = window(0, 0, 2, 2), .channels = channels, .name = name};
}

std::string fault_of(const Path& file, const PassNeeds& needs = {}) {
  return message_of<Error>([&] { (void)read_passes(file, {}, needs); });
}

}  // namespace

TEST_CASE("A file whose writer stopped early is an error if a needed part lacks pixels") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  exr_forms::Part objects = part_of("objects", {{"IndexOB.X", floats({1, 2, 3, 4})}});
  exr_forms::Part depth = part_of("depth", {{"Z", floats({1, 2, 3, 4})}});
  objects.compression = depth.compression = Imf::RLE_COMPRESSION;  // one chunk per line
  depth.lines = 1;
  exr_forms::write(file, {objects, depth});
  CHECK(fault_of(file) == "(no fault was thrown)");
  CHECK(fault_of(file, {.depth = true}) ==
        "cannot read " + file.string() + ": part 1 lacks pixels; expected a completely written file");
}

TEST_CASE("Channels with fewer samples than pixels are refused if they are needed") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  Imf::Header header(2, 2);
  header.channels().insert("IndexOB.X", Imf::Channel(Imf::FLOAT));
  header.channels().insert("Depth.Z", Imf::Channel(Imf::FLOAT, 2, 1));
  const std::vector<float> pixels(4, 5);
  Imf::FrameBuffer buffer;
  buffer.insert("IndexOB.X", Imf::Slice::Make(Imf::FLOAT, pixels.data(), header.dataWindow()));
  buffer.insert("Depth.Z", Imf::Slice::Make(Imf::FLOAT, pixels.data(), header.dataWindow(), 4, 8, 2, 1));
  {
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(2);
  }
  CHECK(read_passes(file, {}).object_index.at(1, 1) == 5);
  CHECK(fault_of(file, {.depth = true}) ==
        file.string() + ": Depth.Z: sampling = 2 x 1 px; expected 1 x 1 px, a number for every pixel");
}

TEST_CASE("Reading does not wait for pipes and devices") {
  const TestFolder folder;
  const Path pipe = folder / "pipe.exr";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(fault_of(pipe) == "cannot read " + pipe.string() + ": it is not a regular file");
  CHECK(fault_of(folder.path()) == "cannot read " + folder.path().string() + ": it is not a regular file");
}

TEST_CASE("A file that claims more than it can hold costs no memory") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  exr_forms::write(file, {part_of("", {{"IndexOB.X", floats({1, 2, 3, 4})}})});
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at =
      bytes.find("dataWindow") + std::string("dataWindow").size() + 1 + 6 + 4;  // name, box2i, size
  const auto claim = [&](std::int32_t right, std::int32_t bottom) {
    std::memcpy(&bytes[at + 8], &right, 4);
    std::memcpy(&bytes[at + 12], &bottom, 4);
    return folder.file("claims.exr", bytes);
  };
  const std::string start = "cannot read " + (folder / "claims.exr").string() + ": part 0: ";
  CHECK(fault_of(claim(2147483646, 0)) == start +
                                              "dataWindow = 2147483647 x 1 px, 2147.483647 megapixels; "
                                              "expected at most 256 (see --max-megapixels)");
  CHECK_THAT(fault_of(claim(15999, 15999)),
             StartsWith(start + "pixels = 1024000000 bytes; expected what the "));
  CHECK(fault_of(claim(1, 1)) == "(no fault was thrown)");
}

TEST_CASE("A file that changes while it is read is reported") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  exr_forms::write(file, {part_of("a", {{"IndexOB.X", floats({1, 2, 3, 4})}}),
                          part_of("b", {{"Z", floats({1, 2, 3, 4})}})});
  const ExrHeader header = read_exr_header(file);
  exr_forms::write(file, {part_of("", {{"R", floats({1, 2, 3, 4})}})});
  const auto fault_at = [&](std::size_t i) {
    return message_of<IoError>([&] { (void)read_exr_channel(file, header, header.channels[i]); });
  };
  CHECK(fault_at(0) == "cannot read " + file.string() + ": a.IndexOB.X is no longer in it");
  CHECK(fault_at(1) == "cannot read " + file.string() + ": b.Z is no longer in it");
}

TEST_CASE("Other readers get the string attributes of all parts, and compressions by part") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  exr_forms::Part a = part_of("a", {{"S.IndexOB.X", floats({1, 2, 3, 4})}});
  exr_forms::Part b = part_of("b", {{"S.CryptoObject00.R", floats({1, 2, 3, 4})}});
  b.compression = Imf::PIZ_COMPRESSION;
  std::vector<Imf::Header> headers = {exr_forms::header_of(a), exr_forms::header_of(b)};
  headers[0].insert("cryptomatte/1/name", Imf::StringAttribute("S.CryptoObject"));
  headers[1].insert("cryptomatte/1/name", Imf::StringAttribute("another"));
  headers[1].insert("note", Imf::StringAttribute("of the second part"));
  {
    Imf::MultiPartOutputFile out(file.c_str(), headers.data(), 2);
    exr_forms::write_lines(out, 0, a);
    exr_forms::write_lines(out, 1, b);
  }
  const ExrHeader header = read_exr_header(file);
  CHECK(header.texts.at("cryptomatte/1/name") == "S.CryptoObject");
  CHECK(header.texts.at("note") == "of the second part");
  CHECK(header.compression == "ZIP");
  REQUIRE(header.channels.size() == 2);
  CHECK(header.channels[0].compression == "ZIP");
  CHECK(header.channels[1].compression == "PIZ");
  CHECK(header.channels[1].part == 1);
}

TEST_CASE("Channels keep all bits of floats, from several parts and when requested twice") {
  const TestFolder folder;
  const Path file = folder / "f.exr";
  // Hashes of a cryptomatte, and a signalling NaN.
  const std::vector<std::uint32_t> bits = {0xA8FCE865, 0x7FA00001, 0x00000001, 0x80000000};
  std::vector<float> pixels;
  for (const std::uint32_t pixel : bits) pixels.push_back(std::bit_cast<float>(pixel));
  const auto compression =
      GENERATE(Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION);
  exr_forms::Part first =
      part_of("a", {{"H", floats(pixels)}, {"U", exr_forms::wholes({0, 16777216, 16777217, 7})}});
  first.compression = compression;
  exr_forms::write(file, {first, part_of("b", {{"H", floats({9, 8, 7, 6})}})});
  const ExrHeader header = read_exr_header(file);
  const auto planes = read_exr_channels(
      file, header,
      {header.channels.data(), &header.channels[2], header.channels.data(), &header.channels[1]});
  for (const std::size_t i : {0U, 1U, 2U, 3U}) {
    CHECK(std::bit_cast<std::uint32_t>(planes[0].pixels()[i]) == bits[i]);
    CHECK(std::bit_cast<std::uint32_t>(planes[2].pixels()[i]) == bits[i]);
    CHECK(planes[1].pixels()[i] == 9 - static_cast<float>(i));
  }
  CHECK(planes[3].at(0, 1) == 16777216);  // floats have 24 bits
}

// AddressSanitizer ends a program that has no memory.
#ifndef __SANITIZE_ADDRESS__
namespace {

/// While it lives, this process may take so much memory more.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    ::getrlimit(RLIMIT_AS, &before_);
    const rlimit limit = {.rlim_cur = pages * static_cast<std::size_t>(::getpagesize()) + bytes,
                          .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("Running out of memory is no fault of a file: for its plane, the library's chunk, or ours") {
  constexpr int kSide = 3000;  // 36 MB in one chunk: more than the allocator keeps
  constexpr std::size_t kMega = 1'000'000;
  const TestFolder folder;
  const Path file = folder / "f.exr";
  {
    Imf::Header header(kSide, kSide);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(kSide, kSide));
    const std::vector<float> pixels(std::size_t{kSide} * kSide, 0.5F);
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, pixels.data(), header.dataWindow(), sizeof(float)));
    Imf::TiledOutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writeTile(0, 0);
  }
  const ExrHeader header = read_exr_header(file);
  const auto read = [&] { (void)read_exr_channel(file, header, header.channels[0]); };
  malloc_trim(0);  // what earlier tests have freed
  for (const std::size_t megabytes : {20U, 56U, 92U}) {
    const MemoryLimit limit(megabytes * kMega);
    CHECK_THROWS_AS(read(), std::bad_alloc);
  }
  CHECK_NOTHROW(read());
}
#endif

}  // namespace exr_faults_test
