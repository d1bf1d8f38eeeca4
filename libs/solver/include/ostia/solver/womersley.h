#pragma once
/// \file Pulsatile flow in a straight circular tube (Womersley, J Physiol 1955).

#include <complex>

namespace ostia::solver {

/// alpha = R sqrt(omega / nu).
double womersley_number(double radius_mm, double angular_frequency, double viscosity_mm2_s);

/// Complex amplitude of the velocity at r = `radius` R over that of the section's mean velocity:
/// (1 - J0(z r/R) / J0(z)) / (1 - 2 J1(z) / (z J0(z))) with z = i^(3/2) alpha. For alpha -> 0 it is the
/// parabola 2 (1 - r^2/R^2). Relative error below 1e-9 for any alpha. Throws InvalidInput for a negative
/// alpha or a radius outside [0, 1].
std::complex<double> womersley_profile(double alpha, double radius);

/// Bessel function of order 0 or 1 at i^(3/2) x, times exp(-x / sqrt(2)), which keeps it finite. x >= 0.
std::complex<double> scaled_bessel(int order, double x);

}  // namespace ostia::solver
