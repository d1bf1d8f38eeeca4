#pragma once
/// \file The heart behind the tree in 3D.

class QComboBox;

namespace ostia::workstation {

struct Desk;
class Opening;
class SceneWidget;

/// The list that chooses what is behind the tree. The CT is reduced in the background once it is to be shown
/// and all of it has been read.
QComboBox* heart_behind(Desk& desk, SceneWidget& scene, const Opening& opening);

}  // namespace ostia::workstation
