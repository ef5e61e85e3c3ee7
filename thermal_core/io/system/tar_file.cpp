#include "io/system/tar_file.h"

#include <cerrno>
#include <cstddef>
#include <new>
#include <utility>

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "io/system/c_locale.h"

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
    discards = true;
    tar.reset();
    ::close(number);
    ::unlink(file.c_str());
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Callback of libarchive. Always reports success, because libarchive does not free its memory after a failure.
  static la_ssize_t take(archive*, void* self, const void* bytes, std::size_t count) noexcept {
    static_cast<Impl*>(self)->write({static_cast<const char*>(bytes), count});
    return static_cast<la_ssize_t>(count);
  }

  void write(std::string_view bytes) noexcept {
    while (!bytes.empty() && !discards && error == 0) {
      const ssize_t written = ::write(number, bytes.data(), bytes.size());
      if (written >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(written));
      } else if (errno != EINTR) {
        error = errno;
      }
    }
  }

  /// Throws unless libarchive reports success and everything was written.
  void check(la_ssize_t status) const {
    if (error != 0) fail_at("write", file, error);
    if (status >= ARCHIVE_OK) return;
    if (const int reason = ::archive_errno(tar.get()); reason > 0) fail_at("write", file, reason);
    const char* words = ::archive_error_string(tar.get());
    throw IoError(fmt::format("cannot write {}: {}", file.string(), words ? words : "unknown error"));
  }

  Archive tar = new_archive();
  Path file;
  int number;
  int error = 0;  ///< of the first write that failed
  bool discards = false;
};

TarFile::TarFile(const Path& file) : impl_(std::make_unique<Impl>(file)) {
  impl_->check(::archive_write_open(impl_->tar.get(), impl_.get(), nullptr, &Impl::take, nullptr));
}

TarFile::~TarFile() = default;

void TarFile::add(const std::string& name, std::string_view content) {
  archive* tar = impl_->tar.get();
  const CLocale names;
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
