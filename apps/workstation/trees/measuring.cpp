#include "trees/measuring.h"

#include "ostia/core/error.h"

#include <locale>
#include <numbers>
#include <sstream>
#include <utility>

namespace ostia::workstation {

std::string name_of(TreeTool tool) {
  switch (tool) {
    case TreeTool::select:
      return "segment";
    case TreeTool::straight:
      return "straight_distance";
    case TreeTool::along:
      return "distance_along_tree";
    case TreeTool::angle:
      return "angle";
    case TreeTool::region:
      return "region";
  }
  return {};
}

std::string measured_csv(const std::vector<TreeMeasured>& measured) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(12);
  out << "kind,value,unit,reference_1,reference_2,x1_mm,y1_mm,z1_mm,x2_mm,y2_mm,z2_mm,segments,length_mm,"
         "area_mm2,volume_mm3\n";
  for (const TreeMeasured& one : measured) {
    out << name_of(one.tool) << ',' << one.value << ',' << one.unit;
    for (std::size_t i = 0; i < 2; ++i) {
      out << ',';
      if (i < one.references.size()) out << one.references[i];
    }
    for (std::size_t i = 0; i < 2; ++i)
      for (int a = 0; a < 3; ++a) {
        out << ',';
        if (i < one.points.size()) out << one.points[i][a];
      }
    if (const auto& t = one.totals)
      out << ',' << t->segments << ',' << t->length_mm << ',' << t->area_mm2 << ',' << t->volume_mm3 << '\n';
    else
      out << ",,,,\n";
  }
  return out.str();
}

void TreeMeasuring::choose(TreeTool tool) {
  tool_ = tool;
  clicked_.clear();
}

void TreeMeasuring::clear() {
  clicked_.clear();
  measured_.clear();
}

TreeMeasured TreeMeasuring::measure(const std::vector<analysis::TreeRayHit>& hits) const {
  TreeMeasured made;
  made.tool = tool_;
  made.unit = "mm";
  for (const analysis::TreeRayHit& hit : hits) {
    made.references.push_back(ruler_->facts(hit.place.edge).reference);
    made.points.push_back(tool_ == TreeTool::straight ? hit.surface : ruler_->point(hit.place));
  }
  if (tool_ == TreeTool::straight) {
    made.value = (hits[0].surface - hits[1].surface).norm();
  } else if (tool_ == TreeTool::along) {
    const auto way = ruler_->along_mm(hits[0].place, hits[1].place);
    if (!way)
      throw InvalidInput(ruler_->why_no_tree().empty()
                             ? "the two places are of two trees: there is no way along vessels between them"
                             : ruler_->why_no_tree());
    made.value = *way;
  } else if (tool_ == TreeTool::angle) {
    const auto angle = ruler_->angle_rad(hits[0].place.edge, hits[1].place.edge);
    if (!angle) throw InvalidInput("one of the two segments has no length: it has no direction");
    made.value = *angle * 180.0 / std::numbers::pi;
    made.unit = "deg";
  } else {
    made.value = region_radius_mm;
    made.totals = ruler_->within(made.points.front(), region_radius_mm);
  }
  return made;
}

std::optional<TreeMeasured> TreeMeasuring::click(const analysis::TreeRayHit& hit) {
  if (tool_ == TreeTool::select) return std::nullopt;
  clicked_.push_back(hit);
  if (clicked_.size() < (tool_ == TreeTool::region ? 1u : 2u)) return std::nullopt;
  const std::vector<analysis::TreeRayHit> hits = std::exchange(clicked_, {});
  measured_.push_back(measure(hits));
  return measured_.back();
}

}  // namespace ostia::workstation
