#include "io/exr/pixels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfTiledInputPart.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/exr/decode.h"

namespace thermal {
namespace {

using Imath::Box2i;

constexpr std::size_t kBytes = 4;  // of a pixel in any plane here

int width_of(const Box2i& window) { return window.max.x - window.min.x + 1; }
int height_of(const Box2i& window) { return window.max.y - window.min.y + 1; }

/// Resizes a target's plane, fills it with `outside`, and returns a pointer to its pixels.
char* sized_plane(const ExrTarget& target, const Box2i& display) {
  const auto make = [&](auto& plane) {
    using Pixel = std::remove_cvref_t<decltype(plane.pixels().front())>;
    static_assert(sizeof(Pixel) == kBytes);
    const auto outside = static_cast<Pixel>(target.outside);
    if (plane.width_px() == width_of(display) && plane.height_px() == height_of(display)) {
      std::fill(plane.pixels().begin(), plane.pixels().end(), outside);
    } else {
      plane = std::remove_cvref_t<decltype(plane)>(width_of(display), height_of(display), outside);
    }
    return reinterpret_cast<char*>(plane.pixels().data());
  };
  return std::visit([&](auto* plane) { return make(*plane); }, target.plane);
}

Imf::PixelType type_of(const ExrTarget& target) {
  return std::holds_alternative<Plane<float>*>(target.plane) ? Imf::FLOAT : Imf::UINT;
}

/// The rows of a part to decode: whole chunks or rows of tiles that overlap the display window.
struct Strip {
  Box2i window;  ///< empty: no overlap
  bool tiled = false;
  int first_row = 0;  ///< of tiles
  int last_row = 0;
};

Strip tiles_of(const Imf::Header& header, const Box2i& shown) {
  const Box2i& data = header.dataWindow();
  const auto height = static_cast<std::int64_t>(header.tileDescription().ySize);
  const std::int64_t first = (std::int64_t{shown.min.y} - data.min.y) / height;
  const std::int64_t last = (std::int64_t{shown.max.y} - data.min.y) / height;
  const auto top = static_cast<int>(data.min.y + first * height);
  const auto bottom =
      static_cast<int>(std::min<std::int64_t>(data.max.y, data.min.y + (last + 1) * height - 1));
  return {.window = Box2i({data.min.x, top}, {data.max.x, bottom}),
          .tiled = true,
          .first_row = static_cast<int>(first),
          .last_row = static_cast<int>(last)};
}

Box2i overlap(const Box2i& a, const Box2i& b) {
  return Box2i({std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
               {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)});
}

Strip strip_of(const Imf::Header& header) {
  const Box2i& data = header.dataWindow();
  const Box2i shown = overlap(data, header.displayWindow());
  if (shown.isEmpty()) return {.window = Box2i()};
  if (header.hasType() ? Imf::isTiled(header.type()) : header.hasTileDescription())
    return tiles_of(header, shown);
  return {.window = Box2i({data.min.x, shown.min.y}, {data.max.x, shown.max.y})};
}

/// An open file, and its name.
struct Source {
  Imf::MultiPartInputFile& file;
  const Path& name;
};

/// A channel and its destination.
struct Job {
  std::string channel;
  Imf::PixelType type;
  char* pixels;  ///< of the display window
};

/// Destination of a strip's pixels of a channel: the first pixel, and the line stride.
struct LineDestination {
  char* first = nullptr;
  std::size_t bytes_a_line = 0;
};

/// The slow path, for all files: the library's own interface.
void read_strip(Imf::MultiPartInputFile& file, int number, const Strip& strip,
                const Imf::FrameBuffer& buffer) {
  if (strip.tiled) {
    Imf::TiledInputPart part(file, number);
    part.setFrameBuffer(buffer);
    part.readTiles(0, part.numXTiles(0) - 1, strip.first_row, strip.last_row, 0, 0);
    return;
  }
  Imf::InputPart part(file, number);
  part.setFrameBuffer(buffer);
  part.readPixels(strip.window.min.y, strip.window.max.y);
}

/// The fast path for most files: a whole part, in a lossless compression.
void read_whole_part(const Source& source, int number, const std::vector<Job>& jobs,
                     const std::vector<LineDestination>& destinations) {
  std::vector<ChannelTarget> targets;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    targets.push_back({.channel = jobs[i].channel,
                       .first = destinations[i].first,
                       .bytes_a_line = static_cast<std::int32_t>(destinations[i].bytes_a_line),
                       .whole = jobs[i].type == Imf::UINT});
  }
  decode_part(source.name, number, targets);
}

/// Whether the C interface of the fast path unpacks these channels correctly. For a part with three or four channels,
/// some of them half floats, it also writes channels without a target, through a null pointer (3.1.5).
bool can_unpack(const Imf::ChannelList& channels, const std::vector<Job>& jobs) {
  std::size_t count = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) ++count;
  if (count < 3 || count > 4 || jobs.size() == count) return true;
  return std::none_of(jobs.begin(), jobs.end(),
                      [&](const Job& job) { return channels.findChannel(job.channel)->type == Imf::HALF; });
}

void read_to(const Source& source, int number, const Strip& strip, const std::vector<Job>& jobs,
             const std::vector<LineDestination>& destinations) {
  const Imf::Header& header = source.file.header(number);
  if (!source.file.partComplete(number))
    throw IoError(fmt::format("part {} lacks pixels; expected a completely written file", number));
  const bool whole = strip.window == header.dataWindow();
  if (whole && can_decode(header.compression()) && can_unpack(header.channels(), jobs)) {
    read_whole_part(source, number, jobs, destinations);
    return;
  }
  Imf::FrameBuffer buffer;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& [first, bytes_a_line] = destinations[i];
    buffer.insert(jobs[i].channel, Imf::Slice::Make(jobs[i].type, first, strip.window, kBytes, bytes_a_line));
  }
  read_strip(source.file, number, strip, buffer);
}

/// Directly into planes of the display window, which contains the strip.
void read_into_planes(const Source& source, int number, const Strip& strip, const std::vector<Job>& jobs) {
  const Box2i display = source.file.header(number).displayWindow();
  const std::size_t bytes_a_line = kBytes * static_cast<std::size_t>(width_of(display));
  const std::size_t before = bytes_a_line * static_cast<std::size_t>(strip.window.min.y - display.min.y) +
                             kBytes * static_cast<std::size_t>(strip.window.min.x - display.min.x);
  std::vector<LineDestination> destinations;
  for (const Job& job : jobs)
    destinations.push_back({.first = job.pixels + before, .bytes_a_line = bytes_a_line});
  read_to(source, number, strip, jobs, destinations);
}

using Bits = Plane<std::uint32_t>;

/// Copies the part of a strip inside the display window.
void crop(const Bits& strip, const Box2i& window, char* to, const Box2i& display) {
  const Box2i shown = overlap(window, display);
  const auto bytes = kBytes * static_cast<std::size_t>(width_of(shown));
  const auto left = static_cast<std::size_t>(shown.min.x - display.min.x);
  const auto stride = static_cast<std::size_t>(width_of(display));
  for (int y = shown.min.y; y <= shown.max.y; ++y) {
    const auto row = static_cast<std::size_t>(y - display.min.y);
    std::memcpy(to + kBytes * (row * stride + left), &strip.at(shown.min.x - window.min.x, y - window.min.y),
                bytes);
  }
}

void read_and_crop(const Source& source, int number, const Strip& strip, const std::vector<Job>& jobs) {
  std::vector<Bits> strips(jobs.size());
  std::vector<LineDestination> destinations;
  for (Bits& bits : strips) {
    bits = Bits(width_of(strip.window), height_of(strip.window));
    destinations.push_back({.first = reinterpret_cast<char*>(bits.pixels().data()),
                            .bytes_a_line = kBytes * static_cast<std::size_t>(width_of(strip.window))});
  }
  read_to(source, number, strip, jobs, destinations);
  for (std::size_t i = 0; i < jobs.size(); ++i)
    crop(strips[i], strip.window, jobs[i].pixels, source.file.header(number).displayWindow());
}

bool holds(const Box2i& outer, const Box2i& inner) {
  return outer.intersects(inner.min) && outer.intersects(inner.max);
}

void read_part(const Source& source, int number, const std::vector<Job>& jobs) {
  const Strip strip = strip_of(source.file.header(number));
  if (strip.window.isEmpty()) return;
  const auto read =
      holds(source.file.header(number).displayWindow(), strip.window) ? read_into_planes : read_and_crop;
  read(source, number, strip, jobs);
}

/// The file may have changed since its channels were listed.
void check_channel(const Imf::MultiPartInputFile& file, const ExrChannel& expected) {
  const Imf::Channel* channel = expected.part < file.parts()
                                    ? file.header(expected.part).channels().findChannel(expected.name)
                                    : nullptr;
  if (channel == nullptr) throw IoError(fmt::format("{} is no longer in it", expected.full_name()));
  if (channel->xSampling == 1 && channel->ySampling == 1) return;
  throw DataError(fault(expected.full_name() + ": sampling",
                        fmt::format("{} x {}", channel->xSampling, channel->ySampling), "px",
                        "1 x 1 px, a number for every pixel"));
}

}  // namespace

void decode(Imf::MultiPartInputFile& file, const Path& name, const std::vector<ExrTarget>& targets) {
  for (const ExrTarget& target : targets) check_channel(file, *target.channel);
  std::map<std::pair<int, std::string>, int> uses;
  std::map<std::pair<int, int>, std::vector<Job>>
      rounds;  // a channel can have only one destination at a time
  for (const ExrTarget& target : targets) {
    const ExrChannel& channel = *target.channel;
    const int round = uses[{channel.part, channel.name}]++;
    rounds[{round, channel.part}].push_back(
        {.channel = channel.name,
         .type = type_of(target),
         .pixels = sized_plane(target, file.header(channel.part).displayWindow())});
  }
  for (const auto& [key, jobs] : rounds) read_part({.file = file, .name = name}, key.second, jobs);
}

namespace {

constexpr int kLargestInHalf = 2048;  // 2^11: half floats have 11 significant bits (IEEE 754-2019, binary16)

bool is_lossy(std::string_view compression) {
  constexpr std::array<std::string_view, 4> kLossy = {"B44", "B44A", "DWAA", "DWAB"};
  return std::find(kLossy.begin(), kLossy.end(), compression) != kLossy.end();
}

template <typename Number>
void convert(const Plane<Number>& plane, const ExrChannel& channel, Plane<std::uint16_t>& out) {
  out.resize(plane.width_px(), plane.height_px());
  const bool half = channel.type == "half";
  to_indices(plane.pixels(), plane.width_px(), channel.full_name(), out.pixels(),
             half ? kLargestInHalf : kLargestIndex, half ? ", up to which half floats are exact" : "");
}

}  // namespace

ExrIndexPlane::ExrIndexPlane(const ExrChannel& channel, IndexPixels& pixels)
    : channel_(channel), pixels_(pixels) {
  if (!is_lossy(channel.compression)) return;
  throw DataError(fault(channel.full_name() + ": compression", channel.compression, "",
                        "a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others change indices"));
}

ExrTarget ExrIndexPlane::target() {
  ExrTarget target{.channel = &channel_, .plane = &pixels_.floats, .outside = 0};
  if (channel_.type == "uint") target.plane = &pixels_.wholes;
  return target;
}

void ExrIndexPlane::indices(Plane<std::uint16_t>& out) const {
  if (channel_.type == "uint") {
    convert(pixels_.wholes, channel_, out);
  } else {
    convert(pixels_.floats, channel_, out);
  }
}

}  // namespace thermal
