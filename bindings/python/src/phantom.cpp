#include "call.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"
#include "values.h"
#include "volume.h"

#include "ostia/core/error.h"
#include "ostia/phantom/builtin_case.h"
#include "ostia/phantom/case_folder.h"
#include "ostia/phantom/moving_case.h"
#include "ostia/phantom/vessel_field.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using phantom::Anatomy;
using phantom::BuiltinOptions;
using phantom::BuiltinStenosis;
using phantom::CaseOptions;
using phantom::CaseVariant;
using phantom::ContourOptions;
using phantom::ObserverOptions;
using phantom::PlaqueKind;
using phantom::Preset;
using phantom::ScanOptions;
using phantom::ScanRealism;
using phantom::SuiteOptions;

template <>
struct WordsOf<Preset> {
  static constexpr std::pair<const char*, Preset> words[] = {
      {"tiny", Preset::tiny}, {"small", Preset::small}, {"full", Preset::full}};
};
template <>
struct WordsOf<Anatomy> {
  static constexpr std::pair<const char*, Anatomy> words[] = {
      {"usual", Anatomy::usual},
      {"left-ostium-closed", Anatomy::left_ostium_closed},
      {"right-ostium-closed", Anatomy::right_ostium_closed},
      {"rca-from-left", Anatomy::rca_from_left},
      {"lcx-from-right", Anatomy::lcx_from_right},
      {"bypass", Anatomy::bypass}};
};
template <>
struct WordsOf<PlaqueKind> {
  static constexpr std::pair<const char*, PlaqueKind> words[] = {{"soft", PlaqueKind::soft},
                                                                 {"fibrous", PlaqueKind::fibrous},
                                                                 {"calcified", PlaqueKind::calcified},
                                                                 {"mixed", PlaqueKind::mixed}};
};
OSTIA_OPTIONS(CaseVariant, (anatomy, calcium, stent_mm, contrast_hu, venous), ())
OSTIA_OPTIONS(ScanRealism,
              (noise_structure, iterative, undershoot, tail, tail_fwhm_mm, streaks, half_scan_motion_mm,
               mixing, cava_hu, sternal_wires, clips, ecg_leads, pacemaker_leads, stent_struts),
              ())
OSTIA_OPTIONS(ScanOptions,
              (supersampling, psf_fwhm_mm, psf_fwhm_z_mm, noise_hu, noise_peak_per_mm, noise_fwhm_z_mm,
               stair_step_mm, stair_block_mm, motion_mm, moving_centre, moving_radius_mm, beam_hardening,
               realism),
              (grid, seed))  // set from the preset and the case's seed
OSTIA_OPTIONS(ContourOptions, (spacing_mm, observer_spacing_mm, points), ())
OSTIA_OPTIONS(ObserverOptions, (count, healthy_mm, diseased_mm, axis_mm, axis_length_mm), (seed))
OSTIA_OPTIONS(CaseOptions, (seed, preset, disease, variant, scan, contours, observers, surface_spacing_mm),
              (patient, obstacles))  // arteries of a file; the suite hard's
OSTIA_OPTIONS(SuiteOptions, (first, cases, truth_only, mhd, nrrd, dicom, report, phases, hard), ())
OSTIA_OPTIONS(BuiltinOptions,
              (seed, spacing_mm, blur_fwhm_mm, noise_hu, noise_grain_mm, lumen_hu, fat_hu, myocardium_hu), ())
OSTIA_FIGURES(BuiltinStenosis, (tube, centre_mm, length_mm, diameter_stenosis, throat_radius_mm), ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::ContourSet;
using geometry::TriMesh;
using geometry::VesselTree;
using phantom::CasePlan;
using py::literals::operator""_a;

TriMesh lumen_of(const CasePlan& plan, const TaskContext& task) {
  return phantom::tree_surface(phantom::VesselField(plan.tree), phantom::Boundary::lumen,
                               plan.options.surface_spacing_mm, task);
}

ContourSet contours_of(const CasePlan& plan) {
  return phantom::annotate(plan.tree, plan.sections.sections, plan.options.contours, plan.options.observers);
}

py::list stenoses_of(const CasePlan& plan) {
  py::list rows;
  for (const auto& vessel : plan.tree.vessels)
    for (const auto& one : vessel.stenoses)
      rows.append(py::dict("vessel"_a = vessel.name, "from_mm"_a = one.s_from_mm, "to_mm"_a = one.s_to_mm,
                           "throat_mm"_a = one.s_throat_mm, "diameter_stenosis"_a = one.diameter_stenosis,
                           "area_stenosis"_a = one.area_stenosis, "eccentricity"_a = one.eccentricity,
                           "plaque"_a = detail::word_of(one.kind)));
  return rows;
}

/// The still truth as it is at some phases of the beat.
py::dict beating(const CasePlan& plan, const py::object& phases, const py::object& progress) {
  const auto shares = numbers_of(phases, "phases");
  auto moved = watched(progress, [&](const TaskContext& task) {
    const TriMesh still = lumen_of(plan, task.sub(0.0, 0.8));
    const phantom::Heartbeat beat = phantom::heartbeat_of(plan);
    std::vector<TriMesh> surfaces;
    for (const double share : shares) surfaces.push_back(phantom::moved(still, beat.phase(100.0 * share)));
    return surfaces;
  });
  py::dict out;
  for (std::size_t i = 0; i < shares.size(); ++i)
    out[py::float_(shares[i])] = std::make_shared<TriMesh>(std::move(moved[i]));
  return out;
}

void bind_type(py::module_& m) {
  py::class_<CasePlan, std::shared_ptr<CasePlan>>(
      m, "PhantomCase", "A synthetic patient of exactly known truth; the same for the same options.")
      .def_property_readonly(
          "tree", [](const CasePlan& p) { return phantom::vessel_tree(p.tree); },
          "VesselTree: axes with the lumen's mean radii, mm")
      .def_property_readonly("contours", &contours_of,
                             "ContourSet of the annotated sections, by the truth and by observers")
      .def_property_readonly(
          "stenoses", &stenoses_of,
          "A dictionary each: vessel, from_mm, to_mm, throat_mm, diameter_stenosis, plaque ...")
      .def_property_readonly(
          "references",
          [](const CasePlan& p) {
            py::dict lines;
            for (const auto& vessel : p.challenge.vessels)
              lines[vessel.name.c_str()] = py::cast(vessel.reference);
            return lines;
          },
          "{vessel: ReferenceLine} as the Rotterdam challenge has them")
      .def_readonly("warnings", &CasePlan::warnings, "What of the plan could not be had.")
      .def(
          "lumen",
          [](const CasePlan& p, const py::object& progress) {
            return watched(progress, [&](const TaskContext& task) { return lumen_of(p, task); });
          },
          py::kw_only(), py::arg("progress") = py::none(), "The true lumen: a closed TriMesh, mm.")
      .def(
          "scan",
          [](const CasePlan& p, const py::object& progress) {
            auto scan =
                watched(progress, [&](const TaskContext& task) { return phantom::scan_case(p, task); });
            return py::make_tuple(AnyVolume(std::move(scan.image)), AnyVolume(std::move(scan.labels)));
          },
          py::kw_only(), py::arg("progress") = py::none(),
          "The case as a scanner sees it: (Volume in HU, labels of tissues, uint8).")
      .def("beating", &beating, py::arg("phases"), py::kw_only(), py::arg("progress") = py::none(),
           "The true lumen at phases (p,), shares of the cycle: {phase: TriMesh}, all with the same "
           "triangles.")
      .def("__repr__", [](const CasePlan& p) {
        return py::str("<ostia.PhantomCase of seed {}: {} vessels, {} sections>")
            .format(p.options.seed, p.tree.vessels.size(), p.sections.sections.size());
      });
  const std::string text = with_options<CaseOptions>(
      m, "phantom_case",
      "A heart with its coronary tree, disease and observers, drawn from a seed, before its image is made.");
  m.def(
      "phantom_case",
      [](const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<CaseOptions>(options);
        phantom::validate(how);
        return std::make_shared<CasePlan>(
            watched(progress, [&](const TaskContext&) { return phantom::plan_case(how); }));
      },
      py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_folders(py::module_& m) {
  std::string text = with_options<SuiteOptions>(m, "write_phantom",
                                                "Synthetic patients as a folder, whole or not at all: "
                                                "images, labels, lines, contours, surfaces. first: "
                                                "the options of phantom_case. Returns suite.json.");
  m.def(
      "write_phantom",
      [](const fs::path& folder, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<SuiteOptions>(options);
        phantom::validate(how);
        return json_of(watched(progress, [&](const TaskContext& task) {
          const auto record = phantom::write_suite(
              folder, how, [](const fs::path&, const phantom::SuiteRecord&) {}, task);
          return phantom::suite_json(how, record);
        }));
      },
      py::arg("folder"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text =
      with_options<BuiltinOptions>(m, "builtin_case",
                                   "A bifurcating, stenosed vessel as a CT shows it: (Volume in HU, true "
                                   "lumen as TriMesh, branches: the two "
                                   "ends of each, (2, 3) mm, as segment_vessels takes them, the stenosis).");
  m.def(
      "builtin_case",
      [](const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<BuiltinOptions>(options);
        phantom::validate(how);
        auto made = watched(progress, [&](const TaskContext& task) {
          auto found = phantom::make_builtin_case(how, task.sub(0.0, 0.9));
          TriMesh truth = geometry::surface_of(found.truth, how.spacing_mm, false);
          return std::pair(std::move(found), std::move(truth));
        });
        py::list branches;
        for (const auto& [from, to] : made.first.branches)
          branches.append(array_of(std::vector<geometry::Vec3>{from, to}));
        return py::make_tuple(AnyVolume(std::move(made.first.image)),
                              std::make_shared<TriMesh>(std::move(made.second)), branches,
                              figures(made.first.stenosis));
      },
      py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_phantom(py::module_& m) {
  bind_type(m);
  bind_folders(m);
}

}  // namespace ostia::python
