#include "ostia/filtering/filter_list.h"

#include "nearest_word.h"

#include "ostia/core/error.h"

namespace ostia::filtering {
namespace {

ParameterFacts real(std::string name, std::string unit, std::string text, double value, double least,
                    double most) {
  return {std::move(name), std::move(unit), std::move(text), value, least, most, false, {}};
}
ParameterFacts count(std::string name, std::string unit, std::string text, int value, int least, int most) {
  return {std::move(name),
          std::move(unit),
          std::move(text),
          static_cast<double>(value),
          static_cast<double>(least),
          static_cast<double>(most),
          true,
          {}};
}
/// The first word is the default.
ParameterFacts choice(std::string name, std::string text, std::vector<std::string> words) {
  const double last = static_cast<double>(words.size()) - 1.0;
  return {std::move(name), "", std::move(text), 0.0, 0.0, last, true, std::move(words)};
}

ParameterFacts radius() {
  return real("radius_mm", "mm", "Radius of the ball, rounded to whole voxels along each axis", 1.0, 0.0,
              20.0);
}
ParameterFacts steps() {
  return count("steps", "steps", "How many explicit steps", 5, 1, 1000);
}
/// Stable up to a sixth in three dimensions.
ParameterFacts time_step() {
  return real("time_step", "squares of the least voxel", "Length of a step", 0.0625, 0.001, 0.125);
}

std::vector<FilterFacts> smoothing() {
  std::vector<FilterFacts> list;
  list.push_back({"gaussian",
                  "Blurs with a Gaussian, by a recursion whose time does not depend on sigma",
                  "SmoothingRecursiveGaussianImageFilter",
                  {real("sigma_mm", "mm", "Standard deviation", 0.5, 0.05, 50.0)},
                  Result::same,
                  "",
                  Companion::none,
                  4,
                  12.0});
  list.push_back({"median",
                  "The middle value of each voxel's box of neighbours; of a mask what most of them are",
                  "MedianImageFilter",
                  {real("radius_mm", "mm", "Half of the box's edge, rounded to whole voxels along each axis",
                        0.5, 0.0, 5.0)},
                  Result::same,
                  "",
                  Companion::none,
                  1,
                  8.0});
  list.push_back({"curvature-flow",
                  "Level sets of the image move by their curvature; edges of any contrast are rounded alike",
                  "CurvatureFlowImageFilter",
                  {steps(), time_step()},
                  Result::same,
                  "",
                  Companion::none,
                  3,
                  12.0});
  list.push_back(
      {"gradient-diffusion",
       "Diffusion that stops at edges (Perona and Malik)",
       "GradientAnisotropicDiffusionImageFilter",
       {steps(), time_step(),
        real("conductance", "root mean square gradients", "Edges steeper than this stay", 1.0, 0.01, 100.0)},
       Result::same,
       "",
       Companion::none,
       3,
       12.0});
  list.push_back(
      {"curvature-diffusion",
       "Curvature flow that stops at edges (Whitaker and Xue)",
       "CurvatureAnisotropicDiffusionImageFilter",
       {steps(), time_step(),
        real("conductance", "root mean square gradients", "Edges steeper than this stay", 3.0, 0.01, 100.0)},
       Result::same,
       "",
       Companion::none,
       3,
       12.0});
  list.push_back(
      {"n4",
       "Takes the coil's shading out of an MR image; values must be above 0 where it works (--mask, "
       "or all that are)",
       "N4BiasFieldCorrectionImageFilter",
       {count("iterations", "iterations", "At most, on each level", 50, 1, 1000),
        count("levels", "levels", "Of the spline, each twice as fine as the one before", 4, 1, 6),
        count("shrink", "voxels", "The field is fitted to an image smaller by this along each axis", 4, 1,
              16),
        count("control_points", "points", "Of the spline's first level, along each axis", 4, 4, 32),
        count("histogram_bins", "bins", "Of the histogram that is sharpened", 200, 16, 1024),
        real("fwhm", "log intensity", "Width of the kernel that the histogram is sharpened by", 0.15, 0.01,
             1.0),
        real("noise", "", "Of the Wiener filter that does so", 0.01, 0.0001, 1.0),
        real("tolerance", "", "A level is done when the field changes by less (its variation)", 0.001, 0.0,
             1.0)},
       Result::same,
       "",
       Companion::mask,
       4,
       36.0});
  return list;
}

std::vector<FilterFacts> shapes() {
  std::vector<FilterFacts> list;
  list.push_back(
      {"objectness",
       "How much a voxel lies in a tube, a plate or a blob, by the eigenvalues of the Hessian (Frangi), "
       "the most of several scales",
       "HessianRecursiveGaussianImageFilter, HessianToObjectnessMeasureImageFilter",
       {choice("object", "What is looked for", {"tube", "plate", "blob"}),
        choice("bright", "Brighter than its surroundings; no: darker", {"yes", "no"}),
        real("sigma_least_mm", "mm", "Standard deviation of the first scale", 0.5, 0.1, 20.0),
        real("sigma_most_mm", "mm", "Of the last scale; those between stand in equal ratios", 2.0, 0.1, 20.0),
        count("scales", "scales", "How many", 4, 1, 16),
        real("alpha", "", "Weight of plates against tubes", 0.5, 0.01, 10.0),
        real("beta", "", "Weight of blobs against tubes", 0.5, 0.01, 10.0),
        real("gamma", "the image's unit", "Contrast below which all counts as noise", 5.0, 0.001, 10000.0)},
       Result::own,
       "the image's unit, times how sure it is",
       Companion::none,
       4,
       48.0});
  list.push_back({"gradient-magnitude",
                  "Length of the gradient of the image blurred by a Gaussian",
                  "GradientMagnitudeRecursiveGaussianImageFilter",
                  {real("sigma_mm", "mm", "Standard deviation", 0.5, 0.05, 50.0)},
                  Result::own,
                  "the image's unit per mm",
                  Companion::none,
                  4,
                  20.0});
  list.push_back({"distance",
                  "Signed distance from the border of what is not 0, negative inside",
                  "SignedMaurerDistanceMapImageFilter",
                  {},
                  Result::own,
                  "mm",
                  Companion::none,
                  1,
                  16.0});
  return list;
}

std::vector<FilterFacts> masks() {
  std::vector<FilterFacts> list;
  list.push_back({"threshold",
                  "1 where the value lies between two bounds, both included",
                  "BinaryThresholdImageFilter",
                  {real("lower", "the image's unit", "Least value", 0.5, -1e9, 1e9),
                   real("upper", "the image's unit", "Largest value", 1e9, -1e9, 1e9)},
                  Result::mask,
                  "",
                  Companion::none,
                  1,
                  8.0});
  list.push_back({"otsu",
                  "Parts the values into classes that differ most from each other: 0 the darkest",
                  "OtsuMultipleThresholdsImageFilter",
                  {count("classes", "classes", "How many", 2, 2, 6),
                   count("histogram_bins", "bins", "Of the histogram", 128, 16, 1024)},
                  Result::labels,
                  "",
                  Companion::none,
                  1,
                  12.0});
  const auto morphology = [&](std::string name, std::string text, std::string itk) {
    list.push_back({std::move(name),
                    std::move(text),
                    std::move(itk),
                    {radius()},
                    Result::same,
                    "",
                    Companion::none,
                    1,
                    16.0});
  };
  morphology("erode", "The least value within a ball: masks shrink", "GrayscaleErodeImageFilter");
  morphology("dilate", "The largest value within a ball: masks grow", "GrayscaleDilateImageFilter");
  morphology("open", "Eroded, then dilated: what is thinner than the ball and bright goes",
             "GrayscaleMorphologicalOpeningImageFilter");
  morphology("close", "Dilated, then eroded: what is thinner than the ball and dark goes",
             "GrayscaleMorphologicalClosingImageFilter");
  list.push_back(
      {"fill-holes",
       "Dark places that no way through darkness joins to the image's border get the value of their rim",
       "GrayscaleFillholeImageFilter",
       {},
       Result::same,
       "",
       Companion::none,
       1,
       20.0});
  list.push_back(
      {"components",
       "The parts of what is not 0, numbered by their size: 1 is the largest",
       "ConnectedComponentImageFilter, RelabelComponentImageFilter",
       {count("least_voxels", "voxels", "Smaller parts go", 1, 1, 1000000000),
        count("most", "parts", "Of the largest, how many stay", 255, 1, 30000),
        choice("corners", "Whether voxels that share an edge or a corner are joined", {"no", "yes"})},
       Result::labels,
       "",
       Companion::none,
       1,
       24.0});
  return list;
}

std::vector<FilterFacts> grids_and_values() {
  std::vector<FilterFacts> list;
  list.push_back(
      {"resample",
       "The same image with voxels of another size, the same in all directions; blur it before voxels "
       "become larger",
       "ResampleImageFilter",
       {real("spacing_mm", "mm", "Edge of a voxel", 0.5, 0.05, 20.0),
        choice("by", "Between voxels", {"linear", "nearest", "bspline"})},
       Result::same,
       "",
       Companion::none,
       2,
       16.0});
  list.push_back(
      {"match-histogram",
       "Values changed so that their distribution becomes that of another image (--reference)",
       "HistogramMatchingImageFilter",
       {count("levels", "bins", "Of both histograms", 1024, 16, 65536),
        count("points", "points", "Quantiles that are matched", 15, 1, 255),
        choice("above_mean", "Only values above the mean of each image count, not the air", {"yes", "no"})},
       Result::same,
       "",
       Companion::reference,
       1,
       16.0});
  list.push_back({"clamp",
                  "Values below and above two bounds become the bounds",
                  "ClampImageFilter",
                  {real("lower", "the image's unit", "Least value", -1024.0, -1e9, 1e9),
                   real("upper", "the image's unit", "Largest value", 3071.0, -1e9, 1e9)},
                  Result::same,
                  "",
                  Companion::none,
                  1,
                  8.0});
  list.push_back({"rescale",
                  "Values stretched so that the least and the largest become two bounds",
                  "RescaleIntensityImageFilter",
                  {real("lower", "a unit of its own", "What the least value becomes", 0.0, -1e9, 1e9),
                   real("upper", "a unit of its own", "What the largest value becomes", 1.0, -1e9, 1e9)},
                  Result::own,
                  "between the bounds",
                  Companion::none,
                  1,
                  8.0});
  return list;
}

std::vector<FilterFacts> all_filters() {
  std::vector<FilterFacts> list;
  for (const auto& part : {smoothing(), shapes(), masks(), grids_and_values()})
    list.insert(list.end(), part.begin(), part.end());
  return list;
}

}  // namespace

std::string name_of(Result result) {
  switch (result) {
    case Result::same:
      return "same";
    case Result::own:
      return "own";
    case Result::mask:
      return "mask";
    case Result::labels:
      break;
  }
  return "labels";
}

std::string name_of(Companion companion) {
  switch (companion) {
    case Companion::none:
      return "none";
    case Companion::mask:
      return "mask";
    case Companion::reference:
      break;
  }
  return "reference";
}

const std::vector<FilterFacts>& filters() {
  static const std::vector<FilterFacts> list = all_filters();
  return list;
}

const FilterFacts& filter_named(std::string_view name) {
  std::vector<std::string> names;
  for (const FilterFacts& one : filters()) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  throw InvalidInput("there is no filter \"" + std::string(name) + "\"; the nearest name is \"" +
                     detail::nearest_word(name, names) + "\" (`ostia filter --list` shows all)");
}

}  // namespace ostia::filtering
