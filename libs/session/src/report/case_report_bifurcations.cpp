// Medina's classes of a report's bifurcations.

#include "report/case_report_grading.h"
#include "report/case_report_text.h"

#include <algorithm>

namespace ostia::session {
namespace {

std::string name_of(const CaseReport& report, std::int32_t id) {
  for (const ReportVessel& vessel : report.vessels)
    if (vessel.id == id) return vessel.name;
  return {};
}

analysis::MeasuredVessel measured_vessel(const CaseReport& report, std::int32_t id) {
  return {report.profiles.at(id), report.references.at(id)};
}

}  // namespace

void classify_bifurcations(CaseReport& report) {
  for (const auto& [id, ostium] : report.ostia) {
    if (ostium.parent < 0) continue;
    const analysis::MeasuredVessel side = measured_vessel(report, id);
    if (analysis::side_calibre_mm(side, ostium) < report.options.medina.least_side_mm) continue;
    ReportBifurcation one;
    one.medina =
        analysis::medina_class(measured_vessel(report, ostium.parent), side, ostium, report.options.medina);
    one.main_name = name_of(report, one.medina.main);
    one.side_name = name_of(report, one.medina.side);
    report.bifurcations.push_back(std::move(one));
  }
  std::stable_sort(report.bifurcations.begin(), report.bifurcations.end(), [](const auto& a, const auto& b) {
    return std::pair(a.medina.main, a.medina.joint_mm) < std::pair(b.medina.main, b.medina.joint_mm);
  });
  for (ReportStenosis& lesion : report.stenoses)
    for (const ReportBifurcation& one : report.bifurcations) {
      const analysis::Stenosis& s = lesion.stenosis;
      if (!lesion.medina.empty() || s.diameter_percent < report.options.medina.least_percent - 0.5 ||
          !one.medina.holds(s.vessel, s.from_mm, s.to_mm))
        continue;
      lesion.medina = analysis::to_string(one.medina);
      lesion.bifurcation = one.main_name + "/" + one.side_name;
    }
}

}  // namespace ostia::session
