#include "opening/orientation_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr std::array<const char*, 3> sides{"LR", "PA", "SI"};

std::size_t patient_axis_of(char letter) {
  for (std::size_t axis = 0; axis < sides.size(); ++axis)
    if (letter == sides[axis][0] || letter == sides[axis][1]) return axis;
  return 0;
}

char other_side(char letter) {
  const char* both = sides[patient_axis_of(letter)];
  return letter == both[0] ? both[1] : both[0];
}

}  // namespace

OrientationDialog::OrientationDialog(std::shared_ptr<const imaging::ImageVolume> volume,
                                     const imaging::Geometry& as_read, const std::string& axes,
                                     const session::GreyWindow& grey, bool closes_case, QWidget* parent)
    : FittedDialog(parent),
      image_{std::move(volume), imaging::given_axes(as_read, axes), {}},
      as_read_(as_read),
      grey_(grey) {
  setObjectName("orientation");
  setWindowTitle(tr("Set orientation"));
  setMinimumWidth(std::min(720, parent->width() - 40));
  auto* rows = new QVBoxLayout(this);
  auto* how = new QLabel(
      tr("Turn and flip until the letters are right: the breastbone at A, the spine at P, the heart's tip "
         "towards L, the liver at R and I."));
  how->setWordWrap(true);
  rows->addWidget(how);
  rows->addWidget(slices(), 1);
  rows->addWidget(choices());
  told_ = new QLabel;
  told_->setObjectName("orientation_told");
  told_->setWordWrap(true);
  rows->addWidget(told_);
  if (closes_case) {
    auto* note = new QLabel(
        tr("The case that is open was made of the image as it was. It is kept and closed; the arteries are "
           "looked for anew."));
    note->setObjectName("orientation_closes_case");
    note->setWordWrap(true);
    rows->addWidget(note);
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  auto* as_file = buttons->addButton(tr("As in the file"), QDialogButtonBox::ResetRole);
  as_file->setObjectName("orientation_as_file");
  connect(as_file, &QPushButton::clicked, this, [this] { set_axes(imaging::axes_of(as_read_)); });
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  rows->addWidget(buttons);
  // Return is OK wherever the keyboard is, and not the first of the buttons.
  for (QPushButton* one : findChildren<QPushButton*>()) one->setAutoDefault(false);
  buttons->button(QDialogButtonBox::Ok)->setDefault(true);
  set_axes(axes.empty() ? imaging::axes_of(as_read_) : axes);
}

QWidget* OrientationDialog::slices() {
  auto* part = new QWidget;
  auto* grid = new QGridLayout(part);
  grid->setContentsMargins(0, 0, 0, 0);
  const std::array titles{tr("Axial, seen from the feet"), tr("Coronal, seen from the front"),
                          tr("Sagittal, seen from the left")};
  const std::array names{"axial", "coronal", "sagittal"};
  for (std::size_t n = 0; n < 3; ++n) {
    const auto which = static_cast<MidSlice>(n);
    const int column = static_cast<int>(n);
    slices_[n] = new OrientationSlice(which, titles[n]);
    slices_[n]->setObjectName(QStringLiteral("orientation_%1").arg(names[n]));
    grid->addWidget(new QLabel(titles[n]), 0, column);
    grid->addWidget(slices_[n], 1, column);
    auto* turned = new QPushButton(tr("Turn by 90\u00b0"));
    turned->setObjectName(QStringLiteral("orientation_turn_%1").arg(names[n]));
    turned->setAccessibleName(tr("Turn by 90\u00b0: %1").arg(titles[n]));
    connect(turned, &QPushButton::clicked, this, [this, which] { turn(which); });
    grid->addWidget(turned, 2, column);
  }
  grid->setRowStretch(1, 1);
  return part;
}

QWidget* OrientationDialog::choices() {
  auto* part = new QWidget;
  auto* columns = new QHBoxLayout(part);
  columns->setContentsMargins(0, 0, 0, 0);
  auto* axes = new QFormLayout;
  const std::array titles{tr("Columns run towards"), tr("Rows run towards"), tr("Slices run towards")};
  for (std::size_t n = 0; n < 3; ++n) {
    auto* choice = new QComboBox;
    choice->setObjectName(QStringLiteral("orientation_axis_%1").arg(n + 1));
    choice->setAccessibleName(titles[n]);
    for (const auto& [text, letter] : {std::pair(tr("Left (L)"), 'L'),
                                       {tr("Right (R)"), 'R'},
                                       {tr("Back (P)"), 'P'},
                                       {tr("Front (A)"), 'A'},
                                       {tr("Head (S)"), 'S'},
                                       {tr("Feet (I)"), 'I'}})
      choice->addItem(text, QChar(letter));
    connect(choice, QOverload<int>::of(&QComboBox::activated), this, [this, n] { chosen(n); });
    towards_[n] = choice;
    axes->addRow(titles[n], choice);
  }
  columns->addLayout(axes);
  columns->addStretch(1);
  auto* flips = new QVBoxLayout;
  const std::array texts{tr("Flip left and right"), tr("Flip front and back"), tr("Flip head and feet")};
  for (std::size_t n = 0; n < 3; ++n) {
    auto* button = new QPushButton(texts[n]);
    button->setObjectName(QStringLiteral("orientation_flip_%1").arg(n + 1));
    connect(button, &QPushButton::clicked, this, [this, n] { flip(n); });
    flips->addWidget(button);
  }
  columns->addLayout(flips);
  return part;
}

void OrientationDialog::set_axes(const std::string& axes) {
  axes_ = axes;
  refresh();
}

/// Another axis that had this pair of sides takes over the former one of this: each pair stays there once.
void OrientationDialog::chosen(std::size_t image_axis) {
  const char wanted = towards_[image_axis]->currentData().toChar().toLatin1();
  std::string axes = axes_;
  for (std::size_t other = 0; other < 3; ++other)
    if (other != image_axis && patient_axis_of(axes[other]) == patient_axis_of(wanted))
      axes[other] = axes[image_axis];
  axes[image_axis] = wanted;
  set_axes(axes);
}

void OrientationDialog::flip(std::size_t patient_axis) {
  std::string axes = axes_;
  for (char& letter : axes)
    if (patient_axis_of(letter) == patient_axis) letter = other_side(letter);
  set_axes(axes);
}

/// Clockwise as it is seen: what is to the right goes down, what is below goes to the left.
void OrientationDialog::turn(MidSlice seen) {
  const SliceLetters at = letters_of(seen);
  std::string axes = axes_;
  for (char& letter : axes) {
    if (letter == *at.right)
      letter = *at.below;
    else if (letter == *at.below)
      letter = *at.left;
    else if (letter == *at.left)
      letter = *at.above;
    else if (letter == *at.above)
      letter = *at.right;
  }
  set_axes(axes);
}

void OrientationDialog::refresh() {
  image_.wanted = imaging::given_axes(as_read_, axes_);
  for (OrientationSlice* one : slices_) one->show_image(image_, grey_);
  for (std::size_t n = 0; n < 3; ++n) towards_[n]->setCurrentIndex(towards_[n]->findData(QChar(axes_[n])));
  const std::string file = imaging::axes_of(as_read_);
  QString told =
      axes_ == file
          ? tr("Axes %1, as the file says.").arg(QString::fromStdString(axes_))
          : tr("Axes %1; the file says %2.").arg(QString::fromStdString(axes_), QString::fromStdString(file));
  if (imaging::mirrored(axes_, file))
    told += QStringLiteral(" ") + tr("This mirrors the patient: left and right of the heart are exchanged "
                                     "against the file. Be sure of it.");
  told_->setText(told);
  fit();
}

}  // namespace ostia::workstation
