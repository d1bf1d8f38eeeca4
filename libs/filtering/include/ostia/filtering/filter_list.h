#pragma once
/// \file The filters of the Insight Toolkit (ITK) that are at hand, and what each takes and gives.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::filtering {

/// What a filter may be told: a number, or one of a few words.
struct ParameterFacts {
  std::string name;  ///< with its unit, "sigma_mm"
  std::string unit;  ///< "mm", "steps", ... ; empty where it has none
  std::string text;
  double value = 0.0;  ///< where nothing is said; of words the place in `words`
  double least = 0.0, most = 0.0;
  bool whole = false;              ///< no fractions
  std::vector<std::string> words;  ///< empty: a number
};

/// What the values of a filter's result are.
enum class Result {
  same,    ///< the unit of what went in
  own,     ///< a unit of its own (FilterFacts::unit)
  mask,    ///< 0 and 1
  labels,  ///< whole numbers from 0 on
};
/// "same", "own", "mask", "labels".
std::string name_of(Result result);

/// The second image of a filter.
enum class Companion {
  none,
  mask,      ///< where it works; may be left out
  reference  ///< what it goes by; must be there
};
/// "none", "mask", "reference".
std::string name_of(Companion companion);

struct FilterFacts {
  std::string name;
  std::string text;
  std::string itk;  ///< the class that does it
  std::vector<ParameterFacts> parameters;
  Result result = Result::same;
  std::string unit;  ///< of the result, where it has one of its own
  Companion companion = Companion::none;
  int least_voxels = 1;          ///< along each axis
  double bytes_per_voxel = 8.0;  ///< most memory beside the image that it is given
};

/// All of them, in the order in which they are shown.
const std::vector<FilterFacts>& filters();
/// By its name. Throws InvalidInput, which names the nearest one.
const FilterFacts& filter_named(std::string_view name);

}  // namespace ostia::filtering
