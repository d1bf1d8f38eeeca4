#pragma once
/// \file The choice of what is behind the tree in 3D.

class QComboBox;

namespace ostia::workstation {

class SceneWidget;

/// The list that chooses it: nothing, the heart (heart_volume.h), a MIP.
QComboBox* heart_behind(SceneWidget& scene);

}  // namespace ostia::workstation
