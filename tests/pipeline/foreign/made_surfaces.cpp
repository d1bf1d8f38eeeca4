#include "made_surfaces.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

namespace ostia::pipeline {
namespace {

using geometry::AnalyticShape;
using geometry::Centerline;
using geometry::TriMesh;
using geometry::Vec3;

constexpr double spacing_mm = 0.45;

geometry::AnalyticTube tube_of(std::string name, std::vector<Vec3> points, double first_radius,
                               double last_radius) {
  Centerline axis;
  axis.points = std::move(points);
  for (std::size_t i = 0; i < axis.points.size(); ++i)
    axis.radius.push_back(first_radius + (last_radius - first_radius) * static_cast<double>(i) /
                                             static_cast<double>(axis.points.size() - 1));
  geometry::complete(axis);
  return {std::move(name), std::move(axis)};
}

/// A tube along the axis that `at` draws for t in [0, 1].
geometry::AnalyticTube drawn(const std::string& name, const std::function<Vec3(double)>& at, int samples,
                             double first_radius, double last_radius) {
  std::vector<Vec3> points;
  for (int i = 0; i <= samples; ++i) points.push_back(at(static_cast<double>(i) / samples));
  return tube_of(name, std::move(points), first_radius, last_radius);
}

AnalyticShape shape_of(std::vector<geometry::AnalyticTube> tubes) {
  AnalyticShape shape{std::move(tubes), {}};
  for (const auto& tube : shape.tubes)
    for (std::size_t i = 0; i < tube.axis.size(); ++i) {
      const Vec3 reach = Vec3::Constant(tube.axis.radius[i] + 2.0);
      shape.box.extend(tube.axis.points[i] - reach).extend(tube.axis.points[i] + reach);
    }
  return shape;
}

AnalyticShape forked_vessel() {
  return geometry::y_junction(20.0, 18.0, 2.0, 1.5, 60.0);
}

Vec3 centre_of(const TriMesh& mesh, const geometry::Triangle& t) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : t) sum += mesh.points[static_cast<std::size_t>(v)] / 3.0;
  return sum;
}

/// Its ends closed by flat caps; the wall has label 1, caps 2, 3 ... where labels are wanted.
MadeSurface capped(const TriMesh& open, bool labelled) {
  const geometry::FilledHoles filled = geometry::fill_holes(open);
  MadeSurface made{filled.mesh, {}};
  if (labelled)
    for (const std::int32_t hole : filled.hole_of_triangle) made.labels.push_back(hole < 0 ? 1 : 2 + hole);
  return made;
}

/// Every third triangle at the open ends is missing.
TriMesh torn(const TriMesh& open) {
  std::vector<bool> at_rim(open.points.size(), false), keep(open.triangles.size(), true);
  for (const auto& loop : geometry::boundary_loops(open))
    for (const std::int32_t p : loop) at_rim[static_cast<std::size_t>(p)] = true;
  std::size_t count = 0;
  for (std::size_t t = 0; t < keep.size(); ++t)
    for (const std::int32_t p : open.triangles[t])
      if (at_rim[static_cast<std::size_t>(p)]) {
        keep[t] = ++count % 7 > 1;
        break;
      }
  TriMesh mesh = geometry::subset(open, keep);
  // Where the border runs through a point twice, one of its triangles goes as well.
  for (;;) {
    std::vector<std::size_t> borders(mesh.points.size(), 0);
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    for (const auto& [edge, n] : edges)
      if (n == 1)
        for (const std::int32_t p : {edge.first, edge.second}) ++borders[static_cast<std::size_t>(p)];
    std::vector<bool> stays;
    for (const auto& t : mesh.triangles)
      stays.push_back(
          std::ranges::none_of(t, [&](std::int32_t p) { return borders[static_cast<std::size_t>(p)] > 2; }));
    if (std::ranges::all_of(stays, std::identity())) return mesh;
    mesh = geometry::subset(mesh, stays);
  }
}

/// The point nearest to the middle of all.
Vec3 middle_of_wall(const TriMesh& mesh) {
  Vec3 middle = Vec3::Zero(), nearest = Vec3::Constant(std::numeric_limits<double>::infinity());
  for (const Vec3& p : mesh.points)
    if (p.allFinite()) middle += p / static_cast<double>(mesh.points.size());
  for (const Vec3& p : mesh.points)
    if (p.allFinite() && (p - middle).norm() < (nearest - middle).norm()) nearest = p;
  return nearest;
}

/// Noise that is the same for the same place, in [-1, 1] along each axis.
Vec3 noise_at(const Vec3& place) {
  const auto one = [&](double a, double b, double c) {
    const double x = std::sin(a * place.x() + b * place.y() + c * place.z()) * 43758.5453;
    return 2.0 * (x - std::floor(x)) - 1.0;
  };
  return {one(12.9898, 78.233, 37.719), one(39.346, 11.135, 83.155), one(73.156, 52.235, 9.151)};
}

void turn(MadeSurface& made) {
  for (geometry::Triangle& t : made.mesh.triangles) std::swap(t[0], t[1]);
}

TriMesh shifted(TriMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p += by;
  return mesh;
}

/// A tube with its ends cut aslant, 40 degrees off the axis, and capped there.
MadeSurface aslant() {
  TriMesh tube = geometry::structured_surface(geometry::straight_tube(40.0, 2.0).tubes[0], 24, 0.5);
  for (Vec3& p : tube.points) p.z() += std::tan(40.0 * std::numbers::pi / 180.0) * p.x();
  return capped(tube, false);
}

/// Long thin triangles, few around, as a CAD program exports a loft.
MadeSurface cad() {
  const auto bend = [](double t) {
    const double angle = t * std::numbers::pi / 2.0;
    return Vec3(30.0 * (1.0 - std::cos(angle)), 0.0, 30.0 * std::sin(angle));
  };
  return capped(geometry::structured_surface(drawn("bend", bend, 200, 3.0, 2.0), 16, 4.0), false);
}

/// A tube with a sac on its side.
MadeSurface aneurysm() {
  AnalyticShape shape = geometry::straight_tube(40.0, 2.0);
  shape.tubes.push_back(drawn(
      "sac", [](double t) { return Vec3(5.0 + 0.2 * t, 0.0, 20.0); }, 4, 4.0, 4.0));
  TriMesh mesh = geometry::surface_of(shape_of(shape.tubes), spacing_mm, false);
  std::vector<bool> keep;
  for (const auto& t : mesh.triangles) {
    const double z = centre_of(mesh, t).z();
    keep.push_back(z > 0.0 && z < 40.0);
  }
  return {geometry::subset(mesh, keep), {}};
}

/// Ascending aorta, arch and three arteries of the head: 12 mm beside 3 mm.
MadeSurface aortic_arch() {
  const auto arch = [](double t) {
    if (t < 0.3) return Vec3(-30.0, 0.0, -50.0 * (0.3 - t) / 0.3);
    if (t > 0.7) return Vec3(30.0, 0.0, -50.0 * (t - 0.7) / 0.3);
    const double angle = (t - 0.3) / 0.4 * std::numbers::pi;
    return Vec3(-30.0 * std::cos(angle), 0.0, 30.0 * std::sin(angle));
  };
  std::vector<geometry::AnalyticTube> tubes{drawn("aorta", arch, 800, 12.0, 10.0)};
  int number = 0;
  for (const double at : {0.42, 0.5, 0.58}) {
    const Vec3 from = arch(at);
    tubes.push_back(drawn(
        "branch" + std::to_string(++number),
        [&](double t) { return Vec3(from + t * 40.0 * Vec3(0.3 * from.normalized().x(), 0.0, 1.0)); }, 100,
        3.5, 3.0));
  }
  return capped(geometry::surface_of(shape_of(tubes), 1.2, true), true);
}

void write_vtp(const std::filesystem::path& path, const MadeSurface& made, const std::string& array,
               double unit_mm) {
  std::ofstream out(path);
  out.precision(9);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      << "<PolyData><Piece NumberOfPoints=\"" << made.mesh.points.size() << "\" NumberOfPolys=\""
      << made.mesh.triangles.size() << "\">\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
      << "format=\"ascii\">\n";
  for (const Vec3& p : made.mesh.points) out << (p / unit_mm).transpose() << "\n";
  out << "</DataArray></Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& t : made.mesh.triangles) out << t[0] << " " << t[1] << " " << t[2] << "\n";
  out << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= made.mesh.triangles.size(); ++i) out << 3 * i << "\n";
  out << "</DataArray></Polys>\n";
  if (!array.empty()) {
    out << "<CellData><DataArray type=\"Int32\" Name=\"" << array << "\" format=\"ascii\">\n";
    for (const std::int32_t label : made.labels) out << label << "\n";
    out << "</DataArray></CellData>\n";
  }
  out << "</Piece></PolyData></VTKFile>\n";
}

}  // namespace

std::vector<ForeignKind> foreign_kinds() {
  const auto open = [] { return geometry::surface_of(forked_vessel(), spacing_mm, true); };
  const auto closed = [] { return geometry::surface_of(forked_vessel(), spacing_mm, false); };
  return {
      {"vmtk_capped", "capped.vtp", "CellEntityIds", 1.0, 1, 2, [=] { return capped(open(), true); }},
      {"simvascular_model", "model.vtp", "ModelFaceID", 10.0, 1, 2, [=] { return capped(open(), true); }},
      {"capped_without_labels", "capped.stl", "", 1.0, 1, 2, [=] { return capped(open(), false); }},
      {"open_and_flat", "open.vtp", "", 1.0, 1, 2,
       [=] {
         return MadeSurface{open(), {}};
       }},
      {"open_and_ragged", "ragged.ply", "", 1.0, 1, 2,
       [=] {
         return MadeSurface{torn(open()), {}};
       }},
      {"inward", "inward.ply", "", 1.0, 1, 2,
       [=] {
         MadeSurface made{closed(), {}};
         turn(made);
         return made;
       }},
      {"two_trees", "two.stl", "", 1.0, 2, 4,
       [=] {
         return MadeSurface{geometry::merged(open(), shifted(closed(), Vec3(60.0, 0.0, 0.0))), {}};
       }},
      {"centimetres", "segmented.stl", "", 10.0, 1, 2,
       [] {
         return MadeSurface{geometry::raw_surface_of(forked_vessel(), spacing_mm, false), {}};
       }},
      {"aslant_caps", "aslant.vtp", "", 1.0, 1, 1, aslant},
      {"loft_of_a_cad_program", "loft.stl", "", 1.0, 1, 1, cad},
      {"sac_on_a_tube", "sac.ply", "", 1.0, 1, 1, aneurysm},
      {"aortic_arch", "arch.vtp", "ModelFaceID", 1.0, 1, 4, aortic_arch, false},
      {"coronary_tree_closed", "lca.vtp", "", 1.0, 1, 4,
       [] {
         return MadeSurface{geometry::raw_surface_of(geometry::coronary_like_tree(), 0.4, false), {}};
       }},
  };
}

ForeignKind tree_of_46_outlets() {
  const auto make = [] {
    constexpr double ring = 22.0, rise = 60.0, turns = 3.0;
    const auto trunk = [=](double t) {
      const double angle = 2.0 * std::numbers::pi * turns * t;
      return Vec3(ring * std::cos(angle), ring * std::sin(angle), rise * t);
    };
    std::vector<geometry::AnalyticTube> tubes{drawn("trunk", trunk, 4000, 2.8, 1.6)};
    for (int i = 1; i <= 45; ++i) {
      const double at = (0.5 + i) / 46.5;
      const Vec3 from = trunk(at), ahead = (trunk(at + 1e-4) - from).normalized();
      const Vec3 out = (Vec3(from.x(), from.y(), 0.0).normalized() * (i % 2 == 0 ? 1.0 : -0.7));
      tubes.push_back(drawn(
          "side" + std::to_string(i),
          [&](double t) { return Vec3(from + 14.0 * t * (out * (0.4 + 0.6 * t) + ahead * (0.6 - 0.4 * t))); },
          140, 1.1, 0.9));
    }
    return capped(geometry::surface_of(shape_of(tubes), 0.5, true), true);
  };
  return {"tree_of_46_outlets", "tree.vtp", "ModelFaceID", 10.0, 1, 46, make};
}

std::filesystem::path write_foreign(const ForeignKind& kind, const MadeSurface& made,
                                    const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kind.file;
  if (path.extension() == ".vtp") {
    write_vtp(path, made, made.labels.empty() ? "" : kind.label_array, kind.unit_mm);
    return path;
  }
  TriMesh mesh = made.mesh;
  for (Vec3& p : mesh.points) p /= kind.unit_mm;
  io::write_surface(path, mesh);
  return path;
}

std::vector<Fault> faults() {
  const auto each_label = [](MadeSurface& made, std::size_t triangle) {
    if (!made.labels.empty()) made.labels.push_back(made.labels[triangle]);
  };
  return {
      {"turned inward", turn},
      {"copies and triangles without area",
       [=](MadeSurface& made) {
         for (const std::size_t t : {10u, 20u, 30u}) {
           made.mesh.triangles.push_back(made.mesh.triangles[t]);
           each_label(made, t);
         }
         made.mesh.triangles.push_back({4, 4, 5});
         each_label(made, 0);
       }},
      {"points that are nowhere",
       [=](MadeSurface& made) {
         made.mesh.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
         made.mesh.triangles.push_back({0, 1, static_cast<std::int32_t>(made.mesh.points.size()) - 1});
         each_label(made, 0);
       }},
      {"a soup of triangles",
       [](MadeSurface& made) {
         TriMesh soup;
         for (const auto& t : made.mesh.triangles) {
           const auto n = static_cast<std::int32_t>(soup.points.size());
           for (const std::int32_t v : t)
             soup.points.push_back(made.mesh.points[static_cast<std::size_t>(v)]);
           soup.triangles.push_back({n, n + 1, n + 2});
         }
         made.mesh = std::move(soup);
       }},
      {"a hole in the wall",
       [](MadeSurface& made) {
         std::vector<bool> keep(made.mesh.triangles.size(), true);
         keep[keep.size() / 2] = false;
         TriMesh mesh = geometry::subset(made.mesh, keep);
         if (!made.labels.empty())
           made.labels.erase(made.labels.begin() + static_cast<std::ptrdiff_t>(keep.size() / 2));
         made.mesh = std::move(mesh);
       }},
      {"a speck",
       [=](MadeSurface& made) {
         const TriMesh speck = shifted(geometry::surface_of(geometry::straight_tube(0.3, 0.3), 0.2, false),
                                       Vec3(9.0, 9.0, 0.0));
         made.mesh = geometry::merged(made.mesh, speck);
         if (!made.labels.empty()) made.labels.resize(made.mesh.triangles.size(), 1);
       }},
      {"triangles turned at random",
       [](MadeSurface& made) {
         for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t)
           if ((t * 2654435761u >> 7) % 3 == 0)
             std::swap(made.mesh.triangles[t][0], made.mesh.triangles[t][1]);
       }},
      {"a spike through the other side",
       [](MadeSurface& made) {
         Vec3 middle = Vec3::Zero();
         for (const Vec3& p : made.mesh.points)
           if (p.allFinite()) middle += p / static_cast<double>(made.mesh.points.size());
         const Vec3 from = middle_of_wall(made.mesh);
         for (Vec3& p : made.mesh.points)
           if ((p - from).norm() == 0.0) p += 5.0 * (middle - from).normalized() + Vec3(0.1, 0.2, 0.0);
       }},
      {"small folds",
       [](MadeSurface& made) {
         constexpr double reach_mm = 1.5, noise_mm = 0.2;
         const Vec3 place = middle_of_wall(made.mesh);
         for (Vec3& p : made.mesh.points)
           if ((p - place).norm() < reach_mm) p += noise_mm * noise_at(p);
       }},
      {"in centimetres", [](MadeSurface&) {}, [](ForeignKind& kind) { kind.unit_mm = 10.0; }},
      {"two of it",
       [](MadeSurface& made) {
         made.mesh = geometry::merged(made.mesh, shifted(made.mesh, Vec3(0.0, 200.0, 0.0)));
         const std::vector<std::int32_t> once = made.labels;
         made.labels.insert(made.labels.end(), once.begin(), once.end());
       },
       [](ForeignKind& kind) { kind.parts *= 2, kind.outlets *= 2; }},
  };
}

}  // namespace ostia::pipeline
