// Options of `ostia measure` for branches and bifurcations.

#include "measure/measure.h"
#include "options/validators.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace ostia::app {

void add_branch_measures(CLI::App& app, MeasureCommand& c) {
  app.add_flag("--bifurcations", c.bifurcations,
               "Reference systems, vectors and angles of bifurcations, as VMTK defines them");
  app.add_flag("--sections", c.sections,
               "Surfaces, cases: area, diameters and shape of sections an inscribed sphere apart");
  app.add_option("--section-spheres", c.section_spheres, "Inscribed spheres from one section to the next")
      ->check(CLI::Range(1, 1000));
  app.add_option("--centerline", c.centerline, "Surfaces: their centerlines; left out: computed");
  app.add_option("--patch-length", c.patch_length_mm,
                 "Surfaces, cases: means of their arrays over patches so long, mm")
      ->check(above_zero());
  app.add_option("--patch-sectors", c.patch_sectors, "Patches around the vessel")->check(CLI::Range(1, 360));
}

}  // namespace ostia::app
