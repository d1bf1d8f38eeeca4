#pragma once
/// \file The orientation of the image on the table, where its file says it wrongly or not at all.

#include <QObject>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Desk;
class Opening;

/// Each orientation that is given is a step beside those of cases: it can be taken back, and with it comes
/// the case that was open before. The case that is made afterwards keeps the orientation.
class Orientation final : public QObject {
  Q_OBJECT
 public:
  /// `search`: what follows where a person says that it is right as it is, and there is no case.
  Orientation(Desk& desk, Opening& opening, std::function<void()> search);
  bool can_be_set() const;  ///< there is an image, and it is whole
  void ask();
  bool can_take_back() const;
  bool can_do_again() const;
  void take_back();
  void do_again();

 private:
  struct Step {
    std::string image_sha256, from, to;
    std::filesystem::path former_case;  ///< empty where none was open
  };
  bool stands_at(const Step& step, const std::string& axes) const;
  void give(const std::string& axes);
  Desk& desk_;
  Opening& opening_;
  std::function<void()> search_;
  std::vector<Step> done_, undone_;
};

}  // namespace ostia::workstation
