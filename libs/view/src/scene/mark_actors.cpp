#include "scene/mark_actors.h"

#include "ostia/view/label_layout.h"

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::view {
namespace {

using figure::Color;
using geometry::Vec2;

constexpr Color cursor_color{0.98, 0.90, 0.25, 1.0};
constexpr Color first_cpr{0.34, 0.71, 0.91, 1.0}, second_cpr{0.90, 0.62, 0.0, 1.0};
constexpr Color measured{0.40, 0.90, 0.75, 1.0}, measured_on_light{0.0, 0.42, 0.32, 1.0};
constexpr Color chosen{1.0, 0.85, 0.25, 1.0}, chosen_on_light{0.70, 0.30, 0.0, 1.0};

constexpr double label_units = 13.0;

Color measurement_color(bool is_chosen, figure::Look look) {
  if (look == figure::Look::light) return is_chosen ? chosen_on_light : measured_on_light;
  return is_chosen ? chosen : measured;
}

Vec2 shown_at(const Vec3& place, const CameraPose& pose, int width_px, int height_px) {
  const double px_per_mm = 0.5 * height_px / pose.half_height_mm;
  const Vec3 off = px_per_mm * (place - pose.target);
  return {0.5 * width_px + off.dot(pose.right()), 0.5 * height_px - off.dot(pose.up)};
}

std::array<Vec3, 4> corners(const reformat::Plane& plane) {
  const Vec3 right = plane.width * plane.pixel_mm * plane.u, down = plane.height * plane.pixel_mm * plane.v;
  return {plane.origin, plane.origin + right, plane.origin + right + down, plane.origin + down};
}

vtkSmartPointer<vtkTexture> texture_of(const ScenePlanePicture& picture) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.plane.width, picture.plane.height, 1);
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetNumberOfValues(static_cast<vtkIdType>(picture.gray.size()));
  std::copy(picture.gray.begin(), picture.gray.end(), bytes->GetPointer(0));
  image->GetPointData()->SetScalars(bytes);
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->RepeatOff();
  texture->EdgeClampOn();
  texture->SetColorModeToDirectScalars();
  return texture;
}

vtkSmartPointer<vtkActor> picture_actor(const ScenePlanePicture& picture) {
  vtkNew<vtkPoints> points;
  for (const Vec3& corner : corners(picture.plane)) points->InsertNextPoint(corner.data());
  vtkNew<vtkCellArray> cells;
  const std::array<vtkIdType, 4> quad{0, 1, 2, 3};
  cells->InsertNextCell(4, quad.data());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  coordinates->InsertNextTuple2(0.0, 0.0);
  coordinates->InsertNextTuple2(1.0, 0.0);
  coordinates->InsertNextTuple2(1.0, 1.0);
  coordinates->InsertNextTuple2(0.0, 1.0);
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(cells);
  shape->GetPointData()->SetTCoords(coordinates);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetTexture(texture_of(picture));
  actor->GetProperty()->LightingOff();
  actor->PickableOff();
  return actor;
}

}  // namespace

MarkActors::MarkActors(vtkRenderer& renderer)
    : renderer_(renderer), leaders_(vtkSmartPointer<vtkPolyData>::New()) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(leaders_);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->PickableOff();
  renderer.AddViewProp(actor);
}

void MarkActors::replace(Props& former, Props props) {
  for (const auto& prop : former) renderer_.RemoveViewProp(prop);
  former = std::move(props);
  for (const auto& prop : former) renderer_.AddViewProp(prop);
}

void MarkActors::show_all(const Marks& marks) {
  show_cursor(marks);
  show_measurements(marks);
  show_draft(marks);
  show_axes(marks);
  for (const ScenePlane plane : {ScenePlane::cross_section, ScenePlane::axial, ScenePlane::coronal,
                                 ScenePlane::sagittal, ScenePlane::oblique})
    show_plane(marks, plane);
}

void MarkActors::show_cursor(const Marks& marks) {
  Props props;
  if (marks.cursor) {
    const SceneCursor& at = *marks.cursor;
    const auto direction = [&](double theta) { return geometry::radial_direction(at.frame, theta); };
    const double right_angle = 0.5 * std::numbers::pi;
    const SceneLine ring{circle(at.place, direction(0.0), direction(right_angle), at.radius_mm), true,
                         cursor_color};
    const auto solid = line_actor({&ring, 1}, 3.0 * marks.pixel_ratio);
    props.emplace_back(solid);
    const auto hidden_part = line_actor({&ring, 1}, 1.5 * marks.pixel_ratio);  // a hint of what lies behind
    hidden_part->GetProperty()->SetOpacity(0.4);
    draw_over_all(*hidden_part);
    props.emplace_back(hidden_part);
    const auto under_ball =
        point_actor({&at.place, 1}, figure::theme(marks.look).background, 10.5 * marks.pixel_ratio);
    draw_over_all(*under_ball);
    props.emplace_back(under_ball);
    const auto ball = point_actor({&at.place, 1}, cursor_color, 8.0 * marks.pixel_ratio);
    draw_over_all(*ball);
    props.emplace_back(ball);
    if (at.plane_traces) {
      const auto trace = [&](double theta, const Color& color) {
        const Vec3 reach = 1.6 * at.radius_mm * direction(theta);
        return SceneLine{{at.place - reach, at.place + reach}, false, color};
      };
      const std::array<SceneLine, 2> traces{trace(at.theta, first_cpr),
                                            trace(at.theta + right_angle, second_cpr)};
      const auto lines = line_actor(traces, 2.0 * marks.pixel_ratio);
      draw_over_all(*lines);
      props.emplace_back(lines);
    }
  }
  replace(cursor_, std::move(props));
}

/// Lines and dots with a rim that sets them off from whatever lies behind, and the label.
void MarkActors::add_measurement(Props& props, std::vector<Label>& labels,
                                 const SceneMeasurement& measurement, const Marks& marks, bool chosen) {
  const Color color = measurement_color(chosen, marks.look), rim = figure::theme(marks.look).background;
  const double thick = (chosen ? 3.0 : 2.0) * marks.pixel_ratio, rim_px = 2.5 * marks.pixel_ratio;
  const double dot = 2.0 * thick + 3.0 * marks.pixel_ratio;
  const auto add = [&](const vtkSmartPointer<vtkActor>& actor) {
    draw_over_all(*actor);
    props.emplace_back(actor);
  };
  const auto add_lines = [&](const Color& with, double width) {
    std::vector<SceneLine> lines;
    for (SceneCurve& curve : curves_of(measurement))
      lines.push_back({std::move(curve.points), curve.closed, with});
    if (!lines.empty()) add(line_actor(lines, width));
  };
  add_lines(rim, thick + rim_px);
  if (measurement.dots) add(point_actor(measurement.points, rim, dot + rim_px));
  add_lines(color, thick);
  if (measurement.dots) add(point_actor(measurement.points, color, dot));
  if (measurement.label.empty()) return;
  const double size = label_units * marks.pixel_ratio;
  const auto label = label_actor(measurement.label, color, rim, size);
  labels.push_back({measurement.label_at ? std::vector{*measurement.label_at} : measurement.points, label,
                    curves_of(measurement), measurement.id, color});
  props.emplace_back(label);
}

void MarkActors::show_measurements(const Marks& marks) {
  Props props;
  labels_.clear();
  for (const SceneMeasurement& measurement : marks.measurements)
    add_measurement(props, labels_, measurement, marks, measurement.selected);
  replace(measurements_, std::move(props));
}

void MarkActors::show_draft(const Marks& marks) {
  Props props;
  draft_labels_.clear();
  if (marks.draft) add_measurement(props, draft_labels_, *marks.draft, marks, true);
  replace(draft_, std::move(props));
}

std::vector<LabelLine> MarkActors::lines_of(const Label& label, const CameraPose& pose, int width_px,
                                            int height_px) const {
  std::vector<LabelLine> lines;
  for (const SceneCurve& curve : label.curves) {
    const std::size_t count = curve.points.size();
    for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < count; ++i)
      lines.push_back({shown_at(curve.points[i], pose, width_px, height_px),
                       shown_at(curve.points[(i + 1) % count], pose, width_px, height_px)});
  }
  return lines;
}

/// Beside the place that is farthest to the right; view::place_labels counts y downwards, VTK upwards.
void MarkActors::lay_out(const CameraPose& pose, int width_px, int height_px, double pixel_ratio,
                         std::vector<LabelRect> taken) {
  const auto anchor_of = [&](const Label& label) {
    const Vec3 place =
        *std::max_element(label.places.begin(), label.places.end(),
                          [&](const Vec3& a, const Vec3& b) { return (a - b).dot(pose.right()) < 0.0; });
    return shown_at(place, pose, width_px, height_px);
  };
  texts_.clear();
  std::vector<const Label*> labels;
  std::vector<LabelWish> wishes;
  for (const std::vector<Label>* some : {&draft_labels_, &labels_})
    for (const Label& label : *some) {
      labels.push_back(&label);
      std::array<double, 2> size{};
      label.actor->GetSize(&renderer_, size.data());
      wishes.push_back({anchor_of(label),
                        {size[0] + 2.0 * pixel_ratio, size[1] + 2.0 * pixel_ratio},
                        {},
                        lines_of(label, pose, width_px, height_px)});
      if (const auto was = offsets_.find(label.id); was != offsets_.end()) wishes.back().before = was->second;
    }
  const std::vector<PlacedLabel> placed =
      place_labels(wishes, {{double(width_px), double(height_px)}, 7.0 * pixel_ratio, std::move(taken)});
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  offsets_.clear();
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Label& label = *labels[i];
    label.actor->SetVisibility(placed[i].shown);
    if (!placed[i].shown) continue;
    const LabelRect& rect = placed[i].rect;
    offsets_[label.id] = rect.low - wishes[i].anchor;
    texts_.push_back({label.actor->GetInput(), rect, wishes[i].lines});
    label.actor->SetDisplayPosition(static_cast<int>(std::lround(rect.low.x())),
                                    static_cast<int>(std::lround(height_px - rect.low.y() - rect.size.y())));
    if (!placed[i].leader_to) continue;
    const auto add = [&](const Vec2& p) { return points->InsertNextPoint(p.x(), height_px - p.y(), 0.0); };
    const std::array<vtkIdType, 2> ends{add(wishes[i].anchor), add(*placed[i].leader_to)};
    lines->InsertNextCell(2, ends.data());
    colors->InsertNextTuple3(255.0 * label.color.r, 255.0 * label.color.g, 255.0 * label.color.b);
  }
  leaders_->Initialize();
  leaders_->SetPoints(points);
  leaders_->SetLines(lines);
  leaders_->GetCellData()->SetScalars(colors);
}

void MarkActors::show_plane(const Marks& marks, ScenePlane plane) {
  Props props;
  const auto found = marks.planes.find(plane);
  if (found != marks.planes.end()) {
    props.emplace_back(picture_actor(found->second));
    const auto edge = corners(found->second.plane);
    const SceneLine border{{edge.begin(), edge.end()}, true, figure::theme(marks.look).muted};
    props.emplace_back(line_actor({&border, 1}, marks.pixel_ratio));
  }
  replace(planes_[plane], std::move(props));
}

void MarkActors::show_axes(const Marks& marks) {
  Props props;
  if (marks.axes_shown && !marks.axes.empty()) {
    const auto actor = line_actor(marks.axes, 2.0 * marks.pixel_ratio);
    draw_over_all(*actor);
    props.emplace_back(actor);
  }
  replace(axes_, std::move(props));
}

}  // namespace ostia::view
