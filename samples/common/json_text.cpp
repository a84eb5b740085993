// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "json_text.hpp"

namespace rsackermann_samples {

nlohmann::json parseJson(const std::string& text, bool throws)
{
    return nlohmann::json::parse(text, nullptr, throws);
}

} // namespace rsackermann_samples
