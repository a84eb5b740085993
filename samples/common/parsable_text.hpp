// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP
#define RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP

#include <string>

namespace rsackermann_samples {

/** The text of a YAML, XML or JSON file of up to a megabyte that can be given to a parser: parsers are for files that
somebody means well with. Throws UsageError for one that is nested so deeply that a parser, which calls itself, ends the
program, and for a YAML file of cv::FileStorage with more than one document, which its parser may read for ever. */
std::string readParsableText(const std::string& path);

//! Without the first line of a YAML file of cv::FileStorage, a directive that isn't YAML.
std::string withoutDirective(const std::string& text);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PARSABLE_TEXT_HPP
