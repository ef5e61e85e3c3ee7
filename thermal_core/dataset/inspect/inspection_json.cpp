#include <fmt/format.h>

#include "dataset/inspect/inspection.h"
#include "io/json/camera.h"

namespace thermal {
namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json gaps_of(const FrameSequence& sequence) {
  Json gaps = Json::array();
  for (const auto& [name, is_gap] : sequence.frames)
    if (is_gap) gaps.push_back(name.name);
  return gaps;
}

Json channels_of(const ExrHeader& header) {
  Json channels = Json::array();
  for (const ExrChannel& channel : header.channels) {
    channels.push_back({{"name", channel.name},
                        {"part", channel.part},
                        {"layer", channel.layer},
                        {"pass", channel.pass},
                        {"component", channel.component},
                        {"type", channel.type},
                        {"compression", channel.compression}});
  }
  return channels;
}

Json objects_of(const Inspection& inspection) {
  Json objects = Json::array();
  for (const auto& [index, pixels] : inspection.survey.objects)
    objects.push_back({{"index", index}, {"pixels", pixels}, {"name", object_name(inspection, index)}});
  return objects;
}

Json materials_of(const PassSurvey& survey) {
  Json materials = Json::array();
  for (const auto& [index, pixels] : survey.materials)
    materials.push_back({{"index", index}, {"pixels", pixels}});
  return materials;
}

Json colours_of(const PassSurvey& survey) {
  Json colours = Json::array();
  for (const auto& [colour, pixels] : survey.colours)
    colours.push_back({{"colour", colour}, {"pixels", pixels}});
  return colours;
}

Json mattes_of(const std::map<std::uint32_t, PassSurvey::Matte>& mattes) {
  Json found = Json::array();
  for (const auto& [hash, matte] : mattes) {
    found.push_back({{"hash", fmt::format("{:08x}", hash)},
                     {"name", text_or_null(matte.name)},
                     {"pixels", matte.pixels}});
  }
  return found;
}

Json cryptomattes_of(const PassSurvey& survey) {
  Json cryptomattes = Json::array();
  for (const auto& [name, mattes] : survey.cryptomattes)
    cryptomattes.push_back({{"name", name}, {"mattes", mattes_of(mattes)}});
  return cryptomattes;
}

Json depth_of(const PassSurvey& survey) {
  if (!survey.depth) return nullptr;
  return {{"nearest_m", survey.depth->nearest_m}, {"farthest_m", survey.depth->farthest_m}};
}

Json bad_frames_of(const PassSurvey& survey) {
  Json frames = Json::array();
  for (const PassSurvey::BadFrame& frame : survey.bad_frames)
    frames.push_back({{"file", frame.file}, {"reason", frame.reason}});
  return frames;
}

Json conversion_of(const Inspection& inspection) {
  return {{"possible", inspection.obstacle.empty()},
          {"obstacle", text_or_null(inspection.obstacle)},
          {"object_index", text_or_null(inspection.planes.objects)},
          {"cryptomatte", text_or_null(inspection.cryptomatte)},
          {"material_index", text_or_null(inspection.planes.materials)},
          {"depth", text_or_null(inspection.planes.depth)},
          {"normal", text_or_null(inspection.planes.normals)},
          {"likely_object_index", inspection.likely},
          {"has_manifest", inspection.manifest.has_value()}};
}

}  // namespace

Json to_json(const Inspection& inspection) {
  const FrameSequence& sequence = inspection.sequence;
  Json report = {{"file", inspection.file.string()},
                 {"files", sequence.frames.size() - static_cast<std::size_t>(sequence.gaps())},
                 {"missing", gaps_of(sequence)},
                 {"frames_read", inspection.survey.frames},
                 {"width_px", inspection.header.width_px},
                 {"height_px", inspection.header.height_px},
                 {"compression", inspection.header.compression},
                 {"channels", channels_of(inspection.header)},
                 {"objects", objects_of(inspection)},
                 {"materials", materials_of(inspection.survey)},
                 {"colours", colours_of(inspection.survey)},
                 {"cryptomattes", cryptomattes_of(inspection.survey)},
                 {"cryptomatte_faults", inspection.cryptomatte_faults},
                 {"depth", depth_of(inspection.survey)},
                 {"bad_frames", bad_frames_of(inspection.survey)},
                 {"conversion", conversion_of(inspection)}};
  if (const auto& window = inspection.window) {
    report["data_window"] = {{"x_px", window->x_px},
                             {"y_px", window->y_px},
                             {"width_px", window->width_px},
                             {"height_px", window->height_px}};
  }
  if (inspection.manifest && inspection.manifest->overscan_px > 0)
    report["overscan_px"] = inspection.manifest->overscan_px;
  if (inspection.manifest && !inspection.manifest->lens.is_none())
    report["distortion"] = to_json(inspection.manifest->lens);
  return report;
}

}  // namespace thermal
