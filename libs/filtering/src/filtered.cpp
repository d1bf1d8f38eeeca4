#include "calls.h"
#include "itk_run.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::filtering {
namespace {

using detail::Call;
using detail::Image;

constexpr double most_voxels = 2147483648.0;  // as of an image that is read

struct Work {
  const char* name;
  Image (*run)(const Image&, const Call&);
};
constexpr Work works[] = {{"gaussian", detail::gaussian},
                          {"median", detail::median},
                          {"curvature-flow", detail::curvature_flow},
                          {"gradient-diffusion", detail::gradient_diffusion},
                          {"curvature-diffusion", detail::curvature_diffusion},
                          {"n4", detail::n4},
                          {"objectness", detail::objectness},
                          {"gradient-magnitude", detail::gradient_magnitude},
                          {"distance", detail::distance},
                          {"threshold", detail::threshold},
                          {"otsu", detail::otsu},
                          {"erode", detail::erode},
                          {"dilate", detail::dilate},
                          {"open", detail::opened},
                          {"close", detail::closed},
                          {"fill-holes", detail::fill_holes},
                          {"components", detail::components},
                          {"resample", detail::resample},
                          {"match-histogram", detail::match_histogram},
                          {"clamp", detail::clamp},
                          {"rescale", detail::rescale}};

const Work& work_of(const std::string& name) {
  const auto found =
      std::find_if(std::begin(works), std::end(works), [&](const Work& w) { return name == w.name; });
  if (found == std::end(works)) throw InvalidInput("the filter " + name + " is listed and not there");
  return *found;
}

void check_image(const Image& image, const std::string& what) {
  if (image.voxels.empty() || static_cast<std::int64_t>(image.voxels.size()) != image.geometry.voxels())
    throw InvalidInput(what + ": " + std::to_string(image.voxels.size()) + " values for " +
                       std::to_string(image.geometry.voxels()) + " voxels");
  if (!std::all_of(image.voxels.begin(), image.voxels.end(), [](float v) { return std::isfinite(v); }))
    throw InvalidInput(what + ": it has values that are not finite");
}

void check_grid(const FilterFacts& filter, const imaging::Geometry& grid) {
  const std::int64_t least = *std::min_element(grid.size.begin(), grid.size.end());
  if (least >= filter.least_voxels) return;
  throw InvalidInput(filter.name + " needs " + std::to_string(filter.least_voxels) +
                     " voxels or more along each axis; the image has " + std::to_string(least) +
                     " along one");
}

bool takes(const std::vector<FilterStep>& steps, Companion companion) {
  return std::any_of(steps.begin(), steps.end(),
                     [&](const FilterStep& s) { return filter_named(s.name).companion == companion; });
}

void check_companions(const Image& image, const std::vector<FilterStep>& steps, const FilterInputs& inputs) {
  if (takes(steps, Companion::reference) && inputs.reference == nullptr)
    throw InvalidInput("match-histogram needs a reference (--reference)");
  if (inputs.reference != nullptr && !takes(steps, Companion::reference))
    throw InvalidInput("a reference is given, and no filter takes one (match-histogram does)");
  if (inputs.mask != nullptr && !takes(steps, Companion::mask))
    throw InvalidInput("a mask is given, and no filter takes one (n4 does)");
  if (inputs.reference != nullptr) check_image(*inputs.reference, "reference");
  if (inputs.mask != nullptr && (!imaging::same_grid(inputs.mask->geometry, image.geometry) ||
                                 inputs.mask->voxels.size() != image.voxels.size()))
    throw InvalidInput("the mask is on another grid than the image");
}

/// A resampled image has another grid than the mask.
void check_order(const std::vector<FilterStep>& steps, const FilterInputs& inputs) {
  if (inputs.mask == nullptr) return;
  bool resampled = false;
  for (const FilterStep& step : steps) {
    if (resampled && filter_named(step.name).companion == Companion::mask)
      throw InvalidInput(step.name +
                         " comes after resample, and the mask is on the grid before it; put it first");
    resampled = resampled || step.name == "resample";
  }
}

void require_steps(const std::vector<FilterStep>& steps) {
  if (steps.empty()) throw InvalidInput("no filter is given");
  for (const FilterStep& step : steps) validate(step);
}

imaging::Geometry after(const imaging::Geometry& grid, const FilterStep& step) {
  if (step.name != "resample") return grid;
  const double spacing = value_of(step, "spacing_mm");
  double voxels = 1.0;
  for (int a = 0; a < 3; ++a)
    voxels *= std::max(1.0, static_cast<double>(grid.size[a]) * grid.spacing[a] / spacing);
  if (voxels > most_voxels)
    throw InvalidInput("resample: spacing_mm=" + core::shortest_text(spacing) + " makes " +
                       core::significant_text(voxels, 3) +
                       " voxels, more than the 2147483648 that an image may have");
  return detail::resampled_grid(grid, spacing);
}

}  // namespace

imaging::Geometry grid_after(const imaging::Geometry& grid, const std::vector<FilterStep>& steps) {
  require_steps(steps);
  imaging::Geometry now = grid;
  for (const FilterStep& step : steps) now = after(now, step);
  return now;
}

std::uint64_t memory_needed(const imaging::Geometry& grid, const std::vector<FilterStep>& steps) {
  require_steps(steps);
  double most = 0.0;
  imaging::Geometry now = grid;
  for (const FilterStep& step : steps) {
    const imaging::Geometry next = after(now, step);
    const double voxels = static_cast<double>(std::max(now.voxels(), next.voxels()));
    most = std::max(
        most, 4.0 * static_cast<double>(now.voxels()) + filter_named(step.name).bytes_per_voxel * voxels);
    now = next;
  }
  return static_cast<std::uint64_t>(most);
}

Filtered filtered(imaging::FloatVolume image, const std::vector<FilterStep>& steps,
                  const FilterInputs& inputs, const core::TaskContext& task) {
  require_steps(steps);
  check_image(image, "the image");
  check_companions(image, steps, inputs);
  check_order(steps, inputs);
  grid_after(image.geometry, steps);
  Filtered done{std::move(image), Result::same, "", {}};
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const FilterFacts& filter = filter_named(steps[n].name);
    check_grid(filter, done.image.geometry);
    const auto share = [&](std::size_t at) {
      return static_cast<double>(at) / static_cast<double>(steps.size());
    };
    const Call call{steps[n], inputs, task.sub(share(n), share(n + 1)), done.warnings};
    task.set_stage(filter.name);
    task.throw_if_cancelled();
    done.image = detail::in_our_threads(filter.name, call.task,
                                        [&] { return work_of(filter.name).run(done.image, call); });
    if (filter.result == Result::same) continue;
    done.values = filter.result;
    done.unit = filter.unit;
  }
  return done;
}

}  // namespace ostia::filtering
