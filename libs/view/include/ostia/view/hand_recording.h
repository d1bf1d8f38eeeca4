#pragma once
/// \file What a hand did in the 2D views, written down and done again (docs/reference/qa-mode.md,
/// docs/schemas/hand-recording.schema.json).

#include "ostia/view/pointer.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::view {

/// What decides what a hand's movement means, beside the case: where the person looks, with which tool.
struct HandState {
  std::int32_t vessel = session::Workbench::no_vessel;
  double cursor_mm = 0.0;
  Vec3 place = Vec3::Zero();
  double theta_deg = 0.0;
  reformat::CurvedMode mode = reformat::CurvedMode::straightened;
  reformat::Slab slab = reformat::Slab::none;
  double slab_mm = 5.0;
  session::GreyWindow grey;
  session::Tool tool = session::Tool::browse;
  double brush_mm = 1.0, reach_mm = 3.0, beta_deg = 60.0, section_eps_mm = 1.5;
  bool marks_shown = true;
  bool operator==(const HandState&) const = default;
};
HandState hand_state(const session::Workbench& bench);
void set_hand_state(session::Workbench& bench, const HandState& state);

/// Size and framing of one view.
struct HandFrame {
  int width = 0, height = 0;
  double density = 1.0;
  std::vector<double> framing;  ///< PictureView::framing
  bool operator==(const HandFrame&) const = default;
};

/// One line: a hand's act in a view, or a command that came from elsewhere (a menu, a list, a key). State and
/// frame are those before it, and there only where they are not the last line's (the frame: of that view).
struct HandLine {
  double t_ms = 0.0;  ///< from the beginning
  std::string view;   ///< empty for a command
  HandAct act;
  std::optional<Vec3> world;  ///< of the act's pixel
  std::string command;        ///< "undo", "redo", or a line of edit.schema.json or annotation.schema.json
  std::optional<HandState> state;
  std::optional<HandFrame> frame;
};

struct HandRecording {
  std::string start_digest;  ///< lumen::digest of the model at the beginning
  std::string end_digest;    ///< and at the end; empty where the recording was broken off
  double duration_ms = 0.0;
  std::vector<HandLine> lines;
};

/// One line of the file without its end. Numbers are read back to the last bit.
std::string to_json(const HandLine& line);
/// Throws InvalidInput naming the field.
HandLine hand_line_of_json(std::string_view text);
/// Throws InvalidInput naming the file and the line; a last line cut short is left out. IoError.
HandRecording read_hand_recording(const std::filesystem::path& path);

/// Writes down what is done as long as it lives, or until another case is opened. It holds no name, path or
/// picture: places, times and settings alone.
class HandRecorder {
 public:
  /// Throws InvalidInput without a case, IoError where the file cannot be written. Another file of that name
  /// is replaced.
  HandRecorder(session::Workbench& bench, const std::filesystem::path& path);
  ~HandRecorder();  ///< as `stop`, but says nothing of what fails
  HandRecorder(const HandRecorder&) = delete;
  HandRecorder& operator=(const HandRecorder&) = delete;
  /// Of this view, too. View and pointer must outlive the recorder. Throws InvalidInput for an empty name or
  /// one that is taken.
  void watch(const std::string& name, PictureView& view, Pointer& pointer);
  /// Throws ResourceError or IoError where the file could not be written to its end.
  void stop();
  bool active() const;
  std::size_t lines() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Does it again: the views take the recorded sizes and framings, so that the same places are meant to the
/// last bit, whatever the window's size is now. Owners give the views their sizes back afterwards.
class HandReplay {
 public:
  HandReplay(session::Workbench& bench, HandRecording recording);
  ~HandReplay();
  HandReplay(const HandReplay&) = delete;
  HandReplay& operator=(const HandReplay&) = delete;
  void drive(const std::string& name, PictureView& view, Pointer& pointer);
  /// Throws InvalidInput: no case, another model than the recording began with, a view that is not there.
  void begin();
  /// Does the next line; false when all are done. What the program refused when it was recorded it refuses
  /// again: that is no error, but counted.
  bool step();
  std::optional<double> next_ms() const;  ///< time of the next line
  std::size_t done() const;
  std::size_t size() const;
  std::size_t refused() const;
  /// The model is what it was when the recording ended; nothing where that is not known, or not all is done.
  std::optional<bool> same() const;
  void cancel();  ///< drops a gesture that is going on; what was done stays

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::view
