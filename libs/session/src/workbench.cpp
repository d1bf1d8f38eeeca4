#include "ostia/session/workbench.h"

#include "ostia/core/error.h"
#include "ostia/session/beating.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace ostia::session {
namespace {

/// Places of the samples that an edit took away; those that only changed are in both lists.
std::vector<Vec3> dismissed_places(const lumen::LumenModel& before,
                                   const std::vector<lumen::VesselChange>& changes) {
  std::vector<Vec3> places;
  for (const lumen::VesselChange& change : changes) {
    if (change.axis_changed || change.removed.empty()) continue;
    std::unordered_set<std::int64_t> gone(change.removed.begin(), change.removed.end());
    for (const lumen::SurfaceSample& sample : change.added) gone.erase(sample.id);
    for (const auto& vessel : before.vessels) {
      if (vessel->vessel != change.vessel) continue;
      for (const lumen::SurfaceSample& sample : vessel->samples)
        if (gone.contains(sample.id)) places.push_back(sample.position);
    }
  }
  return places;
}

bool any_axis_changed(const std::vector<lumen::VesselChange>& changes) {
  return std::any_of(changes.begin(), changes.end(), [](const auto& change) { return change.axis_changed; });
}

bool same_names(const geometry::VesselTree& a, const geometry::VesselTree& b) {
  return std::equal(a.vessels.begin(), a.vessels.end(), b.vessels.begin(), b.vessels.end(),
                    [](const auto& u, const auto& v) { return u.id == v.id && u.name == v.name; });
}

/// To a person: the same number, in the same places to 0.1 mm and by the same percent.
bool look_alike(const std::vector<analysis::Stenosis>& a, const std::vector<analysis::Stenosis>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::abs(x.from_mm - y.from_mm) < 0.1 && std::abs(x.to_mm - y.to_mm) < 0.1 &&
           std::abs(x.diameter_percent - y.diameter_percent) < 0.5;
  });
}

bool has_vessel(const lumen::LumenModel& model, std::int32_t id) {
  return std::any_of(model.vessels.begin(), model.vessels.end(),
                     [&](const auto& vessel) { return vessel->vessel == id; });
}

}  // namespace

const std::vector<WindowPreset>& window_presets() {
  // Usual windows of a reading station; CTA is wide enough for calcium beside contrast.
  static const std::vector<WindowPreset> presets{{"CTA", {250.0, 900.0}},
                                                 {"Soft tissue", {40.0, 400.0}},
                                                 {"Lung", {-600.0, 1500.0}},
                                                 {"Bone", {400.0, 1800.0}}};
  return presets;
}

/// What was measured of one vessel, and where its wall has moved since.
struct Workbench::Measured {
  analysis::LumenProfile profile, from_ostium;
  analysis::ReferenceLine reference;
  analysis::Ostium ostium;
  std::vector<analysis::Stenosis> stenoses;
  bool measured = false;
  bool other_tree = false;             // vessels about it came or went: what is told by branches is read anew
  double from_mm = 0.0, to_mm = -1.0;  // nothing where from > to

  void moved(double from, double to) {
    const bool none = from_mm > to_mm;
    from_mm = none ? from : std::min(from_mm, from);
    to_mm = none ? to : std::max(to_mm, to);
  }
};

namespace {

void require_image_of(const CaseFile& file, const ImageReference& image) {
  file.check_image(image);
  const std::optional<ImageReference> own = file.image();
  if (own && own->axes != image.axes)
    throw InvalidInput("the image is turned otherwise than the case has it (its axes run " +
                       (own->axes.empty() ? "as its file says" : own->axes) + "); open it from the case");
}

}  // namespace

Workbench::Workbench() {
  own_.push_back(vessel.observe([this](const std::int32_t&) { cursor_to_vessel(); }));
  own_.push_back(cursor_mm.observe([this](const double&) { cursor_to_place(); }));
}
Workbench::~Workbench() = default;

void Workbench::set_image(OpenImage image) {
  if (!image.volume) throw InvalidInput("there is no image to show");
  if (session_) require_image_of(session_->file(), image.reference);
  leave_other_image();
  image_ = std::move(image);
  const imaging::Geometry& grid = image_.volume->geometry;
  if (!session_ && !grid.contains(place.get())) {
    const Vec3 last(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                    static_cast<double>(grid.size[2] - 1));
    place.set(grid.world(last / 2.0));
  }
  image_changed.tell();
}

void Workbench::close_image() {
  leave_other_image();
  image_ = {};
  image_changed.tell();
}

void Workbench::set_session(Session session) {
  if (image_.volume) require_image_of(session.file(), image_.reference);
  leave_phase();
  leave_other_image();
  session_ = std::make_unique<Session>(std::move(session));
  measured_.clear();
  selected_measurement.set(0);
  const lumen::LumenModel& shown = session_->live().model();
  const std::int32_t first = shown.vessels.front()->vessel;
  case_changed.tell();
  if (!vessel.set(first)) cursor_to_vessel();
}

void Workbench::close_case() {
  leave_phase();
  leave_other_image();
  session_.reset();
  measured_.clear();
  selected_measurement.set(0);
  vessel.set(no_vessel);
  case_changed.tell();
}

Session& Workbench::session() {
  if (!session_) throw InvalidInput("no case is open");
  return *session_;
}
const Session& Workbench::session() const {
  if (!session_) throw InvalidInput("no case is open");
  return *session_;
}

const lumen::LumenModel* Workbench::model() const {
  return session_ ? &session_->live().model() : nullptr;
}

std::shared_ptr<const geometry::AxisCurve> Workbench::axis() const {
  return axis(vessel.get());
}
std::shared_ptr<const geometry::AxisCurve> Workbench::axis(std::int32_t id) const {
  const lumen::LumenModel* shown = model();
  if (!shown || !has_vessel(*shown, id)) return nullptr;
  if (phase_) return phase_->axis(id).curve();
  return lumen::vessel(*shown, id).axis;
}

std::string Workbench::vessel_name(std::int32_t id) const {
  if (const lumen::LumenModel* shown = model())
    for (const geometry::Vessel& one : shown->tree.vessels)
      if (one.id == id) return one.name;
  return {};
}

Workbench::Measured* Workbench::measured_of(std::int32_t id) const {
  const lumen::LumenModel* shown = model();
  if (!shown || !has_vessel(*shown, id)) return nullptr;
  std::unique_ptr<Measured>& found = measured_[id];
  if (!found) found = std::make_unique<Measured>();
  const bool moved = found->from_mm <= found->to_mm;
  if (found->measured && !moved && !found->other_tree) return found.get();
  const auto surface_of = [this](std::int32_t one) { return session_->live().surface(one); };
  if (found->measured && moved)
    analysis::update_profile(found->profile, *shown, surface_of, found->from_mm, found->to_mm);
  if (!found->measured) found->profile = analysis::lumen_profile(*shown, surface_of, id);
  found->measured = true;
  found->other_tree = false;
  found->to_mm = found->from_mm - 1.0;
  interpret(*shown, id, *found);
  return found.get();
}

void Workbench::interpret(const lumen::LumenModel& model, std::int32_t id, Measured& measured) const {
  const auto surface_of = [this](std::int32_t one) { return session_->live().surface(one); };
  const std::vector<analysis::Ostium> ostia = analysis::ostia_of(model, surface_of, id);
  measured.ostium = ostia.empty() ? analysis::Ostium() : ostia.back();
  measured.reference = analysis::reference_line(measured.profile, analysis::branch_abscissas(model, id),
                                                analysis::reading_from_ostium(ostia));
  measured.from_ostium = analysis::read_through(measured.profile, measured.reference);
  std::vector<analysis::Stenosis> stenoses = analysis::find_stenoses(measured.profile, measured.reference);
  const bool other = !look_alike(stenoses, measured.stenoses);
  measured.stenoses = std::move(stenoses);
  if (other) stenoses_changed.tell();
}

std::optional<ProfileWork> Workbench::profile_work(std::int32_t id) const {
  const lumen::LumenModel* shown = model();
  if (!shown || !has_vessel(*shown, id)) return std::nullopt;
  const auto found = measured_.find(id);
  if (found != measured_.end() && found->second->measured) return std::nullopt;
  ProfileWork work;
  work.model = session_->file().model();
  work.vessel = id;
  work.walls = session_->solved_walls();
  return work;
}

analysis::LumenProfile ProfileWork::measured(const core::TaskContext& task) const {
  const auto wall_of = [this](std::int32_t one) { return walls.at(one); };
  return analysis::lumen_profile(*model, wall_of, vessel, {}, task);
}

bool Workbench::take_profile(const ProfileWork& work, analysis::LumenProfile profile) {
  if (!session_ || session_->file().model() != work.model) return false;
  std::unique_ptr<Measured>& found = measured_[work.vessel];
  if (found && found->measured) return true;
  found = std::make_unique<Measured>();
  found->profile = std::move(profile);
  found->measured = true;
  interpret(*work.model, work.vessel, *found);
  if (found->stenoses.empty()) stenoses_changed.tell();  // there are none: that is known now, too
  return true;
}

const analysis::LumenProfile* Workbench::profile(std::int32_t id) const {
  const Measured* of = measured_of(id);
  return of ? &of->profile : nullptr;
}
const analysis::ReferenceLine* Workbench::reference(std::int32_t id) const {
  const Measured* of = measured_of(id);
  return of ? &of->reference : nullptr;
}
const std::vector<analysis::Stenosis>& Workbench::stenoses(std::int32_t id) const {
  static const std::vector<analysis::Stenosis> none;
  const Measured* of = measured_of(id);
  return of ? of->stenoses : none;
}

const analysis::LumenProfile* Workbench::profile_from_ostium(std::int32_t id) const {
  const Measured* of = measured_of(id);
  return of ? &of->from_ostium : nullptr;
}
std::vector<analysis::WayStretch> Workbench::way(std::int32_t id) const {
  const lumen::LumenModel* shown = model();
  if (!shown || !has_vessel(*shown, id)) return {};
  return analysis::ostial_way(*shown, id);
}
std::optional<analysis::Ostium> Workbench::ostium(std::int32_t id) const {
  const Measured* of = measured_of(id);
  if (!of || of->ostium.parent < 0) return std::nullopt;
  return of->ostium;
}
std::optional<analysis::MedinaClass> Workbench::medina(std::int32_t id) const {
  const std::optional<analysis::Ostium> at = ostium(id);
  const Measured* main = at ? measured_of(at->parent) : nullptr;
  if (!main) return std::nullopt;
  const Measured* side = measured_of(id);
  const analysis::MeasuredVessel branch{side->profile, side->reference};
  if (analysis::side_calibre_mm(branch, *at) < analysis::MedinaOptions{}.least_side_mm) return std::nullopt;
  return analysis::medina_class({main->profile, main->reference}, branch, *at);
}

const std::vector<analysis::Stenosis>& Workbench::known_stenoses(std::int32_t id) const {
  static const std::vector<analysis::Stenosis> none;
  const auto found = measured_.find(id);
  return found != measured_.end() ? found->second->stenoses : none;
}
std::optional<analysis::SectionMeasures> Workbench::section(std::int32_t id, double s_mm) const {
  const lumen::LumenModel* shown = model();
  if (phase_ || !shown || !has_vessel(*shown, id)) return std::nullopt;
  const auto surface_of = [this](std::int32_t one) { return session_->live().surface(one); };
  return analysis::measured_section(*shown, surface_of, id, s_mm).measures;
}

std::vector<analysis::MeasuredValue> Workbench::measured(const analysis::Measurement& measurement) const {
  analysis::MeasureContext context;
  context.model = model();
  if (session_) context.surface_of = [this](std::int32_t one) { return session_->live().surface(one); };
  context.profile_of = [this](std::int32_t one) -> const analysis::LumenProfile& {
    const analysis::LumenProfile* found = profile(one);
    if (!found) throw InvalidInput("the measurement's vessel is no longer in the tree");
    return *found;
  };
  context.image = image_.volume.get();
  return analysis::measured(measurement, context);
}

Session::Done Workbench::edit(const lumen::Edit& change) {
  require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  Session::Done done = session().apply(change);
  follow(done, *before);
  return done;
}
Session::Done Workbench::edit_merged(const lumen::Edit& change) {
  require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  Session::Done done = session().apply_merged(change);
  follow(done, *before);
  return done;
}
Session::Done Workbench::edit_by_plugin(const PluginEdits& step) {
  require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  Session::Done done = session().apply_plugin(step);
  follow(done, *before);
  return done;
}
Session::Done Workbench::annotate(const AnnotationCommand& command) {
  // A calcium score is read off another image of the study, while it is shown.
  if (!std::holds_alternative<MarkVessel>(command) && !std::holds_alternative<SetReportModifiers>(command))
    require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  Session::Done done = session().annotate(command);
  follow(done, *before);
  return done;
}
Session::Done Workbench::annotate_merged(const AnnotationCommand& command, std::int64_t drag) {
  if (!std::holds_alternative<MarkVessel>(command)) require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  Session::Done done = session().annotate_merged(command, drag);
  follow(done, *before);
  return done;
}
bool Workbench::undo() {
  require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  const std::optional<Session::Done> done = session().undo();
  if (done) follow(*done, *before);
  return done.has_value();
}
bool Workbench::redo() {
  require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  const std::optional<Session::Done> done = session().redo();
  if (done) follow(*done, *before);
  return done.has_value();
}
void Workbench::go_to_step(std::int64_t number) {
  require_own_phase();
  const std::shared_ptr<const lumen::LumenModel> before = session().file().model();
  if (const std::optional<Session::Done> done = session().go_to_step(number)) follow(*done, *before);
}

void Workbench::follow(const Session::Done& done, const lumen::LumenModel& before) {
  if (done.edited) {
    const lumen::LumenModel& now = session_->live().model();
    ModelEvent event;
    event.change = done.change;
    event.dismissed = dismissed_places(before, done.outcome.changes);
    event.tree_changed = any_axis_changed(done.outcome.changes) || !same_names(before.tree, now.tree);
    if (event.tree_changed) {  // what was measured of vessels that run as before stays
      for (const lumen::VesselChange& change : done.outcome.changes)
        if (change.axis_changed) measured_.erase(change.vessel);
      for (const auto& one : measured_) one.second->other_tree = true;
    }
    // A wall is also its neighbours' on the stretch that they share; a profile asks the owner.
    for (const auto& of : done.change.vessels)
      for (const auto& [id, known] : measured_) {
        const double length = known->profile.length_mm;
        const double from = of.solved_anew ? 0.0 : of.from_mm;
        double to = of.solved_anew ? length : std::min(of.to_mm, length);
        if (of.vessel != id) to = std::min(to, lumen::own_from_mm(now.tree, id));
        if (from <= to) known->moved(from, to);
      }
    if (event.tree_changed) {
      if (!has_vessel(now, vessel.get()))
        vessel.set(now.vessels.front()->vessel);
      else
        cursor_to_vessel();
    }
    model_changed.tell(event);
  }
  if (!done.annotations.empty()) annotations_changed.tell();
  steps_changed.tell();
  for (const std::string& note : done.outcome.notes) noted.tell(note);
}

void Workbench::cursor_to_vessel() {
  const std::shared_ptr<const geometry::AxisCurve> curve = axis();
  const double length = curve ? curve->length() : 0.0;
  cursor_mm.set_domain(Range<double>{0.0, length, 0.0});
  cursor_to_place();
}

void Workbench::cursor_to_place() {
  if (place_stays_) return;
  if (const std::shared_ptr<const geometry::AxisCurve> curve = axis())
    place.set(curve->point(cursor_mm.get()));
}

}  // namespace ostia::session
