#include "bench/radiance_suite.h"

#include "base/parallel.h"
#include "bench/evaluator_rows.h"
#include "bench/scene_rows.h"

namespace thermal {

std::vector<BenchRow> run_radiance_suite(const MaterialLibrary& materials) {
  return with_threads(1, [&] {
    std::vector<BenchRow> rows = evaluator_rows();
    for (const auto& part : {term_rows(materials), supersample_rows(materials)}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    mark_dominated(rows);
    return rows;
  });
}

}  // namespace thermal
