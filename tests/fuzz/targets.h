#pragma once

#include "fuzz/target.h"

/// One function a reader of what strangers wrote. Whatever the bytes, it returns within seconds and a few hundred MB;
/// an exception that leaves it, as a sanitizer's complaint, is a fault of the reader.
namespace fuzz {

void birdsai(Bytes bytes);        ///< annotations of one video, CSV
void coco(Bytes bytes);           ///< a COCO file
void config(Bytes bytes);         ///< a config; or settings, one a line, as --set takes them
void detections(Bytes bytes);     ///< COCO results; or YOLO's of one picture
void exr_passes(Bytes bytes);     ///< an EXR file; its last byte chooses the manifest
void index_picture(Bytes bytes);  ///< a PNG; its last byte chooses the manifest
void manifest(Bytes bytes);       ///< a manifest
void variants(Bytes bytes);       ///< variants of a small config

}  // namespace fuzz
