#pragma once
/// \file A plug-in at work, in a process of its own, on copies.

#include "ostia/imaging/volume.h"
#include "ostia/io/surface_fields.h"
#include "ostia/session/case_file.h"
#include "ostia/session/edit_json.h"
#include "ostia/session/plugin.h"

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ostia::core {
class PrivateFolder;
}

namespace ostia::session {

using PluginValues = std::map<std::string, PluginValue>;

/// What a plug-in gave: of these the one that PluginGives says.
struct PluginAnswer {
  PluginEdits edits;
  /// Overlays and fields: all surfaces as one, with the number of its surface at each point as "part" where
  /// there are several or no field; a field that another surface lacks is NaN there.
  io::SurfaceWithFields surface;
  std::optional<imaging::MaskVolume> mask;
};

/// One run. Copies lie in a folder of this user's alone, which goes with the job and is where the script
/// works: what it leaves there goes, too, and the case itself is never in its reach.
class PluginJob {
 public:
  /// Values that are not given are the parameters' own. Throws InvalidInput for one that is no parameter.
  PluginJob(Plugin plugin, PluginValues values);
  ~PluginJob();
  PluginJob(PluginJob&&) noexcept;

  void take_case(const CaseFile& file);  ///< copies it now
  void take_image(std::shared_ptr<const imaging::ImageVolume> image);
  const Plugin& plugin() const { return plugin_; }

  /// Any thread. Throws InvalidInput where the script fails (its file and line, and what it said), has
  /// changed since it was listed, or gives what it may not; ResourceError where it takes longer than `limit`;
  /// IoError without Python or the package; Cancelled. What the script says goes to the log.
  PluginAnswer run(std::chrono::seconds limit = std::chrono::hours(1),
                   const core::TaskContext& task = core::no_task()) const;

 private:
  Plugin plugin_;
  PluginValues values_;
  std::unique_ptr<core::PrivateFolder> folder_;
  std::shared_ptr<const imaging::ImageVolume> image_;
  bool has_case_ = false;
};

}  // namespace ostia::session
