#include "case_file/model_rows.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::session {
namespace {

using geometry::TreeNode;
using geometry::TreeSegment;
using geometry::Vec3;
using geometry::Vessel;
using lumen::SurfaceSample;
using lumen::VesselLumen;

std::string_view view_of(const Vec3& v) {
  return {reinterpret_cast<const char*>(v.data()), 3 * sizeof(double)};
}

[[noreturn]] void damaged_model(const std::string& what) {
  throw InvalidInput("the case is damaged: " + what);
}

std::int32_t small(std::int64_t value) {
  if (value != static_cast<std::int32_t>(value)) damaged_model("an id of " + std::to_string(value));
  return static_cast<std::int32_t>(value);
}

lumen::FarField far_field_named(const std::string& name) {
  for (const auto choice : {lumen::FarField::constant, lumen::FarField::linear})
    if (name_of(choice) == name) return choice;
  damaged_model("an unknown far field");
}

lumen::JointShape joints_named(const std::string& name) {
  for (const auto choice : {lumen::JointShape::sharp, lumen::JointShape::smooth})
    if (name_of(choice) == name) return choice;
  damaged_model("an unknown shape of joints");
}

lumen::Kernel kernel_of(const std::string& name) {
  try {
    return lumen::kernel_named(name);
  } catch (const InvalidInput&) {
    damaged_model("an unknown kernel");
  }
}

}  // namespace

std::string name_of(lumen::JointShape joints) {
  return joints == lumen::JointShape::sharp ? "sharp" : "smooth";
}
std::string name_of(lumen::FarField far_field) {
  return far_field == lumen::FarField::constant ? "constant" : "linear";
}

ModelRow row_of(const lumen::LumenModel& model) {
  return {model.next_sample_id, model.next_tree_id, model.blend};
}

std::uint64_t sum_of(const ModelRow& row) {
  Checksum sum;
  sum.add("model").add(row.next_sample_id).add(std::int64_t{row.next_tree_id});
  return sum.add(row.blend.width_mm).add(name_of(row.blend.joints)).value();
}
std::uint64_t sum_of(const TreeNode& node, std::size_t place) {
  Checksum sum;
  sum.add("node").add(std::int64_t{node.id}).add(static_cast<std::int64_t>(place));
  return sum.add(node.position).value();
}
std::uint64_t sum_of(const TreeSegment& segment, std::size_t place) {
  Checksum sum;
  sum.add("segment").add(std::int64_t{segment.id}).add(static_cast<std::int64_t>(place));
  sum.add(std::int64_t{segment.from}).add(std::int64_t{segment.to});
  for (const std::string& blob : {bytes_of(segment.axis.points), bytes_of(segment.axis.radius),
                                  bytes_of(segment.axis.abscissa), bytes_of(segment.axis.frames)})
    sum.add(blob);
  return sum.value();
}
std::uint64_t sum_of(const Vessel& vessel, const VesselLumen& lumen, std::size_t place) {
  Checksum sum;
  sum.add("vessel").add(std::int64_t{vessel.id}).add(static_cast<std::int64_t>(place)).add(vessel.name);
  sum.add(bytes_of(vessel.segments)).add(lumen.own_from_mm);
  const lumen::InterpolationOptions& options = lumen.interpolation;
  sum.add(lumen::name(options.kernel)).add(options.support_radius_mm).add(options.offset_mm);
  return sum.add(name_of(options.far_field)).value();
}
std::uint64_t sum_of(const SurfaceSample& sample, std::int32_t vessel) {
  Checksum sum;
  sum.add(std::int64_t{vessel}).add(sample.id).add(sample.s_mm).add(sample.position).add(sample.normal);
  return sum.add(static_cast<std::int64_t>(sample.origin)).value();
}

std::uint64_t sum_of(const lumen::LumenModel& model) {
  std::uint64_t sum = sum_of(row_of(model));
  for (std::size_t i = 0; i < model.tree.nodes.size(); ++i) sum += sum_of(model.tree.nodes[i], i);
  for (std::size_t i = 0; i < model.tree.segments.size(); ++i) sum += sum_of(model.tree.segments[i], i);
  for (std::size_t i = 0; i < model.vessels.size(); ++i) {
    sum += sum_of(model.tree.vessels[i], *model.vessels[i], i);
    for (const SurfaceSample& sample : model.vessels[i]->samples)
      sum += sum_of(sample, model.vessels[i]->vessel);
  }
  return sum;
}

ModelRows::ModelRows(const Database& db)
    : insert_model_(db, "INSERT INTO model VALUES(1, ?1, ?2, ?3, ?4, ?5)"),
      update_model_(db,
                    "UPDATE model SET next_sample_id = ?1, next_tree_id = ?2, blend_width_mm = ?3, "
                    "joints = ?4, checksum = ?5 WHERE id = 1"),
      insert_node_(db, "INSERT INTO node VALUES(?1, ?2, ?3)"),
      update_node_(db, "UPDATE node SET place = ?2, position = ?3 WHERE id = ?1"),
      erase_node_(db, "DELETE FROM node WHERE id = ?1"),
      insert_segment_(db, "INSERT INTO segment VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)"),
      update_segment_(db,
                      "UPDATE segment SET place = ?2, from_node = ?3, to_node = ?4, points = ?5, "
                      "radius = ?6, abscissa = ?7, frames = ?8 WHERE id = ?1"),
      erase_segment_(db, "DELETE FROM segment WHERE id = ?1"),
      insert_vessel_(db, "INSERT INTO vessel VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)"),
      update_vessel_(db,
                     "UPDATE vessel SET place = ?2, name = ?3, segments = ?4, own_from_mm = ?5, "
                     "kernel = ?6, support_radius_mm = ?7, offset_mm = ?8, far_field = ?9 WHERE id = ?1"),
      erase_vessel_(db, "DELETE FROM vessel WHERE id = ?1"),
      insert_sample_(db, "INSERT INTO sample VALUES(?1, ?2, ?3, ?4, ?5, ?6)"),
      update_sample_(db,
                     "UPDATE sample SET s_mm = ?3, position = ?4, normal = ?5, origin = ?6 "
                     "WHERE vessel = ?1 AND id = ?2"),
      erase_sample_(db, "DELETE FROM sample WHERE vessel = ?1 AND id = ?2"),
      read_model_(db, "SELECT next_sample_id, next_tree_id, blend_width_mm, joints, checksum FROM model"),
      read_nodes_(db, "SELECT id, position FROM node ORDER BY place"),
      read_segments_(db,
                     "SELECT id, from_node, to_node, points, radius, abscissa, frames FROM segment "
                     "ORDER BY place"),
      read_vessels_(db,
                    "SELECT id, name, segments, own_from_mm, kernel, support_radius_mm, offset_mm, "
                    "far_field FROM vessel ORDER BY place"),
      read_samples_(db, "SELECT id, s_mm, position, normal, origin FROM sample WHERE vessel = ?1"),
      count_samples_(db, "SELECT count(*) FROM sample") {}

namespace {

void write(Statement& statement, const ModelRow& row, std::uint64_t checksum) {
  statement
      .with(row.next_sample_id, row.next_tree_id, row.blend.width_mm, name_of(row.blend.joints),
            static_cast<std::int64_t>(checksum))
      .run();
}

void write(Statement& statement, const TreeNode& node, std::size_t place) {
  statement.with(node.id, static_cast<std::int64_t>(place), Blob{view_of(node.position)}).run();
}

void write(Statement& statement, const TreeSegment& segment, std::size_t place) {
  const std::string points = bytes_of(segment.axis.points), radius = bytes_of(segment.axis.radius),
                    abscissa = bytes_of(segment.axis.abscissa), frames = bytes_of(segment.axis.frames);
  statement
      .with(segment.id, static_cast<std::int64_t>(place), segment.from, segment.to, Blob{points},
            Blob{radius}, Blob{abscissa}, Blob{frames})
      .run();
}

void write(Statement& statement, const Vessel& vessel, const VesselLumen& lumen, std::size_t place) {
  const std::string segments = bytes_of(vessel.segments);
  const lumen::InterpolationOptions& options = lumen.interpolation;
  statement
      .with(vessel.id, static_cast<std::int64_t>(place), vessel.name, Blob{segments}, lumen.own_from_mm,
            lumen::name(options.kernel), options.support_radius_mm, options.offset_mm,
            name_of(options.far_field))
      .run();
}

void write(Statement& statement, const SurfaceSample& sample, std::int32_t vessel) {
  statement
      .with(vessel, sample.id, sample.s_mm, Blob{view_of(sample.position)}, Blob{view_of(sample.normal)},
            static_cast<std::int64_t>(sample.origin))
      .run();
}

}  // namespace

void ModelRows::insert(const ModelRow& row, std::uint64_t checksum) {
  write(insert_model_, row, checksum);
}
void ModelRows::update(const ModelRow& row, std::uint64_t checksum) {
  write(update_model_, row, checksum);
}
void ModelRows::insert(const TreeNode& node, std::size_t place) {
  write(insert_node_, node, place);
}
void ModelRows::update(const TreeNode& node, std::size_t place) {
  write(update_node_, node, place);
}
void ModelRows::insert(const TreeSegment& segment, std::size_t place) {
  write(insert_segment_, segment, place);
}
void ModelRows::update(const TreeSegment& segment, std::size_t place) {
  write(update_segment_, segment, place);
}
void ModelRows::insert(const Vessel& vessel, const VesselLumen& lumen, std::size_t place) {
  write(insert_vessel_, vessel, lumen, place);
}
void ModelRows::update(const Vessel& vessel, const VesselLumen& lumen, std::size_t place) {
  write(update_vessel_, vessel, lumen, place);
}
void ModelRows::insert(const SurfaceSample& sample, std::int32_t vessel) {
  write(insert_sample_, sample, vessel);
}
void ModelRows::update(const SurfaceSample& sample, std::int32_t vessel) {
  write(update_sample_, sample, vessel);
}

ModelRow ModelRows::read_model(std::uint64_t& checksum) {
  if (!read_model_.with().step()) damaged_model("it holds no model");
  ModelRow row;
  row.next_sample_id = read_model_.integer(0);
  row.next_tree_id = small(read_model_.integer(1));
  row.blend = {read_model_.real(2), joints_named(read_model_.text(3))};
  checksum = static_cast<std::uint64_t>(read_model_.integer(4));
  read_model_.reset();
  return row;
}

geometry::VesselTree ModelRows::read_tree(std::vector<VesselLumen>& lumens) {
  geometry::VesselTree tree;
  read_nodes_.with();
  while (read_nodes_.step())
    tree.nodes.push_back({small(read_nodes_.integer(0)), vec_of(read_nodes_.bytes(1))});
  Statement& s = read_segments_.with();
  while (s.step()) {
    TreeSegment segment{small(s.integer(0)), small(s.integer(1)), small(s.integer(2)), {}};
    segment.axis.points = points_of(s.bytes(3));
    segment.axis.radius = doubles_of(s.bytes(4));
    segment.axis.abscissa = doubles_of(s.bytes(5));
    segment.axis.frames = frames_of(s.bytes(6));
    tree.segments.push_back(std::move(segment));
  }
  Statement& v = read_vessels_.with();
  lumens.clear();
  while (v.step()) {
    tree.vessels.push_back({small(v.integer(0)), v.text(1), ids_of(v.bytes(2))});
    VesselLumen lumen;
    lumen.vessel = tree.vessels.back().id;
    lumen.own_from_mm = v.real(3);
    lumen.interpolation = {kernel_of(v.text(4)), v.real(5), v.real(6), far_field_named(v.text(7))};
    lumens.push_back(std::move(lumen));
  }
  return tree;
}

std::vector<SurfaceSample> ModelRows::read_samples(std::int32_t vessel) {
  std::vector<SurfaceSample> samples;
  Statement& row = read_samples_.with(vessel);
  while (row.step()) {
    const std::int64_t origin = row.integer(4);
    if (origin < 0 || origin > static_cast<std::int64_t>(lumen::SampleOrigin::edit))
      damaged_model("a sample of unknown origin");
    samples.push_back({row.integer(0), vec_of(row.bytes(2)), vec_of(row.bytes(3)), row.real(1),
                       static_cast<lumen::SampleOrigin>(origin)});
  }
  std::sort(samples.begin(), samples.end(), lumen::canonical_order);
  return samples;
}

std::int64_t ModelRows::count_samples() {
  count_samples_.with().step();
  const std::int64_t count = count_samples_.integer(0);
  count_samples_.reset();
  return count;
}

}  // namespace ostia::session
