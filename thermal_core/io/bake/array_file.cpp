#include "io/bake/array_file.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/json/schema.h"

namespace thermal {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are little-endian");

constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 36;

Path binary_of(const Path& json) { return Path(json).replace_extension(".bin"); }

std::vector<std::byte> read_binary(const Path& file, std::uintmax_t expected) {
  check_is_file(file);
  const std::uintmax_t found = std::filesystem::file_size(file);
  if (found != expected || found > kMostBytes)
    throw DataError(fmt::format("{}: {} bytes; expected {}", file.string(), found, expected));
  std::vector<std::byte> bytes;
  bytes.reserve(found);
  read_pieces(file, [&bytes](std::string_view piece) {
    const auto* begin = reinterpret_cast<const std::byte*>(piece.data());
    bytes.insert(bytes.end(), begin, begin + piece.size());
  });
  if (bytes.size() != expected)
    throw DataError(fmt::format("{}: {} bytes; expected {}", file.string(), bytes.size(), expected));
  return bytes;
}

std::size_t bytes_of_type(const std::string& type) { return static_cast<std::size_t>(type.back() - '0'); }

/// The product of the lengths, or nothing if it exceeds any file.
std::optional<std::uintmax_t> bytes_of_array(const Json& entry) {
  std::uintmax_t bytes = bytes_of_type(entry.at("type"));
  for (const Json& length : entry.at("shape")) {
    const auto count = length.get<std::uintmax_t>();
    if (bytes > 0 && count > kMostBytes / bytes) return std::nullopt;  // the product might overflow
    bytes *= count;
  }
  return bytes;
}

template <typename Number>
void check_all_finite(const ArrayFile& file, const std::string& name, std::span<const Number> values) {
  const auto wrong = std::ranges::find_if(values, [](Number value) { return !std::isfinite(value); });
  if (wrong == values.end()) return;
  throw file.fault_at(fmt::format("{}[{}]", name, wrong - values.begin()), fmt::format("{}", *wrong),
                      "a finite number");
}

}  // namespace

ArrayFile::ArrayFile(const Path& json, const Json& schema) : file_(json), header_(read_json(json)) {
  const std::vector<std::string> faults = check_and_fill(header_, schema);
  if (!faults.empty()) throw DataError(fmt::format("{}: {}", file_.string(), faults.front()));
  data_ = read_binary(binary_of(json), header_.at("bytes").get<std::uintmax_t>());
  for (const auto& [name, entry] : header_.at("arrays").items()) {
    const auto offset = entry.at("offset").get<std::uintmax_t>();
    const auto bytes = bytes_of_array(entry);
    if (bytes && offset % kAlignmentBytes == 0 && offset <= data_.size() && *bytes <= data_.size() - offset)
      continue;
    throw fault_at(fmt::format("arrays.{}.offset", name), fmt::format("{}", offset),
                   fmt::format("a multiple of {} within the {} bytes of {}, with all of the array",
                               kAlignmentBytes, data_.size(), binary_of(json).filename().string()));
  }
}

DataError ArrayFile::fault_at(const std::string& where, const std::string& value,
                              const std::string& rule) const {
  return fault_of(fault(where, value, "", rule));
}

DataError ArrayFile::fault_of(const std::string& words) const {
  return DataError(fmt::format("{}: {}", file_.string(), words));
}

std::span<const std::byte> ArrayFile::bytes_of(const std::string& name, std::string_view type,
                                               const std::vector<std::size_t>& shape,
                                               std::size_t element_bytes) const {
  const Json& arrays = header_.at("arrays");
  if (!arrays.contains(name)) throw fault_at("arrays." + name, "nothing", "an array");
  const Json& entry = arrays.at(name);
  if (entry.at("type") != type)
    throw fault_at(fmt::format("arrays.{}.type", name), brief(entry.at("type")), fmt::format("\"{}\"", type));
  const auto found = entry.at("shape").get<std::vector<std::size_t>>();
  const bool fits = std::ranges::equal(
      found, shape, [](std::size_t one, std::size_t wanted) { return wanted == kAny || one == wanted; });
  if (!fits) {
    std::vector<std::string> words;
    for (const std::size_t length : shape) words.push_back(length == kAny ? "n" : std::to_string(length));
    throw fault_at(fmt::format("arrays.{}.shape", name), brief(entry.at("shape")),
                   fmt::format("[{}]", fmt::join(words, ", ")));
  }
  const std::size_t bytes = *bytes_of_array(entry);
  assert(bytes % element_bytes == 0);
  (void)element_bytes;
  return std::span(data_).subspan(entry.at("offset").get<std::size_t>(), bytes);
}

void ArrayFile::check_finite(const std::string& name, std::span<const float> values) const {
  check_all_finite(*this, name, values);
}

void ArrayFile::check_finite(const std::string& name, std::span<const double> values) const {
  check_all_finite(*this, name, values);
}

void ArrayFile::check_below(const std::string& name, std::span<const std::uint8_t> numbers,
                            std::size_t count) const {
  const auto wrong = std::ranges::find_if(numbers, [count](std::uint8_t number) { return number >= count; });
  if (wrong == numbers.end()) return;
  throw fault_at(fmt::format("{}[{}]", name, wrong - numbers.begin()), fmt::format("{}", *wrong),
                 fmt::format("less than {}", count));
}

static_assert(std::endian::native == std::endian::little, "arrays are little-endian");

ArrayWriter::ArrayWriter(const Path& json, const Path& scratch)
    : json_(json), binary_(scratch / (json.stem().string() + ".bin.new")) {}

void ArrayWriter::add_bytes(const std::string& name, const std::string& type,
                            const std::vector<std::size_t>& shape, std::span<const std::byte> bytes) {
  arrays_[name] = {{"type", type}, {"shape", shape}, {"offset", written_bytes_}};
  binary_.add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const std::size_t rest =
      (ArrayFile::kAlignmentBytes - bytes.size() % ArrayFile::kAlignmentBytes) % ArrayFile::kAlignmentBytes;
  binary_.add(std::string(rest, '\0'));
  written_bytes_ += bytes.size() + rest;
}

void ArrayWriter::close(Json header) {
  binary_.close_as(Path(json_).replace_extension(".bin"));
  header["bytes"] = written_bytes_;
  header["arrays"] = std::move(arrays_);
  write_file_atomically(json_, to_text(header));
}

}  // namespace thermal
