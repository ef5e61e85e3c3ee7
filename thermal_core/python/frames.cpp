#include "python/frames.h"

#include <algorithm>
#include <string>

#include "dataset/clip/annotations.h"
#include "python/arrays.h"

namespace thermal::python {
namespace {

std::string labels_of(const ClipImager::Frame& frame, const LiveClip& clip) {
  const Manifest& manifest = clip.manifest();
  Json labels = Json::array();
  for (const Instance& instance : frame.instances) {
    const auto actor = std::ranges::find(manifest.objects, instance.index, &ManifestObject::index);
    Json label = {{"category", actor->category}};
    label.update(
        label_entry(instance, *actor, manifest.camera, clip.task().labels, frame.pictures.shutter_closed));
    labels.push_back(std::move(label));
  }
  return labels.dump();
}

}  // namespace

py::tuple tuple_of(const ClipImager::Frame& frame, const LiveClip& clip) {
  return py::make_tuple(array_of(Plane<std::uint8_t>(frame.pictures.ir8)),
                        array_of(Plane<std::uint16_t>(frame.pictures.ir16)), frame.pictures.shutter_closed,
                        labels_of(frame, clip));
}

}  // namespace thermal::python
