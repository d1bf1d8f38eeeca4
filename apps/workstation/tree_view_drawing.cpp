// The drawing of a vessel tree: the segments on the graphics card, grid and marks over them.

#include "tree_view.h"

#include <QMatrix4x4>

#include <QOpenGLContext>
#include <QOpenGLShaderProgram>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ostia::workstation {
namespace {

using geometry::Vec3;

struct Instance {
  float from[3], radius_from, to[3], radius_to;
  std::int32_t edge;
};

constexpr const char* vertex_code = R"(#version 330 core
layout(location = 0) in vec4 from;
layout(location = 1) in vec4 to;
layout(location = 2) in int edge;
uniform mat4 view, projection;
uniform float pixel;   // of a length at depth 1
uniform int highlight;
out float side;
out vec3 colour;
void main() {
  vec3 a = (view * vec4(from.xyz, 1)).xyz, b = (view * vec4(to.xyz, 1)).xyz;
  bool end = (gl_VertexID & 2) != 0;
  side = (gl_VertexID & 1) != 0 ? 1.0 : -1.0;
  vec3 at = end ? b : a;
  vec3 across = cross(b - a, -at);
  float most = length(across);
  across = most > 0.0 ? across / most : vec3(1, 0, 0);
  bool chosen = edge == highlight;
  float least = (chosen ? 2.5 : 0.6) * pixel * abs(at.z);
  float radius = end ? to.w : from.w;
  radius = radius > 0.0 ? radius : 0.0;
  gl_Position = projection * vec4(at + side * max(radius * (chosen ? 1.15 : 1.0), least) * across, 1);
  if (chosen) gl_Position.z -= 1e-4 * gl_Position.w;
  colour = chosen ? vec3(1.0, 0.85, 0.1) : vec3(0.80, 0.27, 0.23);
}
)";

constexpr const char* fragment_code = R"(#version 330 core
in float side;
in vec3 colour;
out vec4 result;
void main() {
  result = vec4(colour * (0.35 + 0.65 * sqrt(max(0.0, 1.0 - side * side))), 1);
}
)";

}  // namespace

TreeView::~TreeView() {
  free_buffers();
}

void TreeView::free_buffers() {
  if (!context() || !program_) return;
  makeCurrent();
  program_.reset();
  glDeleteBuffers(1, &buffer_);
  glDeleteVertexArrays(1, &array_);
  doneCurrent();
}

void TreeView::initializeGL() {
  if (!initializeOpenGLFunctions()) {
    trouble_ = tr("The display's OpenGL is older than 3.3: the tree cannot be drawn.");
    return;
  }
  // The context goes before the widget where the widget gets another window.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &TreeView::free_buffers,
          Qt::UniqueConnection);
  program_ = std::make_unique<QOpenGLShaderProgram>();
  if (!program_->addShaderFromSourceCode(QOpenGLShader::Vertex, vertex_code) ||
      !program_->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment_code) || !program_->link()) {
    trouble_ = tr("The graphics driver refuses the tree's drawing: %1").arg(program_->log());
    return;
  }
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &buffer_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Instance), offset(0));
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(Instance), offset(offsetof(Instance, to)));
  glVertexAttribIPointer(2, 1, GL_INT, sizeof(Instance), offset(offsetof(Instance, edge)));
  for (unsigned int i = 0; i < 3; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribDivisor(i, 1);
  }
  glBindVertexArray(0);
  stale_ = true;
}

void TreeView::fill_buffer() {
  const Vec3 centre = 0.5 * (low_ + high_);  // what is far from 0 keeps its digits in single precision
  std::vector<Instance> all;
  all.reserve(graph_->edges.size());
  for (std::size_t e = 0; e < graph_->edges.size(); ++e) {
    if (!shown_.empty() && !shown_[e]) continue;
    const geometry::GraphEdge& edge = graph_->edges[e];
    const Vec3 from = graph_->points[static_cast<std::size_t>(edge.from)] - centre;
    const Vec3 to = graph_->points[static_cast<std::size_t>(edge.to)] - centre;
    if (!from.allFinite() || !to.allFinite()) continue;
    Instance one{};
    for (int a = 0; a < 3; ++a) {
      one.from[a] = static_cast<float>(from[a]);
      one.to[a] = static_cast<float>(to[a]);
    }
    one.radius_from = std::isfinite(edge.radius_from) ? static_cast<float>(edge.radius_from) : 0.0f;
    one.radius_to = std::isfinite(edge.radius_to) ? static_cast<float>(edge.radius_to) : 0.0f;
    one.edge = static_cast<std::int32_t>(e);
    all.push_back(one);
  }
  drawn_ = static_cast<int>(all.size());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size() * sizeof(Instance)), all.data(),
               GL_STATIC_DRAW);
  stale_ = false;
}

void TreeView::draw_tree() {
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  if (stale_) fill_buffer();
  const Vec3 centre = 0.5 * (low_ + high_);
  const Vec3 at = eye() - centre;
  QMatrix4x4 view;
  const Vec3 rows[3] = {right_, up_, back_};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) view(r, c) = static_cast<float>(rows[r][c]);
    view(r, 3) = static_cast<float>(-rows[r].dot(at));
  }
  const double reach = (high_ - low_).norm(), away = at.norm();
  const double far = away + reach, near = std::max(away - reach, 1e-3 * std::min(distance_, far));
  QMatrix4x4 projection;
  projection.perspective(30.0f, static_cast<float>(width()) / static_cast<float>(std::max(1, height())),
                         static_cast<float>(near), static_cast<float>(far));
  program_->bind();
  program_->setUniformValue("view", view);
  program_->setUniformValue("projection", projection);
  program_->setUniformValue("pixel", static_cast<float>(pixel_mm() / distance_));
  program_->setUniformValue("highlight", highlight_);
  glBindVertexArray(array_);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, drawn_);
  glBindVertexArray(0);
  program_->release();
}

void TreeView::paintGL() {
  QPainter painter(this);
  painter.beginNativePainting();
  const QColor back = palette().color(QPalette::Base);
  if (trouble_.isEmpty()) {
    glClearColor(static_cast<float>(back.redF()), static_cast<float>(back.greenF()),
                 static_cast<float>(back.blueF()), 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_tree();
    glDisable(GL_DEPTH_TEST);
  }
  painter.endNativePainting();
  painter.setRenderHint(QPainter::Antialiasing);
  if (!trouble_.isEmpty()) painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, trouble_);
  if (grid_) draw_grid(painter);
  draw_marks(painter);
}

void TreeView::draw_grid(QPainter& painter) const {
  const Vec3 size = high_ - low_;
  const double seen = pixel_mm() * height();
  const analysis::GridScale scale = analysis::grid_scale(std::max(1e-9, std::min(seen, 4.0 * size.norm())));
  // No more lines than can be told apart, however far into a large tree the eye has gone.
  double step = scale.step_mm;
  while (size.maxCoeff() / step > 200.0) step *= 10.0;
  QColor faint = palette().color(QPalette::Text);
  const auto line = [&](const Vec3& a, const Vec3& b) {
    const auto from = place_of(a), to = place_of(b);
    if (from && to) painter.drawLine(*from, *to);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double tick : analysis::grid_ticks(low_[axis], high_[axis], step)) {
      faint.setAlpha(50);
      painter.setPen(faint);
      const int other = axis == 0 ? 1 : 0;  // lines on the floor, and for z on the wall at the least y
      Vec3 a = low_, b = low_;
      a[axis] = b[axis] = tick;
      b[other] = high_[other];
      line(a, b);
      const auto at = place_of(a);
      faint.setAlpha(230);
      painter.setPen(faint);
      if (at)
        painter.drawText(*at + QPointF(3, -3),
                         QStringLiteral("%1 %2").arg(
                             QChar("xyz"[axis]), QString::fromStdString(analysis::tick_text(tick, scale))));
    }
}

void TreeView::draw_marks(QPainter& painter) const {
  for (const TreeMark& mark : marks_) {
    std::optional<QPointF> before;
    QPointF words;
    int seen = 0;
    painter.setPen(QPen(QColor(255, 220, 60), 2.0));
    painter.setBrush(QColor(255, 220, 60));
    for (const Vec3& point : mark.points) {
      const auto at = place_of(point);
      if (!at) continue;
      painter.drawEllipse(*at, 3.0, 3.0);
      if (before) painter.drawLine(*before, *at);
      before = at;
      words += *at;
      ++seen;
    }
    if (seen == 0 || mark.text.isEmpty()) continue;
    const QPointF at = words / seen + QPointF(8, -8);
    const QRectF box =
        painter.fontMetrics().boundingRect(mark.text).translated(at.toPoint()).adjusted(-3, -2, 3, 2);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 0, 0, 170));
    painter.drawRect(box);
    painter.setPen(Qt::white);
    painter.drawText(at, mark.text);
  }
}

}  // namespace ostia::workstation
