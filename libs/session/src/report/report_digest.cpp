#include "ostia/session/report_digest.h"

#include "ostia/core/files.h"
#include "ostia/session/annotation_json.h"

namespace ostia::session {

std::string report_content_digest(const lumen::LumenModel& model, const Annotations& annotations,
                                  const std::string& image_sha256) {
  std::string all = lumen::digest(model) + "\n" + image_sha256 + "\n";
  const auto add = [&](const AnnotationCommand& command) { all += to_json(command) + "\n"; };
  for (const analysis::Measurement& one : annotations.measurements) add(MeasureChange{one});
  for (VesselMark mark : annotations.marks) {
    mark.visible = true, mark.color.reset();  // how it is shown
    add(MarkVessel{mark});
  }
  add(SetReportImpression{annotations.report.impression});
  add(SetReportModifiers{annotations.report.modifiers});
  add(SetPlaqueFeatures{annotations.report.features});
  return core::sha256(all);
}

}  // namespace ostia::session
