#include "io/output_file.h"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

[[noreturn]] void fail(std::string_view doing, const Path& file) {
  const int error = errno;
  const std::string message = fmt::format("cannot {} {}: {}", doing, file.string(), std::strerror(error));
  if (error == ENOSPC || error == EDQUOT) throw TryAgainError(message);
  throw IoError(message);
}

}  // namespace

OutputFile::OutputFile(const Path& file) : file_(file) {
  ::unlink(file.c_str());
  stream_.reset(
      std::fopen(file.c_str(), "wxe"));  // x: fails on what was put there meanwhile; e: close on exec
  if (!stream_) fail("write", file_);
}

OutputFile::~OutputFile() {
  if (stream_) ::unlink(file_.c_str());
}

void OutputFile::add(std::string_view text) {
  sum_.add(text);
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail("write", file_);
}

std::string OutputFile::close() {
  if (std::fclose(stream_.release()) != 0) {
    const int error = errno;
    ::unlink(file_.c_str());
    errno = error;
    fail("write", file_);
  }
  return sum_.hex();
}

std::string OutputFile::close_as(const Path& place) {
  if (std::fflush(stream_.get()) != 0 || ::fsync(::fileno(stream_.get())) != 0) fail("write", file_);
  std::string sum = close();
  if (::rename(file_.c_str(), place.c_str()) != 0) fail("rename to", place);
  sync_folder(place.parent_path());
  return sum;
}

}  // namespace thermal
