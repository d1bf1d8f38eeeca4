#include "formats.h"

#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace ostia::io::markups {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using MarkupJson = nlohmann::json;

constexpr std::uint64_t most_json_bytes = 256ULL << 20;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// The member's text, or `otherwise` where there is none.
std::string text_in(const MarkupJson& object, const char* name, const std::string& otherwise = "") {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

/// One file's markups, one after another.
class JsonReader {
 public:
  explicit JsonReader(const fs::path& path) : path_(path) {}

  MarkupsFile read() {
    const MarkupJson all = MarkupJson::parse(core::read_file(path_, most_json_bytes), nullptr, false);
    if (all.is_discarded())
      refuse(path_,
             "it is no JSON: it may be cut short, or hold a number that JSON does not have, such as NaN");
    const auto list = all.is_object() ? all.find("markups") : all.end();
    if (list == all.end() || !list->is_array())
      refuse(path_, "it is no file of markups: it has no list \"markups\"");
    check_schema(all);
    for (std::size_t i = 0; i < list->size(); ++i) add((*list)[i], "markups[" + std::to_string(i) + "]");
    if (file_.markups.empty()) refuse(path_, "it has no point whose position is defined");
    return std::move(file_);
  }

 private:
  void check_schema(const MarkupJson& all) {
    const std::string schema = text_in(all, "@schema");
    if (schema.empty()) {
      file_.warnings.emplace_back("it does not name its schema; it is read as markups of schema 1");
    } else if (lower(schema).find("markups-schema-v1.") == std::string::npos) {
      refuse(path_, "its schema is " + schema.substr(0, 200) + "; markups of schema 1 are read");
    }
  }

  void add(const MarkupJson& one, const std::string& where) {
    if (!one.is_object()) refuse(path_, where + " is no object");
    const std::string type = text_in(one, "type");
    Markup markup;
    markup.name = text_in(one, "name");
    if (type == "Curve") {
      markup.kind = MarkupKind::curve;
    } else if (type == "ClosedCurve") {
      markup.kind = MarkupKind::closed_curve;
    } else if (type == "Line") {
      markup.kind = MarkupKind::line;
    } else if (type != "Fiducial" && type != "Angle") {
      file_.warnings.push_back(where + " is of the type \"" + type.substr(0, 40) +
                               "\", which is no list of points; it is left out");
      return;
    }
    add_points(one, where, mirror(one, where), unit(one, where), std::move(markup));
  }

  /// By what x and y are multiplied to be those of LPS.
  double mirror(const MarkupJson& one, const std::string& where) const {
    const auto found = one.find("coordinateSystem");
    if (found == one.end()) return 1.0;  // the schema's default
    const std::string name = found->is_number_integer() ? std::to_string(found->get<std::int64_t>())
                             : found->is_string()       ? lower(found->get<std::string>())
                                                        : "";
    if (name == "lps" || name == "1") return 1.0;
    if (name == "ras" || name == "0") return -1.0;
    refuse(path_, where + ".coordinateSystem is neither LPS nor RAS");
  }

  /// mm in the markup's unit. UCUM's word for it, or a coded entry with that in front.
  double unit(const MarkupJson& one, const std::string& where) {
    const auto found = one.find("coordinateUnits");
    if (found == one.end()) return file_.unit_mm.value_or(1.0);
    const MarkupJson& code = found->is_array() && !found->empty() ? found->front() : *found;
    constexpr std::array<std::pair<const char*, double>, 4> units{
        {{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"um", 1e-3}}};
    for (const auto& [name, mm] : units)
      if (code == name) {
        const double before = file_.markups.empty() ? mm : file_.unit_mm.value_or(1.0);
        file_.unit_mm = mm;
        if (before != mm) refuse(path_, where + " is in another unit than the markups before it");
        return mm;
      }
    refuse(path_, where + ".coordinateUnits is none of mm, cm, m, um");
  }

  /// Nothing where the point's position is not defined.
  std::optional<Vec3> position(const MarkupJson& point, const std::string& where) const {
    if (!point.is_object()) refuse(path_, where + " is no object");
    const std::string status = text_in(point, "positionStatus", "defined");
    if (status == "undefined" || status == "preview" || status == "missing") return std::nullopt;
    if (status != "defined")
      refuse(path_, where + ".positionStatus is \"" + status.substr(0, 40) +
                        "\"; it is defined, undefined, preview or missing");
    const auto found = point.find("position");
    if (found == point.end()) refuse(path_, where + " has no position");
    const MarkupJson& p = *found;
    if (!p.is_array() || p.size() != 3 ||
        !std::all_of(p.begin(), p.end(), [](const MarkupJson& x) { return x.is_number(); }))
      refuse(path_, where + ".position is not [x, y, z]");
    const Vec3 place(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    if (!place.allFinite() || place.cwiseAbs().maxCoeff() > most_mm)
      refuse(path_, where + ".position is not finite, or farther than 1e9 from the origin");
    return place;
  }

  void add_points(const MarkupJson& one, const std::string& where, double mirror, double unit_mm,
                  Markup markup) {
    const auto found = one.find("controlPoints");
    if (found == one.end() || !found->is_array()) refuse(path_, where + " has no list \"controlPoints\"");
    points_ += found->size();
    if (points_ > most_points) refuse(path_, "it has more than a million points");
    const std::vector<double> radius = radii(one, where, found->size());
    std::size_t undefined = 0;
    for (std::size_t i = 0; i < found->size(); ++i) {
      const MarkupJson& point = (*found)[i];
      const auto place = position(point, where + ".controlPoints[" + std::to_string(i) + "]");
      if (!place) {
        ++undefined;
        continue;
      }
      markup.points.push_back(Vec3(mirror * place->x(), mirror * place->y(), place->z()) * unit_mm);
      markup.labels.push_back(text_in(point, "label"));
      if (!radius.empty()) markup.radius.push_back(radius[i]);
    }
    const std::string name = where + (markup.name.empty() ? "" : ", \"" + markup.name + "\",");
    if (undefined > 0)
      file_.warnings.push_back(name + " has " + points_text(undefined) +
                               " whose position is not defined: left out");
    if (markup.points.empty()) {
      if (undefined == 0) file_.warnings.push_back(name + " has no points");
      return;
    }
    file_.markups.push_back(std::move(markup));
  }

  /// The measurement `Radius`, mm; empty where there is none that fits the points.
  std::vector<double> radii(const MarkupJson& one, const std::string& where, std::size_t count) {
    const auto all = one.find("measurements");
    if (all == one.end() || !all->is_array()) return {};
    for (const MarkupJson& measurement : *all) {
      if (!measurement.is_object() || text_in(measurement, "name") != "Radius") continue;
      const auto values = measurement.find("controlPointValues");
      if (values == measurement.end() || !values->is_array()) continue;
      std::vector<double> out;
      for (const MarkupJson& value : *values) {
        const double r = value.is_number() ? value.get<double>() : 0.0;
        if (r > 0.0 && r < most_mm) out.push_back(r);
      }
      if (out.size() == count && values->size() == count && text_in(measurement, "units", "mm") == "mm")
        return out;
      file_.warnings.push_back(where +
                               ": its Radius is not one positive number of mm for each point: left out");
    }
    return {};
  }

  const fs::path& path_;
  MarkupsFile file_;
  std::size_t points_ = 0;
};

}  // namespace

MarkupsFile read_json(const fs::path& path) {
  return JsonReader(path).read();
}

}  // namespace ostia::io::markups
