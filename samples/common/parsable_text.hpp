// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP
#define RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP

#include "opencv2/core.hpp"
#include <string>

namespace rsackermann_samples {

/** The text of a YAML, XML or JSON file, compressed by gzip or not, that can be given to a parser. Throws UsageError
for one that is larger than so many bytes, or nested so deeply that a parser, which calls itself, would end the program,
and for a YAML file of cv::FileStorage, known by its first line, that isn't one map: its parser may never come to the
end of it. */
std::string readParsableText(const std::string& path, size_t largest = 1 << 20);

//! A file of cv::FileStorage that is a map; throws InputError.
cv::FileStorage readStorage(const std::string& path, size_t largest = 1 << 20);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP
