#pragma once
/// \file What differs between two models: what undo, redo and merged drags tell the views.

#include "ostia/lumen/edit.h"

#include <vector>

namespace ostia::session {

/// By vessel: samples that went, that came, or that changed in place (in both lists under one id); vessels
/// that are new or gone have `axis_changed`. Vessels that both models share cost nothing.
std::vector<lumen::VesselChange> changes_between(const lumen::LumenModel& before,
                                                 const lumen::LumenModel& after);

/// The same to the last bit.
bool same(const lumen::SurfaceSample& a, const lumen::SurfaceSample& b);
bool same(const geometry::Centerline& a, const geometry::Centerline& b);

}  // namespace ostia::session
