#include "scene/scene_overlay.h"

#include "scene/scene_lines.h"

#include "ostia/core/text.h"
#include "ostia/geometry/carm_words.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::view {
namespace {

using figure::Color;
using geometry::Vec2;

/// Coloured quadrilaterals in pixels from the lower left corner.
class Quads {
 public:
  void add(const std::array<Vec2, 4>& corners, const Color& color) {
    std::array<vtkIdType, 4> ids{};
    for (std::size_t i = 0; i < 4; ++i)
      ids[i] = points_->InsertNextPoint(corners[i].x(), corners[i].y(), 0.0);
    cells_->InsertNextCell(4, ids.data());
    colors_->InsertNextTuple3(255.0 * color.r, 255.0 * color.g, 255.0 * color.b);
  }
  void add_box(double left, double low, double wide, double high, const Color& color) {
    add({Vec2(left, low), Vec2(left + wide, low), Vec2(left + wide, low + high), Vec2(left, low + high)},
        color);
  }
  void put_into(vtkPolyData& shape) {
    shape.SetPoints(points_);
    shape.SetPolys(cells_);
    colors_->SetName("colors");
    shape.GetCellData()->SetScalars(colors_);
  }
  Quads() { colors_->SetNumberOfComponents(3); }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  vtkNew<vtkUnsignedCharArray> colors_;
};

void put(vtkTextActor& actor, const std::string& text, const Vec2& at, const Color& color, double size_px) {
  actor.SetInput(text.c_str());
  set_font(*actor.GetTextProperty(), color, size_px);
  actor.SetDisplayPosition(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
  actor.VisibilityOn();
}

struct CubeFace {
  Vec3 normal, right, up;  // as one who looks at the face from outside sees it
  const char* letter;
};
/// The patient's directions in LPS.
const std::array<CubeFace, 6>& cube_faces() {
  static const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  static const std::array<CubeFace, 6> faces{CubeFace{x, y, z, "L"},  CubeFace{-x, -y, z, "R"},
                                             CubeFace{y, -x, z, "P"}, CubeFace{-y, x, z, "A"},
                                             CubeFace{z, x, -y, "S"}, CubeFace{-z, x, y, "I"}};
  return faces;
}

}  // namespace

std::vector<SceneText> SceneOverlay::texts() const {
  std::vector<SceneText> all;
  const auto add = [&](vtkTextActor* text) {
    if (const std::optional<LabelRect> rect = rect_of(*text, renderer_, height_px_))
      all.push_back({text->GetInput(), *rect});
  };
  for (const auto& letter : letters_) add(letter);
  for (const auto& text : bar_texts_) add(text);
  for (vtkTextActor* text : {ruler_text_.Get(), bar_title_.Get(), angles_.Get()}) add(text);
  if (corner_.rect()) all.push_back({corner_.text(), *corner_.rect()});
  return all;
}

std::vector<LabelRect> SceneOverlay::taken() const {
  std::vector<LabelRect> all = pictures_;
  for (const SceneText& one : texts()) all.push_back(one.rect);
  return all;
}

void SceneOverlay::keep_within(vtkTextActor& text, int width_px, double room_px) {
  std::optional<LabelRect> rect = rect_of(text, renderer_, height_px_);
  vtkTextProperty& font = *text.GetTextProperty();
  for (int size = font.GetFontSize(); rect && rect->size.x() > room_px && size > 6;) {
    font.SetFontSize(--size);
    rect = rect_of(text, renderer_, height_px_);
  }
  if (!rect) return;
  const double over =
      std::max(0.0, rect->low.x() + rect->size.x() - (width_px - 2.0)) - std::max(0.0, 2.0 - rect->low.x());
  const double* at = text.GetPosition();
  if (over != 0.0)
    text.SetDisplayPosition(static_cast<int>(std::floor(at[0] - over)), static_cast<int>(std::lround(at[1])));
}

double scale_bar_mm(double mm_per_px, int width_px) {
  const double most = 0.25 * mm_per_px * width_px;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0})
    if (step * power <= most) return step * power;
  return power;
}

SceneOverlay::Flat SceneOverlay::make_flat(vtkRenderer& renderer) {
  Flat flat{vtkSmartPointer<vtkPolyData>::New(), vtkSmartPointer<vtkActor2D>::New()};
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(flat.shape);
  flat.actor->SetMapper(mapper);
  flat.actor->PickableOff();
  flat.actor->VisibilityOff();
  renderer.AddViewProp(flat.actor);
  return flat;
}

vtkSmartPointer<vtkTextActor> SceneOverlay::make_text(vtkRenderer& renderer) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetTextProperty()->SetVerticalJustificationToCentered();
  actor->PickableOff();
  actor->VisibilityOff();
  renderer.AddViewProp(actor);
  return actor;
}

SceneOverlay::SceneOverlay(vtkRenderer& renderer)
    : renderer_(renderer),
      corner_(renderer),
      cube_(make_flat(renderer)),
      ruler_(make_flat(renderer)),
      bar_(make_flat(renderer)),
      lasso_(make_flat(renderer)),
      frame_(make_flat(renderer)),
      grips_(make_flat(renderer)) {
  for (auto& letter : letters_) letter = make_text(renderer);
  ruler_text_ = make_text(renderer);
  bar_title_ = make_text(renderer);
  angles_ = make_text(renderer);
  angles_->GetTextProperty()->SetJustificationToLeft();
  for (auto& text : bar_texts_) text = make_text(renderer);
}

void SceneOverlay::lay_out(const CameraPose& pose, int width_px, int height_px,
                           const OverlaySettings& settings) {
  height_px_ = height_px;
  pictures_.clear();
  corner_.lay_out(static_cast<int>(std::lround(8.0 * settings.pixel_ratio)),
                  static_cast<int>(std::lround((settings.marker_shown ? 76.0 : 8.0) * settings.pixel_ratio)),
                  height_px);
  lay_out_marker(pose, settings);
  lay_out_scale_bar(pose, width_px, height_px, settings);
  lay_out_color_bar(width_px, height_px, settings);
  lay_out_angles(pose, height_px, settings);
  lay_out_lasso(settings);
  lay_out_frame(pose, width_px, height_px, settings);
}

void SceneOverlay::lay_out_marker(const CameraPose& pose, const OverlaySettings& settings) {
  for (auto& letter : letters_) letter->VisibilityOff();
  cube_.actor->SetVisibility(settings.marker_shown);
  if (!settings.marker_shown) return;
  const double half = 17.0 * settings.pixel_ratio;
  const Vec2 centre = Vec2::Constant(half * 1.74 + 10.0 * settings.pixel_ratio);
  pictures_.push_back(
      {{centre.x() - 1.74 * half, height_px_ - centre.y() - 1.74 * half}, Vec2::Constant(2.0 * 1.74 * half)});
  const auto seen = [&](const Vec3& direction) {
    return Vec2(direction.dot(pose.right()), direction.dot(pose.up));
  };
  const figure::Theme theme = figure::theme(settings.look);
  Quads quads;
  for (std::size_t f = 0; f < 6; ++f) {
    const CubeFace& face = cube_faces()[f];
    const double facing = face.normal.dot(pose.towards);
    if (facing < 1e-3) continue;
    const auto corner = [&](double r, double u) -> Vec2 {
      return centre + half * seen(face.normal + r * face.right + u * face.up);
    };
    const double inner = 0.93;  // a rim shows where faces meet
    quads.add({corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, theme.muted);
    quads.add({corner(-inner, -inner), corner(inner, -inner), corner(inner, inner), corner(-inner, inner)},
              figure::mixed(theme.panel, theme.foreground, 0.10 + 0.25 * facing));
    if (facing > 0.35)
      put(*letters_[f], face.letter, centre + half * seen(face.normal), theme.foreground,
          (10.0 + 8.0 * facing) * settings.pixel_ratio);
  }
  quads.put_into(*cube_.shape);
}

void SceneOverlay::lay_out_scale_bar(const CameraPose& pose, int width_px, int height_px,
                                     const OverlaySettings& settings) {
  ruler_.actor->SetVisibility(settings.scale_bar_shown);
  ruler_text_->VisibilityOff();
  if (!settings.scale_bar_shown || height_px < 1) return;
  const double mm_per_px = 2.0 * pose.half_height_mm / height_px;
  const double length_mm = scale_bar_mm(mm_per_px, width_px), length_px = length_mm / mm_per_px;
  const double unit = settings.pixel_ratio, thick = std::max(1.0, std::round(2.0 * unit));
  const double left = std::round(width_px - 16.0 * unit - length_px), low = std::round(16.0 * unit);
  const Color color = figure::theme(settings.look).foreground;
  Quads quads;
  quads.add_box(left, low, length_px, thick, color);
  quads.add_box(left, low, thick, 7.0 * unit, color);
  quads.add_box(left + length_px - thick, low, thick, 7.0 * unit, color);
  quads.put_into(*ruler_.shape);
  put(*ruler_text_, core::significant_text(length_mm, 3) + " mm",
      Vec2(left + 0.5 * length_px, low + 15.0 * unit), color, 13.0 * unit);
  keep_within(*ruler_text_, width_px, width_px);
  pictures_.push_back({{left, height_px - low - 8.0 * unit}, {length_px, 8.0 * unit}});
}

/// At the upper left, as the catheter laboratory writes them.
void SceneOverlay::lay_out_angles(const CameraPose& pose, int height_px, const OverlaySettings& settings) {
  angles_->VisibilityOff();
  if (!settings.angles_shown) return;
  const double unit = settings.pixel_ratio;
  put(*angles_, geometry::text_of(carm_angles(pose)), Vec2(10.0 * unit, height_px - 16.0 * unit),
      figure::theme(settings.look).foreground, 14.0 * unit);
}

void SceneOverlay::lay_out_lasso(const OverlaySettings& settings) {
  const std::vector<Vec2>& corners = settings.lasso;
  lasso_.actor->SetVisibility(corners.size() > 1);
  if (corners.size() < 2) return;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> line;
  line->InsertNextCell(static_cast<int>(corners.size()) + 1);
  for (const Vec2& corner : corners)
    line->InsertCellPoint(points->InsertNextPoint(corner.x(), corner.y(), 0.0));
  line->InsertCellPoint(0);
  lasso_.shape->SetPoints(points);
  lasso_.shape->SetLines(line);
  lasso_.actor->GetProperty()->SetColor(1.0, 0.85, 0.2);
  lasso_.actor->GetProperty()->SetLineWidth(static_cast<float>(2.0 * settings.pixel_ratio));
}

void SceneOverlay::lay_out_frame(const CameraPose& pose, int width_px, int height_px,
                                 const OverlaySettings& settings) {
  const SceneFrame& frame = settings.frame;
  frame_.actor->SetVisibility(!frame.lines.empty());
  grips_.actor->SetVisibility(!frame.grips.empty());
  if (height_px < 1) return;
  const double px_per_mm = height_px / (2.0 * pose.half_height_mm), unit = settings.pixel_ratio;
  const auto seen = [&](const Vec3& place) -> Vec2 {
    const Vec3 off = place - pose.target;
    return Vec2(0.5 * width_px, 0.5 * height_px) + px_per_mm * Vec2(off.dot(pose.right()), off.dot(pose.up));
  };
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const std::array<Vec3, 2>& line : frame.lines) {
    lines->InsertNextCell(2);
    for (const Vec3& end : line) {
      const Vec2 at = seen(end);
      lines->InsertCellPoint(points->InsertNextPoint(at.x(), at.y(), 0.0));
    }
  }
  frame_.shape->SetPoints(points);
  frame_.shape->SetLines(lines);
  frame_.actor->GetProperty()->SetColor(1.0, 0.85, 0.2);
  frame_.actor->GetProperty()->SetOpacity(0.7);
  frame_.actor->GetProperty()->SetLineWidth(static_cast<float>(1.2 * unit));
  Quads quads;
  const Color gold{1.0, 0.85, 0.2}, held{1.0, 1.0, 1.0}, edge{0.1, 0.1, 0.1};
  for (std::size_t n = 0; n < frame.grips.size(); ++n) {
    const Vec2 at = seen(frame.grips[n]);
    const double half = (frame.held == static_cast<int>(n) ? 6.5 : 5.0) * unit, rim = half + unit;
    quads.add_box(at.x() - rim, at.y() - rim, 2.0 * rim, 2.0 * rim, edge);
    quads.add_box(at.x() - half, at.y() - half, 2.0 * half, 2.0 * half,
                  frame.held == static_cast<int>(n) ? held : gold);
  }
  quads.put_into(*grips_.shape);
}

void SceneOverlay::lay_out_color_bar(int width_px, int height_px, const OverlaySettings& settings) {
  bar_.actor->SetVisibility(settings.color_bar.has_value());
  bar_title_->VisibilityOff();
  for (auto& text : bar_texts_) text->VisibilityOff();
  if (!settings.color_bar) return;
  const ValueScale& scale = *settings.color_bar;
  const double unit = settings.pixel_ratio;
  const double wide = 12.0 * unit, high = std::max(40.0, 0.4 * height_px);
  // Numbers of the usual length; longer ones push the bar inwards.
  double widest = 39.0 * unit;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = 0.5 * static_cast<double>(i);
    bar_texts_[i]->GetTextProperty()->SetJustificationToLeft();
    put(*bar_texts_[i], range_text(scale.low + t * (scale.high - scale.low), {scale.low, scale.high}),
        Vec2::Zero(), figure::theme(settings.look).foreground, 13.0 * unit);
    if (const auto rect = rect_of(*bar_texts_[i], renderer_, height_px))
      widest = std::max(widest, rect->size.x());
  }
  const double left = width_px - wide - 11.0 * unit - widest, low = 0.5 * (height_px - high);
  constexpr int steps = 64;
  Quads quads;
  for (int i = 0; i < steps; ++i)
    quads.add_box(left, low + high * i / steps, wide, high / steps + 0.5,
                  scale_color(scale.colors, (i + 0.5) / steps));
  quads.put_into(*bar_.shape);
  const Color color = figure::theme(settings.look).foreground;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = 0.5 * static_cast<double>(i);
    const std::string text = bar_texts_[i]->GetInput();
    put(*bar_texts_[i], text, Vec2(left + wide + 5.0 * unit, low + t * high), color, 13.0 * unit);
  }
  bar_title_->GetTextProperty()->SetJustificationToRight();
  put(*bar_title_, scale.title, Vec2(width_px - 12.0 * unit, low + high + 20.0 * unit), color, 13.0 * unit);
  keep_within(*bar_title_, width_px, width_px - 16.0 * unit);
  pictures_.push_back({{left, height_px - low - high}, {wide, high}});
}

}  // namespace ostia::view
