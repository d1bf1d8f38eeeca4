#pragma once
/// \file A vessel tree of up to millions of segments in three dimensions, and the mouse in it.

#include "ostia/analysis/tree_ruler.h"
#include "ostia/geometry/segment_blocks.h"
#include "ostia/glview/tree_camera.h"
#include "ostia/glview/tree_drawing.h"

#include <QOpenGLWidget>
#include <memory>
#include <optional>
#include <vector>

class QPainter;

namespace ostia::workstation {

/// A line or a point over the picture, with what is to be read there.
struct TreeMark {
  std::vector<geometry::Vec3> points;
  QString text;
};

/// Drawn by glview::TreeDrawing. Left button: turn; with Shift, or the middle one: move; wheel or right
/// button: nearer, the wheel at the mouse. A click says what is under it.
class TreeView final : public QOpenGLWidget {
  Q_OBJECT
 public:
  TreeView(std::shared_ptr<const geometry::SegmentBlocks> blocks,
           std::shared_ptr<const analysis::TreeRays> rays, QWidget* parent = nullptr);
  ~TreeView() override;
  void fit();
  void set_grid(bool shown);
  void set_highlight(std::int32_t edge);
  void set_marks(std::vector<TreeMark> marks);
  void set_shown(std::vector<std::uint8_t> shown);  ///< empty: all
  const std::vector<std::uint8_t>& shown() const { return shown_; }
  /// What is under a place of the widget.
  std::optional<analysis::TreeRayHit> under(const QPointF& place) const;
  /// Where a point of the tree is on the widget; none behind the eye.
  std::optional<QPointF> place_of(const geometry::Vec3& point) const;
  const glview::TreeCamera& eye() const { return eye_; }
  QString trouble() const { return trouble_; }

 signals:
  void clicked(const QPointF& place);

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void free_drawing();
  void draw_grid(QPainter& painter) const;
  void draw_marks(QPainter& painter) const;
  void nearer(double factor, const std::optional<QPointF>& at);
  std::shared_ptr<const geometry::SegmentBlocks> blocks_;
  std::shared_ptr<const analysis::TreeRays> rays_;
  std::vector<std::uint8_t> shown_;
  std::vector<TreeMark> marks_;
  geometry::Vec3 low_, high_;
  glview::TreeCamera eye_;
  bool grid_ = false, moved_ = false;
  std::int32_t highlight_ = -1;
  QPointF pressed_, last_;
  QString trouble_;
  std::unique_ptr<glview::TreeDrawing> drawing_;
};

}  // namespace ostia::workstation
