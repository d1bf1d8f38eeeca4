#pragma once
/// \file Annotation commands as JSON lines (docs/schemas/annotation.schema.json).

#include "ostia/session/annotation.h"

#include <string>
#include <string_view>

namespace ostia::session {

/// One line without its end: {"v":1,"op":"measure.change","id":3,"kind":"distance",...}. Numbers are written
/// so that they are read back to the last bit. Throws InvalidInput for what JSON cannot hold.
std::string to_json(const AnnotationCommand& command);
/// Throws InvalidInput naming the field, what is wrong with it and what is allowed.
AnnotationCommand annotation_of_json(std::string_view line);

}  // namespace ostia::session
