#pragma once
/// \file Filters of ITK run on an image, one after the other.

#include "ostia/core/task_context.h"
#include "ostia/filtering/filter_list.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::filtering {

/// A filter with what it is told.
struct FilterStep {
  std::string name;
  std::map<std::string, double> given;  ///< of a word its place in ParameterFacts::words
};
/// Reads "n4:iterations=50,levels=3". Throws InvalidInput for names and keys that are not known (with the
/// nearest one), values that are none, are given twice or lie outside of their bounds.
FilterStep step_of_text(std::string_view text);
/// The same text with every parameter, those left out, too.
std::string text_of(const FilterStep& step);
/// What a parameter is, given or not. Throws InvalidInput as `validate` does.
double value_of(const FilterStep& step, std::string_view parameter);
/// Throws InvalidInput.
void validate(const FilterStep& step);

/// Second images of filters that have one; on any grid of their own the reference, on the image's the mask.
struct FilterInputs {
  const imaging::MaskVolume* mask = nullptr;
  const imaging::FloatVolume* reference = nullptr;
};

struct Filtered {
  imaging::FloatVolume image;
  Result values = Result::same;  ///< what its values are after all steps
  std::string unit;              ///< where values is `own`
  std::vector<std::string> warnings;
};

/// The image after all steps, which are run as ITK's filters in single precision. The same bits for any
/// number of threads. A cancel is seen between ITK's pieces of work, which are a sixty-fourth of a pass over
/// the image or less. Throws InvalidInput (no steps; a step that `validate` refuses; an image that is empty,
/// has values that are not finite, too few voxels for a filter or no values that it could work on; a
/// companion that is missing, superfluous or on another grid), ResourceError (memory), NumericalError (ITK's
/// own words), Cancelled.
Filtered filtered(imaging::FloatVolume image, const std::vector<FilterStep>& steps,
                  const FilterInputs& inputs = {}, const core::TaskContext& task = core::no_task());

/// The most memory in bytes that `filtered` takes for an image of this grid, the image and its result among
/// it, as the filters' facts have it. Throws InvalidInput.
std::uint64_t memory_needed(const imaging::Geometry& grid, const std::vector<FilterStep>& steps);
/// The grid of the result. Throws InvalidInput, also where it would have more voxels than an image may have.
imaging::Geometry grid_after(const imaging::Geometry& grid, const std::vector<FilterStep>& steps);

}  // namespace ostia::filtering
