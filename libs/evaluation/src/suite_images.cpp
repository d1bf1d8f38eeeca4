// Images and masks of two runs.

#include "suite_files.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/image_file.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::evaluation {
namespace {

void compare_labels(const imaging::FloatVolume& golden, const imaging::FloatVolume& result,
                    const ImageRule& rule, ComparedFile& file, std::vector<Finding>& findings) {
  struct Counts {
    std::size_t golden = 0, result = 0, both = 0;
  };
  std::map<int, Counts> labels;
  for (std::size_t i = 0; i < golden.voxels.size(); ++i) {
    const int a = static_cast<int>(golden.voxels[i]), b = static_cast<int>(result.voxels[i]);
    if (a != 0) ++labels[a].golden;
    if (b != 0) ++labels[b].result;
    if (a != 0 && a == b) ++labels[a].both;
  }
  for (const auto& [label, n] : labels) {
    const double dice = 2.0 * static_cast<double>(n.both) / static_cast<double>(n.golden + n.result);
    judge({"dice[" + std::to_string(label) + "]", 1.0, dice, 1.0 - rule.dice, Direction::higher_is_better},
          file, findings);
  }
}

void compare_values(const imaging::FloatVolume& golden, const imaging::FloatVolume& result,
                    const ImageRule& rule, ComparedFile& file, std::vector<Finding>& findings,
                    const core::TaskContext& task) {
  struct Sum {
    double sum = 0.0, max = 0.0;
  };
  const Sum total = core::parallel_reduce(
      golden.voxels.size(), std::size_t{1} << 18, Sum{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        Sum part;
        for (std::size_t i = first; i < last; ++i) {
          const double d = std::abs(static_cast<double>(golden.voxels[i]) - result.voxels[i]);
          part.sum += d;
          part.max = std::max(part.max, d);
        }
        return part;
      },
      [](const Sum& a, const Sum& b) {
        return Sum{a.sum + b.sum, std::max(a.max, b.max)};
      });
  judge_distance("mean_hu", total.sum / static_cast<double>(golden.voxels.size()), rule.mean_hu, file,
                 findings);
  judge_distance("max_hu", total.max, rule.max_hu, file, findings);
}

}  // namespace

void compare_image_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                         std::vector<Finding>& findings, const core::TaskContext& task) {
  const auto golden = imaging::read_float_image(pair.golden, task).volume;
  const auto result = imaging::read_float_image(pair.result, task).volume;
  if (!imaging::same_grid(golden.geometry, result.geometry)) {
    findings.push_back({FindingKind::regression, file.file, "grid", std::nullopt, std::nullopt, 0.0,
                        "the two lie on different grids: other sizes, spacings, origins or axes"});
    file.differs = true;
    return;
  }
  const ImageRule rule = rule_for(tolerances.images, pair.name);
  if (file.kind == FileKind::mask) {
    compare_labels(golden, result, rule, file, findings);
  } else {
    compare_values(golden, result, rule, file, findings, task);
  }
}

}  // namespace ostia::evaluation
