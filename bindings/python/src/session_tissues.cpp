// Calcium, the fat about the arteries, the muscle behind them.

#include "call.h"
#include "options.h"
#include "session_parts.h"
#include "values.h"
#include "volume.h"
#include "walls.h"

#include "ostia/analysis/calcium_score.h"
#include "ostia/analysis/myocardial_territories.h"
#include "ostia/core/log.h"
#include "ostia/pipeline/calcium_report.h"
#include "ostia/session/vessel_fat.h"

#include <pybind11/stl.h>

#include <map>
#include <string>

namespace ostia::python {

using analysis::CalciumOptions;
using analysis::FatOptions;
using analysis::TerritoryOptions;
using session::CaseFatOptions;

OSTIA_OPTIONS(CalciumOptions,
              (threshold_hu, least_area_mm2, definition_mm, average_thin, slice_thickness_mm,
               largest_slice_mm, calibration),
              ())
OSTIA_OPTIONS(FatOptions, (from_hu, to_hu, reach_diameters, edge_mm, slab_mm, sectors), ())
OSTIA_OPTIONS(CaseFatOptions, (fat, tube_kv), (walls))  // find_plaque's
OSTIA_OPTIONS(TerritoryOptions, (density_g_ml, step_mm), ())

namespace {

using core::TaskContext;
using geometry::VesselTree;
using lumen::LumenModel;

void bind_calcium(py::module_& m) {
  const std::string text = with_options<CalciumOptions>(
      m, "score_calcium",
      "The calcium score of a CT without contrast agent (int16, HU), as calcium.json has it. places: a "
      "dictionary of a lesion's number and where it lies (LM, LAD, LCX, RCA, aorta, valve, bone, none), in "
      "place of what is proposed.");
  m.def(
      "score_calcium",
      [](const AnyVolume& image, const std::map<int, std::string>& places, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<CalciumOptions>(options);
        const imaging::ImageVolume& ct = image.image("image");
        std::map<int, analysis::CalciumPlace> said;
        for (const auto& [number, place] : places) said[number] = analysis::calcium_place(place);
        return json_of(watched(progress, [&](const TaskContext& task) {
          pipeline::ScoredScan scan{analysis::score_calcium(ct, how, task), "", {}};
          scan.scored.score = analysis::with_places(std::move(scan.scored.score), said);
          for (const std::string& warning : scan.scored.score.warnings) core::log_warning(warning);
          return pipeline::calcium_json(scan);
        }));
      },
      py::arg("image"), py::kw_only(), py::arg("places") = py::dict(), py::arg("progress") = py::none(),
      text.c_str());
}

void bind_fat(py::module_& m) {
  const std::string text = with_options<CaseFatOptions>(
      m, "measure_fat",
      "The fat about RCA, LAD and LCX in the CT that a model was made with (int16, HU), as fat.json has it.");
  m.def(
      "measure_fat",
      [](const LumenModel& model, const AnyVolume& image, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<CaseFatOptions>(options);
        const imaging::ImageVolume& ct = image.image("image");
        return json_of(watched(progress, [&](const TaskContext& task) {
          const SolvedWalls walls = solved(model, task.sub(0.0, 0.5));
          const session::CaseFat fat = session::case_fat(model, walls, ct, how, task.sub(0.5, 1.0));
          for (const std::string& warning : fat.warnings) core::log_warning(warning);
          return session::fat_json(fat);
        }));
      },
      py::arg("model"), py::arg("image"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_territories(py::module_& m) {
  const std::string text = with_options<TerritoryOptions>(
      m, "find_territories",
      "The left ventricle's muscle (a mask, uint8) by the nearest artery: (Volume of uint8, 1 and up by "
      "vessel "
      "in the tree's order; dictionary of masses, g). behind: pairs of a vessel's id and mm along it; the "
      "muscle behind each.");
  m.def(
      "find_territories",
      [](const VesselTree& tree, const AnyVolume& myocardium,
         const std::vector<std::pair<std::int32_t, double>>& behind, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<TerritoryOptions>(options);
        const imaging::MaskVolume& mask = myocardium.mask("myocardium");
        auto found = watched(progress, [&](const TaskContext& task) {
          return analysis::myocardial_territories(tree, mask, how, task);
        });
        py::dict result;
        result["mass_g"] = found.mass_g;
        result["lumen_mm3"] = found.lumen_mm3;
        result["lumen_mm3_per_g"] = found.lumen_mm3_per_g();
        py::list vessels, places;
        for (const analysis::VesselTerritory& one : found.vessels) {
          py::dict vessel;
          vessel["id"] = one.vessel;
          vessel["name"] = one.name;
          vessel["mass_g"] = one.mass_g;
          vessel["share"] = one.share;
          vessels.append(vessel);
        }
        for (const auto& [vessel, s_mm] : behind)
          places.append(analysis::mass_behind_g(found, tree, vessel, s_mm));
        result["vessels"] = vessels;
        result["behind_g"] = places;
        return py::make_tuple(AnyVolume(std::move(found.labels)), result);
      },
      py::arg("tree"), py::arg("myocardium"), py::kw_only(), py::arg("behind") = py::list(),
      py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_session_tissues(py::module_& m) {
  bind_calcium(m);
  bind_fat(m);
  bind_territories(m);
}

}  // namespace ostia::python
