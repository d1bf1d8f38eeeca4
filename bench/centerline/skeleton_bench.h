#pragma once
/// \file Benchmarks of skeletons.

void add_skeleton_benchmarks();
