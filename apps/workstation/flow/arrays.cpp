#include "flow/arrays.h"

#include "ostia/core/error.h"
#include "ostia/io/surface_fields.h"
#include "ostia/view/value_scale.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::workstation {
namespace {

struct Ending {
  const char *ending, *unit;
};
/// Of two that fit the longer one stands first.
constexpr Ending endings[] = {
    {"_mmHg", "mmHg"},   {"_1_Pa", "1/Pa"},
    {"_per_Pa", "1/Pa"}, {"_Pa_s", "Pa s"},
    {"_mPa_s", "mPa s"}, {"_Pa", "Pa"},
    {"_kPa", "kPa"},     {"_mm_s", "mm/s"},
    {"_cm_s", "cm/s"},   {"_m2_s2", "m\u00b2/s\u00b2"},
    {"_m_s", "m/s"},     {"_1_s", "1/s"},
    {"_per_s", "1/s"},   {"_ml_s", "ml/s"},
    {"_percent", "%"},   {"_mm2", "mm\u00b2"},
    {"_mm", "mm"},       {"_deg", "\u00b0"},
    {"_m", "m"},         {"_s", "s"},
};

const Ending* ending_of(const std::string& name) {
  for (const Ending& one : endings)
    if (name.size() > std::char_traits<char>::length(one.ending) && name.ends_with(one.ending)) return &one;
  return nullptr;
}

// What Ostia writes.
[[maybe_unused]] const char* const known_names[] = {
    QT_TRANSLATE_NOOP("fields", "wall shear stress"),
    QT_TRANSLATE_NOOP("fields", "wall shear stress vector"),
    QT_TRANSLATE_NOOP("fields", "pressure"),
    QT_TRANSLATE_NOOP("fields", "velocity"),
    QT_TRANSLATE_NOOP("fields", "time averaged wall shear stress"),
    QT_TRANSLATE_NOOP("fields", "oscillatory shear index"),
    QT_TRANSLATE_NOOP("fields", "relative residence time"),
};

FlowArray array_of(const std::string& name, const io::FieldValues& field, view::FieldAt at) {
  FlowArray made{name, at, field.components > 1, {}};
  const auto components = static_cast<std::size_t>(field.components);
  for (std::size_t i = 0; i < field.values.size(); i += components) {
    double squared = 0.0;
    for (std::size_t c = 0; c < components; ++c) squared += field.values[i + c] * field.values[i + c];
    made.values.push_back(made.magnitude ? std::sqrt(squared) : field.values[i]);
  }
  return made;
}

std::vector<FlowArray> arrays_of(const io::SurfaceWithFields& read) {
  std::vector<FlowArray> arrays;
  for (const auto& [name, field] : read.points)
    arrays.push_back(array_of(name, field, view::FieldAt::points));
  for (const auto& [name, field] : read.triangles)
    arrays.push_back(array_of(name, field, view::FieldAt::triangles));
  return arrays;
}

/// Another surface's values behind those of the former ones; what one of them lacks is left out.
void add_arrays(std::vector<FlowArray> more, bool first, std::vector<FlowArray>& all) {
  if (first) {
    all = std::move(more);
    return;
  }
  std::erase_if(all, [&](FlowArray& one) {
    const auto same = std::find_if(more.begin(), more.end(), [&](const FlowArray& other) {
      return other.name == one.name && other.at == one.at && other.magnitude == one.magnitude;
    });
    if (same == more.end()) return true;
    one.values.insert(one.values.end(), same->values.begin(), same->values.end());
    return false;
  });
}

void add_mesh(const geometry::TriMesh& one, geometry::TriMesh& all) {
  const auto first = static_cast<std::int32_t>(all.points.size());
  all.points.insert(all.points.end(), one.points.begin(), one.points.end());
  for (geometry::Triangle triangle : one.triangles) {
    for (std::int32_t& corner : triangle) corner += first;
    all.triangles.push_back(triangle);
  }
}

}  // namespace

FlowSurface read_flow_surface(const std::vector<std::filesystem::path>& files) {
  FlowSurface made;
  geometry::TriMesh mesh;
  for (std::size_t i = 0; i < files.size(); ++i) {
    io::SurfaceWithFields read = io::read_surface_with_fields(files[i]);
    add_arrays(arrays_of(read), i == 0, made.arrays);
    add_mesh(read.mesh, mesh);
  }
  if (made.arrays.empty())
    throw InvalidInput(
        QCoreApplication::translate(
            "jobs",
            "%1 is a surface without values. Open the wall.vtp of a result, which \"ostia result\" writes "
            "and which a run from the window leaves")
            .arg(files.empty() ? QString() : QString::fromStdString(files.front().string()))
            .toStdString());
  made.surface = std::make_shared<const view::FieldSurface>(std::move(mesh));
  return made;
}

FlowSurface flow_surface_of(io::SurfaceWithFields read) {
  FlowSurface made{nullptr, arrays_of(read)};
  if (made.arrays.empty()) throw InvalidInput("the surface has no values");
  made.surface = std::make_shared<const view::FieldSurface>(std::move(read.mesh));
  return made;
}

QString unit_of_array(const std::string& name) {
  const Ending* ending = ending_of(name);
  return ending ? QString::fromUtf8(ending->unit) : QString();
}

QString title_of_array(const FlowArray& array) {
  std::string words = array.name;
  if (const Ending* ending = ending_of(words))
    words.resize(words.size() - std::char_traits<char>::length(ending->ending));
  for (char& c : words)
    if (c == '_') c = ' ';
  const QString title = QCoreApplication::translate("fields", words.c_str());
  return array.magnitude ? QCoreApplication::translate("fields", "%1 (magnitude)").arg(title) : title;
}

QString title_with_unit(const FlowArray& array) {
  const QString unit = unit_of_array(array.name);
  return title_of_array(array) + (unit.isEmpty() ? QString() : ", " + unit);
}

QString value_text(double value, const FlowArray& array) {
  if (!std::isfinite(value)) return QCoreApplication::translate("fields", "not known");
  const QString unit = unit_of_array(array.name);
  return QString::fromStdString(view::three_digits(value)) + (unit.isEmpty() ? QString() : " " + unit);
}

std::size_t first_shown(const std::vector<FlowArray>& arrays) {
  for (const char* wanted : {"time_averaged_wall_shear_stress_Pa", "wall_shear_stress_Pa"})
    for (std::size_t i = 0; i < arrays.size(); ++i)
      if (arrays[i].name == wanted) return i;
  return 0;
}

}  // namespace ostia::workstation
