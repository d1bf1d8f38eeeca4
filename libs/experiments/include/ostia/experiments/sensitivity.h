#pragma once
/// \file How much a lumen depends on each parameter of its segmentation ([Antiga] 3.3 asks for it).

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/lumen_boundary.h"
#include "ostia/segmentation/segment.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ostia::experiments {

/// An image of a lumen that is known exactly.
struct KnownLumen {
  std::string name;
  imaging::ImageVolume image;
  geometry::AnalyticShape truth;
  std::vector<segmentation::BranchSeeds> branches;
  double lumen_hu = 0.0, around_hu = 0.0;
};
/// A stenosed tube, a Y-junction (both oblique to the grid, voxels of 0.4 mm, blur of 0.7 mm full width at
/// half maximum, noise of 15 HU) and phantom::make_builtin_case: a small scan with two coronary branches.
KnownLumen stenosed_lumen(std::uint64_t seed);
KnownLumen forked_lumen(std::uint64_t seed);
KnownLumen coronary_lumen(std::uint64_t seed);

/// A lumen measured on the cross-sections of the true axes, or the differences of two.
struct LumenFigures {
  double volume_mm3 = 0.0, mean_diameter_mm = 0.0, least_diameter_mm = 0.0;
  double axis_mm = 0.0;  ///< mean distance of the sections' centroids from the truth's
  int lost = 0;          ///< sections without lumen
};

/// One value of a parameter.
struct Setting {
  std::string name;  ///< "0.125"
  double value = 0.0;
  bool near = false;  ///< within 25 % of the default, or next to it where that is 0
};
template <class Options>
struct Parameter {
  std::string name;     ///< "curvature weight w2"
  std::string meaning;  ///< and the option's name
  std::vector<Setting> settings;
  std::size_t standard = 0;  ///< the default among them
  bool choice = false;       ///< kinds, not numbers: no plateau is asked for
  std::function<void(Options&, double, const KnownLumen&)> apply;
};
/// Every parameter of segmentation::segment_vessels that a person may set, and of lumen_boundary, with the
/// range that is tried. "One at a time": the others keep their defaults, but for what a parameter needs to
/// have any say (the balloon's tau needs a balloon).
std::vector<Parameter<segmentation::SegmentOptions>> segment_parameters();
std::vector<Parameter<segmentation::LumenBoundaryOptions>> boundary_parameters();

struct SettingRun {
  Setting setting;
  std::vector<LumenFigures> cases;  ///< one a lumen
  std::string failure;              ///< not empty: refused, or no lumen, and why
};
struct ParameterRun {
  std::string name, meaning;
  bool choice = false;
  std::size_t standard = 0;
  std::vector<SettingRun> settings;
  double plateau = 0.0;  ///< largest relative change of volume over the near settings and all lumina
  bool on_plateau = false;
  std::string verdict;  ///< "plateau", "slope: 3.1 %", "choice"
};
constexpr double plateau_limit = 0.02;

struct SensitivityOptions {
  std::uint64_t seed = 1;
  double section_step_mm = 0.5;  ///< of the sections measured
};
struct SensitivityResult {
  std::vector<std::string> lumina;
  std::vector<LumenFigures> truth;  ///< one a lumen
  std::vector<ParameterRun> level_set, boundary;
};
/// `only`: parameters whose name holds this text; all when empty.
SensitivityResult run_sensitivity(const std::vector<KnownLumen>& lumina, const SensitivityOptions& options,
                                  const std::string& only = {},
                                  const core::TaskContext& task = core::no_task());

std::string parameters_json(const SensitivityOptions& options, const std::string& only);
std::string sensitivity_json(const SensitivityResult& result, const SensitivityOptions& options);
std::string sensitivity_text(const SensitivityResult& result);  ///< one line a parameter
/// level-set.csv, boundary.csv, sensitivity.png (change of volume over the parameter's multiple of its
/// default), report.html into an existing folder.
void write_sensitivity_report(const std::filesystem::path& folder, const SensitivityResult& result);

}  // namespace ostia::experiments
