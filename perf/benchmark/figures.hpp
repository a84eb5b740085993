// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_FIGURES_HPP
#define RSACKERMANN_PERF_FIGURES_HPP

#include "benchmark.hpp"

namespace benchmark {

void addSolverFigures(Benchmark& benchmark);
void addEstimateFigures(Benchmark& benchmark);
void addMapFigures(Benchmark& benchmark);
void addCorrectFigures(Benchmark& benchmark);
void addFolderFigures(Benchmark& benchmark);

} // namespace benchmark

#endif // RSACKERMANN_PERF_FIGURES_HPP
