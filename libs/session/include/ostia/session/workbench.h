#pragma once
/// \file What a person has on the table: an image, a case, and where they are looking. No toolkit: views ask
/// it and watch it, a window binds its widgets to its properties.

#include "ostia/analysis/medina.h"
#include "ostia/analysis/stenosis.h"
#include "ostia/imaging/volume.h"
#include "ostia/reformat/curved_reformation.h"
#include "ostia/session/property.h"
#include "ostia/session/session.h"
#include "ostia/session/tool.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

using geometry::Vec3;
class ShownPhase;   // beating.h
struct PhaseImage;  // beating.h

/// CT numbers shown between black and white.
struct GreyWindow {
  double level_hu = 250.0;
  double width_hu = 900.0;  ///< > 0
  bool operator==(const GreyWindow&) const = default;
};
struct WindowPreset {
  std::string name;  ///< "CTA"
  GreyWindow window;
};
const std::vector<WindowPreset>& window_presets();  ///< CTA, soft tissue, lung, bone

/// The image that is shown, and how a case knows it.
struct OpenImage {
  std::shared_ptr<const imaging::ImageVolume> volume;
  ImageReference reference;
};

/// Another image of the same study: a phase of the heart or a reconstruction.
struct OtherImage {
  std::shared_ptr<const imaging::ImageVolume> volume;
  std::string name{};     ///< "45 %", "series 3": nothing of the patient
  std::string caption{};  ///< what views say of it: "image 45 %, axes of 75 %"
  bool warns = false;     ///< axes and walls are not those of the image
};

/// What a change of the model means for views.
struct ModelEvent {
  lumen::LiveChange change;
  bool tree_changed = false;    ///< vessels came, went, or run elsewhere: axes and lists are to be read anew
  std::vector<Vec3> dismissed;  ///< places of samples that an edit took away
};

/// A vessel to be measured on a model that no longer changes.
struct ProfileWork {
  std::shared_ptr<const lumen::LumenModel> model;
  SolvedWalls walls;
  std::int32_t vessel = 0;
  analysis::LumenProfile measured(const core::TaskContext& task = core::no_task()) const;  ///< any thread
};

/// Not safe from several threads. What throws (InvalidInput, NumericalError, ResourceError, IoError) leaves
/// everything as it was.
class Workbench {
 public:
  Workbench();
  ~Workbench();

  // -- image and case
  void set_image(OpenImage image);  ///< the place goes to its middle if it was outside of it
  void close_image();
  const OpenImage& image() const { return image_; }
  /// Throws InvalidInput where an image is open that is not the case's, or turned otherwise.
  void set_session(Session session);
  void close_case();
  bool has_case() const { return session_ != nullptr; }
  Session& session();              ///< throws InvalidInput without a case
  const Session& session() const;  ///< throws InvalidInput without a case

  // -- the selected vessel; null, empty, or nothing without one
  const lumen::LumenModel* model() const;
  std::shared_ptr<const geometry::AxisCurve> axis() const;
  std::shared_ptr<const geometry::AxisCurve> axis(std::int32_t vessel) const;
  std::string vessel_name(std::int32_t vessel) const;

  // -- what is measured along a vessel: made when asked for; after an edit only what it moved is measured
  // again
  const analysis::LumenProfile* profile(std::int32_t vessel) const;
  const analysis::ReferenceLine* reference(std::int32_t vessel) const;
  const std::vector<analysis::Stenosis>& stenoses(std::int32_t vessel) const;
  /// The profile as it is read from the aorta, without a jump where the vessel leaves its parent.
  const analysis::LumenProfile* profile_from_ostium(std::int32_t vessel) const;
  /// From the aorta through its parents to its end; empty without the vessel.
  std::vector<analysis::WayStretch> way(std::int32_t vessel) const;
  /// Where it leaves its parent; nothing for a vessel that leaves none.
  std::optional<analysis::Ostium> ostium(std::int32_t vessel) const;
  /// Of the bifurcation where a vessel leaves its parent; nothing for one that leaves none or is too thin to
  /// count.
  std::optional<analysis::MedinaClass> medina(std::int32_t side) const;
  /// As they were when they were last asked for: for views that must not wait. `stenoses_changed` says when
  /// to look again.
  const std::vector<analysis::Stenosis>& known_stenoses(std::int32_t vessel) const;
  /// The measuring that `profile` would have to do first, as work for another thread; nothing where it is
  /// done.
  std::optional<ProfileWork> profile_work(std::int32_t vessel) const;
  /// Takes what the work has measured; false, and nothing taken, where the model is another by now.
  bool take_profile(const ProfileWork& work, analysis::LumenProfile profile);
  /// The lumen on one section, as it is now.
  std::optional<analysis::SectionMeasures> section(std::int32_t vessel, double s_mm) const;
  std::vector<analysis::MeasuredValue> measured(const analysis::Measurement& measurement) const;

  // -- another phase of the heart than the one that the case is of: axes and places are then that phase's,
  // and commands that change the case are refused (but for vessels' marks)
  /// Null: the case's own phase. The cursor stays at the same place of the vessel. Throws InvalidInput
  /// without a case, and for a phase of another model.
  void show_phase(std::shared_ptr<const ShownPhase> phase, std::shared_ptr<const PhaseImage> image = {});
  /// Null where the case's own phase is shown.
  const ShownPhase* other_phase() const { return phase_.get(); }
  /// Another image of the study in all views, along the same axes, in the place of the case's own or the one
  /// on the table; null: that one again. Gone with it and with the case. While it is shown, commands that
  /// change the case are refused as at another phase, since they are those of its own image. Throws
  /// InvalidInput without a volume or with nothing on the table, and where the two images do not overlap.
  void show_other_image(std::shared_ptr<const OtherImage> image);
  const OtherImage* other_image() const { return other_image_.get(); }
  /// What views show: the phase's image where there is one, else another of the study, else the case's; null
  /// without any.
  const imaging::ImageVolume* shown_volume() const { return shown_image().get(); }
  std::shared_ptr<const imaging::ImageVolume> shown_image() const;  ///< the same, to be kept
  /// The phase that `shown_volume` is of: the case's own where there is no other.
  double image_phase() const;  ///< only with other_phase()
  /// Abscissas on the selected vessel as it is shown, for those at the case's own phase, and back.
  double here_mm(double own_mm) const;
  double own_mm(double here_mm) const;
  /// Throws InvalidInput while another phase or another image is shown, and tells it before.
  void require_own_phase() const;

  // -- commands: each is in the case file when it returns
  Session::Done edit(const lumen::Edit& edit);
  Session::Done edit_merged(const lumen::Edit& edit);
  Session::Done edit_by_plugin(const PluginEdits& step);  ///< one step
  Session::Done annotate(const AnnotationCommand& command);
  Session::Done annotate_merged(const AnnotationCommand& command, std::int64_t drag);
  bool undo();  ///< false where there is nothing to undo
  bool redo();
  void go_to_step(std::int64_t number);

  // -- where the person looks
  static constexpr std::int32_t no_vessel = -1;
  Property<std::int32_t> vessel{no_vessel};
  Property<double> cursor_mm{0.0};     ///< abscissa on the selected vessel; its domain is the vessel's length
  Property<Vec3> place{Vec3::Zero()};  ///< the cursor in the patient; on the axis after cursor_mm was set
  Property<double> theta_deg{0.0};     ///< of the first CPR; the second is at + 90
                                       /// A hand turns the CPRs: their lines may be coarse until it lets go.
  Property<bool> turning{false};
  Property<reformat::CurvedMode> curved_mode{reformat::CurvedMode::straightened};
  Property<reformat::Slab> slab{reformat::Slab::none};
  Property<double> slab_mm{5.0, Range<double>{0.5, 50.0, 0.5}};
  Property<GreyWindow> grey;
  Property<Tool> tool{Tool::browse};
  Property<double> brush_mm{1.0, Range<double>{0.2, 5.0, 0.1}};   ///< radius of the ball
  Property<double> reach_mm{3.0, Range<double>{0.5, 20.0, 0.5}};  ///< of a pull
  Property<double> beta_deg{60.0,
                            Range<double>{45.0, 90.0, 5.0}};  ///< half-angle within which a stroke dismisses
  Property<double> section_eps_mm{1.5, Range<double>{0.2, 20.0, 0.1}};
  Property<std::optional<Vec3>> first_end;  ///< of a vessel that is being placed by its two ends
  Property<bool> contours_shown{true};
  Property<bool> marks_shown{true};                ///< measurements
  Property<std::int32_t> selected_measurement{0};  ///< 0: none

  // -- who wants to know
  Signal<> image_changed;
  Signal<> case_changed;  ///< another case, or none
  Signal<const ModelEvent&> model_changed;
  Signal<> annotations_changed;
  mutable Signal<> stenoses_changed;  ///< of any vessel
  Signal<> steps_changed;             ///< the journal has another line
  Signal<> phase_changed;             ///< another phase of the heart is shown, or with another image
  Signal<> other_image_changed;
  mutable Signal<> phase_refused;    ///< a command was refused because of the phase or image that is shown
  Signal<const std::string&> noted;  ///< what the person should know of an edit

 private:
  struct Measured;
  void follow(const Session::Done& done, const lumen::LumenModel& before);
  void cursor_to_vessel();
  void cursor_to_place();
  void leave_phase();
  void leave_other_image();
  OpenImage image_;
  std::unique_ptr<Session> session_;
  std::shared_ptr<const ShownPhase> phase_;
  std::shared_ptr<const PhaseImage> phase_image_;
  std::shared_ptr<const OtherImage> other_image_;
  bool place_stays_ = false;
  mutable std::map<std::int32_t, std::unique_ptr<Measured>> measured_;
  std::vector<Subscription> own_;
  Measured* measured_of(std::int32_t vessel) const;
  /// Reference line and stenoses of a profile.
  void interpret(const lumen::LumenModel& model, std::int32_t vessel, Measured& measured) const;
};

}  // namespace ostia::session
