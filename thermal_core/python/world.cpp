#include "dataset/run/world.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "base/error.h"
#include "python/arrays.h"
#include "python/frames.h"
#include "python/parts.h"

namespace thermal::python {
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

}  // namespace thermal::python
