#pragma once
/// \file All that is read before the window opens.

#include "options.h"

#include "ostia/geometry/cage_motion.h"
#include "ostia/geometry/ecg_record.h"
#include "ostia/geometry/tri_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::live {

struct LiveEcg {
  geometry::EcgLead lead;
  double samples_per_second = 0.0;
};

struct LiveInput {
  geometry::TriMesh surface;
  geometry::CageMotion motion;
  std::optional<LiveEcg> ecg;
  std::vector<std::string> warnings;  ///< a sentence each; an ECG that cannot be used is one
  bool ecg_failed = false;            ///< one was named, and the tree beats without it
};

/// Throws IoError, InvalidInput for a motion or a surface that cannot be used. An electrocardiogram that
/// cannot be used is a warning: the tree beats in a loop.
LiveInput read_input(const Options& options);

/// The file of the motion, empty for the sample heart.
std::filesystem::path motion_file(const Options& options);
/// Where in the record pictures without a window begin: a stream that has just begun has no phase yet, so
/// that, unless a start or a phase is told, it is 10 s later, or half of a record shorter than 20 s.
double first_picture_s(const LiveInput& input, const Options& options);

}  // namespace ostia::live
