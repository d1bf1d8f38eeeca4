#pragma once
/// \file What a signature of a report is for.

#include "ostia/lumen/lumen_model.h"
#include "ostia/session/annotation.h"

#include <string>

namespace ostia::session {

/// SHA-256 over model, measurements, readers' words and notes, but not how vessels are shown and who signed.
std::string report_content_digest(const lumen::LumenModel& model, const Annotations& annotations);

}  // namespace ostia::session
