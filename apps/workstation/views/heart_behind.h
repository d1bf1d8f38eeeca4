#pragma once
/// \file The heart behind the tree in 3D.

#include <functional>

class QComboBox;

namespace ostia::workstation {

struct Desk;
class SceneWidget;

/// The list that chooses what is behind the tree. The CT is reduced in the background once it is to be shown
/// and no image `is_being_read`.
QComboBox* heart_behind(Desk& desk, SceneWidget& scene, const std::function<bool()>& is_being_read);

}  // namespace ostia::workstation
