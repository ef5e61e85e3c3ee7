#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "dataset/exports/plan.h"
#include "io/system/files.h"

namespace thermal {

/// Tar files of samples as the WebDataset library reads them: SPLIT/NAME-000000.tar with at most `samples` pictures, in
/// the order of the set. DataError for two pictures with one key, and for invalid file names.
[[nodiscard]] ExportPlan plan_webdataset(const ExportInput& input, std::size_t samples);

/// The labels of a picture: everything that the set knows, without masks. `first` is that of first_labels().
[[nodiscard]] std::string sample_json(const LabelSet& set, std::size_t image,
                                      const std::vector<std::size_t>& first);

/// Writes one tar file: for each picture KEY.json, then KEY.png unchanged. `begin_sample` is called before each sample
/// with its image, and may throw to stop. Errors as TarFile, and IoError for a picture that cannot be read.
void write_shard(const Path& file, const PlannedShard& shard, const LabelSet& set,
                 const std::vector<std::size_t>& first,
                 const std::function<void(const LabelImage& image)>& begin_sample);

/// Whether a file name, relative to the export's folder, is that of a tar file of plan_webdataset().
[[nodiscard]] bool is_shard_name(const Path& name, const ExportInput& input);

}  // namespace thermal
