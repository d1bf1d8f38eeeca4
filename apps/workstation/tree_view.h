#pragma once
/// \file A vessel tree of up to millions of segments in three dimensions, and the mouse in it.

#include "ostia/analysis/tree_ruler.h"

#include <QOpenGLFunctions_3_3_Core>

#include <QOpenGLWidget>
#include <memory>
#include <optional>
#include <vector>

class QOpenGLShaderProgram;
class QPainter;

namespace ostia::workstation {

/// A line or a point over the picture, with what is to be read there.
struct TreeMark {
  std::vector<geometry::Vec3> points;
  QString text;
};

/// Each segment is drawn as a strip that faces the eye, shaded as the cone that it stands for and never
/// thinner than a pixel. Left button: turn; with Shift, or the middle one: move; wheel or right button:
/// nearer. A click says what is under it.
class TreeView final : public QOpenGLWidget, protected QOpenGLFunctions_3_3_Core {
  Q_OBJECT
 public:
  TreeView(std::shared_ptr<const geometry::VesselGraph> graph, std::shared_ptr<const analysis::TreeRays> rays,
           QWidget* parent = nullptr);
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
  double pixel_mm() const;  ///< at the point that the view turns about
  QString trouble() const { return trouble_; }

 signals:
  void clicked(const QPointF& place);

 protected:
  void initializeGL() override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void free_buffers();
  void fill_buffer();
  void draw_tree();
  void draw_grid(QPainter& painter) const;
  void draw_marks(QPainter& painter) const;
  geometry::Vec3 eye() const { return target_ + distance_ * back_; }
  void turn(const QPointF& by);
  void move(const QPointF& by);
  void nearer(double factor);
  std::shared_ptr<const geometry::VesselGraph> graph_;
  std::shared_ptr<const analysis::TreeRays> rays_;
  std::vector<std::uint8_t> shown_;
  std::vector<TreeMark> marks_;
  geometry::Vec3 low_, high_, target_;
  geometry::Vec3 right_{1, 0, 0}, up_{0, 0, 1}, back_{0, -1, 0};
  double distance_ = 1.0;
  bool grid_ = false, moved_ = false, stale_ = true;
  std::int32_t highlight_ = -1;
  int drawn_ = 0;
  QPointF pressed_, last_;
  QString trouble_;
  std::unique_ptr<QOpenGLShaderProgram> program_;
  unsigned int array_ = 0, buffer_ = 0;
};

}  // namespace ostia::workstation
