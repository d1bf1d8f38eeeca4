#include "views/heart_memory.h"

#include "shell/desk.h"
#include "views/heart_volume.h"

#include "ostia/core/error.h"
#include "ostia/view/volume_box.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int quiet_ms_of_heart = 1000;
constexpr const char *cuts_key = "heart.cuts", *box_key = "heart.box";
constexpr std::size_t most_bytes = std::size_t{4} << 20U;  // of all cuts: more than a hand draws

using view::VolumePreset;
constexpr std::array<std::pair<VolumePreset, const char*>, 4> look_names{
    {{VolumePreset::coronary, "coronary"},
     {VolumePreset::vessels, "vessels"},
     {VolumePreset::soft_tissue, "soft tissue"},
     {VolumePreset::bone, "bone"}}};

QJsonArray numbers_of(std::initializer_list<double> values) {
  QJsonArray all;
  for (const double one : values) all.append(one);
  return all;
}

QJsonArray numbers_of(const geometry::Vec3& v) {
  return numbers_of({v.x(), v.y(), v.z()});
}

double tenths(double mm) {
  return std::round(10.0 * mm) / 10.0;
}

std::optional<std::vector<double>> numbers_in(const QJsonValue& value, std::size_t count) {
  const QJsonArray array = value.toArray();
  std::vector<double> numbers;
  for (const QJsonValue& one : array) {
    if (!one.isDouble() || !std::isfinite(one.toDouble())) return std::nullopt;
    numbers.push_back(one.toDouble());
  }
  if (!value.isArray() || (count != 0 && numbers.size() != count)) return std::nullopt;
  return numbers;
}

std::optional<view::VolumeCut> cut_of(const QJsonObject& object) {
  const auto right = numbers_in(object["right"], 3), up = numbers_in(object["up"], 3),
             outline = numbers_in(object["outline_mm"], 0);
  if (!right || !up || !outline || outline->size() % 2 != 0) return std::nullopt;
  view::VolumeCut cut;
  cut.right = {(*right)[0], (*right)[1], (*right)[2]};
  cut.up = {(*up)[0], (*up)[1], (*up)[2]};
  for (std::size_t n = 0; n < outline->size(); n += 2)
    cut.outline_mm.emplace_back((*outline)[n], (*outline)[n + 1]);
  cut.keep_inside = object["keep_inside"].toBool();
  try {
    validate(cut);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  return cut;
}

}  // namespace

std::map<std::string, std::string> look_settings(const HeartVolume& heart) {
  const auto name = std::find_if(look_names.begin(), look_names.end(),
                                 [&](const auto& one) { return one.first == heart.preset.get(); });
  return {{"heart.look", name == look_names.end() ? "" : name->second},
          {"heart.shift_hu", QString::number(heart.shift_hu.get(), 'g', 6).toStdString()},
          {"heart.stretch", QString::number(heart.stretch.get(), 'g', 6).toStdString()},
          {"heart.alone", heart.alone.get() ? "on" : "off"},
          {"heart.tree", heart.tree_over_it.get() ? "on" : "off"}};
}

void restore_look(HeartVolume& heart, const std::map<std::string, std::string>& values) {
  const auto value = [&](const char* key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string() : found->second;
  };
  const auto number = [&](const char* key, session::Property<double>& into) {
    bool good = false;
    const double read = QString::fromStdString(value(key)).toDouble(&good);
    if (good && std::isfinite(read)) into.set(read);
  };
  const auto choice = [&](const char* key, session::Property<bool>& into) {
    if (const std::string text = value(key); text == "on" || text == "off") into.set(text == "on");
  };
  for (const auto& [preset, name] : look_names)
    if (value("heart.look") == name) heart.preset.set(preset);
  number("heart.shift_hu", heart.shift_hu);
  number("heart.stretch", heart.stretch);
  choice("heart.alone", heart.alone);
  choice("heart.tree", heart.tree_over_it);
}

std::string text_of_cuts(const std::vector<view::VolumeCut>& cuts) {
  QJsonArray all;
  for (const view::VolumeCut& cut : cuts) {
    QJsonArray outline;
    for (const view::Vec2& corner : cut.outline_mm) {
      outline.append(tenths(corner.x()));
      outline.append(tenths(corner.y()));
    }
    all.append(QJsonObject{{"right", numbers_of(cut.right)},
                           {"up", numbers_of(cut.up)},
                           {"outline_mm", outline},
                           {"keep_inside", cut.keep_inside}});
  }
  return QJsonDocument(all).toJson(QJsonDocument::Compact).toStdString();
}

std::string text_of_box(const view::VolumeCrop& box) {
  QJsonArray all;
  const auto rounded = [](double share) { return std::round(1e4 * share) / 1e4; };
  for (std::size_t a = 0; a < 3; ++a) all.append(numbers_of({rounded(box.low[a]), rounded(box.high[a])}));
  return QJsonDocument(all).toJson(QJsonDocument::Compact).toStdString();
}

std::optional<std::vector<view::VolumeCut>> cuts_of_text(const std::string& text) {
  const QJsonDocument read = QJsonDocument::fromJson(QByteArray::fromStdString(text));
  if (!read.isArray() || text.size() > most_bytes) return std::nullopt;
  std::vector<view::VolumeCut> cuts;
  for (const QJsonValue& one : read.array()) {
    const auto cut = cut_of(one.toObject());
    if (!cut) return std::nullopt;
    cuts.push_back(*cut);
  }
  return cuts;
}

std::optional<view::VolumeCrop> box_of_text(const std::string& text) {
  const QJsonArray read = QJsonDocument::fromJson(QByteArray::fromStdString(text)).array();
  view::VolumeCrop box;
  if (read.size() != 3) return std::nullopt;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto range = numbers_in(read[static_cast<int>(a)], 2);
    if (!range) return std::nullopt;
    box.low[a] = (*range)[0];
    box.high[a] = (*range)[1];
  }
  try {
    validate(box);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  return box;
}

HeartMemory::HeartMemory(Desk& desk, HeartVolume& heart) : QObject(&heart), desk_(desk), heart_(heart) {
  resting_.setSingleShot(true);
  resting_.setInterval(quiet_ms_of_heart);
  connect(&resting_, &QTimer::timeout, this, &HeartMemory::keep);
  connect(&heart, &HeartVolume::cuts_changed, this, &HeartMemory::changed);
  own_.push_back(heart.crop.observe([this](const view::VolumeCrop&) { changed(); }));
  own_.push_back(desk.bench.case_changed.observe([this] { on_case(); }));
  // After HeartVolume, which was made before: box and cuts of the former image are gone by then.
  own_.push_back(desk.bench.image_changed.observe([this] {
    if (desk_.bench.has_case() && desk_.bench.image().volume) restore();
  }));
}

std::map<std::string, std::string> HeartMemory::now() const {
  const view::VolumeCrop box =
      view::carried(heart_.crop.get(), heart_.crop_grid(), desk_.bench.image().volume->geometry);
  return {{cuts_key, text_of_cuts(heart_.all_cuts())}, {box_key, text_of_box(box)}};
}

void HeartMemory::changed() {
  if (!restoring_ && desk_.bench.has_case() && desk_.bench.image().volume) resting_.start();
}

void HeartMemory::keep() {
  resting_.stop();
  const session::Workbench& bench = desk_.bench;
  if (!bench.has_case() || !bench.image().volume || !desk_.bench.session().file().editable()) return;
  const auto values = now();
  const bool nothing = heart_.all_cuts().empty() && heart_.crop.get().whole();
  if (values == kept_ || (kept_.empty() && nothing)) return;
  try {
    desk_.bench.session().file().set_settings(values);
    kept_ = values;
  } catch (const Error&) {
    // Nobody asked for it; an edit or the case's closing will say what is wrong with the file.
  }
}

/// Of the case that was left nothing stays; what was made without one belongs to the next.
void HeartMemory::on_case() {
  resting_.stop();
  kept_.clear();
  const bool had = std::exchange(had_case_, desk_.bench.has_case());
  if (!desk_.bench.image().volume) return;
  const bool stored = had_case_ && desk_.bench.session().file().setting(box_key).has_value();
  if (stored)
    restore();
  else if (had)
    heart_.crop.set({}), heart_.reset_cuts();
  else
    changed();
}

void HeartMemory::restore() {
  const session::CaseFile& file = desk_.bench.session().file();
  const auto cuts =
      cuts_of_text(file.setting(cuts_key).value_or("")).value_or(std::vector<view::VolumeCut>{});
  const auto box = box_of_text(file.setting(box_key).value_or("")).value_or(view::VolumeCrop{});
  restoring_ = true;
  heart_.set_cuts(cuts);
  heart_.crop.set(view::carried(box, desk_.bench.image().volume->geometry, heart_.crop_grid()));
  restoring_ = false;
  kept_ = now();
}

}  // namespace ostia::workstation
