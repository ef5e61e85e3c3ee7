#include "io/system/tar_file.h"

#include <cerrno>
#include <clocale>
#include <cstddef>
#include <new>
#include <utility>

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr int kBytesPerWrite = 1 << 20;  // a multiple of 512, the block of tar
constexpr int kMode = 0644;

struct FreeArchive {
  void operator()(archive* tar) const noexcept { ::archive_write_free(tar); }
};

struct FreeEntry {
  void operator()(archive_entry* entry) const noexcept { ::archive_entry_free(entry); }
};

using Archive = std::unique_ptr<archive, FreeArchive>;
using Entry = std::unique_ptr<archive_entry, FreeEntry>;

/// While it exists, libarchive takes names for UTF-8, whatever the locale of the process is.
class Utf8 {
 public:
  Utf8() : locale_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(::uselocale(locale_)) {}
  ~Utf8() {
    ::uselocale(before_);
    if (locale_) ::freelocale(locale_);
  }
  Utf8(const Utf8&) = delete;
  Utf8& operator=(const Utf8&) = delete;

 private:
  locale_t locale_;
  locale_t before_;
};

Archive new_archive() {
  Archive tar(::archive_write_new());
  if (!tar) throw std::bad_alloc();
  ::archive_write_set_format_pax_restricted(tar.get());
  ::archive_write_set_bytes_per_block(tar.get(), kBytesPerWrite);
  ::archive_write_set_bytes_in_last_block(tar.get(), 1);  // nothing is appended to fill the last write
  return tar;
}

Entry entry_of(const std::string& name, std::size_t bytes) {
  Entry entry(::archive_entry_new());
  if (!entry) throw std::bad_alloc();
  ::archive_entry_set_pathname(entry.get(), name.c_str());
  ::archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes));
  ::archive_entry_set_filetype(entry.get(), AE_IFREG);
  ::archive_entry_set_perm(entry.get(), kMode);
  ::archive_entry_set_mtime(entry.get(), 0, 0);
  ::archive_entry_set_uid(entry.get(), 0);
  ::archive_entry_set_gid(entry.get(), 0);
  return entry;
}

}  // namespace

struct TarFile::Impl {
  explicit Impl(const Path& place)
      : file(place), number(::open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
    if (number < 0) fail_at("write", file, errno);
  }
  ~Impl() {
    if (number < 0) return;
    ::archive_write_fail(tar.get());  // what it holds back is not written
    tar.reset();
    ::close(number);
    ::unlink(file.c_str());
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Throws unless libarchive reports success.
  void check(la_ssize_t status) const {
    if (status >= ARCHIVE_OK) return;
    const int error = ::archive_errno(tar.get());
    if (error > 0) fail_at("write", file, error);
    const char* words = ::archive_error_string(tar.get());
    throw IoError(fmt::format("cannot write {}: {}", file.string(), words ? words : "unknown error"));
  }

  Archive tar = new_archive();
  Path file;
  int number;
};

TarFile::TarFile(const Path& file) : impl_(std::make_unique<Impl>(file)) {
  impl_->check(::archive_write_open_fd(impl_->tar.get(), impl_->number));
}

TarFile::~TarFile() = default;

void TarFile::add(const std::string& name, std::string_view content) {
  archive* tar = impl_->tar.get();
  const Utf8 names;
  impl_->check(::archive_write_header(tar, entry_of(name, content.size()).get()));
  impl_->check(::archive_write_data(tar, content.data(), content.size()));
  impl_->check(::archive_write_finish_entry(tar));
}

void TarFile::close() {
  impl_->check(::archive_write_close(impl_->tar.get()));
  if (::close(impl_->number) != 0 && errno != EINTR) fail_at("write", impl_->file, errno);
  impl_->number = -1;
}

}  // namespace thermal
