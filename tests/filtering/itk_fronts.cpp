#include "itk_peer_image.h"
#include "itk_peers.h"

#include <itkFastMarchingImageFilter.h>
#include <itkGeodesicActiveContourLevelSetImageFilter.h>

namespace ostia::filtering::peers {

FloatVolume itk_marched(const FloatVolume& speed, const std::vector<std::array<std::int64_t, 3>>& seeds,
                        const std::vector<double>& times, double stop) {
  use_our_number_of_threads();
  using Marching = itk::FastMarchingImageFilter<PeerImage, PeerImage>;
  auto nodes = Marching::NodeContainer::New();
  nodes->Initialize();
  for (std::size_t n = 0; n < seeds.size(); ++n) {
    Marching::NodeType node;
    node.SetValue(static_cast<float>(times[n]));
    node.SetIndex({{seeds[n][0], seeds[n][1], seeds[n][2]}});
    nodes->InsertElement(n, node);
  }
  auto filter = Marching::New();
  filter->SetInput(lent(speed));
  filter->SetTrialPoints(nodes);
  filter->SetStoppingValue(stop);
  filter->Update();
  return taken(*filter->GetOutput(), speed.geometry);
}

FloatVolume itk_geodesic(const FloatVolume& initial, const FloatVolume& edges, double propagation,
                         double advection, int most_iterations, double most_rms, int& iterations) {
  use_our_number_of_threads();
  auto filter = itk::GeodesicActiveContourLevelSetImageFilter<PeerImage, PeerImage>::New();
  filter->SetInput(lent(initial));
  filter->SetFeatureImage(lent(edges));
  filter->SetIsoSurfaceValue(0.0);
  filter->SetDerivativeSigma(0.0F);
  filter->SetPropagationScaling(propagation);
  filter->SetAdvectionScaling(advection);
  filter->SetCurvatureScaling(0.0);
  filter->SetNumberOfIterations(static_cast<unsigned>(most_iterations));
  filter->SetMaximumRMSError(most_rms);
  filter->Update();
  iterations = static_cast<int>(filter->GetElapsedIterations());
  return taken(*filter->GetOutput(), initial.geometry);
}

}  // namespace ostia::filtering::peers
