#include "array.h"
#include "call.h"
#include "options.h"
#include "rooms.h"
#include "volume.h"

#include "ostia/segmentation/segment.h"

#include <pybind11/stl.h>

namespace ostia::python {

using imaging::Diffusion;
using imaging::DiffusionOptions;
using segmentation::CollidingFrontsOptions;
using segmentation::CurvatureTerm;
using segmentation::FrontDomain;
using segmentation::IntensityBalloon;
using segmentation::LevelSetOptions;
using segmentation::MaskSurfaceOptions;
using segmentation::SegmentOptions;
using segmentation::TissueOptions;
using segmentation::WallFeature;

template <>
struct WordsOf<FrontDomain> {
  static constexpr std::pair<const char*, FrontDomain> words[] = {
      {"sparse", FrontDomain::sparse}, {"whole_volume", FrontDomain::whole_volume}};
};
template <>
struct WordsOf<WallFeature> {
  static constexpr std::pair<const char*, WallFeature> words[] = {{"edges", WallFeature::edges},
                                                                  {"upwind", WallFeature::upwind},
                                                                  {"centred", WallFeature::centred},
                                                                  {"gaussian", WallFeature::gaussian}};
};
template <>
struct WordsOf<CurvatureTerm> {
  static constexpr std::pair<const char*, CurvatureTerm> words[] = {{"mean", CurvatureTerm::mean},
                                                                    {"minimal", CurvatureTerm::minimal}};
};
template <>
struct WordsOf<Diffusion> {
  static constexpr std::pair<const char*, Diffusion> words[] = {
      {"flux", Diffusion::flux}, {"gradient", Diffusion::gradient}, {"curvature", Diffusion::curvature}};
};

OSTIA_OPTIONS(CollidingFrontsOptions, (lower_hu, upper_hu, domain, slowest, overrun, margin_voxels), ())
OSTIA_OPTIONS(IntensityBalloon, (tau, mean_hu, sigma_hu), ())
OSTIA_OPTIONS(TissueOptions,
              (bone, calcium, skin, candidate_hu, shell_hu, contact_mm, calcium_hu, largest_calcium_mm3,
               skin_mm, fill_hu),
              ())
OSTIA_OPTIONS(DiffusionOptions, (method, iterations, contrast_hu_per_mm, attachment, step), ())
OSTIA_OPTIONS(LevelSetOptions,
              (inflation, curvature, curvature_term, advection, iterations_max, rms_tolerance_voxels),
              (feature_offset_voxels, curvature_needs_feature, ends,
               kept))  // set from the image and the seeds
OSTIA_OPTIONS(SegmentOptions,
              (fronts, feature, bright_is_lumen, gaussian_sigma_mm, balloon, remove, denoise,
               leave_out_unfollowed, level_set),
              ())
OSTIA_OPTIONS(MaskSurfaceOptions, (sigma_voxels, largest_part_only), ())

namespace {

/// Each branch is two places, its ends, or three: from, through, to.
std::vector<segmentation::BranchSeeds> branches_of(const py::sequence& given) {
  std::vector<segmentation::BranchSeeds> branches;
  for (const py::handle one : given) {
    const std::string name = "branches[" + std::to_string(branches.size()) + "]";
    const auto places = places_of(py::reinterpret_borrow<py::object>(one), name);
    if (places.size() < 2 || places.size() > 3)
      throw InvalidInput(name + ": its two ends, or from, through, to; not " + std::to_string(places.size()) +
                         " places");
    segmentation::BranchSeeds seeds{places.front(), std::nullopt, places.back()};
    if (places.size() == 3) seeds.through = places[1];
    branches.push_back(seeds);
  }
  return branches;
}

struct Segmented {
  AnyVolume level_set;
  std::vector<std::string> left_out, warnings;
  int iterations = 0;
  bool converged = false;
};

}  // namespace

void bind_segmentation(py::module_& m) {
  py::class_<Segmented>(m, "Segmentation", "What segment_vessels found.")
      .def_readonly("level_set", &Segmented::level_set, "Volume of float32, distance in mm, negative inside")
      .def_readonly("left_out", &Segmented::left_out, "branches that could not be followed, and why")
      .def_readonly("warnings", &Segmented::warnings, "What a person should know.")
      .def_readonly("iterations", &Segmented::iterations, "Of the level set.")
      .def_readonly("converged", &Segmented::converged, "Whether it came to rest before iterations_max.")
      .def("__repr__",
           [](const Segmented& s) {
             return py::str("<ostia.Segmentation: {} iterations, converged {}, {} branches left out>")
                 .format(s.iterations, s.converged, s.left_out.size());
           })
      .def(py::pickle(
          [](const Segmented& s) {
            return py::make_tuple(s.level_set, s.left_out, s.warnings, s.iterations, s.converged);
          },
          [](const py::tuple& s) {
            return Segmented{s[0].cast<const AnyVolume&>(), s[1].cast<std::vector<std::string>>(),
                             s[2].cast<std::vector<std::string>>(), s[3].cast<int>(), s[4].cast<bool>()};
          }));
  std::string text = with_options<SegmentOptions>(m, "segment_vessels",
                                                  "The lumen in a CT between the ends of branches, each of "
                                                  "two places, (2, 3), mm, or three, with one between.");
  m.def(
      "segment_vessels",
      [](const AnyVolume& image, const py::sequence& branches, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<SegmentOptions>(options);
        const auto seeds = branches_of(branches);
        const imaging::ImageVolume& ct = image.image("image");
        auto found = watched(
            progress, [&](const auto& task) { return segmentation::segment_vessels(ct, seeds, how, task); });
        Segmented result{
            AnyVolume(std::move(found.level_set)), {}, found.warnings, found.iterations, found.converged};
        for (const auto& branch : found.left_out)
          result.left_out.push_back("branch " + std::to_string(branch.branch) + ": " + branch.why);
        return result;
      },
      py::arg("image"), py::arg("branches"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text =
      with_options<MaskSurfaceOptions>(m, "segment_mask", "The surface of a mask, smoothed below a voxel.");
  m.def(
      "segment_mask",
      [](const AnyVolume& mask, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<MaskSurfaceOptions>(options);
        const imaging::MaskVolume& voxels = mask.mask("mask");
        return watched(progress,
                       [&](const auto& task) { return segmentation::segment_mask(voxels, how, task); });
      },
      py::arg("mask"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace ostia::python
