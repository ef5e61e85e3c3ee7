#include "io/exr/file.h"

#include <array>

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfMultiView.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include "io/exr/header.h"

namespace thermal {
namespace {

std::string type_name(Imf::PixelType type) {
  if (type == Imf::HALF) return "half";
  return type == Imf::UINT ? "uint" : "float";
}

std::string compression_name(Imf::Compression compression) {
  static const std::array<const char*, 10> kNames = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                                     "PXR24", "B44", "B44A", "DWAA", "DWAB"};
  const auto number = static_cast<std::size_t>(compression);
  return number < kNames.size() ? kNames.at(number) : "unknown";
}

ExrParts parts_of(const Imf::MultiPartInputFile& opened) {
  ExrParts parts;
  for (int number = 0; number < opened.parts(); ++number) {
    const Imf::Header& header = opened.header(number);
    parts.parts.push_back(
        {.name = header.hasName() ? header.name() : "", .view = header.hasView() ? header.view() : ""});
    if (Imf::hasMultiView(header)) parts.views = Imf::multiView(header);
  }
  return parts;
}

std::vector<ExrChannel> channels_of(const Imf::MultiPartInputFile& opened) {
  std::vector<ExrChannel> channels;
  for (int number = 0; number < opened.parts(); ++number) {
    const Imf::Header& header = opened.header(number);
    for (auto entry = header.channels().begin(); entry != header.channels().end(); ++entry) {
      ExrChannel& channel = channels.emplace_back();
      channel.part = number;
      channel.name = entry.name();
      channel.type = type_name(entry.channel().type);
      channel.compression = compression_name(header.compression());
    }
  }
  name_channels(channels, parts_of(opened));
  return channels;
}

ExrWindow window_of(const Imf::Header& header) {
  const Imath::Box2i& picture = header.displayWindow();
  const Imath::Box2i& data = header.dataWindow();
  return {.x_px = data.min.x - picture.min.x,
          .y_px = data.min.y - picture.min.y,
          .width_px = data.max.x - data.min.x + 1,
          .height_px = data.max.y - data.min.y + 1};
}

std::string environment_in(const Imf::MultiPartInputFile& opened) {
  for (int number = 0; number < opened.parts(); ++number)
    if (Imf::hasEnvmap(opened.header(number)))
      return Imf::envmap(opened.header(number)) == Imf::ENVMAP_CUBE ? "cube" : "latlong";
  return "";
}

ExrHeader header_of(const Imf::MultiPartInputFile& opened) {
  const Imath::Box2i& picture = opened.header(0).displayWindow();
  ExrHeader header;
  header.width_px = picture.max.x - picture.min.x + 1;
  header.height_px = picture.max.y - picture.min.y + 1;
  header.data_window = window_of(opened.header(0));
  header.pixel_aspect = static_cast<double>(opened.header(0).pixelAspectRatio());
  header.environment = environment_in(opened);
  header.compression = compression_name(opened.header(0).compression());
  header.channels = channels_of(opened);
  return header;
}

/// The file's name, after checks that make it safe to open by a library. Reading a file that is not regular might never
/// end.
std::string checked(const Path& file, const ExrLimits& limits) {
  if (!std::filesystem::exists(file)) throw IoError("no such file");
  if (!std::filesystem::is_regular_file(file)) throw IoError("it is not a regular file");
  try {
    check_exr_headers(file, limits);
  } catch (const DataError& error) {
    throw IoError(error.what());
  }
  return file.string();
}

}  // namespace

ExrFile::ExrFile(const Path& file, const ExrLimits& limits)
    : name_(file), opened_(checked(file, limits).c_str(), 1), header_(header_of(opened_)) {
  header_.folder = file.parent_path();
}

std::map<std::string, std::string> ExrFile::texts() const {
  std::map<std::string, std::string> texts;
  for (int number = 0; number < opened_.parts(); ++number) {
    const Imf::Header& header = opened_.header(number);
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute());
      if (text != nullptr) texts.emplace(entry.name(), text->value());
    }
  }
  return texts;
}

ExrHeader read_exr_header(const Path& file, const ExrLimits& limits) {
  return with_exr_file(file, limits, [](const ExrFile& opened) {
    ExrHeader header = opened.header();
    header.texts = opened.texts();
    return header;
  });
}

std::vector<Plane<float>> read_exr_channels(const Path& file, const ExrHeader& /*header*/,
                                            const std::vector<const ExrChannel*>& channels, float outside,
                                            const ExrLimits& limits) {
  return with_exr_file(file, limits, [&](ExrFile& opened) {
    std::vector<Plane<float>> planes(channels.size());
    std::vector<ExrTarget> targets;
    for (std::size_t i = 0; i < channels.size(); ++i)
      targets.push_back({.channel = channels[i], .plane = &planes[i], .outside = outside});
    opened.decode(targets);
    return planes;
  });
}

Plane<float> read_exr_channel(const Path& file, const ExrHeader& header, const ExrChannel& channel,
                              float outside, const ExrLimits& limits) {
  return std::move(read_exr_channels(file, header, {&channel}, outside, limits).front());
}

}  // namespace thermal
