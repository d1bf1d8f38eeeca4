// The drawing of a vessel tree: the segments on the graphics card, grid and marks over them.

#include "trees/view.h"
#include "views/frame_log.h"

#include "ostia/core/error.h"

#include <QElapsedTimer>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ostia::workstation {
using geometry::Vec3;

TreeView::~TreeView() {
  free_drawing();
}

void TreeView::free_drawing() {
  if (!context() || !drawing_) return;
  makeCurrent();
  drawing_.reset();
  doneCurrent();
}

void TreeView::initializeGL() {
  if (context()->format().version() < qMakePair(3, 3)) {
    trouble_ = tr("The display's OpenGL is older than 3.3: the tree cannot be drawn.");
    return;
  }
  // The context goes before the widget where the widget gets another window.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &TreeView::free_drawing,
          Qt::UniqueConnection);
  try {
    drawing_ = std::make_unique<glview::TreeDrawing>(blocks_);
  } catch (const Error& error) {
    trouble_ = tr("The graphics driver refuses the tree's drawing: %1").arg(QString::fromUtf8(error.what()));
  }
}

void TreeView::paintGL() {
  QElapsedTimer clock;
  clock.start();
  QPainter painter(this);
  painter.beginNativePainting();
  const QColor back = palette().color(QPalette::Base);
  if (trouble_.isEmpty()) {
    QOpenGLFunctions& gl = *context()->functions();
    gl.glClearColor(static_cast<float>(back.redF()), static_cast<float>(back.greenF()),
                    static_cast<float>(back.blueF()), 1.0f);
    gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    drawing_->draw(eye_, devicePixelRatioF(), shown_, highlight_);
    if (FrameLog::instance().on()) gl.glFinish();  // what is drawn later takes its time, too
  }
  painter.endNativePainting();
  painter.setRenderHint(QPainter::Antialiasing);
  if (!trouble_.isEmpty()) painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, trouble_);
  if (grid_) draw_grid(painter);
  draw_marks(painter);
  FrameLog::instance().painted(QStringLiteral("vessel_tree"),
                               static_cast<double>(clock.nsecsElapsed()) / 1e6);
}

void TreeView::draw_grid(QPainter& painter) const {
  const Vec3 size = high_ - low_;
  const double seen = eye_.pixel_mm() * height();
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

namespace {

void draw_labels(QPainter& painter, const std::vector<std::pair<QPointF, QString>>& labels) {
  std::vector<QRect> taken;
  for (const auto& [wanted, text] : labels) {
    QRect box = painter.fontMetrics().boundingRect(text).translated(wanted.toPoint()).adjusted(-3, -2, 3, 2);
    const QPoint place = box.topLeft();
    const auto crowded = [&](const QRect& other) { return other.intersects(box); };
    // Below what is there already.
    for (auto in = std::find_if(taken.begin(), taken.end(), crowded); in != taken.end();
         in = std::find_if(taken.begin(), taken.end(), crowded))
      box.moveTop(in->bottom() + 1);
    taken.push_back(box);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 0, 0, 170));
    painter.drawRect(box);
    painter.setPen(Qt::white);
    painter.drawText(wanted.toPoint() + (box.topLeft() - place), text);
  }
}

}  // namespace

void TreeView::draw_marks(QPainter& painter) const {
  std::vector<std::pair<QPointF, QString>> labels;
  for (const TreeMark& mark : marks_) {
    QPolygonF way;
    for (const Vec3& point : mark.points)
      if (const auto at = place_of(point)) way << *at;
    if (way.isEmpty()) continue;
    // The dark edge tells it from the segment that is chosen, which is yellow, too.
    for (const auto& [color, edge] : {std::pair(QColor(0, 0, 0, 190), 2.0), {QColor(255, 220, 60), 0.0}}) {
      painter.setPen(QPen(color, 2.0 + edge));
      painter.setBrush(color);
      painter.drawPolyline(way);
      for (const QPointF& at : way) painter.drawEllipse(at, 3.0 + 0.5 * edge, 3.0 + 0.5 * edge);
    }
    if (mark.text.isEmpty()) continue;
    const QPointF sum = std::accumulate(way.begin(), way.end(), QPointF());
    labels.emplace_back(sum / way.size() + QPointF(8, -8), mark.text);
  }
  draw_labels(painter, labels);
}

}  // namespace ostia::workstation
