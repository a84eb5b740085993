// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_TABLE_HPP
#define RSACKERMANN_PERF_TABLE_HPP

#include <string>
#include <vector>

namespace experiments {

//! Columns of a file of comma-separated values, row by row; throws InputError if it can't be read or lacks one of them.
std::vector<std::vector<std::string>> readTable(const std::string& file, const std::vector<std::string>& columns);

} // namespace experiments

#endif // RSACKERMANN_PERF_TABLE_HPP
