// What flows along the selected vessel, in the profile.
#include "flow/bar.h"
#include "flow/results.h"
#include "shell/desk.h"
#include "views/picture_widget.h"

#include "ostia/view/profile_flow.h"

#include <algorithm>
#include <initializer_list>

namespace ostia::workstation {
namespace {

const QString along_job = QStringLiteral("flow_along");

/// The first of these names that there is.
const FlowArray* array_named(const FlowSurface& result, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (const FlowArray& one : result.arrays)
      if (one.name == name) return &one;
  return nullptr;
}

view::WallValues values_of(const FlowArray* array) {
  return array ? view::WallValues{array->values, array->at} : view::WallValues{};
}

}  // namespace

void FlowResults::follow_vessels() {
  connect(bar_, &FlowBar::along_toggled, this, &FlowResults::show_along);
  own_.push_back(desk_.bench.model_changed.observe([this](const session::ModelEvent& event) {
    if (scene_ && event.tree_changed) show_along();  // axes run elsewhere
  }));
}

void FlowResults::show_along() {
  desk_.jobs.cancel(along_job);
  if (!scene_ || !bar_->along() || !desk_.bench.has_case()) {
    profile_.view().set_flow(nullptr);
    return;
  }
  const FlowArray* shear =
      array_named(result_, {"time_averaged_wall_shear_stress_Pa", "wall_shear_stress_Pa"});
  const FlowArray* pressure = array_named(result_, {"pressure_Pa"});
  if (!shear && !pressure) {
    profile_.view().set_flow(nullptr);
    return;
  }
  view::ProfileFlow titles;
  if (shear)
    titles.shear_title = tr("%1: mean (least to greatest)").arg(title_with_unit(*shear)).toStdString();
  if (pressure) titles.pressure_title = title_with_unit(*pressure).toStdString();
  const auto kept = std::make_shared<const FlowSurface>(result_);
  desk_.jobs.run(
      along_job, tr("Flow along the vessels"),
      [model = desk_.bench.session().file().model(), kept, titles,
       shear = shear ? shear - result_.arrays.data() : -1,
       pressure = pressure ? pressure - result_.arrays.data() : -1](const core::TaskContext& task) {
        const auto array = [&](std::ptrdiff_t i) {
          return i < 0 ? nullptr : &kept->arrays[static_cast<std::size_t>(i)];
        };
        auto made = std::make_shared<view::ProfileFlow>(titles);
        made->stations = view::flow_along_vessels(*model, kept->surface->mesh(), values_of(array(shear)),
                                                  values_of(array(pressure)), task);
        return std::any(std::shared_ptr<const view::ProfileFlow>(made));
      },
      [this](const std::any& made) {
        if (scene_ && bar_->along())
          profile_.view().set_flow(std::any_cast<const std::shared_ptr<const view::ProfileFlow>&>(made));
      },
      [this](const QString& message) { desk_.messages.say(message); });
}

}  // namespace ostia::workstation
