#include "io/bake/array_writer.h"

#include <bit>
#include <string_view>

#include "io/bake/array_file.h"

namespace thermal {

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
