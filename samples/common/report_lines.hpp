// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_REPORT_LINES_HPP
#define RSACKERMANN_SAMPLES_REPORT_LINES_HPP

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace rsackermann_samples {

/** Hands over each line of a report of rsackermann_correct with words for its place. Throws InputError with the place
if a line isn't JSON or use() throws an exception of JSON. */
void readReportLines(const std::string& path,
                     const std::function<void(const nlohmann::json& line, const std::string& source)>& use);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_REPORT_LINES_HPP
