// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "motion_words.hpp"

namespace rsackermann_samples {

const std::vector<std::string> STATUS_WORDS = {"ok", "not_significant", "too_few_segments", "no_consensus",
                                               "not_observable"};
const std::vector<std::string> SCALE_WORDS = {"unknown", "wall", "road", "speed"};

} // namespace rsackermann_samples
