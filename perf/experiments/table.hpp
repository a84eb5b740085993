// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_TABLE_HPP
#define RSACKERMANN_PERF_TABLE_HPP

#include <string>
#include <vector>

namespace experiments {

//! The rows of a file of comma-separated values; throws InputError where it can't be read or has other columns.
std::vector<std::vector<std::string> > readTable(const std::string& file, const std::vector<std::string>& columns);

} // namespace experiments

#endif // RSACKERMANN_PERF_TABLE_HPP
