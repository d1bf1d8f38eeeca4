#include "convert/info_kinds.h"

#include "motion/motion_input.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/session/case_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using core::significant_text;
using InfoJson = nlohmann::ordered_json;
using InfoRows = std::vector<std::pair<std::string, std::string>>;

struct Told {
  InfoJson json;
  InfoRows rows;
};

InfoJson place_of(const geometry::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

std::string place_text_of(const geometry::Vec3& p) {
  return significant_text(p.x(), 6) + ", " + significant_text(p.y(), 6) + ", " + significant_text(p.z(), 6) +
         " mm (LPS)";
}

fs::path manifest_in(const fs::path& folder) {
  return folder / "manifest.json";
}

bool is_motion(const fs::path& path) {
  std::error_code error;
  return path.filename() == "motion.json" || fs::is_regular_file(path / "motion.json", error);
}

Told of_case(const fs::path& path) {
  const auto file = session::CaseFile::open(path, session::OpenMode::read_only);
  const lumen::LumenModel& model = *file.model();
  const auto image = file.image();
  Told told;
  InfoJson vessels = InfoJson::array();
  told.rows = {{"kind", "case"}, {"image", image ? image->pseudonym : "none"}};
  for (std::size_t v = 0; v < model.vessels.size(); ++v) {
    const lumen::VesselLumen& vessel = *model.vessels[v];
    const auto edited = std::ranges::count_if(vessel.samples, [](const lumen::SurfaceSample& sample) {
      return sample.origin == lumen::SampleOrigin::edit;
    });
    const std::string& name = model.tree.vessels[v].name;
    vessels.push_back({{"id", vessel.vessel},
                       {"name", name},
                       {"length_mm", vessel.axis->length()},
                       {"samples", vessel.samples.size()},
                       {"edited_samples", edited}});
    told.rows.emplace_back("vessel", name + ", " + significant_text(vessel.axis->length(), 4) + " mm, " +
                                         std::to_string(vessel.samples.size()) + " samples, " +
                                         std::to_string(edited) + " of them edited");
  }
  const std::size_t edits = file.edits().size(), measurements = file.annotations()->measurements.size();
  told.rows.emplace_back("edits", std::to_string(edits));
  told.rows.emplace_back("measurements", std::to_string(measurements));
  told.rows.emplace_back("model", lumen::digest(model));
  told.json = {{"v", 1},
               {"kind", "case"},
               {"image", image ? InfoJson(image->pseudonym) : InfoJson()},
               {"vessels", std::move(vessels)},
               {"edits", edits},
               {"measurements", measurements},
               {"digest", lumen::digest(model)}};
  return told;
}

Told of_mesh(const fs::path& path, const core::TaskContext& task) {
  const io::LayeredMesh read = io::read_layered_mesh(path);
  const meshing::MixedQuality q = meshing::mixed_quality(read.mesh, task);
  const geometry::Box3 box = geometry::bounds(read.mesh.points);
  Told told;
  told.rows = {{"kind", "volume mesh"},
               {"points", std::to_string(q.points)},
               {"tetrahedra", std::to_string(q.tetrahedra.count)},
               {"prisms", std::to_string(q.prisms.count)}};
  if (read.hexahedra > 0)
    told.rows.emplace_back("hexahedra", std::to_string(read.hexahedra) + ", read as two prisms each");
  told.rows.emplace_back("order", q.quadratic ? "2" : "1");
  told.rows.emplace_back("volume", significant_text(q.volume_mm3(), 6) + " mm3");
  told.rows.emplace_back("inverted", std::to_string(q.inverted()));
  told.rows.emplace_back("from", place_text_of(box.min()));
  told.rows.emplace_back("to", place_text_of(box.max()));
  InfoJson faces = InfoJson::array();
  for (const meshing::FaceQuality& face : q.faces) {
    faces.push_back(
        {{"name", face.name}, {"facets", face.triangles + face.quads}, {"area_mm2", face.area_mm2}});
    told.rows.emplace_back("face", face.name + ", " + significant_text(face.area_mm2, 4) + " mm2");
  }
  told.json = {{"v", 1},
               {"kind", "volume mesh"},
               {"points", q.points},
               {"tetrahedra", q.tetrahedra.count},
               {"prisms", q.prisms.count},
               {"hexahedra", read.hexahedra},
               {"order", q.quadratic ? 2 : 1},
               {"volume_mm3", q.volume_mm3()},
               {"inverted", q.inverted()},
               {"box_mm", {place_of(box.min()), place_of(box.max())}},
               {"faces", std::move(faces)}};
  return told;
}

Told of_motion(const fs::path& path) {
  const io::CageMotionFile file = io::read_cage_motion(motion_path(path));
  const auto fitted = std::ranges::count_if(file.motion.phases, [](const geometry::CagePhase& phase) {
    return phase.origin == geometry::PhaseOrigin::fitted;
  });
  InfoJson percents = InfoJson::array();
  std::string all;
  for (const geometry::CagePhase& phase : file.motion.phases) {
    percents.push_back(io::percent_of(phase.phase));
    all += (all.empty() ? "" : ", ") + geometry::percent_text(phase.phase);
  }
  const bool surface = !file.surface.empty();
  return {{{"v", 1},
           {"kind", "motion"},
           {"template_percent", io::percent_of(file.motion.template_phase)},
           {"phases_percent", std::move(percents)},
           {"fitted", fitted},
           {"has_surface", surface}},
          {{"kind", "motion"},
           {"template", "at " + geometry::percent_text(file.motion.template_phase)},
           {"phases", all},
           {"fitted", std::to_string(fitted)},
           {"surface", surface ? "of the template, beside it" : "none"}}};
}

Told of_result(const fs::path& folder) {
  const auto manifest = nlohmann::json::parse(core::read_file(manifest_in(folder)), nullptr, false);
  if (!manifest.is_object() || !manifest.contains("command") || !manifest.contains("outputs"))
    throw InvalidInput("cannot read " + manifest_in(folder).string() + ": it is no manifest of Ostia's");
  Told told;
  const std::string command = manifest.value("command", ""), finished = manifest.value("finished", "");
  const int code = manifest.value("exit_code", 0);
  told.json = {{"v", 1},
               {"kind", "result"},
               {"command", command},
               {"finished", finished},
               {"exit_code", code},
               {"seconds", manifest.value("seconds", 0.0)},
               {"warnings", manifest.value("warnings", nlohmann::json::array())},
               {"files", InfoJson::array()}};
  told.rows = {{"kind", "result of `ostia " + command + "`"},
               {"finished", finished},
               {"exit code", std::to_string(code)}};
  for (const auto& warning : told.json["warnings"])
    told.rows.emplace_back("warning", warning.get<std::string>());
  for (const auto& [name, digest] : manifest["outputs"].items()) {
    told.json["files"].push_back(name);
    told.rows.emplace_back("file", name);
  }
  return told;
}

}  // namespace

bool is_own_kind(const fs::path& path) {
  std::error_code error;
  return path.extension() == ".ostia" || is_motion(path) || fs::is_regular_file(manifest_in(path), error) ||
         io::is_volume_mesh(path);
}

ExitCode own_kind_info(const InfoOptions& options, const core::TaskContext& task) {
  if (!options.preview.empty()) throw UsageError("--preview is for images");
  const fs::path& path = options.input.input;
  std::error_code error;
  const Told told = path.extension() == ".ostia"                    ? of_case(path)
                    : is_motion(path)                               ? of_motion(path)
                    : fs::is_regular_file(manifest_in(path), error) ? of_result(path)
                                                                    : of_mesh(path, task);
  if (options.json) {
    std::fputs((told.json.dump(2) + "\n").c_str(), stdout);
    return ExitCode::ok;
  }
  constexpr std::size_t column = 14;
  for (const auto& [name, value] : told.rows)
    std::printf("%s%s%s\n", name.c_str(),
                std::string(column > name.size() ? column - name.size() : 1, ' ').c_str(), value.c_str());
  return ExitCode::ok;
}

}  // namespace ostia::app
