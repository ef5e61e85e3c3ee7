#pragma once

#include "fuzz/target.h"

/// One function per reader of untrusted files. Whatever the bytes, it returns within seconds and a few hundred MB; an
/// exception that leaves it is a fault of the reader, and so is a sanitizer's report.
namespace fuzz {

void baked_scene(Bytes bytes);    ///< a plan's scene.json, a NUL byte, and scene.bin
void birdsai(Bytes bytes);        ///< annotations of one video, CSV
void calibration(Bytes bytes);    ///< a camera's calibration: OpenCV's YAML, XML or JSON, or ROS'
void coco(Bytes bytes);           ///< a COCO file
void config(Bytes bytes);         ///< a config; or settings as for --set, one per line
void dataset(Bytes bytes);        ///< files and links of a dataset, as JSON
void detections(Bytes bytes);     ///< COCO results; or YOLO's of one picture
void exr_passes(Bytes bytes);     ///< an EXR file; its last byte chooses the manifest
void ground_maps(Bytes bytes);    ///< a plan's ground.json, a NUL byte, and ground.bin
void index_picture(Bytes bytes);  ///< a PNG; its last byte chooses the manifest
void manifest(Bytes bytes);       ///< a manifest
void picture(Bytes bytes);        ///< a TIFF, PNG or JPEG of grey levels or temperatures
void scene_plan(Bytes bytes);     ///< a plan's plan.json and config.json, as one JSON
void tracks(Bytes bytes);         ///< a track's JSON, a NUL byte, and its arrays
void variants(Bytes bytes);       ///< variants of a small config

}  // namespace fuzz
