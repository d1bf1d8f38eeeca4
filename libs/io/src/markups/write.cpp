#include "formats.h"

#include "ostia/core/csv.h"
#include "ostia/core/text.h"

#include <nlohmann/json.hpp>

#include <array>

namespace ostia::io::markups {
namespace {

using OutJson = nlohmann::ordered_json;

constexpr const char* schema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
    "markups-schema-v1.0.3.json#";

const char* type_of(MarkupKind kind) {
  switch (kind) {
    case MarkupKind::line:
      return "Line";
    case MarkupKind::curve:
      return "Curve";
    case MarkupKind::closed_curve:
      return "ClosedCurve";
    case MarkupKind::fiducials:
      break;
  }
  return "Fiducial";
}

/// Names may come from files of any encoding.
std::string dumped(const OutJson& value) {
  return value.dump(-1, ' ', false, OutJson::error_handler_t::replace);
}

OutJson display_of(const Markup& markup, std::size_t index) {
  constexpr std::array<std::array<double, 3>, 4> colors{
      {{0.84, 0.15, 0.16}, {0.12, 0.47, 0.71}, {0.17, 0.63, 0.17}, {1.0, 0.5, 0.05}}};
  const auto& color = colors[index % colors.size()];
  const bool places = markup.kind == MarkupKind::fiducials;
  return {{"visibility", true},
          {"opacity", 1.0},
          {"color", color},
          {"selectedColor", color},
          {"propertiesLabelVisibility", !places},
          {"pointLabelsVisibility", places},
          {"glyphType", "Sphere3D"},
          {"glyphScale", places ? 2.0 : 0.5},
          {"useGlyphScale", true},
          {"lineThickness", 0.3}};
}

std::string label_of(const Markup& markup, std::size_t i) {
  if (!markup.labels.empty()) return markup.labels[i];
  return (markup.name.empty() ? "P" : markup.name) + "-" + std::to_string(i + 1);
}

/// A point a line: files of thousands stay readable, and small.
std::string points_json(const Markup& markup) {
  std::string out;
  for (std::size_t i = 0; i < markup.points.size(); ++i) {
    const geometry::Vec3& p = markup.points[i];
    const OutJson point{{"id", std::to_string(i + 1)},
                        {"label", label_of(markup, i)},
                        {"position", {p.x(), p.y(), p.z()}},
                        {"positionStatus", "defined"}};
    out += (i == 0 ? "" : ",\n") + dumped(point);
  }
  return out;
}

std::string markup_json(const Markup& markup, std::size_t index) {
  const OutJson head{{"type", type_of(markup.kind)},
                     {"name", markup.name},
                     {"coordinateSystem", "LPS"},
                     {"coordinateUnits", "mm"},
                     {"locked", false},
                     {"fixedNumberOfControlPoints", false},
                     {"labelFormat", "%N-%d"},
                     {"lastUsedControlPointNumber", markup.points.size()}};
  OutJson measurements = OutJson::array();
  if (!markup.radius.empty())
    measurements.push_back(
        {{"name", "Radius"}, {"enabled", true}, {"units", "mm"}, {"controlPointValues", markup.radius}});
  std::string text = dumped(head);
  text.pop_back();  // the object goes on
  return text + ",\"controlPoints\":[\n" + points_json(markup) +
         "],\n\"measurements\":" + dumped(measurements) +
         ",\n\"display\":" + dumped(display_of(markup, index)) + "}";
}

}  // namespace

std::string json_text(const std::vector<Markup>& markups) {
  std::string out = "{\"@schema\":\"" + std::string(schema) + "\",\n\"markups\":[\n";
  for (std::size_t i = 0; i < markups.size(); ++i) out += (i == 0 ? "" : ",\n") + markup_json(markups[i], i);
  return out + "]}\n";
}

std::string fcsv_text(const std::vector<Markup>& markups) {
  // RAS by its number, which all versions of Slicer read alike.
  std::string out =
      "# Markups fiducial file version = 4.11\n# CoordinateSystem = 0\n"
      "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  std::size_t id = 0;
  for (const Markup& markup : markups)
    for (std::size_t i = 0; i < markup.points.size(); ++i) {
      const geometry::Vec3& p = markup.points[i];
      out += core::csv_line({std::to_string(++id), core::shortest_text(0.0 - p.x()),
                             core::shortest_text(0.0 - p.y()), core::shortest_text(p.z()), "0", "0", "0", "1",
                             "1", "1", "0", label_of(markup, i), markup.name, ""});
    }
  return out;
}

}  // namespace ostia::io::markups
