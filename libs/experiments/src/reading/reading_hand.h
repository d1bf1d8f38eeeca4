#pragma once
/// \file The hand of the reader of a tree: what the workstation's tools do, with the time that it takes.

#include "ostia/experiments/reading.h"
#include "ostia/lumen/live_model.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::experiments {

/// Each act is added to `actions`; false where the program refused it and the model is as it was. Cancelled
/// passes through.
class ReadingHand {
 public:
  /// Throws as lumen::LiveModel does; `start` null: no case is open.
  ReadingHand(const imaging::ImageVolume& image, std::shared_ptr<const lumen::LumenModel> start,
              const ReadingOptions& options, std::vector<ReadingAction>& actions);
  const lumen::LumenModel* model() const { return live_ ? &live_->model() : nullptr; }
  const lumen::LiveModel* live() const { return live_.get(); }
  bool tired() const;  ///< no action is left
  Vec3 click(const Vec3& place, double sigma_mm);

  bool remove(std::int32_t vessel);  ///< the case is put aside where it is the last one
  bool cut_off(std::int32_t vessel, double s_mm);
  bool rename(std::int32_t vessel, const std::string& name);
  /// "Add vessel" by its distal end or, with `from`, "Add artery" by both; one that goes on from an end is an
  /// `ending`.
  bool find(const std::string& name, const std::optional<Vec3>& from, const Vec3& end,
            const core::TaskContext& task);
  bool pull_axis(std::int32_t vessel, const Vec3& from, const Vec3& to, double reach_mm);
  bool put_on_axis(std::int32_t vessel, const Vec3& place);
  bool draw(std::int32_t vessel, const ReaderStroke& stroke, double s_mm);
  void undo();  ///< of the last act that was done

 private:
  bool act(ReadingAction action, const std::function<void(ReadingAction&)>& work);
  bool edit(ReadingAction action, const lumen::Edit& edit);
  void take(const lumen::Edit& edit);
  ReadingAction begun(ReadingAct act, std::int32_t vessel, double seconds, int clicks = 0) const;
  double clicked_s() const;
  const imaging::ImageVolume& image_;
  const ReadingOptions& options_;
  std::vector<ReadingAction>& actions_;
  std::unique_ptr<lumen::LiveModel> live_;
  std::shared_ptr<const lumen::LumenModel> former_;
  std::uint64_t clicks_ = 0;
};

}  // namespace ostia::experiments
