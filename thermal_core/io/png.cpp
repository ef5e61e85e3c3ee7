#include "io/png.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

template <typename T>
std::vector<std::byte> encode(const Plane<T>& picture) {
  const auto type = OIIO::BaseTypeFromC<T>::value;
  OIIO::ImageSpec spec(picture.width_px(), picture.height_px(), 1, OIIO::TypeDesc(type));
  spec.attribute("png:compressionLevel", 1);  // 9 takes ten times as long for a tenth less
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create("png");
  const bool written = out && out->set_ioproxy(&memory) && out->open("frame.png", spec) &&
                       out->write_image(OIIO::TypeDesc(type), picture.pixels().data()) && out->close();
  if (!written)
    throw IoError(fmt::format("cannot encode a PNG: {}", out ? out->geterror() : OIIO::geterror()));
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

template <typename T>
Plane<T> read(const Path& file) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw IoError(fmt::format("cannot read {}: {}", file.string(), OIIO::geterror()));
  const OIIO::ImageSpec& spec = in->spec();
  const auto type = OIIO::BaseTypeFromC<T>::value;
  if (spec.nchannels != 1 || spec.format.basetype != type) {
    throw DataError(fmt::format("{}: {} channels of {}; expected 1 of {}", file.string(), spec.nchannels,
                                spec.format.c_str(), OIIO::TypeDesc(type).c_str()));
  }
  Plane<T> picture(spec.width, spec.height);
  if (!in->read_image(0, 0, 0, 1, OIIO::TypeDesc(type), picture.pixels().data())) {
    throw DataError(fmt::format("{}: damaged: {}", file.string(), in->geterror()));
  }
  return picture;
}

}  // namespace

std::vector<std::byte> encode_png(const Plane<std::uint8_t>& picture) { return encode(picture); }
std::vector<std::byte> encode_png(const Plane<std::uint16_t>& picture) { return encode(picture); }

Plane<std::uint8_t> read_png8(const Path& file) { return read<std::uint8_t>(file); }
Plane<std::uint16_t> read_png16(const Path& file) { return read<std::uint16_t>(file); }

}  // namespace thermal
