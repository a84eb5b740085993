// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_ESTIMATOR_OPTIONS_HPP
#define RSACKERMANN_SAMPLES_ESTIMATOR_OPTIONS_HPP

#include "opencv2/rsackermann/motion.hpp"
#include "options.hpp"

namespace rsackermann_samples {

//! One of cv::rsackermann::SegmentDetector.
inline int readDetector(const Options& options)
{
    return options.choice("detector", {"lsd", "fld", "edlines"});
}

//! One of cv::rsackermann::MotionModel.
inline int readModel(const Options& options)
{
    using namespace cv::rsackermann;
    const int models[] = {MODEL_AUTO, MODEL_4LA, MODEL_3LA, MODEL_1LA, MODEL_NONE};
    return models[options.choice("model", {"auto", "4la", "3la", "1la", "none"})];
}

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_ESTIMATOR_OPTIONS_HPP
