#include "reading/reading_hand.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"
#include "ostia/segmentation/minimal_path.h"
#include "ostia/session/new_vessel.h"

#include <algorithm>
#include <utility>

namespace ostia::experiments {
namespace {

constexpr double ostium_mm = 6.0;  // of a way from an ostium that may lie in the aorta
constexpr std::uint64_t clicks_seed = 0x636c69636bULL;

std::string vessel_name(const lumen::LumenModel& model, std::int32_t id) {
  const auto vessel = std::find_if(model.tree.vessels.begin(), model.tree.vessels.end(),
                                   [&](const geometry::Vessel& one) { return one.id == id; });
  return vessel == model.tree.vessels.end() ? std::string() : vessel->name;
}

}  // namespace

ReadingHand::ReadingHand(const imaging::ImageVolume& image, std::shared_ptr<const lumen::LumenModel> start,
                         const ReadingOptions& options, std::vector<ReadingAction>& actions)
    : image_(image), options_(options), actions_(actions) {
  if (start) live_ = std::make_unique<lumen::LiveModel>(std::move(start));
}

bool ReadingHand::tired() const {
  return actions_.size() >= static_cast<std::size_t>(options_.most_actions);
}

Vec3 ReadingHand::click(const Vec3& place, double sigma_mm) {
  Vec3 hit = place;
  for (int a = 0; a < 3; ++a) hit[a] += sigma_mm * phantom::normal(options_.seed ^ clicks_seed, clicks_++);
  return hit;
}

/// Where to, then there.
double ReadingHand::clicked_s() const {
  return options_.strokes.seconds_a_view + options_.times.point_s + options_.times.press_s;
}

ReadingAction ReadingHand::begun(ReadingAct act, std::int32_t vessel, double seconds, int clicks) const {
  return {act,
          model() ? vessel_name(*model(), vessel) : std::string(),
          clicks,
          options_.times.think_s + seconds,
          {}};
}

bool ReadingHand::act(ReadingAction action, const std::function<void(ReadingAction&)>& work) {
  const auto refused = [&](const std::exception& error) { action.refusal = error.what(); };
  try {
    work(action);
  } catch (const InvalidInput& error) {
    refused(error);
  } catch (const GeometryError& error) {
    refused(error);
  } catch (const NumericalError& error) {
    refused(error);
  }
  actions_.push_back(std::move(action));
  return actions_.back().refusal.empty();
}

void ReadingHand::take(const lumen::Edit& edit) {
  auto before = std::make_shared<const lumen::LumenModel>(live_->model());
  live_->follow(lumen::apply(*before, edit));
  former_ = std::move(before);
}

bool ReadingHand::edit(ReadingAction action, const lumen::Edit& edit) {
  return act(std::move(action), [&](ReadingAction&) { take(edit); });
}

bool ReadingHand::remove(std::int32_t vessel) {
  const HandTimes& t = options_.times;
  ReadingAction action = begun(ReadingAct::removal, vessel, t.point_s + t.press_s + t.home_s + t.key_s);
  if (model()->tree.vessels.size() > 1) return edit(std::move(action), lumen::BranchDelete{vessel});
  return act(std::move(action), [&](ReadingAction&) {
    former_ = std::make_shared<const lumen::LumenModel>(live_->model());
    live_.reset();
  });
}

bool ReadingHand::cut_off(std::int32_t vessel, double s_mm) {
  const HandTimes& t = options_.times;  // the cursor goes there, then the list's menu and its line
  return edit(begun(ReadingAct::ending, vessel, clicked_s() + 2.0 * (t.point_s + t.press_s), 1),
              lumen::AxisTrim{vessel, s_mm});
}

bool ReadingHand::rename(std::int32_t vessel, const std::string& name) {
  const HandTimes& t = options_.times;  // F2, the name, Return
  return edit(begun(ReadingAct::naming, vessel,
                    t.point_s + t.press_s + t.home_s + t.key_s * (2.0 + static_cast<double>(name.size()))),
              lumen::VesselRename{vessel, name});
}

bool ReadingHand::find(const std::string& name, const std::optional<Vec3>& from, const Vec3& end,
                       const core::TaskContext& task) {
  const HandTimes& t = options_.times;
  ReadingAction action =
      begun(ReadingAct::addition, 0, t.home_s + (from ? 2.0 : 1.0) * (t.key_s + clicked_s()), from ? 2 : 1);
  action.vessel = name;
  return act(std::move(action), [&](ReadingAction& done) {
    segmentation::MinimalPath way;
    if (from)
      way = segmentation::path_between(image_, *from, end, {}, task);
    else
      way = segmentation::path_to_tree(image_, end, live_->model().tree, {}, task);
    session::require_artery(way, image_, from ? ostium_mm : 0.0);
    const std::string unused = session::unused_name(model());
    if (!live_) {
      live_ = std::make_unique<lumen::LiveModel>(
          std::make_shared<const lumen::LumenModel>(session::model_of_way(way, unused, image_, task)));
      former_.reset();
    } else if (from) {
      take(session::with_wall_and_name(session::artery_of(way, unused), live_->model(), image_, task));
    } else if (const auto extension = session::extension_of(way, live_->model())) {
      done.act = ReadingAct::ending;
      take(*extension);
    } else {
      take(session::with_wall_and_name(session::branch_of(way, unused), live_->model(), image_, task));
    }
  });
}

bool ReadingHand::pull_axis(std::int32_t vessel, const Vec3& from, const Vec3& to, double reach_mm) {
  const HandTimes& t = options_.times;
  return edit(begun(ReadingAct::axis, vessel, t.home_s + t.key_s + clicked_s() + t.point_s + t.press_s, 1),
              lumen::AxisMove{vessel, from, to, reach_mm});
}

bool ReadingHand::put_on_axis(std::int32_t vessel, const Vec3& place) {
  const HandTimes& t = options_.times;  // a double click
  return edit(begun(ReadingAct::axis, vessel, t.home_s + t.key_s + clicked_s() + t.press_s, 1),
              lumen::AxisInsert{vessel, place});
}

bool ReadingHand::draw(std::int32_t vessel, const ReaderStroke& stroke, double s_mm) {
  ReadingAction action = begun(ReadingAct::stroke, vessel, 0.0);
  action.seconds = stroke.seconds;
  action.on_section = stroke.on_section;
  action.s_mm = s_mm;
  action.worst_mm = stroke.worst_mm;
  return edit(std::move(action), stroke.edit);
}

void ReadingHand::undo() {
  const HandTimes& t = options_.times;
  act(begun(ReadingAct::undo, 0, t.home_s + 2.0 * t.key_s), [&](ReadingAction&) {
    live_ = former_ ? std::make_unique<lumen::LiveModel>(former_) : nullptr;
    former_.reset();
  });
}

}  // namespace ostia::experiments
