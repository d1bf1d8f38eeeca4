#pragma once
/// \file The rows of a model's parts: written, changed, taken away; and their sums.

#include "case_file/database.h"
#include "case_file/model_blob.h"

namespace ostia::session {

/// What stands in the table `model`.
struct ModelRow {
  std::int64_t next_sample_id = 1;
  std::int32_t next_tree_id = 1;
  lumen::BlendOptions blend;
};
ModelRow row_of(const lumen::LumenModel& model);

std::uint64_t sum_of(const ModelRow& row);
std::uint64_t sum_of(const geometry::TreeNode& node, std::size_t place);
std::uint64_t sum_of(const geometry::TreeSegment& segment, std::size_t place);
std::uint64_t sum_of(const geometry::Vessel& vessel, const lumen::VesselLumen& lumen, std::size_t place);
std::uint64_t sum_of(const lumen::SurfaceSample& sample, std::int32_t vessel);
/// Of all rows of a model: additive, so that an edit changes it by its own rows.
std::uint64_t sum_of(const lumen::LumenModel& model);

std::string name_of(lumen::JointShape joints);
std::string name_of(lumen::FarField far_field);

/// Prepared statements for the tables that hold the model.
class ModelRows {
 public:
  explicit ModelRows(const Database& database);

  void insert(const ModelRow& row, std::uint64_t checksum);
  void update(const ModelRow& row, std::uint64_t checksum);
  void insert(const geometry::TreeNode& node, std::size_t place);
  void update(const geometry::TreeNode& node, std::size_t place);
  void erase(const geometry::TreeNode& node) { erase_node_.with(node.id).run(); }
  void insert(const geometry::TreeSegment& segment, std::size_t place);
  void update(const geometry::TreeSegment& segment, std::size_t place);
  void erase(const geometry::TreeSegment& segment) { erase_segment_.with(segment.id).run(); }
  void insert(const geometry::Vessel& vessel, const lumen::VesselLumen& lumen, std::size_t place);
  void update(const geometry::Vessel& vessel, const lumen::VesselLumen& lumen, std::size_t place);
  void erase_vessel(std::int32_t id) { erase_vessel_.with(id).run(); }
  void insert(const lumen::SurfaceSample& sample, std::int32_t vessel);
  void update(const lumen::SurfaceSample& sample, std::int32_t vessel);
  void erase_sample(std::int64_t id, std::int32_t vessel) { erase_sample_.with(vessel, id).run(); }

  /// Readers throw InvalidInput where a row cannot be one.
  ModelRow read_model(std::uint64_t& checksum);
  geometry::VesselTree read_tree(
      std::vector<lumen::VesselLumen>& lumens);                         ///< lumens without axis and samples
  std::vector<lumen::SurfaceSample> read_samples(std::int32_t vessel);  ///< in canonical order
  std::int64_t count_samples();

 private:
  Statement insert_model_, update_model_, insert_node_, update_node_, erase_node_, insert_segment_,
      update_segment_, erase_segment_, insert_vessel_, update_vessel_, erase_vessel_, insert_sample_,
      update_sample_, erase_sample_, read_model_, read_nodes_, read_segments_, read_vessels_, read_samples_,
      count_samples_;
};

}  // namespace ostia::session
