// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_CASES_HPP
#define RSACKERMANN_PERF_CASES_HPP

#include "experiment.hpp"
#include "options.hpp"

namespace experiments {

//! The options that makeCases() reads, in the form of cv::CommandLineParser.
extern const char* const CASE_KEYS;

//! The images of an experiment: streets to be rendered, or photographs with simulated motion; throws UsageError or
//! InputError.
std::vector<Case> makeCases(const rsackermann_samples::Options& options);

} // namespace experiments

#endif // RSACKERMANN_PERF_CASES_HPP
