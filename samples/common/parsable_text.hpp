// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP
#define RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP

#include <string>

namespace rsackermann_samples {

/** The text of a YAML, XML or JSON file of up to a megabyte that can be given to a parser. Throws UsageError for one
that is nested so deeply that a parser, which calls itself, would end the program, and for a YAML file of
cv::FileStorage, known by its first line, that isn't one map: its parser may never come to the end of it. */
std::string readParsableText(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP
