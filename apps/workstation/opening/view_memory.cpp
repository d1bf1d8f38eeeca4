#include "opening/view_memory.h"

#include "ostia/core/error.h"

#include <QString>
#include <cmath>
#include <optional>

namespace ostia::workstation {
namespace {

constexpr int quiet_ms = 1000;
constexpr const char* grey_key = "view.level_hu";

std::string stored_text(double value) {
  return QString::number(value, 'g', 8).toStdString();
}

std::map<std::string, std::string> settings_of(const session::Workbench& bench) {
  return {{"view.vessel", std::to_string(bench.vessel.get())},
          {"view.cursor_mm", stored_text(bench.own_mm(bench.cursor_mm.get()))},
          {"view.theta_deg", stored_text(bench.theta_deg.get())},
          {"view.curved_mode", std::to_string(static_cast<int>(bench.curved_mode.get()))},
          {"view.slab", std::to_string(static_cast<int>(bench.slab.get()))},
          {"view.slab_mm", stored_text(bench.slab_mm.get())},
          {grey_key, stored_text(bench.grey.get().level_hu)},
          {"view.window_hu", stored_text(bench.grey.get().width_hu)}};
}

}  // namespace

ViewMemory::ViewMemory(session::Workbench& bench, QObject* parent) : QObject(parent), bench_(bench) {
  resting_.setSingleShot(true);
  resting_.setInterval(quiet_ms);
  connect(&resting_, &QTimer::timeout, this, [this] {
    try {
      keep();
    } catch (const Error&) {
      // Nobody asked for it, and an edit or the case's closing will say what is wrong with the file.
    }
  });
  const auto changed = [this](const auto&...) { resting_.start(); };
  own_.push_back(bench.vessel.observe(changed));
  own_.push_back(bench.cursor_mm.observe(changed));
  own_.push_back(bench.theta_deg.observe(changed));
  own_.push_back(bench.curved_mode.observe(changed));
  own_.push_back(bench.slab.observe(changed));
  own_.push_back(bench.slab_mm.observe(changed));
  own_.push_back(bench.grey.observe(changed));
  own_.push_back(bench.case_changed.observe([this] {
    resting_.stop();
    kept_.clear();
  }));
}

void ViewMemory::keep() {
  resting_.stop();
  if (!bench_.has_case() || !bench_.session().file().editable()) return;
  const std::map<std::string, std::string> now = settings_of(bench_);
  if (now == kept_) return;
  bench_.session().file().set_settings(now);
  kept_ = now;
}

void ViewMemory::restore() {
  const session::CaseFile& file = bench_.session().file();
  const auto number = [&](const char* key) -> std::optional<double> {
    const std::optional<std::string> text = file.setting(key);
    if (!text) return std::nullopt;
    bool good = false;
    const double value = QString::fromStdString(*text).toDouble(&good);
    return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  if (const auto vessel = number("view.vessel"); vessel && bench_.axis(static_cast<std::int32_t>(*vessel)))
    bench_.vessel.set(static_cast<std::int32_t>(*vessel));
  if (const auto cursor = number("view.cursor_mm")) bench_.cursor_mm.set(*cursor);
  if (const auto theta = number("view.theta_deg")) bench_.theta_deg.set(*theta);
  using reformat::CurvedMode, reformat::Slab;
  if (const auto mode = number("view.curved_mode"))
    bench_.curved_mode.set(*mode == 1.0 ? CurvedMode::stretched : CurvedMode::straightened);
  if (const auto slab = number("view.slab"))
    bench_.slab.set(*slab == 1.0   ? Slab::mean
                    : *slab == 2.0 ? Slab::maximum
                    : *slab == 3.0 ? Slab::minimum
                                   : Slab::none);
  if (const auto thickness = number("view.slab_mm")) bench_.slab_mm.set(*thickness);
  const auto level = number(grey_key), window = number("view.window_hu");
  if (level && window && *window > 0.0) bench_.grey.set({*level, *window});
}

bool ViewMemory::knows_grey() const {
  return bench_.has_case() && bench_.session().file().setting(grey_key);
}

}  // namespace ostia::workstation
