#include "io/matte_ranks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include "base/error.h"
#include "scene/manifest.h"

namespace thermal {
namespace {

/// One object of a pixel.
struct Share {
  std::uint16_t index = 0;
  double coverage = 0;
};

/// Caches the results, with the last one at hand: neighbouring pixels mostly show the same object.
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

  /// Returns the sum.
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
