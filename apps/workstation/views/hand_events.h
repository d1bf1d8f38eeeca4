#pragma once
/// \file Between Qt's mouse and the hands of `view`.

#include "ostia/view/pointer.h"

#include <Qt>

namespace ostia::workstation {

/// Without its place: whoever sends it knows how it counts pixels.
inline view::PointerEvent hand_event(Qt::MouseButton button, Qt::KeyboardModifiers keys) {
  view::PointerEvent event;
  event.button = button == Qt::LeftButton     ? view::Button::left
                 : button == Qt::MiddleButton ? view::Button::middle
                 : button == Qt::RightButton  ? view::Button::right
                                              : view::Button::none;
  event.shift = keys & Qt::ShiftModifier;
  event.control = keys & Qt::ControlModifier;
  event.alt = keys & Qt::AltModifier;
  return event;
}

inline Qt::CursorShape cursor_of(view::CursorShape shape) {
  switch (shape) {
    case view::CursorShape::arrow:
      return Qt::ArrowCursor;
    case view::CursorShape::cross:
      return Qt::CrossCursor;
    case view::CursorShape::grab:
      return Qt::PointingHandCursor;
    case view::CursorShape::turn:
      return Qt::SizeHorCursor;
    case view::CursorShape::move:
      return Qt::SizeAllCursor;
    case view::CursorShape::contrast:
      return Qt::SizeFDiagCursor;
  }
  return Qt::ArrowCursor;
}

}  // namespace ostia::workstation
