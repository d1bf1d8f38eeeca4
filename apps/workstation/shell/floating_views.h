#pragma once
/// \file Views that stand in windows of their own, on another monitor, and come back.

#include <QMap>
#include <QObject>
#include <QPointer>
#include <QRect>
#include <QTimer>
#include <functional>
#include <string>
#include <vector>

class QSplitter;

namespace ostia::workstation {

/// A view of the main window. `leave` is called before it is taken out, `come_back` puts it back.
struct FloatingView {
  QWidget* view = nullptr;  ///< known by its object name
  QString title{};
  std::function<void()> leave{}, come_back{};
};

/// A hidden part keeps its place in the splitter.
FloatingView in_splitter(QWidget& view, const QString& title);

class FloatingViews final : public QObject {
  Q_OBJECT
 public:
  explicit FloatingViews(QWidget& main);
  void add(FloatingView view);
  const std::vector<FloatingView>& all() const { return all_; }
  bool floats(const QString& name) const { return windows_.contains(name); }
  /// Nothing where it is so already, or there is no view of the name.
  void set_floating(const QString& name, bool floating);
  void bring_all_back();
  /// Which views float, and where; for the settings of this machine.
  std::string places() const;
  /// As `places` wrote them; what is none of them is left out. Windows that would stand on no screen come to
  /// the nearest one. They are shown with the main window.
  void restore(const std::string& places);

 signals:
  void changed();  ///< another view floats, or one no longer

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  const FloatingView* find(const QString& name) const;
  void float_at(const FloatingView& view, const QRect& place);
  void come_back(const QString& name);
  QRect first_place(const FloatingView& view) const;
  void look_after();
  QWidget& main_;
  std::vector<FloatingView> all_;
  QMap<QString, QPointer<QWidget>> windows_;
  QMap<QString, QRect> stood_;  // where each was before it came back
  QTimer soon_;                 // after monitors came or went
};

}  // namespace ostia::workstation
