// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PAGE_TEXT_HPP
#define RSACKERMANN_SAMPLES_PAGE_TEXT_HPP

#include <nlohmann/json.hpp>

namespace rsackermann_samples {

//! The lines of a report, without what is large, of each frame the last one; throws InputError.
std::vector<nlohmann::json> readPageFrames(const std::string& report);

//! The page with its data.
std::string pageText(const nlohmann::json& data);

//! The address of a picture that holds all of it.
std::string dataAddress(const std::vector<unsigned char>& jpeg);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PAGE_TEXT_HPP
