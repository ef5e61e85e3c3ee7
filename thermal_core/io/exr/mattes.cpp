#include "io/exr/mattes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "scene/manifest.h"

namespace thermal {
namespace {

std::uint32_t scrambled(std::uint32_t block) noexcept {
  return std::rotl(block * 0xCC9E2D51U, 15) * 0x1B873593U;
}

/// Up to four bytes, little-endian on every machine.
std::uint32_t block_of(std::string_view bytes) noexcept {
  std::uint32_t block = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    block |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return block;
}

std::uint32_t murmur_hash(std::string_view bytes) noexcept {
  std::uint32_t hash = 0;
  const auto length = static_cast<std::uint32_t>(bytes.size());
  for (; bytes.size() >= 4; bytes.remove_prefix(4)) {
    hash = std::rotl(hash ^ scrambled(block_of(bytes.substr(0, 4))), 13) * 5 + 0xE6546B64U;
  }
  hash ^= scrambled(block_of(bytes)) ^ length;
  hash = (hash ^ (hash >> 16)) * 0x85EBCA6BU;
  hash = (hash ^ (hash >> 13)) * 0xC2B2AE35U;
  return hash ^ (hash >> 16);
}

}  // namespace

std::uint32_t hash_in_float(std::uint32_t hash) noexcept {
  const std::uint32_t exponent = (hash >> 23) & 0xFF;
  return exponent == 0 || exponent == 0xFF ? hash ^ (1U << 23) : hash;
}

std::uint32_t cryptomatte_hash(std::string_view name) noexcept { return hash_in_float(murmur_hash(name)); }

bool matches_matte(std::string_view pattern, std::string_view name) noexcept {
  // After a mismatch, the last star matches one more letter, so that the time is at most the product of both lengths.
  std::size_t in_pattern = 0;
  std::size_t in_name = 0;
  std::size_t after_star = std::string_view::npos;
  std::size_t star_ends = 0;
  while (in_name < name.size()) {
    if (in_pattern < pattern.size() && pattern[in_pattern] == '*') {
      after_star = ++in_pattern;
      star_ends = in_name;
    } else if (in_pattern < pattern.size() && pattern[in_pattern] == name[in_name]) {
      ++in_pattern;
      ++in_name;
    } else if (after_star != std::string_view::npos) {
      in_pattern = after_star;
      in_name = ++star_ends;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', in_pattern) == std::string_view::npos;
}

MatteNames::MatteNames(std::span<const ManifestObject> objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ManifestObject& object = objects[i];
    Matte matte = {.text = object.name, .is_pattern = false, .index = object.index, .object = object.name};
    if (object.mattes.empty()) add(matte, fmt::format("objects[{}].name", i));
    for (std::size_t k = 0; k < object.mattes.size(); ++k) {
      matte.text = object.mattes[k];
      matte.is_pattern = matte.text.find('*') != std::string::npos;
      add(matte, fmt::format("objects[{}].mattes[{}]", i, k));
    }
  }
}

/// The same matte listed twice for one object is harmless.
void MatteNames::add(Matte matte, const std::string& where) {
  const auto check = [&](const auto& found, bool is_new, std::string_view what) {
    const std::size_t other = found->second;
    if (is_new || mattes_[other].index == matte.index) return;
    throw DataError(
        fault(where, fmt::format("\"{}\"", matte.text), "",
              fmt::format("a unique {}, but {} is \"{}\"", what, where_[other], mattes_[other].text)));
  };
  const auto [text, new_text] = by_text_.emplace(matte.text, mattes_.size());
  check(text, new_text, "name");
  if (!matte.is_pattern) {
    const auto [hash, new_hash] = by_hash_.emplace(cryptomatte_hash(matte.text), mattes_.size());
    check(hash, new_hash, "hash");
  }
  mattes_.push_back(std::move(matte));
  where_.push_back(where);
}

const MatteNames::Matte* MatteNames::find(std::string_view name) const {
  const auto itself = by_text_.find(std::string(name));
  if (itself != by_text_.end() && !mattes_[itself->second].is_pattern) return &mattes_[itself->second];
  const Matte* found = nullptr;
  for (const Matte& matte : mattes_) {
    if (!matte.is_pattern || !matches_matte(matte.text, name)) continue;
    if (found != nullptr && found->index != matte.index) {
      throw DataError(fmt::format("expected a name of one object, but {}'s \"{}\" and {}'s \"{}\" match it",
                                  found->object, found->text, matte.object, matte.text));
    }
    if (found == nullptr) found = &matte;
  }
  return found;
}

const MatteNames::Matte* MatteNames::find_hash(std::uint32_t hash) const noexcept {
  const auto found = by_hash_.find(hash);
  return found != by_hash_.end() ? &mattes_[found->second] : nullptr;
}

std::vector<std::string> MatteNames::texts() const {
  std::vector<std::string> texts;
  for (const Matte& matte : mattes_) texts.push_back(matte.text);
  return texts;
}

namespace {

/// One object of a pixel.
struct Share {
  std::uint16_t index = 0;
  double coverage = 0;
};

/// Caches the results, and separately the last one: neighbouring pixels mostly show the same object.
class IndexCache {
 public:
  explicit IndexCache(const MatteIndex& index_of) : index_of_(index_of) {}

  std::uint16_t of(std::uint32_t hash) {
    if (hash == last_hash_) return last_index_;
    auto known = known_.find(hash);
    if (known == known_.end()) known = known_.emplace(hash, index_of_(hash)).first;
    last_hash_ = hash;
    return last_index_ = known->second;
  }

 private:
  const MatteIndex& index_of_;
  std::unordered_map<std::uint32_t, std::uint16_t> known_;
  std::uint32_t last_hash_ = 0;  ///< nothing, which is never looked up
  std::uint16_t last_index_ = 0;
};

/// Combines the objects of each pixel.
class Ranker {
 public:
  Ranker(const MatteChannels& mattes, const MatteIndex& index_of, Passes& passes)
      : mattes_(mattes), cache_(index_of), passes_(passes) {
    const Plane<float>& first = mattes.planes.front();
    passes_.object_index = Plane<std::uint16_t>(first.width_px(), first.height_px());
    passes_.ranks.clear();
    shares_.reserve(mattes.planes.size() / 2);
  }

  void rank(std::size_t pixel) {
    gather(pixel);
    if (shares_.empty()) return;
    const double covered = normalise();
    const Share& most = shares_.front();
    passes_.object_index.pixels()[pixel] = 1 - covered > most.coverage ? kSkyIndex : most.index;
    store(pixel);
  }

 private:
  void gather(std::size_t pixel) {
    shares_.clear();
    for (std::size_t k = 0; k < mattes_.planes.size(); k += 2) {
      const float coverage = mattes_.planes[k + 1].pixels()[pixel];
      if (coverage < 0 || !std::isfinite(coverage)) fail(k + 1, pixel);
      const auto hash = std::bit_cast<std::uint32_t>(mattes_.planes[k].pixels()[pixel]);
      if (coverage > 0 && hash != 0) add(cache_.of(hash), static_cast<double>(coverage));
    }
  }

  void add(std::uint16_t index, double coverage) {
    const auto same = [index](const Share& share) { return share.index == index; };
    const auto found = std::find_if(shares_.begin(), shares_.end(), same);
    if (found != shares_.end()) {
      found->coverage += coverage;
    } else {
      shares_.push_back({.index = index, .coverage = coverage});
    }
  }

  /// Normalises coverages; returns their sum.
  double normalise() {
    double covered = 0;
    for (const Share& share : shares_) covered += share.coverage;
    if (covered > 1) {
      for (Share& share : shares_) share.coverage /= covered;
      covered = 1;
    }
    const auto more = [](const Share& a, const Share& b) { return a.coverage > b.coverage; };
    std::stable_sort(shares_.begin(), shares_.end(), more);
    return covered;
  }

  void store(std::size_t pixel) {
    const Plane<std::uint16_t>& like = passes_.object_index;
    for (std::size_t rank = 0; rank < shares_.size(); ++rank) {
      if (rank == passes_.ranks.size()) {
        passes_.ranks.push_back({.object_index = Plane<std::uint16_t>(like.width_px(), like.height_px()),
                                 .coverage = Plane<float>(like.width_px(), like.height_px())});
      }
      passes_.ranks[rank].object_index.pixels()[pixel] = shares_[rank].index;
      passes_.ranks[rank].coverage.pixels()[pixel] = static_cast<float>(shares_[rank].coverage);
    }
  }

  [[noreturn]] void fail(std::size_t channel, std::size_t pixel) const {
    const Plane<float>& plane = mattes_.planes[channel];
    const auto width = static_cast<std::size_t>(plane.width_px());
    throw DataError(
        fault(fmt::format("{} at pixel ({}, {})", mattes_.names[channel], pixel % width, pixel / width),
              fmt::format("{}", plane.pixels()[pixel]), "", "a coverage from 0 to 1"));
  }

  const MatteChannels& mattes_;
  IndexCache cache_;
  Passes& passes_;
  std::vector<Share> shares_;
};

}  // namespace

MatteSpot spot_matte(const MatteChannels& mattes, std::uint32_t hash) {
  MatteSpot spot = {.hash = hash, .channel = "", .x_px = 0, .y_px = 0, .pixels = 0};
  const Plane<float>& first = mattes.planes.front();
  const auto width = static_cast<std::size_t>(first.width_px());
  for (std::size_t pixel = 0; pixel < first.size(); ++pixel) {
    for (std::size_t k = 0; k < mattes.planes.size(); k += 2) {
      const bool covers = mattes.planes[k + 1].pixels()[pixel] > 0;
      if (!covers || std::bit_cast<std::uint32_t>(mattes.planes[k].pixels()[pixel]) != hash) continue;
      if (spot.pixels++ > 0) break;  // counted once per pixel
      spot.channel = mattes.names[k];
      spot.x_px = static_cast<int>(pixel % width);
      spot.y_px = static_cast<int>(pixel / width);
      break;
    }
  }
  return spot;
}

void rank_mattes(const MatteChannels& mattes, const MatteIndex& index_of, Passes& passes) {
  Ranker ranker(mattes, index_of, passes);
  for (std::size_t pixel = 0; pixel < mattes.planes.front().size(); ++pixel) ranker.rank(pixel);
}

}  // namespace thermal
