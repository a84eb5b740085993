// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_SUMMARY_HPP
#define RSACKERMANN_PERF_SUMMARY_HPP

#include "experiment.hpp"

namespace experiments {

//! Prints a line for each case, under a line with the names of the columns.
void printCases(const std::vector<Case>& cases, const std::vector<Result>& results);

//! Prints quantiles of the displacements and errors, and how often the truth lies within the estimator's standard
//! deviations.
void printSummary(const std::vector<Result>& results);

} // namespace experiments

#endif // RSACKERMANN_PERF_SUMMARY_HPP
