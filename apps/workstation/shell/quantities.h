#pragma once
/// \file Quantities in the window's texts: core/quantity_text.h, for Qt.

#include "ostia/core/quantity_text.h"

#include <QString>
#include <optional>

namespace ostia::workstation::quantity {

using Number = std::optional<double>;
inline QString calibre(Number mm) {
  return QString::fromStdString(core::calibre_text(mm));
}
inline QString length(Number mm) {
  return QString::fromStdString(core::length_text(mm));
}
inline QString area(Number mm2) {
  return QString::fromStdString(core::area_text(mm2));
}
inline QString volume(Number mm3) {
  return QString::fromStdString(core::volume_text(mm3));
}
inline QString percent(Number percent) {
  return QString::fromStdString(core::percent_text(percent));
}
inline QString stenosis(Number percent) {
  return QString::fromStdString(core::stenosis_text(percent));
}
inline QString hu(Number hu) {
  return QString::fromStdString(core::hu_text(hu));
}
inline QString ratio(Number value) {
  return QString::fromStdString(core::ratio_text(value));
}

}  // namespace ostia::workstation::quantity
