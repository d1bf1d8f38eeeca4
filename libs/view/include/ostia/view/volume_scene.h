#pragma once
/// \file The CT itself in three dimensions.

#include "ostia/imaging/volume.h"
#include "ostia/view/volume_cuts.h"
#include "ostia/view/volume_look.h"

#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

class vtkImageData;
class vtkVolume;
class vtkGPUVolumeRayCastMapper;
class vtkVolumeProperty;

namespace ostia::view {

enum class VolumeMode {
  off,
  rendering,  ///< as its look says (volume_look.h), lit
  mip,        ///< the greatest value along each ray
};

/// How finely the volume is drawn. A step takes about the time that `next_level_cost` says more.
enum class VolumeQuality {
  hidden,
  coarse,  ///< two voxels between samples, one of 4 x 4 pixels
  medium,  ///< a voxel, one of 2 x 2 pixels
  fine,    ///< a voxel, every pixel
  full,    ///< half a voxel, every pixel
};
/// The next finer level's work over this one's, where work is all that takes time; 1 for `full`.
double next_level_cost(VolumeQuality quality);
VolumeQuality finer(VolumeQuality quality);  ///< `full` stays

/// A vtkVolume of a CT image at its place in the patient, oblique axes included. The voxels are not copied.
/// To be used from the thread that renders.
class VolumeScene {
 public:
  VolumeScene();
  ~VolumeScene();
  VolumeScene(const VolumeScene&) = delete;
  VolumeScene& operator=(const VolumeScene&) = delete;

  vtkVolume* prop() const;  ///< for a vtkRenderer
  /// An image small enough for the machine (reduced_volume); null takes it away. Throws InvalidInput where
  /// sizes and voxels disagree or an axis has fewer than two voxels.
  void set_image(std::shared_ptr<const imaging::ImageVolume> image);
  void set_mode(VolumeMode mode);
  /// Of the image that is there (volume_light.h), one a voxel: the rendering is darker in hollows. Null: the
  /// lamps alone, which takes less time. Another image takes it away. Throws InvalidInput for another number.
  void set_ambient_light(std::shared_ptr<const std::vector<float>> light);
  /// The window of the 2D views, which the MIP follows. Throws InvalidInput for a width that is not positive.
  void set_window(double level_hu, double width_hu);
  void set_look(const VolumeLook& look);  ///< of the rendering; throws InvalidInput
  void set_crop(const VolumeCrop& crop);  ///< throws InvalidInput; stays when the image changes
  void set_quality(VolumeQuality quality);

  VolumeMode mode() const { return mode_; }
  VolumeQuality quality() const { return quality_; }
  bool has_image() const { return image_ != nullptr; }
  std::vector<geometry::Vec3> corners() const;  ///< of what the box leaves of it; none without an image
  const VolumeLook& look() const { return look_; }
  const VolumeCrop& crop() const { return crop_; }
  /// Takes image, mode, window, look and box of another.
  void copy_from(const VolumeScene& other);

 private:
  void apply();
  void apply_colors();
  void apply_crop();
  void apply_light();
  std::shared_ptr<const imaging::ImageVolume> image_;
  VolumeMode mode_ = VolumeMode::off;
  VolumeQuality quality_ = VolumeQuality::coarse;
  double level_hu_ = 250.0, width_hu_ = 800.0;
  VolumeLook look_;
  VolumeCrop crop_;
  std::shared_ptr<const std::vector<float>> light_;
  vtkSmartPointer<vtkImageData> data_;
  vtkSmartPointer<vtkVolume> volume_;
  vtkSmartPointer<vtkGPUVolumeRayCastMapper> mapper_;
  vtkSmartPointer<vtkVolumeProperty> property_;
};

}  // namespace ostia::view
