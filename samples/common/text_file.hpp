// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_TEXT_FILE_HPP
#define RSACKERMANN_SAMPLES_TEXT_FILE_HPP

#include <fstream>
#include <string>

namespace rsackermann_samples {

/** Opens a text behind the mark of UTF-8 that some editors put before it.
@return a stream that has failed if the file is missing, a folder or can't be read. */
std::ifstream openText(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_TEXT_FILE_HPP
