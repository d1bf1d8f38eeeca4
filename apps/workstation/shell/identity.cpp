#include "shell/identity.h"

#include <optional>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr const char* on_views_setting = "identity.on_views";
constexpr const char* kept_setting = "identity.kept";

}  // namespace

QStringList identity_parts(const imaging::ShownIdentity& whose) {
  QStringList parts;
  if (whose.anonymous()) return parts;
  for (const std::string& part :
       {whose.patient_name, whose.patient_id, whose.study_date, whose.series_description})
    if (!part.empty()) parts << QString::fromStdString(part);
  return parts;
}

QString identity_line(const imaging::ShownIdentity& whose) {
  return identity_parts(whose).join(QStringLiteral("  \u00b7  "));
}

Identity::Identity(session::Workbench& bench, session::MachineState& machine,
                   const std::filesystem::path& folder)
    : bench_(bench), machine_(machine), store_(folder) {
  on_views.set(machine.setting(on_views_setting).value_or("on") != "off");
  kept.set(machine.setting(kept_setting).value_or("on") != "off");
  own_.push_back(bench.image_changed.observe([this] { look(); }));
  own_.push_back(bench.case_changed.observe([this] { look(); }));
  own_.push_back(on_views.observe([this](const bool& on) {
    machine_.set_setting(on_views_setting, on ? "on" : "off");
    changed.tell();
  }));
  own_.push_back(kept.observe([this](const bool& on) {
    machine_.set_setting(kept_setting, on ? "on" : "off");
    if (!on) forget_all();
  }));
}

void Identity::expect(const imaging::ShownIdentity& whose) {
  expected_ = whose;
  look();
}

void Identity::take(const std::string& image_sha256, const imaging::ShownIdentity& whose) {
  expected_ = {};
  seen_[image_sha256] = whose;
  look();
  if (kept.get()) store_.remember(image_sha256, whose);
}

imaging::ShownIdentity Identity::of_image(const std::string& image_sha256) const {
  if (image_sha256.empty()) return {};
  if (const auto found = seen_.find(image_sha256); found != seen_.end()) return found->second;
  return store_.find(image_sha256).value_or(imaging::ShownIdentity{});
}

void Identity::forget_all() {
  const std::string& open = bench_.image().reference.sha256;
  std::erase_if(seen_, [&](const auto& one) { return one.first != open; });
  store_.forget_all();
  changed.tell();
}

/// The image on the table says whose it is, not the case: one that waits for its image has none beside it.
void Identity::look() {
  imaging::ShownIdentity whose;
  const session::OpenImage& image = bench_.image();
  if (image.volume) {
    whose = image.reference.sha256.empty() ? expected_ : of_image(image.reference.sha256);
  } else if (bench_.has_case()) {
    const std::optional<session::ImageReference> of_case = bench_.session().file().image();
    if (of_case) whose = of_image(of_case->sha256);
  }
  if (whose == now_) return;
  now_ = std::move(whose);
  changed.tell();
}

}  // namespace ostia::workstation
