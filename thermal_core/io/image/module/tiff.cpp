#include "io/image/module/tiff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/functions.h"

namespace thermal::pictures {
namespace {

int keep_reason(TIFF*, void* reason, const char*, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  (void)std::vsnprintf(text.data(), text.size(), format, arguments);
  *static_cast<std::string*>(reason) = text.data();
  return 1;
}

int say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

bool can_decode_all(TIFF* tiff) {
  constexpr tmsize_t kWhole = -1;
  const bool tiled = TIFFIsTiled(tiff) != 0;
  const std::uint32_t pieces = tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  std::vector<std::byte> piece(static_cast<std::size_t>(tiled ? TIFFTileSize(tiff) : TIFFStripSize(tiff)));
  for (std::uint32_t k = 0; k < pieces; ++k) {
    const tmsize_t bytes = tiled ? TIFFReadEncodedTile(tiff, k, piece.data(), kWhole)
                                 : TIFFReadEncodedStrip(tiff, k, piece.data(), kWhole);
    if (bytes < 0) return false;
  }
  return true;
}

}  // namespace

TiffOptions quiet_options(std::string& reason) {
  TiffOptions options(TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_reason, &reason);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  return options;
}

Tiff open_tiff(const Path& file, std::string& reason) {
  const TiffOptions options = quiet_options(reason);
  return {TIFFOpenExt(file.c_str(), "r", options.get()), &TIFFClose};
}

void check_is_whole(const Path& file) {
  std::string reason;
  const Tiff tiff = open_tiff(file, reason);
  if (!tiff || !can_decode_all(tiff.get())) throw DataError(fmt::format("damaged: {}", reason));
}

void check_is_single(const Path& file) {
  constexpr int kMostCopies = 64;  // each half as large
  std::string reason;
  const Tiff tiff = open_tiff(file, reason);
  for (int k = 0; tiff && k < kMostCopies && TIFFReadDirectory(tiff.get()) == 1; ++k) {
    std::uint32_t kind = 0;
    (void)TIFFGetField(tiff.get(), TIFFTAG_SUBFILETYPE, &kind);
    if ((kind & FILETYPE_MASK) != 0)
      throw DataError("has a mask of pixels without a value; expected a picture of all pixels");
    if ((kind & FILETYPE_REDUCEDIMAGE) == 0)
      throw DataError("has several pages; expected one picture in each file");
  }
}

// libtiff and not OpenImageIO: OpenImageIO 2.4 cannot write a GPS directory or arbitrary XMP, and always writes the
// time.

namespace {

/// A file in memory, for libtiff's callbacks.
struct TiffMemory {
  std::string bytes;
  std::size_t place = 0;
  std::string reason;  ///< libtiff's last error
};

TiffMemory& memory_of(thandle_t handle) { return *static_cast<TiffMemory*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count) {
  TiffMemory& file = memory_of(handle);
  const std::size_t left = file.bytes.size() - std::min(file.place, file.bytes.size());
  const std::size_t taken = std::min(left, static_cast<std::size_t>(count));
  std::memcpy(to, file.bytes.data() + file.place, taken);
  file.place += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t write_bytes(thandle_t handle, void* from, tmsize_t count) {
  TiffMemory& file = memory_of(handle);
  const auto size = static_cast<std::size_t>(count);
  file.bytes.resize(std::max(file.bytes.size(), file.place + size));
  std::memcpy(file.bytes.data() + file.place, from, size);
  file.place += size;
  return count;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  TiffMemory& file = memory_of(handle);
  const std::size_t from = whence == SEEK_CUR ? file.place : whence == SEEK_END ? file.bytes.size() : 0;
  file.place = from + static_cast<std::size_t>(offset);
  return file.place;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of_file(thandle_t handle) { return memory_of(handle).bytes.size(); }

class TiffWriter {
 public:
  TiffWriter() {
    const TiffOptions options = quiet_options(memory_.reason);
    // Little endian on every machine.
    tiff_.reset(TIFFClientOpenExt("a TIFF in memory", "wl", &memory_, read_bytes, write_bytes, seek,
                                  close_nothing, size_of_file, nullptr, nullptr, options.get()));
    check(tiff_ != nullptr);
  }

  /// IoError if libtiff failed.
  void check(bool done) const {
    if (!done) throw IoError(fmt::format("cannot encode a TIFF: {}", memory_.reason));
  }

  template <typename... Values>
  void set(std::uint32_t tag, Values... values) {
    check(TIFFSetField(tiff_.get(), tag, values...) == 1);
  }

  void set_text(std::uint32_t tag, const std::string& text) {
    if (!text.empty()) set(tag, text.c_str());
  }

  /// Writes the current directory, which has no pixels. Returns its offset.
  std::uint64_t end_directory() {
    std::uint64_t place = 0;
    check(TIFFWriteCustomDirectory(tiff_.get(), &place) == 1);
    TIFFFreeDirectory(tiff_.get());
    return place;
  }

  [[nodiscard]] TIFF* tiff() const { return tiff_.get(); }

  std::string end() {
    check(TIFFWriteDirectory(tiff_.get()) == 1);
    tiff_.reset();
    return std::move(memory_.bytes);
  }

 private:
  TiffMemory memory_;
  Tiff tiff_{nullptr, &TIFFClose};
};

bool has_exif(const TiffTags& tags) {
  return !tags.taken_at.empty() || !tags.subsecond.empty() || tags.f_number || tags.focal_length_mm ||
         tags.pixels_per_cm;
}

std::uint64_t write_exif(TiffWriter& writer, const TiffTags& tags) {
  writer.check(TIFFCreateEXIFDirectory(writer.tiff()) == 0);
  writer.set_text(EXIFTAG_DATETIMEORIGINAL, tags.taken_at);
  writer.set_text(EXIFTAG_SUBSECTIMEORIGINAL, tags.subsecond);
  if (tags.f_number) writer.set(EXIFTAG_FNUMBER, *tags.f_number);
  if (tags.focal_length_mm) writer.set(EXIFTAG_FOCALLENGTH, *tags.focal_length_mm);
  if (tags.pixels_per_cm) {
    constexpr int kCentimetre = 3;
    writer.set(EXIFTAG_FOCALPLANEXRESOLUTION, *tags.pixels_per_cm);
    writer.set(EXIFTAG_FOCALPLANEYRESOLUTION, *tags.pixels_per_cm);
    writer.set(EXIFTAG_FOCALPLANERESOLUTIONUNIT, kCentimetre);
  }
  return writer.end_directory();
}

/// Degrees, minutes and seconds of an angle's magnitude, rounded once.
std::array<double, 3> sexagesimal(double angle_deg) {
  constexpr std::int64_t kMicro = 1'000'000;
  const std::int64_t micro_seconds = std::llround(std::abs(angle_deg) * 3600 * kMicro);
  const std::int64_t minutes = micro_seconds / (60 * kMicro);
  const std::int64_t degrees = minutes / 60;
  return {static_cast<double>(degrees), static_cast<double>(minutes % 60),
          static_cast<double>(micro_seconds % (60 * kMicro)) / kMicro};
}

std::uint64_t write_gps(TiffWriter& writer, const GeoPosition& position) {
  constexpr std::array<std::uint8_t, 4> kVersion = {2, 3, 0, 0};
  writer.check(TIFFCreateGPSDirectory(writer.tiff()) == 0);
  const std::array<double, 3> latitude = sexagesimal(position.latitude_deg);
  const std::array<double, 3> longitude = sexagesimal(position.longitude_deg);
  const double height_m = std::round(std::abs(position.height_m) * 1000) / 1000;
  writer.set(GPSTAG_VERSIONID, kVersion.data());
  writer.set(GPSTAG_LATITUDEREF, position.latitude_deg < 0 ? "S" : "N");
  writer.set(GPSTAG_LATITUDE, latitude.data());
  writer.set(GPSTAG_LONGITUDEREF, position.longitude_deg < 0 ? "W" : "E");
  writer.set(GPSTAG_LONGITUDE, longitude.data());
  writer.set(GPSTAG_ALTITUDEREF, position.height_m < 0 ? 1 : 0);
  writer.set(GPSTAG_ALTITUDE, height_m);
  writer.set(GPSTAG_MAPDATUM, "WGS-84");
  return writer.end_directory();
}

void add_gdal_metadata(TiffWriter& writer, const std::string& xml) {
  if (xml.empty()) return;
  constexpr std::uint32_t kGdalMetadata = 42112;
  static char name[] = "GDALMetadata";
  static const TIFFFieldInfo kInfo = {
      .field_tag = kGdalMetadata,
      .field_readcount = -1,
      .field_writecount = -1,
      .field_type = TIFF_ASCII,
      .field_bit = FIELD_CUSTOM,
      .field_oktochange = 1,
      .field_passcount = 0,
      .field_name = name,
  };
  writer.check(TIFFMergeFieldInfo(writer.tiff(), &kInfo, 1) == 0);
  writer.set(kGdalMetadata, xml.c_str());
}

void set_texts(TiffWriter& writer, const TiffTags& tags) {
  writer.set_text(TIFFTAG_IMAGEDESCRIPTION, tags.description);
  writer.set_text(TIFFTAG_MAKE, tags.make);
  writer.set_text(TIFFTAG_MODEL, tags.model);
  writer.set_text(TIFFTAG_SOFTWARE, tags.software);
  if (!tags.xmp.empty())
    writer.set(TIFFTAG_XMLPACKET, static_cast<std::uint32_t>(tags.xmp.size()), tags.xmp.data());
  add_gdal_metadata(writer, tags.gdal_metadata);
}

template <typename T>
void write_pixels(TiffWriter& writer, const Plane<T>& picture) {
  constexpr bool kInteger = std::is_integral_v<T>;
  const int height_px = picture.height_px();
  writer.set(TIFFTAG_IMAGEWIDTH, picture.width_px());
  writer.set(TIFFTAG_IMAGELENGTH, height_px);
  writer.set(TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
  writer.set(TIFFTAG_SAMPLESPERPIXEL, 1);
  writer.set(TIFFTAG_SAMPLEFORMAT, kInteger ? SAMPLEFORMAT_UINT : SAMPLEFORMAT_IEEEFP);
  writer.set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  writer.set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  writer.set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  writer.set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  // Kelvin from counts have full mantissas: the floating-point predictor makes them a third larger.
  if (kInteger) writer.set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  writer.set(TIFFTAG_ROWSPERSTRIP, height_px);
  // One strip in one call, which libtiff may modify: then it compresses with libdeflate, in half of the time.
  Plane<T> strip = picture;
  const auto bytes = std::as_writable_bytes(strip.pixels());
  const auto size = static_cast<tmsize_t>(bytes.size());
  writer.check(TIFFWriteEncodedStrip(writer.tiff(), 0, bytes.data(), size) == size);
}

/// The directories of EXIF and GPS come first, because the one of pixels refers to them.
template <typename T>
std::string encode(const Plane<T>& picture, const TiffTags& tags) {
  TiffWriter writer;
  const std::uint64_t exif = has_exif(tags) ? write_exif(writer, tags) : 0;  // libtiff writes no empty one
  const std::uint64_t gps = tags.position ? write_gps(writer, *tags.position) : 0;
  TIFFCreateDirectory(writer.tiff());
  set_texts(writer, tags);
  if (has_exif(tags)) writer.set(TIFFTAG_EXIFIFD, exif);
  if (tags.position) writer.set(TIFFTAG_GPSIFD, gps);
  write_pixels(writer, picture);
  return writer.end();
}

}  // namespace

std::string encode_kelvin_tiff(const Plane<float>& picture, const TiffTags& tags) {
  return encode(picture, tags);
}

std::string encode_counts_tiff(const Plane<std::uint16_t>& picture, const TiffTags& tags) {
  return encode(picture, tags);
}

}  // namespace thermal::pictures
