#include "io/output_file.h"

#include <cerrno>

#include <unistd.h>

namespace thermal {

OutputFile::OutputFile(const Path& file) : file_(file) {
  ::unlink(file.c_str());
  stream_.reset(
      std::fopen(file.c_str(), "wxe"));  // x: fails if something has been created meanwhile; e: close on exec
  if (!stream_) fail_at("write", file_, errno);
}

OutputFile::~OutputFile() {
  if (stream_) ::unlink(file_.c_str());
}

void OutputFile::add(std::string_view text) {
  sum_.add(text);
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail_at("write", file_, errno);
}

std::string OutputFile::close() {
  if (std::fclose(stream_.release()) != 0) {
    const int error = errno;
    ::unlink(file_.c_str());
    fail_at("write", file_, error);
  }
  return sum_.hex();
}

std::string OutputFile::close_as(const Path& place) {
  if (std::fflush(stream_.get()) != 0 || ::fsync(::fileno(stream_.get())) != 0)
    fail_at("write", file_, errno);
  std::string sum = close();
  if (::rename(file_.c_str(), place.c_str()) != 0) fail_at("rename to", place, errno);
  sync_folder(place.parent_path());
  return sum;
}

}  // namespace thermal
