#include "fitting.h"

#include "bending.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <itkAffineTransform.h>
#include <itkBSplineInterpolateImageFunction.h>
#include <itkBSplineTransform.h>
#include <itkImage.h>
#include <itkLBFGSBOptimizer.h>
#include <itkMattesMutualInformationImageToImageMetric.h>
#include <itkMeanSquaresImageToImageMetric.h>
#include <itkMultiThreaderBase.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace ostia::registration {
namespace {

using ItkImage = itk::Image<float, 3>;
using ItkMetric = itk::ImageToImageMetric<ItkImage, ItkImage>;
using ItkSpline = itk::BSplineTransform<double, 3, 3>;
using ItkAffine = itk::AffineTransform<double, 3>;
using ItkArray = itk::OptimizerParameters<double>;

// The metric adds the sums of its work units in their order: their number decides on the last bits, the
// threads that do them do not.
constexpr unsigned work_units = 8;
constexpr int histogram_bins = 40;

/// The volume as ITK sees it, without a copy.
ItkImage::Pointer itk_view(const imaging::FloatVolume& volume) {
  auto image = ItkImage::New();
  ItkImage::SizeType size;
  ItkImage::SpacingType spacing;
  ItkImage::PointType origin;
  ItkImage::DirectionType direction;
  for (unsigned a = 0; a < 3; ++a) {
    size[a] = static_cast<itk::SizeValueType>(volume.geometry.size[a]);
    spacing[a] = volume.geometry.spacing[a];
    origin[a] = volume.geometry.origin[a];
    for (unsigned b = 0; b < 3; ++b) direction[a][b] = volume.geometry.direction(a, b);
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->GetPixelContainer()->SetImportPointer(const_cast<float*>(volume.voxels.data()), volume.voxels.size(),
                                               false);
  return image;
}

ItkMetric::Pointer empty_metric(Likeness likeness, bool few_parameters) {
  if (likeness == Likeness::mean_squares) {
    auto squares = itk::MeanSquaresImageToImageMetric<ItkImage, ItkImage>::New();
    return ItkMetric::Pointer(squares);
  }
  auto mutual = itk::MattesMutualInformationImageToImageMetric<ItkImage, ItkImage>::New();
  mutual->SetNumberOfHistogramBins(histogram_bins);
  mutual->SetUseExplicitPDFDerivatives(few_parameters);
  return ItkMetric::Pointer(mutual);
}

ItkMetric::Pointer metric_of(const ComparedImages& images, ItkMetric::TransformType* transform) {
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(
      static_cast<unsigned>(std::max(1, core::max_threads())));
  const bool few = transform->GetNumberOfParameters() <= 12;
  ItkMetric::Pointer metric = empty_metric(images.likeness, few);
  // Linear, but with derivatives that are its own, which the linear interpolator does not have.
  auto interpolator = itk::BSplineInterpolateImageFunction<ItkImage, double>::New();
  interpolator->SetSplineOrder(1);
  metric->SetFixedImage(itk_view(*images.fixed));
  metric->SetMovingImage(itk_view(*images.moving));
  metric->SetFixedImageRegion(metric->GetFixedImage()->GetBufferedRegion());
  metric->SetInterpolator(interpolator);
  metric->SetTransform(transform);
  metric->SetComputeGradient(false);
  metric->SetNumberOfWorkUnits(work_units);
  ItkMetric::FixedImageIndexContainer indexes;
  indexes.reserve(images.samples.size());
  for (const std::int64_t offset : images.samples)
    indexes.push_back(metric->GetFixedImage()->ComputeIndex(offset));
  metric->SetFixedImageIndexes(indexes);
  metric->Initialize();
  if (metric->GetNumberOfWorkUnits() != work_units)
    throw NumericalError("ITK does not take " + std::to_string(work_units) +
                         " work units, without which its results would depend on the machine");
  return metric;
}

/// The cost and its derivative at some parameters, as ITK's optimizers ask for it.
class FittedCost : public itk::SingleValuedCostFunction {
 public:
  using Self = FittedCost;
  using Superclass = itk::SingleValuedCostFunction;
  using Pointer = itk::SmartPointer<Self>;
  static Pointer New() {
    Pointer made = new Self;
    made->UnRegister();  // it is counted from the first on
    return made;
  }
  using Evaluation = std::function<double(const ParametersType&, DerivativeType&)>;

  unsigned count = 0;
  Evaluation evaluate;
  mutable double best = std::numeric_limits<double>::infinity();
  mutable ParametersType best_at;

  unsigned GetNumberOfParameters() const override { return count; }
  MeasureType GetValue(const ParametersType& at) const override {
    DerivativeType unused(count);
    MeasureType value = 0.0;
    GetValueAndDerivative(at, value, unused);
    return value;
  }
  void GetDerivative(const ParametersType& at, DerivativeType& derivative) const override {
    MeasureType unused = 0.0;
    GetValueAndDerivative(at, unused, derivative);
  }
  void GetValueAndDerivative(const ParametersType& at, MeasureType& value,
                             DerivativeType& derivative) const override {
    derivative.SetSize(count);
    value = evaluate(at, derivative);
    if (value < best) {
      best = value;
      best_at = at;
    }
  }
};

/// The best parameters that L-BFGS-B (Byrd, Lu, Nocedal, Zhu, SIAM J. Sci. Comput. 16:1190-1208, 1995) comes
/// by, from `start` on.
ItkArray minimized(const ItkArray& start, int iterations, const FittedCost::Evaluation& evaluate,
                   const core::TaskContext& task, double& cost) {
  auto function = FittedCost::New();
  function->count = start.GetSize();
  const double evaluations = 2.0 * iterations;
  double asked = 0.0;
  function->evaluate = [&](const ItkArray& at, ItkMetric::DerivativeType& derivative) {
    task.throw_if_cancelled();
    task.set_progress(std::min(1.0, asked / evaluations));
    asked += 1.0;
    return evaluate(at, derivative);
  };
  auto optimizer = itk::LBFGSBOptimizer::New();
  optimizer->SetCostFunction(function);
  optimizer->SetInitialPosition(start);
  itk::LBFGSBOptimizer::BoundSelectionType unbounded(start.GetSize());
  itk::LBFGSBOptimizer::BoundValueType bounds(start.GetSize());
  unbounded.Fill(0);
  bounds.Fill(0.0);
  optimizer->SetBoundSelection(unbounded);
  optimizer->SetLowerBound(bounds);
  optimizer->SetUpperBound(bounds);
  optimizer->SetCostFunctionConvergenceFactor(1e10);
  optimizer->SetProjectedGradientTolerance(1e-7);
  optimizer->SetMaximumNumberOfIterations(static_cast<unsigned>(iterations));
  optimizer->SetMaximumNumberOfEvaluations(static_cast<unsigned>(evaluations));
  optimizer->SetMaximumNumberOfCorrections(7);
  optimizer->StartOptimization();
  cost = function->best;
  return function->best_at.GetSize() == start.GetSize() ? function->best_at : start;
}

/// Calls ITK; what it throws becomes ours.
template <class Work>
auto by_itk(const Work& work) {
  try {
    return work();
  } catch (const itk::ExceptionObject& error) {
    const std::string text = error.GetDescription();
    if (text.find("outside") != std::string::npos || text.find("PDF") != std::string::npos)
      throw InvalidInput(no_overlap);
    throw NumericalError("the images could not be compared (ITK: " + text + ")");
  }
}

void set_map(ItkAffine& affine, const Mat3& linear, const Vec3& shift) {
  ItkAffine::ParametersType parameters(12);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) parameters[3 * row + column] = linear(row, column);
    parameters[9 + row] = shift[row];
  }
  affine.SetParameters(parameters);
}

/// Small parameters, all in mm at `reach_mm` from the centre, about a map: three turns or nine parts of a
/// linear change, then three shifts.
class LinearSteps {
 public:
  LinearSteps(const LinearMap& start, const LinearSearch& search)
      : start_(start),
        search_(search),
        shift_(start.linear * search.centre_mm + start.offset_mm - search.centre_mm) {}

  unsigned count() const { return search_.affine ? 12 : 6; }
  Mat3 linear(const ItkArray& at) const {
    return search_.affine ? Mat3(changed(at) * start_.linear) : Mat3(turn(turns(at)) * start_.linear);
  }
  Vec3 shift(const ItkArray& at) const {
    const unsigned first = count() - 3;
    return shift_ + Vec3(at[first], at[first + 1], at[first + 2]);
  }
  /// From the derivative over the twelve numbers of the map.
  void chain(const ItkArray& at, const ItkMetric::DerivativeType& over_map,
             ItkMetric::DerivativeType& derivative) const {
    Mat3 over_linear;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) over_linear(row, column) = over_map[3 * row + column];
    if (search_.affine) {
      const Mat3 over_change = over_linear * start_.linear.transpose();
      for (int i = 0; i < 9; ++i) derivative[i] = over_change(i / 3, i % 3) / search_.reach_mm;
    } else {
      constexpr double step = 1e-5;
      for (int i = 0; i < 3; ++i) {
        const Vec3 before = turns(at) - step * Vec3::Unit(i), after = turns(at) + step * Vec3::Unit(i);
        const Mat3 slope = (turn(after) - turn(before)) / (2.0 * step) * start_.linear;
        derivative[i] = over_linear.cwiseProduct(slope).sum() / search_.reach_mm;
      }
    }
    for (int i = 0; i < 3; ++i) derivative[count() - 3 + i] = over_map[9 + i];
  }
  LinearMap map(const ItkArray& at, double cost) const {
    const Mat3 there = linear(at);
    return {there, Vec3(shift(at) + search_.centre_mm - there * search_.centre_mm), cost};
  }

 private:
  Vec3 turns(const ItkArray& at) const { return Vec3(at[0], at[1], at[2]) / search_.reach_mm; }
  static Mat3 turn(const Vec3& by) {
    const double angle = by.norm();
    return angle > 0.0 ? Eigen::AngleAxisd(angle, by / angle).toRotationMatrix() : Mat3(Mat3::Identity());
  }
  Mat3 changed(const ItkArray& at) const {
    Mat3 change = Mat3::Identity();
    for (int i = 0; i < 9; ++i) change(i / 3, i % 3) += at[i] / search_.reach_mm;
    return change;
  }

  LinearMap start_;
  LinearSearch search_;
  Vec3 shift_;
};

ItkSpline::Pointer itk_spline(const imaging::Geometry& nodes) {
  auto spline = ItkSpline::New();
  ItkSpline::FixedParametersType grid(18);
  for (unsigned a = 0; a < 3; ++a) {
    grid[a] = static_cast<double>(nodes.size[a]);
    grid[3 + a] = nodes.origin[a];
    grid[6 + a] = nodes.spacing[a];
    for (unsigned b = 0; b < 3; ++b) grid[9 + 3 * a + b] = nodes.direction(a, b);
  }
  spline->SetFixedParameters(grid);
  return spline;
}

}  // namespace

std::vector<double> costs_of(const ComparedImages& images, const std::vector<LinearMap>& maps) {
  return by_itk([&] {
    auto affine = ItkAffine::New();
    const ItkMetric::Pointer metric = metric_of(images, affine);
    std::vector<double> costs;
    for (const LinearMap& map : maps) {
      set_map(*affine, map.linear, map.offset_mm);
      const ItkArray at = affine->GetParameters();
      try {
        costs.push_back(metric->GetValue(at));
      } catch (const itk::ExceptionObject&) {
        costs.push_back(std::numeric_limits<double>::max());
      }
    }
    return costs;
  });
}

LinearMap fitted_linear(const ComparedImages& images, const LinearMap& start, const LinearSearch& search,
                        const core::TaskContext& task) {
  return by_itk([&] {
    auto affine = ItkAffine::New();
    ItkAffine::InputPointType centre;
    for (unsigned a = 0; a < 3; ++a) centre[a] = search.centre_mm[a];
    affine->SetCenter(centre);
    const LinearSteps steps(start, search);
    ItkArray none(steps.count());
    none.Fill(0.0);
    set_map(*affine, steps.linear(none), steps.shift(none));
    const ItkMetric::Pointer metric = metric_of(images, affine);
    double cost = 0.0;
    const ItkArray best = minimized(
        none, search.iterations,
        [&](const ItkArray& at, ItkMetric::DerivativeType& derivative) {
          set_map(*affine, steps.linear(at), steps.shift(at));
          const ItkArray map = affine->GetParameters();
          double value = 0.0;
          ItkMetric::DerivativeType over_map(12);
          metric->GetValueAndDerivative(map, value, over_map);
          steps.chain(at, over_map, derivative);
          return value;
        },
        task, cost);
    return steps.map(best, cost);
  });
}

SplineGrid fitted_spline(const ComparedImages& images, const SplineGrid& start, double bending_weight,
                         int iterations, const core::TaskContext& task) {
  return by_itk([&] {
    const ItkSpline::Pointer spline = itk_spline(start.nodes);
    const ItkMetric::Pointer metric = metric_of(images, spline);
    const std::int64_t count = start.nodes.voxels();
    ItkArray first(static_cast<itk::SizeValueType>(3 * count));
    for (std::int64_t i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) first[c * count + i] = start.shifts_mm[i][c];
    double cost = 0.0;
    const ItkArray best = minimized(
        first, iterations,
        [&](const ItkArray& at, ItkMetric::DerivativeType& derivative) {
          double value = 0.0;
          metric->GetValueAndDerivative(at, value, derivative);
          return value + bending_cost(start.nodes, bending_weight, at.data_block(), derivative.data_block());
        },
        task, cost);
    SplineGrid fitted = start;
    for (std::int64_t i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) fitted.shifts_mm[i][c] = best[c * count + i];
    return fitted;
  });
}

}  // namespace ostia::registration
