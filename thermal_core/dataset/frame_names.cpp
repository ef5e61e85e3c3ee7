#include "dataset/frame_names.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr const char* kNamesRule =
    "text and the fields {altitude_m}, {look_angle_deg} and {_}, one of the first two among them, with text "
    "between fields";

bool is_field(std::string_view name) {
  constexpr std::array<std::string_view, 3> kFields = {"altitude_m", "look_angle_deg", "_"};
  return std::find(kFields.begin(), kFields.end(), name) != kFields.end();
}

}  // namespace

FrameNames::FrameNames(std::string_view pattern, const std::string& where) {
  const auto refuse = [&] { throw ConfigError(fault(where, pattern, "", kNamesRule)); };
  start_ = pattern.substr(0, pattern.find('{'));
  for (std::size_t at = start_.size(); at < pattern.size();) {
    const std::size_t close = pattern.find('}', at);
    if (close == std::string_view::npos) refuse();
    const std::size_t next = std::min(pattern.find('{', close), pattern.size());
    pieces_.push_back({.field = std::string(pattern.substr(at + 1, close - at - 1)),
                       .text = std::string(pattern.substr(close + 1, next - close - 1))});
    if (!is_field(pieces_.back().field) || (pieces_.back().text.empty() && next < pattern.size())) refuse();
    at = next;
  }
  if (std::all_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return piece.field == "_"; }))
    refuse();
}

std::optional<NamedPose> FrameNames::read(std::string_view name) const {
  if (!name.starts_with(start_)) return {};
  name.remove_prefix(start_.size());
  NamedPose pose;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const bool last = k + 1 == pieces_.size();
    const std::string& text = pieces_[k].text;
    if (last && !name.ends_with(text)) return {};
    const std::size_t end = last ? name.size() - text.size() : name.find(text, 1);
    if (end == std::string_view::npos || end == 0) return {};
    const auto number = number_in<double>(name.substr(0, end));
    if (pieces_[k].field != "_" && !(number && std::isfinite(*number))) return {};
    if (pieces_[k].field == "altitude_m") pose.altitude_m = number;
    if (pieces_[k].field == "look_angle_deg") pose.look_angle_deg = number;
    name.remove_prefix(end + text.size());
  }
  return pose;
}

}  // namespace thermal
