#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "dataset/clip/imager.h"
#include "dataset/live/frame_stream.h"
#include "dataset/live/live_clip.h"
#include "dataset/live/world.h"
#include "io/manifest_file.h"
#include "io/video/h264_file.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

/// A frame for Python: ir8, ir16, whether the shutter was closed, and its labels as JSON, each label_entry() with its
/// category. The pictures are copied: the clip reuses its frame.
py::tuple tuple_of(const ClipImager::Frame& frame, const LiveClip& clip) {
  return py::make_tuple(array_of(Plane<std::uint8_t>(frame.pictures.ir8)),
                        array_of(Plane<std::uint16_t>(frame.pictures.ir16)), frame.pictures.shutter_closed,
                        clip.labels().dump());
}

/// Planes by name, from Python; absent ones are empty.
Passes passes_of(const py::dict& planes) {
  Passes passes;
  const auto take_indices = [&planes](const char* name, Plane<std::uint16_t>& plane) {
    if (planes.contains(name)) plane = index_plane_of(planes[name], name);
  };
  const auto take_numbers = [&planes](const char* name, Plane<float>& plane) {
    if (planes.contains(name)) plane = plane_of<float>(planes[name], name);
  };
  take_indices("object_index", passes.object_index);
  take_indices("material_index", passes.material_index);
  take_indices("actor_index", passes.actor_index);
  take_numbers("depth_m", passes.depth_m);
  take_numbers("normal_x", passes.normal[0]);
  take_numbers("normal_y", passes.normal[1]);
  take_numbers("normal_z", passes.normal[2]);
  return passes;
}

/// A clip that is opened with its first frame, whose planes decide on its terms. Calls from several threads are
/// serialised.
class Converter {
 public:
  Converter(const std::string& manifest, const std::string& name, const std::optional<std::string>& config,
            const std::string& config_name, std::vector<std::string> settings, const std::string& home)
      : options_{.assets = Assets(home), .config_name = config_name, .settings = std::move(settings)},
        manifest_(parse_manifest(parse_json(manifest, name), name, options_.assets)) {
    if (config) options_.config = parse_json(*config, config_name);
  }

  [[nodiscard]] py::tuple convert(int number, const py::dict& planes) {
    const Passes passes = passes_of(planes);
    const py::gil_scoped_release others_run;
    const std::lock_guard turn(mutex_);
    if (!clip_) clip_ = live_clip_of(manifest_, passes, options_);
    const ClipImager::Frame& frame = clip_->make(passes, number);
    const py::gil_scoped_acquire python;
    return tuple_of(frame, *clip_);
  }

  [[nodiscard]] std::size_t frames() const { return manifest_.frames.size(); }

 private:
  ConvertOptions options_;
  Manifest manifest_;
  std::unique_ptr<LiveClip> clip_;
  std::mutex mutex_;
};

}  // namespace

void add_converter(py::module_& module) {
  py::class_<Converter>(module, "Converter")
      .def(py::init<const std::string&, const std::string&, const std::optional<std::string>&,
                    const std::string&, std::vector<std::string>, const std::string&>(),
           py::arg("manifest"), py::arg("name"), py::arg("config"), py::arg("config_name"),
           py::arg("settings"), py::arg("home"))
      .def("convert", &Converter::convert, py::arg("number"), py::arg("planes"))
      .def_property_readonly("frames", &Converter::frames);
}

namespace {

std::array<double, 16> pose_of(const py::object& given) {
  std::array<double, 16> pose{};
  const ArrayOf<double> matrix = numbers_of<double>(given, "camera_to_world");
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4)
    throw ConfigError(fault("camera_to_world", std::to_string(matrix.size()) + " numbers", "", "4 x 4"));
  std::copy_n(matrix.data(), pose.size(), pose.begin());
  return pose;
}

py::array_t<double> times_of(const World& world) {
  const auto times_s = world.flight_s();
  py::array_t<double> array(std::vector<py::ssize_t>{static_cast<py::ssize_t>(times_s.size())});
  std::ranges::copy(times_s, array.mutable_data());
  return array;
}

py::array_t<double> poses_of(const World& world) {
  const auto poses = world.flight_poses();
  py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), py::ssize_t{4}, py::ssize_t{4}});
  for (std::size_t k = 0; k < poses.size(); ++k) std::ranges::copy(poses[k], array.mutable_data() + 16 * k);
  return array;
}

/// By track: (x, y, z) on the ground [m] and heading [rad].
py::dict actors_of(const World& world) {
  py::dict actors;
  for (const ActorPose& pose : world.frame().actors) {
    const auto actor = std::ranges::find(world.clip().manifest().objects, pose.index, &ManifestObject::index);
    actors[py::int_(actor->track_id)] = py::make_tuple(
        actor->category, pose.position_m[0], pose.position_m[1], pose.position_m[2], pose.heading_rad);
  }
  return actors;
}

/// Calls from several threads are serialised.
class PythonWorld {
 public:
  PythonWorld(const std::string& plan, const std::string& clip, const std::string& home,
              std::optional<double> frame_rate_hz, bool roam)
      : world_(std::make_unique<World>(plan, clip, Assets(home),
                                       WorldOptions{.frame_rate_hz = frame_rate_hz, .roam = roam})) {}

  [[nodiscard]] py::tuple capture(const py::object& camera_to_world, const py::object& time) {
    const std::array<double, 16> pose = pose_of(camera_to_world);
    const double time_s = finite_number_of(time, "time_s");
    const py::gil_scoped_release others_run;
    const std::lock_guard turn(mutex_);
    const ClipImager::Frame& frame = world_->capture(pose, time_s);
    const py::gil_scoped_acquire python;
    return py::make_tuple(tuple_of(frame, world_->clip()),
                          array_of(Plane<std::uint16_t>(world_->passes().object_index)),
                          array_of(Plane<float>(world_->passes().depth_m)), actors_of(*world_));
  }

  void restart(std::uint32_t seed) {
    const py::gil_scoped_release others_run;
    const std::lock_guard turn(mutex_);
    world_->restart(seed);
  }

  [[nodiscard]] const World& world() const { return *world_; }

 private:
  std::unique_ptr<World> world_;
  std::mutex mutex_;
};

}  // namespace

void add_world(py::module_& module) {
  py::class_<PythonWorld>(module, "World")
      .def(
          py::init<const std::string&, const std::string&, const std::string&, std::optional<double>, bool>(),
          py::arg("plan"), py::arg("clip"), py::arg("home"), py::arg("frame_rate_hz"), py::arg("roam"),
          py::call_guard<py::gil_scoped_release>())
      .def("capture", &PythonWorld::capture, py::arg("camera_to_world"), py::arg("time_s"))
      .def("restart", &PythonWorld::restart, py::arg("seed"))
      .def_property_readonly("seed", [](const PythonWorld& of) { return of.world().clip().task().seed; })
      .def_property_readonly("frame_rate_hz",
                             [](const PythonWorld& of) { return of.world().frame_rate_hz(); })
      .def_property_readonly("flight_s", [](const PythonWorld& of) { return times_of(of.world()); })
      .def_property_readonly("flight_poses", [](const PythonWorld& of) { return poses_of(of.world()); })
      .def_property_readonly("camera", [](const PythonWorld& of) {
        const CameraIntrinsics& camera = of.world().clip().manifest().camera;
        return py::make_tuple(camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px,
                              camera.cy_px);
      });
}

namespace {

FrameStream* open_stream(const std::string& video_url, const std::optional<std::string>& labels_url,
                         double frame_rate_hz, int width_px, int height_px, bool allow_remote) {
  StreamTarget target = {.video = parse_video_address(video_url, "video_url"),
                         .frame_rate_hz = frame_rate_hz,
                         .width_px = width_px,
                         .height_px = height_px};
  if (labels_url) target.lines = parse_line_address(*labels_url, "labels_url");
  if (!allow_remote) {
    constexpr const char* kPermit = "allow_remote=True";
    check_is_loopback(target.video, "video_url", kPermit);
    if (target.lines) check_is_loopback(*target.lines, "labels_url", kPermit);
  }
  silence_ffmpeg();                // counts report a missing receiver
  return new FrameStream(target);  // pybind11 owns it
}

}  // namespace

void add_stream(py::module_& module) {
  py::class_<FrameStream>(module, "FrameStream")
      .def(py::init(&open_stream), py::arg("video_url"), py::arg("labels_url"), py::arg("frame_rate_hz"),
           py::arg("width_px"), py::arg("height_px"), py::arg("allow_remote"),
           py::call_guard<py::gil_scoped_release>())
      .def(
          "send",
          [](FrameStream& stream, const py::object& ir8, std::int64_t time, const std::string& line) {
            const Plane<std::uint8_t> frame = levels_of(ir8, "ir8");
            const py::gil_scoped_release others_run;
            return stream.send(frame, time, line);
          },
          py::arg("ir8"), py::arg("time"), py::arg("line"))
      .def("close", &FrameStream::close, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("clients_refused",
                             [](const FrameStream& stream) { return stream.counts().clients_refused; })
      .def_property_readonly("counts", [](const FrameStream& stream) {
        const FrameStream::Counts counts = stream.counts();
        return py::make_tuple(counts.sent, counts.dropped, counts.waiting, counts.lines_missed, counts.fault);
      });
  module.def(
      "check_is_loopback",
      [](const std::string& url, const std::string& where, const std::string& permit) {
        check_is_loopback(parse_address(url, {"udp", "tcp", "rtsp"}, where), where, permit);
      },
      py::arg("url"), py::arg("where"), py::arg("permit"));
  module.def("frames_to_leave_out", &frames_to_leave_out, py::arg("late_s"), py::arg("frame_rate_hz"));
}

}  // namespace thermal::python
