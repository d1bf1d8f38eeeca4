#include "shell/named_presets.h"

#include <QJsonDocument>
#include <QJsonObject>

namespace ostia::workstation {
namespace {

QJsonObject stored_object(const session::MachineState& machine, const std::string& key) {
  const auto text = machine.setting(key);
  return text ? QJsonDocument::fromJson(QByteArray::fromStdString(*text)).object() : QJsonObject();
}

void store_object(session::MachineState& machine, const std::string& key, const QJsonObject& all) {
  machine.set_setting(key, QJsonDocument(all).toJson(QJsonDocument::Compact).toStdString());
}

}  // namespace

QStringList NamedPresets::names() const {
  QStringList names = stored_object(machine_, key_).keys();
  names.sort(Qt::CaseInsensitive);
  return names;
}

NamedPresets::Values NamedPresets::values(const QString& name) const {
  Values values;
  const QJsonObject one = stored_object(machine_, key_).value(name).toObject();
  for (auto it = one.begin(); it != one.end(); ++it)
    values[it.key().toStdString()] = it.value().toString().toStdString();
  return values;
}

void NamedPresets::set(const QString& name, const Values& values) {
  QJsonObject all = stored_object(machine_, key_), one;
  for (const auto& [key, value] : values) one[QString::fromStdString(key)] = QString::fromStdString(value);
  all[name] = one;
  store_object(machine_, key_, all);
}

void NamedPresets::remove(const QString& name) {
  QJsonObject all = stored_object(machine_, key_);
  all.remove(name);
  store_object(machine_, key_, all);
}

}  // namespace ostia::workstation
