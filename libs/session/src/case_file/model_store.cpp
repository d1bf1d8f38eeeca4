#include "case_file/model_store.h"

#include "ostia/core/error.h"
#include "ostia/session/model_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace ostia::session {
namespace {

using geometry::TreeNode;
using geometry::TreeSegment;
using geometry::Vessel;
using lumen::LumenModel;
using lumen::SurfaceSample;
using lumen::VesselLumen;

constexpr std::array<const char*, 14> recorded_tables{
    "model", "node",         "segment", "vessel",         "sample",  "annotation",  "measurement",
    "mark",  "evaluability", "lesion",  "pressure_input", "what_if", "report_note", "report_version"};

bool same_item(const TreeNode& a, const TreeNode& b) {
  return a.id == b.id && bytes_of(a.position) == bytes_of(b.position);
}
bool same_item(const TreeSegment& a, const TreeSegment& b) {
  return a.id == b.id && a.from == b.from && a.to == b.to && same(a.axis, b.axis);
}

/// Calls for what came, what changed (in itself or in its place) and what went.
template <class Item, class Same, class Came, class Changed, class Went>
void compare(const std::vector<Item>& before, const std::vector<Item>& after, const Same& is_same,
             const Came& came, const Changed& changed, const Went& went) {
  std::unordered_map<std::int32_t, std::size_t> old;
  for (std::size_t i = 0; i < before.size(); ++i) old.emplace(before[i].id, i);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto found = old.find(after[i].id);
    if (found == old.end()) {
      came(i);
      continue;
    }
    if (found->second != i || !is_same(found->second, i)) changed(found->second, i);
    old.erase(found);
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (old.contains(before[i].id)) went(i);
}

/// The cheap part of lumen::find_fault, for the vessels that an edit touched.
void require_sound(const VesselLumen& lumen, std::int64_t next_sample_id) {
  const auto fault = [&](const std::string& what) {
    throw Error("the edit would leave " + what + " on vessel " + std::to_string(lumen.vessel) +
                "; it is refused, and the case is what it was");
  };
  if (lumen.samples.empty()) fault("no samples");
  std::unordered_set<std::int64_t> ids;
  for (std::size_t i = 0; i < lumen.samples.size(); ++i) {
    const SurfaceSample& sample = lumen.samples[i];
    if (!sample.position.allFinite() || !std::isfinite(sample.s_mm) ||
        !(std::abs(sample.normal.norm() - 1.0) <= 1e-6))
      fault("a sample that is not finite or without a unit normal");
    if (sample.id >= next_sample_id || !ids.insert(sample.id).second)
      fault("a repeated or unknown sample id");
    if (i > 0 && !lumen::canonical_order(lumen.samples[i - 1], sample)) fault("samples out of order");
  }
}

std::string taken(void* buffer, int size) {
  std::string bytes(static_cast<const char*>(buffer ? buffer : ""), static_cast<std::size_t>(size));
  sqlite3_free(buffer);
  return bytes;
}

void* raw(const std::string& bytes) {
  return const_cast<char*>(bytes.data());
}

struct Writing {
  ModelRows& rows;
  std::uint64_t& sum;

  /// Nodes or segments.
  template <class Item>
  void items(const std::vector<Item>& before, const std::vector<Item>& after) {
    compare(
        before, after, [&](std::size_t i, std::size_t k) { return same_item(before[i], after[k]); },
        [&](std::size_t k) {
          rows.insert(after[k], k);
          sum += sum_of(after[k], k);
        },
        [&](std::size_t i, std::size_t k) {
          rows.update(after[k], k);
          sum += sum_of(after[k], k) - sum_of(before[i], i);
        },
        [&](std::size_t i) {
          rows.erase(before[i]);
          sum -= sum_of(before[i], i);
        });
  }

  void vessels(const LumenModel& before, const LumenModel& after) {
    const auto sum_at = [](const LumenModel& model, std::size_t i) {
      return sum_of(model.tree.vessels[i], *model.vessels[i], i);
    };
    compare(
        before.tree.vessels, after.tree.vessels,
        [&](std::size_t i, std::size_t k) { return sum_at(before, i) == sum_at(after, k); },
        [&](std::size_t k) {
          rows.insert(after.tree.vessels[k], *after.vessels[k], k);
          sum += sum_at(after, k);
        },
        [&](std::size_t i, std::size_t k) {
          rows.update(after.tree.vessels[k], *after.vessels[k], k);
          sum += sum_at(after, k) - sum_at(before, i);
        },
        [&](std::size_t i) {
          rows.erase_vessel(before.tree.vessels[i].id);
          sum -= sum_at(before, i);
        });
  }

  void samples(const VesselLumen* before, const VesselLumen* after) {
    if (before == after) return;
    const std::int32_t vessel = (before ? before : after)->vessel;
    std::unordered_map<std::int64_t, const SurfaceSample*> old;
    if (before) {
      old.reserve(before->samples.size());
      for (const SurfaceSample& sample : before->samples) old.emplace(sample.id, &sample);
    }
    if (after) {
      for (const SurfaceSample& sample : after->samples) {
        const auto found = old.find(sample.id);
        if (found == old.end()) {
          rows.insert(sample, vessel);
          sum += sum_of(sample, vessel);
          continue;
        }
        if (!same(*found->second, sample)) {
          rows.update(sample, vessel);
          sum += sum_of(sample, vessel) - sum_of(*found->second, vessel);
        }
        old.erase(found);
      }
    }
    if (!before) return;
    for (const SurfaceSample& sample : before->samples) {
      if (!old.contains(sample.id)) continue;
      rows.erase_sample(sample.id, vessel);
      sum -= sum_of(sample, vessel);
    }
  }

  void walls(const LumenModel& before, const LumenModel& after) {
    std::unordered_map<std::int32_t, const VesselLumen*> old;
    for (const auto& lumen : before.vessels) old.emplace(lumen->vessel, lumen.get());
    for (const auto& lumen : after.vessels) {
      const auto found = old.find(lumen->vessel);
      samples(found == old.end() ? nullptr : found->second, lumen.get());
      old.erase(lumen->vessel);
    }
    for (const auto& lumen : before.vessels)
      if (old.contains(lumen->vessel)) samples(lumen.get(), nullptr);
  }

  void all(const LumenModel& before, const LumenModel& after) {
    items(before.tree.nodes, after.tree.nodes);
    items(before.tree.segments, after.tree.segments);
    vessels(before, after);
    walls(before, after);
  }
};

/// The axis of a vessel, that of the former model where its way is the same.
std::shared_ptr<const geometry::AxisCurve> axis_as_before(const LumenModel& before, const LumenModel& after,
                                                          const Vessel& vessel) {
  for (std::size_t i = 0; i < before.tree.vessels.size(); ++i) {
    const Vessel& old = before.tree.vessels[i];
    if (old.id != vessel.id || old.segments != vessel.segments) continue;
    const bool same_axes = std::all_of(old.segments.begin(), old.segments.end(), [&](std::int32_t id) {
      return same(geometry::segment(before.tree, id).axis, geometry::segment(after.tree, id).axis);
    });
    if (same_axes) return before.vessels[i]->axis;
  }
  return axis_of(after.tree, vessel);
}

void require_no_fault(const LumenModel& model) {
  if (const auto fault = lumen::find_fault(model)) throw InvalidInput("the case is damaged: " + *fault);
}

}  // namespace

void add_touched(const Database& database, const std::string& changeset, Touched& touched) {
  sqlite3_changeset_iter* iterator = nullptr;
  database.check(sqlite3changeset_start(&iterator, static_cast<int>(changeset.size()), raw(changeset)),
                 "use");
  while (sqlite3changeset_next(iterator) == SQLITE_ROW) {
    const char* name = nullptr;
    int columns = 0, op = 0, indirect = 0;
    sqlite3changeset_op(iterator, &name, &columns, &op, &indirect);
    const std::string_view table(name ? name : "");
    if (table == "annotation" || table == "measurement" || table == "mark" || table == "evaluability" ||
        table == "lesion" || table == "pressure_input" || table == "what_if" || table == "report_note" ||
        table == "report_version")
      touched.annotations = true;
    else
      touched.model = true;
    if (table == "node" || table == "segment" || table == "vessel") touched.tree = true;
    if (table != "sample" && table != "vessel") continue;
    sqlite3_value* key = nullptr;
    if (op == SQLITE_INSERT)
      sqlite3changeset_new(iterator, 0, &key);
    else
      sqlite3changeset_old(iterator, 0, &key);
    if (key) touched.vessels.insert(sqlite3_value_int(key));
  }
  database.check(sqlite3changeset_finalize(iterator), "use");
}

Recording::Recording(const Database& database) : database_(&database) {
  database.check(sqlite3session_create(database.get(), "main", &session_), "use");
  for (const char* table : recorded_tables) database.check(sqlite3session_attach(session_, table), "use");
}

std::string Recording::changeset() const {
  int size = 0;
  void* buffer = nullptr;
  database_->check(sqlite3session_changeset(session_, &size, &buffer), "use");
  return taken(buffer, size);
}

std::string joined(const Database& database, const std::string& first, const std::string& then) {
  int size = 0;
  void* buffer = nullptr;
  database.check(sqlite3changeset_concat(static_cast<int>(first.size()), raw(first),
                                         static_cast<int>(then.size()), raw(then), &size, &buffer),
                 "use");
  return taken(buffer, size);
}

std::string inverse(const Database& database, const std::string& changeset) {
  int size = 0;
  void* buffer = nullptr;
  database.check(
      sqlite3changeset_invert(static_cast<int>(changeset.size()), changeset.data(), &size, &buffer), "use");
  return taken(buffer, size);
}

void apply_changeset(const Database& database, const std::string& changeset) {
  const auto refuse = [](void*, int, sqlite3_changeset_iter*) { return SQLITE_CHANGESET_ABORT; };
  const int code = sqlite3changeset_apply(database.get(), static_cast<int>(changeset.size()), raw(changeset),
                                          nullptr, refuse, nullptr);
  if (code == SQLITE_ABORT)
    throw InvalidInput("the case " + database.shown() +
                       " is damaged: a step of its journal does not fit its model; nothing was changed");
  database.check(code, "write");
}

void ModelStore::write(const LumenModel& model) {
  std::uint64_t sum = sum_of(row_of(model));
  Writing{rows_, sum}.all({}, model);
  rows_.insert(row_of(model), sum);
}

void ModelStore::write_change(const LumenModel& before, const LumenModel& after, std::uint64_t& checksum) {
  if (after.vessels.size() != after.tree.vessels.size()) throw Error("a model's walls are not its tree's");
  for (const auto& lumen : after.vessels)
    if (std::find(before.vessels.begin(), before.vessels.end(), lumen) == before.vessels.end())
      require_sound(*lumen, after.next_sample_id);
  std::uint64_t sum = checksum + sum_of(row_of(after)) - sum_of(row_of(before));
  Writing{rows_, sum}.all(before, after);
  rows_.update(row_of(after), sum);
  checksum = sum;
}

LumenModel ModelStore::read(std::uint64_t& checksum) {
  LumenModel model;
  const ModelRow row = rows_.read_model(checksum);
  model.blend = row.blend;
  model.next_sample_id = row.next_sample_id;
  model.next_tree_id = row.next_tree_id;
  std::vector<VesselLumen> lumens;
  model.tree = rows_.read_tree(lumens);
  if (const auto fault = geometry::find_fault(model.tree))
    throw InvalidInput("the case is damaged: " + *fault);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < lumens.size(); ++i) {
    lumens[i].axis = axis_of(model.tree, model.tree.vessels[i]);
    lumens[i].samples = rows_.read_samples(lumens[i].vessel);
    count += static_cast<std::int64_t>(lumens[i].samples.size());
    model.vessels.push_back(std::make_shared<const VesselLumen>(std::move(lumens[i])));
  }
  if (count != rows_.count_samples()) throw InvalidInput("the case is damaged: samples of unknown vessels");
  require_no_fault(model);
  if (sum_of(model) != checksum)
    throw InvalidInput("the case is damaged: the model's checksum is not that of its rows");
  return model;
}

LumenModel ModelStore::read_again(const LumenModel& before, const Touched& touched, std::uint64_t& checksum) {
  LumenModel model;
  const ModelRow row = rows_.read_model(checksum);
  model.blend = row.blend;
  model.next_sample_id = row.next_sample_id;
  model.next_tree_id = row.next_tree_id;
  std::vector<VesselLumen> lumens;
  if (touched.tree || !touched.vessels.empty())
    model.tree = rows_.read_tree(lumens);
  else
    model.tree = before.tree;
  if (lumens.empty()) {
    model.vessels = before.vessels;
    return model;
  }
  for (std::size_t i = 0; i < lumens.size(); ++i) {
    const Vessel& vessel = model.tree.vessels[i];
    const auto old = std::find_if(before.vessels.begin(), before.vessels.end(),
                                  [&](const auto& lumen) { return lumen->vessel == vessel.id; });
    auto axis =
        touched.tree || old == before.vessels.end() ? axis_as_before(before, model, vessel) : (*old)->axis;
    if (old != before.vessels.end() && !touched.vessels.contains(vessel.id) && axis == (*old)->axis) {
      model.vessels.push_back(*old);
      continue;
    }
    lumens[i].axis = std::move(axis);
    lumens[i].samples = rows_.read_samples(vessel.id);
    model.vessels.push_back(std::make_shared<const VesselLumen>(std::move(lumens[i])));
  }
  return model;
}

}  // namespace ostia::session
