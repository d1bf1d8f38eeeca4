#include "mesh/told_mesh.h"

#include "output/told.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <cstdio>

namespace ostia::app {

void tell_mesh(const std::filesystem::path& folder, bool as_json) {
  const std::string text = core::read_file(folder / "quality.json");
  if (as_json) {
    std::fputs(text.c_str(), stdout);
    return;
  }
  const auto quality = nlohmann::json::parse(text);
  const auto& surface = quality.at("surface");
  const auto& volume = quality.at("volume");
  const std::size_t prisms = volume.at("prisms").get<std::size_t>();
  std::string tetrahedra = std::to_string(volume.at("tetrahedra").get<std::size_t>()) + " tetrahedra";
  if (prisms > 0) tetrahedra += " and " + counted(prisms, "prism");
  std::printf(
      "%s (least angle %s degrees), %s (least dihedral %s degrees), %s mm3; %s\n",
      counted(surface.at("triangles").get<std::size_t>(), "triangle").c_str(),
      core::fixed_text(surface.at("min_angle_deg").get<double>(), 1).c_str(), tetrahedra.c_str(),
      core::fixed_text(volume.at("min_dihedral_deg").get<double>(), 1).c_str(),
      core::significant_text(volume.at("volume_mm3").get<double>(), 5).c_str(),
      quality.at("verdict").at("passed").get<bool>() ? "quality control passed" : "quality control failed");
}

}  // namespace ostia::app
