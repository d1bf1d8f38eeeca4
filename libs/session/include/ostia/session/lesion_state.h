#pragma once
/// \file What a reader says of what was found.

#include <string>

namespace ostia::session {

enum class LesionState { open, accepted, rejected };
std::string to_string(LesionState state);           ///< "open", "accepted", "rejected"
LesionState lesion_state(const std::string& text);  ///< of to_string; throws InvalidInput

}  // namespace ostia::session
