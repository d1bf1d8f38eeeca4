#include "call.h"
#include "options.h"
#include "rooms.h"
#include "values.h"
#include "volume.h"

#include "ostia/core/error.h"
#include "ostia/experiments/carotid_report.h"
#include "ostia/experiments/certainty.h"
#include "ostia/experiments/editing_report.h"
#include "ostia/experiments/extraction_report.h"
#include "ostia/experiments/hard.h"
#include "ostia/experiments/motion.h"
#include "ostia/experiments/orientations_report.h"
#include "ostia/experiments/reading.h"
#include "ostia/experiments/robustness.h"
#include "ostia/experiments/sensitivity.h"
#include "ostia/experiments/smoothness_report.h"
#include "ostia/experiments/vessel_chain_report.h"
#include "ostia/experiments/wall_spread.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using experiments::BeatingHeartOptions;
using experiments::CarotidOptions;
using experiments::CarotidScan;
using experiments::CertaintyOptions;
using experiments::ChainMesh;
using experiments::ChainOptions;
using experiments::EditingOptions;
using experiments::ExtractionScoreOptions;
using experiments::HandTimes;
using experiments::HardOptions;
using experiments::MotionMethod;
using experiments::MotionOptions;
using experiments::OrientationsOptions;
using experiments::ReaderOptions;
using experiments::ReadingOptions;
using experiments::ReadingPatients;
using experiments::RobustnessOptions;
using experiments::SensitivityOptions;
using experiments::SmoothnessOptions;
using experiments::TubeScanOptions;
using phantom::HardStrength;
using segmentation::RivalGrowthOptions;

template <>
struct WordsOf<CarotidScan> {
  static constexpr std::pair<const char*, CarotidScan> words[] = {
      {"ct", CarotidScan::ct}, {"mr_axial", CarotidScan::mr_axial}, {"mr_coronal", CarotidScan::mr_coronal}};
};
template <>
struct WordsOf<MotionMethod> {
  static constexpr std::pair<const char*, MotionMethod> words[] = {
      {"cage", MotionMethod::cage},       {"cage-rest", MotionMethod::cage_rest},
      {"descent", MotionMethod::descent}, {"descent-free", MotionMethod::descent_free},
      {"tps-l2", MotionMethod::tps_l2},   {"tps-kc", MotionMethod::tps_kc},
      {"grbf-l2", MotionMethod::grbf_l2}, {"grbf-kc", MotionMethod::grbf_kc}};
};
OSTIA_OPTIONS(ReaderOptions,
              (picture_px, pointing_sigma_mm, points, lines_deg, row_mm, section_step_mm, visible_px,
               section_share, beta_deg, eps_mm, most_strokes, seconds_a_stroke, seconds_a_point,
               seconds_a_view, seed),
              ())
OSTIA_OPTIONS(HandTimes, (think_s, home_s, key_s, point_s, press_s), ())
OSTIA_OPTIONS(ReadingOptions,
              (tolerance_mm, least_diameter_mm, astray_mm, click_sigma_mm, view_mm, most_actions, times,
               strokes, seed),
              ())
OSTIA_OPTIONS(ReadingPatients, (first_seed, patients, voxel_mm, hard, noise_hu, motion_mm, reader), ())
OSTIA_OPTIONS(EditingOptions, (reader, observer, start_excess_mm, margin_mm, start_spacing_mm), ())
OSTIA_OPTIONS(ExtractionScoreOptions, (astray_mm, threshold), ())
OSTIA_OPTIONS(HardStrength, (noise, blur, motion, venous, contact, calcium, fall, closed), ())
OSTIA_OPTIONS(HardOptions, (first_seed, cases, easy, search, voxel_mm, strength, scores), ())
OSTIA_OPTIONS(CertaintyOptions, (first_seed, patients, scans, voxel_mm), ())
OSTIA_OPTIONS(TubeScanOptions,
              (spacing_mm, psf_fwhm_mm, psf_fwhm_z_mm, lumen_hu, gel_hu, noise_hu, margin_mm, seed), ())
OSTIA_OPTIONS(OrientationsOptions,
              (scan, vessel_sigma_hu, tau, inflation, curvature, iterations, diffusion_iterations, prune_mm,
               gap_mm, sigma_mm, knots_mm, settle),
              ())
OSTIA_OPTIONS(SmoothnessOptions,
              (scans, levels, decimations, smoothings, relaxation, vtk_at, clear_mm, sample_mm), ())
OSTIA_OPTIONS(RivalGrowthOptions, (least_hu, snap_mm), ())
OSTIA_OPTIONS(ChainMesh, (sides, spacing, level), ())
OSTIA_OPTIONS(ChainOptions,
              (growth, diffusion_iterations, thinnest_mm, curvature, iterations, prune_mm, gap_mm, sigma_mm,
               knots_mm, meshes, elliptic),
              ())
OSTIA_OPTIONS(SensitivityOptions, (seed, section_step_mm), ())
OSTIA_OPTIONS(RobustnessOptions, (first_seed, seeds, voxel_mm, scores), ())
OSTIA_OPTIONS(BeatingHeartOptions,
              (seed, phases, template_points, target_points, noise_mm, noise_length_mm, phases_with_loss), ())
OSTIA_OPTIONS(MotionOptions,
              (hearts, heart, depths, depth, methods, compared_phases, compared_hearts, dice_resolution_mm),
              (keep))  // of runs of days
OSTIA_OPTIONS(CarotidOptions,
              (scans, ct_fwhm_mm, ct_slice_mm, ct_noise, mr_noise, thresholds, tilt_deg, seed_inset_mm,
               end_mm, section_step_mm, section_points, measured_bias_mm, measured_sigma_mm, wide_mm, seed),
              (features))  // the paper's three

namespace {

namespace fs = std::filesystem;
using core::TaskContext;

/// One whose options are all it is told. `run` gives its JSON.
template <class Options, class Run>
void experiment(py::module_& m, const char* name, const std::string& what, const Run& run) {
  const std::string text = with_options<Options>(m, name, what + " The figures as experiment.json has them.");
  m.def(
      name,
      [run](const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<Options>(options);
        return json_of(watched(progress, [&](const TaskContext& task) { return run(how, task); }));
      },
      py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

/// One of the cases in a suite's folder.
template <class Options, class Run>
void of_suite(py::module_& m, const char* name, const std::string& what, const Run& run) {
  const std::string text = with_options<Options>(m, name, what + " The figures as experiment.json has them.");
  m.def(
      name,
      [run](const fs::path& suite, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<Options>(options);
        return json_of(watched(progress, [&](const TaskContext& task) { return run(suite, how, task); }));
      },
      py::arg("suite"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

std::vector<experiments::Orientation> first_orientations(int count, int least) {
  if (count < least || count > 12)
    throw InvalidInput("orientations: " + std::to_string(least) + " to 12, not " + std::to_string(count));
  auto all = experiments::twelve_orientations();
  all.resize(static_cast<std::size_t>(count));
  return all;
}

/// One of so many orientations of the phantom.
template <class Options, class Run>
void of_orientations(py::module_& m, const char* name, int least, const std::string& what, const Run& run) {
  const std::string text = with_options<Options>(
      m, name, what + " orientations: how many of the twelve. The figures as experiment.json has them.");
  m.def(
      name,
      [run, least](int orientations, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<Options>(options);
        const auto turns = first_orientations(orientations, least);
        return json_of(watched(progress, [&](const TaskContext& task) { return run(turns, how, task); }));
      },
      py::arg("orientations") = 12, py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_phantoms(py::module_& m) {
  of_orientations<OrientationsOptions>(
      m, "experiment_orientations", 2,
      "A phantom of 17 tubes scanned in several orientations: lengths and radii from each, mm.",
      [](const auto& turns, const OrientationsOptions& how, const TaskContext& task) {
        return experiments::orientations_json(
            experiments::measure_orientations(experiments::vascular_phantom(), turns, how, task), how);
      });
  of_orientations<SmoothnessOptions>(
      m, "experiment_smoothness", 1,
      "Surfaces reconstructed from a phantom's scans: smoothness (1/mm), distance from isosurfaces (mm).",
      [](const auto& turns, const SmoothnessOptions& how, const TaskContext& task) {
        return experiments::smoothness_json(
            experiments::measure_smoothness(experiments::vascular_phantom(), turns, how, task), how,
            turns.size());
      });
}

void bind_suites(py::module_& m) {
  of_suite<EditingOptions>(m, "experiment_editing",
                           "A simulated reader edits lumen sections of a suite's cases until they agree with "
                           "an observer's contours.",
                           [](const fs::path& suite, const EditingOptions& how, const TaskContext& task) {
                             return experiments::editing_json(experiments::edit_suite(suite, how, task), how);
                           });
  of_suite<ExtractionScoreOptions>(
      m, "experiment_extraction",
      "The tree of each of a suite's cases found without a click, against its truth.",
      [](const fs::path& suite, const ExtractionScoreOptions& how, const TaskContext& task) {
        return experiments::extraction_json(experiments::extract_suite(suite, how, task), how);
      });
}

void bind_patients(py::module_& m) {
  experiment<RobustnessOptions>(
      m, "experiment_robustness",
      "One thing at a time is made worse in synthetic patients until their tree is no longer found: hours.",
      [](const RobustnessOptions& how, const TaskContext& task) {
        return experiments::robustness_json(
            experiments::vary_patients(experiments::usual_variations(), how, task), how);
      });
  experiment<ReadingPatients>(m, "experiment_reading",
                              "How many actions a simulated reader takes to a tree that is right, with the "
                              "search and without: hours.",
                              [](const ReadingPatients& how, const TaskContext& task) {
                                return experiments::reading_json(experiments::read_patients(how, task), how);
                              });
  experiment<CertaintyOptions>(
      m, "experiment_certainty",
      "Whether the probability of found vessels, and of each centimetre, is the share that is right: hours.",
      [](const CertaintyOptions& how, const TaskContext& task) {
        return experiments::certainty_json(experiments::judge_certainty(how, task));
      });
  const std::string text = with_options<HardOptions>(m, "experiment_hard",
                                                     "Two classical methods, and the search without a click, "
                                                     "on patients and scans as a clinic has them; masks: a "
                                                     "folder of patients' coronary masks, for hearts around "
                                                     "their trees: hours. The figures as experiment.json "
                                                     "has them.");
  m.def(
      "experiment_hard",
      [](const std::optional<fs::path>& masks, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<HardOptions>(options);
        experiments::validate(how);
        return json_of(watched(progress, [&](const TaskContext& task) {
          std::vector<experiments::HardPatient> patients;
          if (masks) patients = experiments::read_hard_patients(*masks, task.sub(0.0, 0.05));
          return experiments::hard_json(experiments::run_hard(how, patients, task.sub(0.05, 1.0)), how);
        }));
      },
      py::arg("masks") = py::none(), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  experiment<MotionOptions>(
      m, "experiment_motion",
      "Hearts whose motion is known: surfaces brought onto all phases by depth of the cage and by method.",
      [](const MotionOptions& how, const TaskContext& task) {
        return experiments::motion_json(experiments::run_motion(how, task), how);
      });
  m.def(
      "experiment_wall_spread",
      [](int fitting, int judged, std::uint64_t seed, const py::object& progress) {
        constexpr std::uint64_t apart = 20000;  // no vessel is in both sets
        experiments::WallSpreadOptions chosen, others;
        chosen.first_seed = seed;
        chosen.vessels = fitting;
        chosen.sections = 4;
        others.first_seed = seed + apart;
        others.vessels = judged;
        experiments::validate(chosen);
        experiments::validate(others);
        return json_of(watched(progress, [&](const TaskContext& task) {
          const double share = static_cast<double>(fitting) / (fitting + judged);
          const auto first = experiments::run_wall_spread(chosen, task.sub(0.0, share));
          const auto second = experiments::run_wall_spread(others, task.sub(share, 1.0));
          return experiments::wall_spread_json(first, second, others);
        }));
      },
      py::kw_only(), py::arg("fitting") = 500, py::arg("judged") = 100, py::arg("seed") = 1,
      py::arg("progress") = py::none(),
      "How often the true calibre lies within the 95 % interval that noise and edges let expect, over so "
      "many "
      "vessels. The figures as experiment.json has them.");
}

void bind_others(py::module_& m) {
  std::string text = with_options<SensitivityOptions>(
      m, "experiment_sensitivity",
      "How volume, diameters and axis of known lumina depend on each parameter of the segmentation. only: "
      "those "
      "whose name holds this text. The figures as experiment.json has them.");
  m.def(
      "experiment_sensitivity",
      [](const std::string& only, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<SensitivityOptions>(options);
        return json_of(watched(progress, [&](const TaskContext& task) {
          const std::vector<experiments::KnownLumen> lumina{experiments::stenosed_lumen(how.seed),
                                                            experiments::forked_lumen(how.seed),
                                                            experiments::coronary_lumen(how.seed)};
          return experiments::sensitivity_json(experiments::run_sensitivity(lumina, how, only, task), how);
        }));
      },
      py::arg("only") = "", py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<CarotidOptions>(m, "experiment_carotid",
                                      "A carotid phantom scanned by CT and MR in silico, segmented and held "
                                      "against its surface (open, mm). The "
                                      "figures as experiment.json has them.");
  m.def(
      "experiment_carotid",
      [](const geometry::TriMesh& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<CarotidOptions>(options);
        experiments::validate(how);
        return json_of(watched(progress, [&](const TaskContext& task) {
          const auto phantom = experiments::carotid_phantom(surface, task.sub(0.0, 0.1));
          return experiments::carotid_json(experiments::run_carotid(phantom, how, task.sub(0.1, 1.0)), how);
        }));
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<ChainOptions>(
      m, "experiment_chain",
      "From a CT to a surface of few quadrilaterals: seeds in the vessels wanted, rivals in those that touch "
      "them, (n, 3) each, mm. The figures as experiment.json has them.");
  m.def(
      "experiment_chain",
      [](const AnyVolume& image, const py::object& seeds, const py::object& rivals,
         const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<ChainOptions>(options);
        experiments::validate(how);
        const auto in = places_of(seeds, "seeds"), out = places_of(rivals, "rivals");
        const imaging::ImageVolume& ct = image.image("image");
        return json_of(watched(progress, [&](const TaskContext& task) {
          return experiments::chain_json(experiments::run_vessel_chain(ct, in, out, how, task), how, in, out);
        }));
      },
      py::arg("image"), py::arg("seeds"), py::arg("rivals") = py::none(), py::kw_only(),
      py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_experiments(py::module_& m) {
  bind_phantoms(m);
  bind_suites(m);
  bind_patients(m);
  bind_others(m);
}

}  // namespace ostia::python
