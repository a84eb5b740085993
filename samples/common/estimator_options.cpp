// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "estimator_options.hpp"

#include "opencv2/rsackermann/motion.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

const std::vector<std::string> DETECTOR_WORDS = {"lsd", "fld", "edlines", "verticals"};

const char* const DETECTOR_KEY = "{detector   | verticals | line segment detector: verticals, lsd, fld or edlines}";

int readDetector(const Options& options)
{
    return options.choice("detector", DETECTOR_WORDS);
}

int readModel(const Options& options)
{
    const int models[] = {MODEL_AUTO, MODEL_4LA, MODEL_3LA, MODEL_1LA, MODEL_NONE};
    return models[options.choice("model", {"auto", "4la", "3la", "1la", "none"})];
}

} // namespace rsackermann_samples
