// Doing again what a hand did.

#include "ostia/core/error.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/session/annotation_json.h"
#include "ostia/session/edit_json.h"
#include "ostia/view/hand_recording.h"

namespace ostia::view {

using session::Tool;
using session::Workbench;

struct HandReplay::Impl {
  Impl(Workbench& of, HandRecording given) : bench(of), recording(std::move(given)) {}
  struct Driven {
    PictureView* view = nullptr;
    Pointer* pointer = nullptr;
  };
  Workbench& bench;
  HandRecording recording;
  std::map<std::string, Driven> views;
  std::optional<HandState> state;
  std::map<std::string, HandFrame> frames;
  std::size_t done = 0, refused = 0;

  void place(const HandLine& line, const Driven& driven) {
    if (line.state) state = line.state;
    if (line.frame) frames[line.view] = *line.frame;
    if (state) set_hand_state(bench, *state);
    const auto frame = frames.find(line.view);
    if (frame == frames.end()) return;
    driven.view->set_size(frame->second.width, frame->second.height, frame->second.density);
    driven.view->set_framing(frame->second.framing);
  }
  void act(const HandLine& line) {
    const Driven& driven = views.at(line.view);
    place(line, driven);
    Pointer& hand = *driven.pointer;
    PointerEvent event = line.act.event;
    event.again = true;
    switch (line.act.kind) {
      case HandAct::Kind::press:
        // The vessel that was sought from there comes as a command of its own.
        if ((bench.tool.get() == Tool::add_vessel || bench.tool.get() == Tool::add_artery) &&
            event.button == Button::left && !event.shift)
          return;
        return hand.press(event);
      case HandAct::Kind::move:
        return hand.move(event);
      case HandAct::Kind::release:
        return hand.release(event);
      case HandAct::Kind::double_click:
        return hand.double_click(event);
      case HandAct::Kind::wheel:
        return hand.wheel(line.act.steps, event);
      case HandAct::Kind::leave:
        return hand.leave();
      case HandAct::Kind::cancel:
        return hand.cancel();
      case HandAct::Kind::erase:
        hand.erase(event);
        return;
    }
  }
  void command(const std::string& line) {
    if (line == "undo") {
      bench.undo();
    } else if (line == "redo") {
      bench.redo();
    } else if (const std::optional<session::AnnotationCommand> annotation = annotation_in(line)) {
      bench.annotate(*annotation);
    } else {
      bench.edit(session::edit_of_json(line));
    }
  }
  static std::optional<session::AnnotationCommand> annotation_in(const std::string& line) {
    try {
      return session::annotation_of_json(line);
    } catch (const InvalidInput&) {
      return std::nullopt;  // an edit
    }
  }
};

HandReplay::HandReplay(Workbench& bench, HandRecording recording)
    : impl_(std::make_unique<Impl>(bench, std::move(recording))) {}
HandReplay::~HandReplay() = default;

void HandReplay::drive(const std::string& name, PictureView& view, Pointer& pointer) {
  impl_->views[name] = {&view, &pointer};
}

void HandReplay::begin() {
  Impl& m = *impl_;
  if (!m.bench.has_case())
    throw InvalidInput("no case is open: a recording is replayed on the case that it began with");
  if (lumen::digest(*m.bench.model()) != m.recording.start_digest)
    throw InvalidInput(
        "this case is not what it was when the recording began: open the case that was recorded, or go back "
        "to "
        "the step at which it was");
  for (const HandLine& line : m.recording.lines)
    if (!line.view.empty() && !m.views.contains(line.view))
      throw InvalidInput("the recording needs a view \"" + line.view + "\", which this window does not have");
  m.done = m.refused = 0;
}

bool HandReplay::step() {
  Impl& m = *impl_;
  if (m.done == m.recording.lines.size()) return false;
  const HandLine& line = m.recording.lines[m.done++];
  try {
    if (line.command.empty())
      m.act(line);
    else
      m.command(line.command);
  } catch (const InvalidInput&) {
    ++m.refused;
  } catch (const NumericalError&) {
    ++m.refused;
  }
  return m.done < m.recording.lines.size();
}

std::optional<double> HandReplay::next_ms() const {
  if (impl_->done == impl_->recording.lines.size()) return std::nullopt;
  return impl_->recording.lines[impl_->done].t_ms;
}
std::size_t HandReplay::done() const {
  return impl_->done;
}
std::size_t HandReplay::size() const {
  return impl_->recording.lines.size();
}
std::size_t HandReplay::refused() const {
  return impl_->refused;
}

std::optional<bool> HandReplay::same() const {
  if (impl_->done < size() || impl_->recording.end_digest.empty() || !impl_->bench.has_case())
    return std::nullopt;
  return lumen::digest(*impl_->bench.model()) == impl_->recording.end_digest;
}

void HandReplay::cancel() {
  for (const auto& [name, driven] : impl_->views) driven.pointer->drop();
}

}  // namespace ostia::view
