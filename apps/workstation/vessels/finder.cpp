#include "vessels/finder.h"

#include "opening/opening.h"
#include "shell/desk.h"

#include "ostia/core/error.h"
#include "ostia/coronary/extract.h"
#include "ostia/session/found_model.h"
#include "ostia/session/new_vessel.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr double least_lumen_hu = 100.0;  // of blood with any contrast agent; without, it has 40

/// What is a little brighter than the fat about it would do for a way.
void require_contrast(const segmentation::MinimalPath& way) {
  if (way.lumen_hu < least_lumen_hu)
    throw GeometryError("there is no contrast along the way between the two places (" +
                        std::to_string(std::lround(way.lumen_hu)) +
                        " HU); click into the vessel's lumen at both ends");
}

constexpr double ostium_mm = 6.0;  // of a way from an ostium that may lie in the aorta

segmentation::MinimalPath way_between(const imaging::ImageVolume& image, const geometry::Vec3& from,
                                      const geometry::Vec3& end, const core::TaskContext& task) {
  segmentation::MinimalPath way = segmentation::path_between(image, from, end, {}, task);
  require_contrast(way);
  return way;
}

/// What was found for a new vessel.
struct NewVessel {
  lumen::Edit edit;
  std::vector<std::string> warnings;
};

}  // namespace

VesselFinder::VesselFinder(Desk& desk, Opening& opening)
    : QObject(&desk.window), desk_(desk), opening_(opening) {
  own_.push_back(desk.bench.case_changed.observe([this] {
    drop_begun();
    if (desk_.bench.has_case()) aside_.clear();
  }));
  own_.push_back(desk.bench.image_changed.observe([this] {
    drop_begun();
    aside_.clear();
  }));
  own_.push_back(desk.bench.tool.observe([this](const session::Tool& tool) {
    desk_.bench.first_end.set({});
    const bool artery =
        tool == session::Tool::add_artery || (tool == session::Tool::add_vessel && !desk_.bench.has_case());
    if (artery && desk_.bench.image().volume)
      desk_.messages.say(tr("Click the ostium of the artery, then its distal end."));
  }));
}

void VesselFinder::drop_begun() {
  desk_.jobs.cancel("tree");
  desk_.jobs.cancel("path");
  desk_.bench.first_end.set({});
}

bool VesselFinder::can_take_back() const {
  if (!desk_.bench.has_case()) return !aside_.empty() && aside_deleted_;
  return !begun_.empty() && desk_.case_path == begun_ && !desk_.bench.session().file().next_undo();
}

bool VesselFinder::can_do_again() const {
  return !desk_.bench.has_case() && !aside_.empty() && !aside_deleted_;
}

void VesselFinder::take_back() {
  if (!can_take_back()) return;
  if (desk_.bench.has_case())
    put_aside(false);
  else
    bring_back();
}

void VesselFinder::do_again() {
  if (can_do_again()) bring_back();
}

void VesselFinder::delete_last() {
  if (desk_.bench.has_case()) put_aside(true);
}

void VesselFinder::put_aside(bool deleted) {
  aside_ = desk_.case_path;
  aside_deleted_ = deleted;
  opening_.close_case();
  desk_.messages.say(deleted
                         ? tr("The case has no vessel any more and was closed; Undo brings it back.")
                         : tr("The first vessel was taken back, and with it its case; Redo brings it back."));
}

void VesselFinder::bring_back() {
  const std::filesystem::path path = std::exchange(aside_, {});
  opening_.open(path);
}

bool VesselFinder::image_is_there() {
  if (!desk_.bench.image().volume)
    desk_.messages.say(tr("A vessel is found in the image: open the image of this case first."));
  else if (opening_.reading())
    desk_.messages.say(tr("The image is still being read."));
  else
    return true;
  return false;
}

void VesselFinder::find_tree() {
  if (!image_is_there()) return;
  const session::OpenImage image = desk_.bench.image();
  using Found = std::shared_ptr<const session::FoundModel>;
  const auto plain = std::make_shared<std::atomic<bool>>(false);  // of a scan without contrast agent
  desk_.jobs.run(
      "tree", tr("Finding the coronary arteries"),
      [volume = image.volume, plain](const core::TaskContext& task) {
        try {
          return std::any(
              Found(std::make_shared<const session::FoundModel>(session::found_model(*volume, {}, task))));
        } catch (const Cancelled&) {
          throw;
        } catch (const Error&) {
          *plain = coronary::lacks_contrast(*volume, task);
          throw;
        }
      },
      [this, reference = image.reference](const std::any& result) {
        const Found found = std::any_cast<Found>(result);
        opening_.start_case(reference, [&](const std::filesystem::path& path) {
          return session::create_case(path, *found, reference);
        });
        desk_.messages.say(
            tr("%n vessel(s) were found. Look at each before you trust it; a question mark in the "
               "list says where the program is not sure.",
               nullptr, static_cast<int>(found->model.tree.vessels.size())));
      },
      [this, plain](const QString& message) {
        desk_.messages.say(tr("The arteries were not found by themselves: %1").arg(message));
        QStringList ways{"tool.add_artery", "view.layout_planes", "file.series", "file.orientation",
                         "file.open"};
        if (*plain) ways.insert(1, "calcium.score");
        desk_.failure.set({tr("The arteries were not found by themselves"), message, ways});
      });
}

void VesselFinder::find_vessel(const geometry::Vec3& end) {
  if (!image_is_there()) return;
  const session::OpenImage image = desk_.bench.image();
  const bool begins = !desk_.bench.has_case();
  if (!begins && desk_.bench.tool.get() != session::Tool::add_artery) return branch(image, end);
  if (begins) desk_.jobs.cancel("tree");  // a person begins the tree
  const auto ends = two_ends(end);
  if (!ends) return;
  if (begins)
    first_vessel(image, ends->first, ends->second);
  else
    another_artery(image, ends->first, ends->second);
}

std::optional<std::pair<geometry::Vec3, geometry::Vec3>> VesselFinder::two_ends(const geometry::Vec3& end) {
  auto& first = desk_.bench.first_end;
  if (!first.get()) {
    first.set(end);
    desk_.messages.say(tr("Now click the distal end of this vessel."));
    return std::nullopt;
  }
  const geometry::Vec3 from = *first.get();
  first.set({});
  return std::pair{from, end};
}

void VesselFinder::first_vessel(const session::OpenImage& image, const geometry::Vec3& from,
                                const geometry::Vec3& end) {
  desk_.jobs.run(
      "path", tr("First vessel"),
      [volume = image.volume, from, end](const core::TaskContext& task) {
        const segmentation::MinimalPath way = way_between(*volume, from, end, task.sub(0.0, 0.5));
        const auto wide = session::require_artery(way, *volume, ostium_mm);
        return std::any(std::pair{
            session::model_of_way(way, session::unused_name(nullptr), *volume, task.sub(0.5, 1.0)), wide});
      },
      [this, reference = image.reference](const std::any& result) {
        using Found = std::pair<lumen::LumenModel, std::optional<std::string>>;
        const auto& [model, wide] = std::any_cast<const Found&>(result);
        opening_.start_case(reference, [&, &made = model](const std::filesystem::path& path) {
          begun_ = path;  // before the commands are told of the case
          return session::CaseFile::create(path, made, reference);
        });
        if (wide) desk_.messages.say(QString::fromStdString(*wide));
      },
      [this](const QString& message) { desk_.messages.complain(message, tr("No vessel found")); });
}

void VesselFinder::another_artery(const session::OpenImage& image, const geometry::Vec3& from,
                                  const geometry::Vec3& end) {
  desk_.jobs.run(
      "path", tr("Another artery"),
      [volume = image.volume, model = desk_.bench.session().file().model(), from,
       end](const core::TaskContext& task) {
        const segmentation::MinimalPath way = way_between(*volume, from, end, task.sub(0.0, 0.5));
        NewVessel made{session::artery_of(way, session::unused_name(model.get())), way.warnings};
        if (const auto wide = session::require_artery(way, *volume, ostium_mm))
          made.warnings.push_back(*wide);
        made.edit = session::with_wall_and_name(made.edit, *model, *volume, task.sub(0.5, 1.0));
        return std::any(std::move(made));
      },
      [this](const std::any& found) { take(found); },
      [this](const QString& message) { desk_.messages.complain(message, tr("No vessel found")); });
}

void VesselFinder::branch(const session::OpenImage& image, const geometry::Vec3& end) {
  desk_.jobs.run(
      "path", tr("Way back to the tree"),
      [volume = image.volume, model = desk_.bench.session().file().model(),
       end](const core::TaskContext& task) {
        const segmentation::MinimalPath way =
            segmentation::path_to_tree(*volume, end, model->tree, {}, task.sub(0.0, 0.6));
        NewVessel made{lumen::Edit{}, way.warnings};
        if (const auto wide = session::require_artery(way, *volume)) made.warnings.push_back(*wide);
        if (const auto extension = session::extension_of(way, *model))
          made.edit = *extension;
        else
          made.edit = session::with_wall_and_name(session::branch_of(way, session::unused_name(model.get())),
                                                  *model, *volume, task.sub(0.6, 1.0));
        return std::any(std::move(made));
      },
      [this](const std::any& found) { take(found); },
      [this](const QString& message) { desk_.messages.complain(message, tr("No vessel found")); });
}

void VesselFinder::take(const std::any& found) {
  const auto& made = std::any_cast<const NewVessel&>(found);
  desk_.messages.guarded([&] { join(made.edit, made.warnings); }, true);
}

void VesselFinder::join(const lumen::Edit& edit, const std::vector<std::string>& warnings) {
  session::Workbench& bench = desk_.bench;
  bench.edit(edit);
  if (const auto* extension = std::get_if<lumen::AxisExtend>(&edit)) {
    bench.vessel.set(extension->vessel);
    desk_.messages.say(tr("%1 was lengthened: the way came to its end.")
                           .arg(QString::fromStdString(bench.vessel_name(extension->vessel))));
  } else {
    bench.vessel.set(bench.model()->tree.vessels.back().id);
  }
  if (!warnings.empty()) desk_.messages.say(QString::fromStdString(warnings.front()));
}

}  // namespace ostia::workstation
