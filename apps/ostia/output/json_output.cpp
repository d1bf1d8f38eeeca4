#include "output/json_output.h"

#include "ostia/core/text.h"

#include <nlohmann/json.hpp>

namespace ostia::app {
namespace {

using geometry::Vec3;
using nlohmann::json;

json array(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

std::string text(const Vec3& v) {
  return core::significant_text(v.x(), 6) + ", " + core::significant_text(v.y(), 6) + ", " +
         core::significant_text(v.z(), 6);
}

std::string lines(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string out;
  for (const auto& [name, value] : rows)
    out += name + std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') + value + "\n";
  return out;
}

std::string size_text(const imaging::Geometry& g) {
  return std::to_string(g.size[0]) + " x " + std::to_string(g.size[1]) + " x " + std::to_string(g.size[2]);
}

json geometry_json(const imaging::Geometry& g) {
  return {{"size", g.size},
          {"spacing_mm", array(g.spacing)},
          {"origin_mm", array(g.origin)},
          {"direction", {array(g.direction.col(0)), array(g.direction.col(1)), array(g.direction.col(2))}}};
}

double volume_mm3(const imaging::Geometry& g, const LabelFacts& one) {
  return static_cast<double>(one.voxels) * g.spacing.prod();
}

}  // namespace

std::string image_text(const ImageFacts& f, bool as_json) {
  const Vec3 last(static_cast<double>(f.geometry.size[0] - 1), static_cast<double>(f.geometry.size[1] - 1),
                  static_cast<double>(f.geometry.size[2] - 1));
  if (as_json) {
    json out = geometry_json(f.geometry);
    out["v"] = 1;
    out["kind"] = f.kind;
    out["axes"] = "LPS";
    out["least_hu"] = f.least;
    out["median_hu"] = f.median;
    out["largest_hu"] = f.largest;
    out["warnings"] = f.warnings;
    for (const LabelFacts& one : f.labels)
      out["labels"].push_back(
          {{"label", one.label}, {"voxels", one.voxels}, {"volume_mm3", volume_mm3(f.geometry, one)}});
    return out.dump(2) + "\n";
  }
  std::vector<std::pair<std::string, std::string>> rows{
      {"kind", f.kind},
      {"voxels", size_text(f.geometry)},
      {"spacing", text(f.geometry.spacing) + " mm"},
      {"first voxel", text(f.geometry.origin) + " mm (LPS)"},
      {"last voxel", text(f.geometry.world(last)) + " mm (LPS)"},
      {"axis i", text(f.geometry.direction.col(0))},
      {"axis j", text(f.geometry.direction.col(1))},
      {"axis k", text(f.geometry.direction.col(2))}};
  const bool empty_mask = f.kind == "mask" && f.largest == 0.0;
  if (empty_mask)
    rows.emplace_back("labels", "none");
  else if (f.labels.empty())
    rows.emplace_back("intensity", std::to_string(static_cast<long>(f.least)) + " to " +
                                       std::to_string(static_cast<long>(f.largest)) + " HU, median " +
                                       std::to_string(static_cast<long>(f.median)));
  for (const LabelFacts& one : f.labels)
    rows.emplace_back(
        "label " + std::to_string(one.label),
        std::to_string(one.voxels) + " voxels, " + core::fixed_text(volume_mm3(f.geometry, one), 1) + " mm3");
  for (const std::string& warning : f.warnings) rows.emplace_back("warning", warning);
  return lines(rows);
}

std::string surface_text(const SurfaceFacts& f, bool as_json) {
  if (as_json) {
    return json{{"v", 1},
                {"kind", "surface"},
                {"points", f.points},
                {"triangles", f.triangles},
                {"area_mm2", f.area_mm2},
                {"volume_mm3", f.volume_mm3},
                {"box_mm", {array(f.box.min()), array(f.box.max())}},
                {"components", f.faults.components},
                {"open_edges", f.faults.open_edges},
                {"non_manifold_edges", f.faults.non_manifold_edges},
                {"non_manifold_vertices", f.faults.non_manifold_vertices},
                {"degenerate_triangles", f.faults.degenerate_triangles},
                {"duplicate_triangles", f.faults.duplicate_triangles},
                {"non_finite_points", f.faults.non_finite_points},
                {"self_intersections", f.faults.self_intersections}}
               .dump(2) +
           "\n";
  }
  return lines({{"kind", "surface"},
                {"points", std::to_string(f.points)},
                {"triangles", std::to_string(f.triangles)},
                {"parts", std::to_string(f.faults.components)},
                {"from", text(f.box.min()) + " mm (LPS)"},
                {"to", text(f.box.max()) + " mm (LPS)"},
                {"area", std::to_string(f.area_mm2) + " mm2"},
                {"faults", f.faults.summary()}});
}

std::string series_text(const imaging::DicomFolder& folder, bool as_json) {
  if (as_json) {
    json out{{"v", 1}, {"kind", "DICOM"}, {"skipped_files", folder.skipped}, {"series", json::array()}};
    for (const imaging::DicomSeries& s : folder.series) {
      json one = geometry_json(s.geometry);
      one["uid"] = s.uid;
      one["modality"] = s.modality;
      one["description"] = s.description;
      one["files"] = s.files.size();
      one["gantry_tilt_deg"] = s.gantry_tilt_deg;
      one["warnings"] = s.warnings;
      one["faults"] = s.faults;
      out["series"].push_back(one);
    }
    return out.dump(2) + "\n";
  }
  std::string out;
  for (const imaging::DicomSeries& s : folder.series) {
    std::vector<std::pair<std::string, std::string>> rows{
        {"series", s.uid},
        {"modality", s.modality},
        {"description", s.description},
        {"files", std::to_string(s.files.size())},
        {"voxels", size_text(s.geometry)},
        {"spacing", text(s.geometry.spacing) + " mm"},
        {"first voxel", text(s.geometry.origin) + " mm (LPS)"}};
    for (const std::string& warning : s.warnings) rows.emplace_back("warning", warning);
    for (const std::string& fault : s.faults) rows.emplace_back("fault", fault);
    out += lines(rows) + "\n";
  }
  if (folder.skipped > 0)
    out += std::to_string(folder.skipped) + " files are no DICOM images and were passed over\n";
  return out;
}

}  // namespace ostia::app
