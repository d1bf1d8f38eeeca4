// Writing down what a hand does.

#include "ostia/core/error.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/view/hand_recording.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>

namespace ostia::view {

using session::Workbench;

HandState hand_state(const Workbench& bench) {
  HandState s;
  s.vessel = bench.vessel.get();
  s.cursor_mm = bench.cursor_mm.get();
  s.place = bench.place.get();
  s.theta_deg = bench.theta_deg.get();
  s.mode = bench.curved_mode.get();
  s.slab = bench.slab.get();
  s.slab_mm = bench.slab_mm.get();
  s.grey = bench.grey.get();
  s.tool = bench.tool.get();
  s.brush_mm = bench.brush_mm.get();
  s.reach_mm = bench.reach_mm.get();
  s.beta_deg = bench.beta_deg.get();
  s.section_eps_mm = bench.section_eps_mm.get();
  s.marks_shown = bench.marks_shown.get();
  return s;
}

void set_hand_state(Workbench& bench, const HandState& s) {
  bench.tool.set(s.tool);  // ends what is begun, as it did then
  bench.vessel.set(s.vessel);
  bench.cursor_mm.set(s.cursor_mm);
  bench.place.set(s.place);  // after the cursor, which takes it to the axis
  bench.theta_deg.set(s.theta_deg);
  bench.curved_mode.set(s.mode);
  bench.slab.set(s.slab);
  bench.slab_mm.set(s.slab_mm);
  bench.grey.set(s.grey);
  bench.brush_mm.set(s.brush_mm);
  bench.reach_mm.set(s.reach_mm);
  bench.beta_deg.set(s.beta_deg);
  bench.section_eps_mm.set(s.section_eps_mm);
  bench.marks_shown.set(s.marks_shown);
}

struct HandRecorder::Impl {
  explicit Impl(Workbench& of) : bench(of) {}
  Workbench& bench;
  std::ofstream file;
  std::string name;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::optional<HandState> state;
  std::map<std::string, std::optional<HandFrame>> frames;
  std::int64_t seen = 0;         // number of the journal's last line that is in the recording
  std::optional<HandLine> open;  // an act that is being done
  // A step from elsewhere that may still change: a drag in another view is one step until it ends.
  std::optional<HandLine> last_step;
  bool active = true, within = false, stepped = false;
  std::size_t lines = 0;
  const session::Session* recorded = nullptr;  // the case that is recorded, by its place in memory
  std::vector<session::Subscription> own;

  double now_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
  void write(const std::string& line) { (file << line << '\n').flush(); }
  void write(const HandLine& line) {
    write(to_json(line));
    ++lines;
  }
  void write_last_step() {
    if (const auto line = std::exchange(last_step, std::nullopt)) write(*line);
  }
  std::int64_t last_number() const {
    const auto journal = bench.session().file().journal();
    return journal.empty() ? 0 : journal.back().number;
  }

  void acting(const std::string& view_name, PictureView& view, const HandAct& act) {
    if (!active) return;
    write_last_step();
    within = true;
    HandLine line;
    line.t_ms = now_ms();
    line.view = view_name;
    line.act = act;
    const bool placed = act.kind != HandAct::Kind::leave && act.kind != HandAct::Kind::cancel;
    if (placed && view.ready()) line.world = view.world(act.event.px);
    if (line.world && !line.world->allFinite()) line.world.reset();
    const HandState now = hand_state(bench);
    if (!state || !(*state == now)) line.state = state = now;
    if (view.width() > 0 && view.height() > 0) {
      const HandFrame frame{view.width(), view.height(), view.density(), view.framing()};
      std::optional<HandFrame>& last = frames[view_name];
      if (!last || !(*last == frame)) line.frame = last = frame;
    }
    open = std::move(line);
  }
  void acted(const Pointer& pointer) {
    if (!active || !open) return;
    within = false;
    if (open->act.kind == HandAct::Kind::press) open->act.event.taken = pointer.taken();
    const bool cancelled = open->act.kind == HandAct::Kind::cancel;
    write(*std::exchange(open, std::nullopt));
    if (!std::exchange(stepped, false)) return;
    // A hand only adds steps: the last one done is the journal's last line. Only where it drops what it has
    // begun it takes back, and that is a line, too.
    if (cancelled)
      seen = last_number();
    else if (const auto last = bench.session().file().next_undo())
      seen = std::max(seen, last->number);
  }
  void steps_changed() {
    if (!active || !bench.has_case()) return;
    if (within) {
      stepped = true;
      return;
    }
    for (const session::JournalEntry& entry : bench.session().file().journal()) {
      const bool grown = last_step && entry.number == seen;
      if (entry.number <= seen && !grown) continue;
      const std::string command = entry.kind == session::StepKind::travel ? entry.op : entry.parameters;
      if (grown && command == last_step->command) continue;
      if (!grown) write_last_step();
      last_step.emplace();
      last_step->t_ms = now_ms();
      last_step->command = command;
      seen = entry.number;
    }
  }
  void end(bool with_digest) {
    if (!active) return;
    active = false;
    own.clear();
    write_last_step();
    if (with_digest && bench.has_case() && &bench.session() == recorded) {
      char time[40];
      std::snprintf(time, sizeof time, "%.3f", now_ms());
      write(std::string("{\"t_ms\":") + time + ",\"end_digest\":\"" + lumen::digest(*bench.model()) + "\"}");
    }
    file.close();
    if (!file)
      throw IoError("the recording " + name + " could not be written to its end: make room on the disk");
  }
};

HandRecorder::HandRecorder(Workbench& bench, const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(bench)) {
  Impl& m = *impl_;
  if (!bench.has_case()) throw InvalidInput("no case is open: a recording begins with a case");
  m.name = path.filename().string();
  m.file.open(path, std::ios::binary | std::ios::trunc);
  if (!m.file) throw IoError("the recording " + m.name + " cannot be written there: choose another folder");
  m.write(R"({"v":1,"kind":"ostia.hand","start_digest":")" + lumen::digest(*bench.model()) + "\"}");
  m.seen = m.last_number();
  m.recorded = &bench.session();
  m.own.push_back(bench.steps_changed.observe([this] { impl_->steps_changed(); }));
  m.own.push_back(bench.case_changed.observe([this] {
    try {
      impl_->end(false);
    } catch (const Error&) {
    }
  }));
}

HandRecorder::~HandRecorder() {
  try {
    impl_->end(true);
  } catch (const std::exception&) {
  }
}

void HandRecorder::watch(const std::string& name, PictureView& view, Pointer& pointer) {
  if (name.empty() || impl_->frames.contains(name))
    throw InvalidInput("a recorded view needs a name of its own, not \"" + name + "\"");
  impl_->frames[name];
  impl_->own.push_back(
      pointer.acting.observe([this, name, &view](const HandAct& act) { impl_->acting(name, view, act); }));
  impl_->own.push_back(pointer.acted.observe([this, &pointer] { impl_->acted(pointer); }));
}

void HandRecorder::stop() {
  impl_->end(true);
}
bool HandRecorder::active() const {
  return impl_->active;
}
std::size_t HandRecorder::lines() const {
  return impl_->lines + (impl_->last_step ? 1 : 0);
}

}  // namespace ostia::view
