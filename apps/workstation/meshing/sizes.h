#pragma once
/// \file Fields of the export dialogs about the triangles' size and the tubes before the ends.

#include "meshing/fields.h"

#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/sizing.h"

#include <QObject>
#include <optional>
#include <vector>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;

namespace ostia::workstation {

/// How long edges are, and what is added beyond the ends; kept for the next time.
struct SizeChoice {
  enum class Size { as_modelled, by_calibre, even };  ///< the first for a surface alone
  Size size = Size::by_calibre;
  double edges_around = 16.0, edge_mm = 0.4;
  // of a mesh
  double stenosis_share = 1.0;   ///< of the edge length at stenoses
  double curvature_ratio = 0.0;  ///< edge over the wall's least radius of curvature; 0: not looked at
  double size_radii = 0.0;       ///< bound on the distance to the axis, in radii; 0: none
  double extensions = 0.0;       ///< diameters; 0: none
};

/// The rows about it.
class SizeFields final : public QObject {
  Q_OBJECT
 public:
  /// `mesh`: with what a mesh alone is asked; else with the size that the model has.
  SizeFields(QFormLayout* form, const SizeChoice& last, bool mesh, QObject* parent);
  SizeChoice choice() const;
  /// Nothing for as fine as the model. Of sound fields alone.
  std::optional<meshing::SizingOptions> sizing() const;
  std::optional<meshing::FlowExtensionOptions> extensions() const;
  /// Marks what is wrong; `of_mesh` is what else is wrong with the size. Returns whether nothing is.
  bool check(const QString& of_mesh);
  bool sound() const;  ///< nothing is wrong by itself: it can be computed with
  void scale_edges(double factor);

 signals:
  void changed();

 private:
  void add_triangles(QFormLayout* form, const SizeChoice& last, bool mesh);
  void add_places(QFormLayout* form, const SizeChoice& last);
  void add_extensions(QFormLayout* form, const SizeChoice& last);
  /// A number with what it may be.
  struct Bounded {
    FormField field;
    QDoubleSpinBox* box = nullptr;
    double low = 0.0, high = 0.0;
    bool may_be_none = false;
    QString wrong;
    bool good() const;
  };
  QString size_trouble() const;
  void add_bounded(QFormLayout* form, const QString& text, const Bounded& number);
  QDoubleSpinBox* number(const QString& name, const QString& accessible, int decimals, double value);
  QComboBox* size_ = nullptr;
  QDoubleSpinBox *edges_ = nullptr, *edge_mm_ = nullptr;
  QDoubleSpinBox *stenoses_ = nullptr, *curvature_ = nullptr, *radii_ = nullptr, *extensions_ = nullptr;
  FormField size_field_;
  std::vector<Bounded> bounded_;
};

}  // namespace ostia::workstation
