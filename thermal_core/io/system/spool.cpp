#include "io/system/spool.h"

#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

void read_lines(std::istream& in, const Spool::TakeLine& take) {
  for (std::string line; std::getline(in, line);) take(line);
}

}  // namespace

Spool::Spool(Path file) : file_(std::move(file)) {
  if (!file_.empty()) out_.emplace(file_);
}

Spool::~Spool() {
  std::error_code error;  // if this fails, the file stays
  if (!file_.empty()) std::filesystem::remove(file_, error);
}

void Spool::add(std::string_view line) {
  if (!out_) {
    text_.append(line).push_back('\n');
    return;
  }
  out_->add(line);
  out_->add("\n");
}

void Spool::read(const TakeLine& take) {
  if (!out_) {
    std::istringstream in(text_);
    return read_lines(in, take);
  }
  (void)out_->close();
  std::ifstream in(file_);
  read_lines(in, take);
  if (in.bad() || !in.eof()) throw IoError(fmt::format("cannot read {}: it has disappeared", file_.string()));
  std::error_code error;
  std::filesystem::remove(file_, error);
  if (error) fail_at("remove", file_, error.value());
  file_.clear();
}

}  // namespace thermal
